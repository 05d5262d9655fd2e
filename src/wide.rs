//! Plain loops, compiled for the widest vector registers of the processor.

#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};
use pulp::{NullaryFnOnce, Scalar, Simd, WithSimd};

/// Runs `work` compiled for the widest registers that the processor has; its loops, and what it calls, must be inlined to
/// gain by it. A closure that changes what it captures is inlined only if it is short; a struct always is. The results have
/// the same bits on any processor: what is fused is so everywhere, and nothing is reordered.
pub fn widest<T>(work: impl NullaryFnOnce<Output = T>) -> T {
    widest_registers(Plain(work))
}

/// Does the same for work that names the registers itself.
pub fn widest_registers<T>(work: impl WithSimd<Output = T>) -> T {
    #[cfg(target_arch = "x86_64")]
    if let Some(machine) = V4::try_new() {
        return Simd::vectorize(machine, work);
    } else if let Some(machine) = V3::try_new() {
        return Simd::vectorize(machine, work);
    }
    work.with_simd(Scalar)
}

/// Work that leaves the registers to the compiler.
struct Plain<F>(F);

impl<F: NullaryFnOnce> WithSimd for Plain<F> {
    type Output = F::Output;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> F::Output {
        self.0.call()
    }
}
