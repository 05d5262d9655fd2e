//! Work in the vector registers of the processor. Its results have the same bits on any processor: each number of a register goes
//! through the same operations in the same order, nothing is reordered, and what is fused is so everywhere.

use std::any::TypeId;

#[cfg(target_arch = "x86_64")]
use pulp::Scalar128b;
#[cfg(target_arch = "aarch64")]
use pulp::aarch64::Neon;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};
use pulp::{NullaryFnOnce, Scalar, WithSimd};

use crate::keyword::keywords;

/// Vector instructions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Simd {
    /// None: one number at a time, or two where the processor has no instruction to multiply and add in one.
    Scalar,
    /// Two numbers in a register of 128 bits: aarch64.
    Neon,
    /// Four numbers in a register of 256 bits.
    Avx2,
    /// Eight numbers in a register of 512 bits.
    Avx512,
}

keywords!(Simd { Scalar = "scalar", Neon = "neon", Avx2 = "avx2", Avx512 = "avx512" });

impl Simd {
    /// Returns the widest that this processor has.
    pub fn fastest() -> Simd {
        let wide = [Simd::Avx512, Simd::Avx2, Simd::Neon];
        wide.into_iter().find(|simd| simd.is_available()).unwrap_or(Simd::Scalar)
    }

    /// Whether this processor has the registers.
    pub fn is_available(self) -> bool {
        match self {
            Simd::Scalar => true,
            #[cfg(target_arch = "aarch64")]
            Simd::Neon => Neon::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => V3::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => V4::try_new().is_some(),
            #[allow(unreachable_patterns, reason = "those of other processors")]
            _ => false,
        }
    }
}

/// Runs `work` compiled for the widest registers that the processor has; its loops, and what it calls, must be inlined to
/// gain by it.
pub fn widest<T>(work: impl NullaryFnOnce<Output = T>) -> T {
    widest_registers(Plain(work))
}

/// Does the same for a closure, marked as always inlined: what it changes is handed to it, since one that changes what it captures is
/// called in a way that need not be inlined.
pub fn widest_on<A, T>(changed: A, work: impl Fn(A) -> T) -> T {
    widest(On { changed, work })
}

struct On<A, F> {
    changed: A,
    work: F,
}

impl<A, T, F: Fn(A) -> T> NullaryFnOnce for On<A, F> {
    type Output = T;

    #[inline(always)]
    fn call(self) -> T {
        (self.work)(self.changed)
    }
}

/// Does the same for work that names the registers itself.
pub fn widest_registers<T>(work: impl WithSimd<Output = T>) -> T {
    registers(Simd::fastest(), work)
}

/// Does the same with these registers, or with single numbers where the processor lacks them.
#[allow(clippy::needless_return, reason = "what comes last depends on the processor")]
pub fn registers<T>(simd: Simd, work: impl WithSimd<Output = T>) -> T {
    #[cfg(target_arch = "x86_64")]
    match (simd, V3::try_new(), V4::try_new()) {
        (Simd::Avx512, _, Some(machine)) => return pulp::Simd::vectorize(machine, work),
        (Simd::Avx2, Some(machine), _) => return pulp::Simd::vectorize(machine, work),
        // Without the instructions of AVX2 each fused operation is a call.
        (_, Some(machine), _) => return pulp::Simd::vectorize(machine, Single(work)),
        _ => return work.with_simd(Scalar128b),
    }
    #[cfg(target_arch = "aarch64")]
    if let (Simd::Neon, Some(machine)) = (simd, Neon::try_new()) {
        return pulp::Simd::vectorize(machine, work);
    }
    #[cfg(not(target_arch = "x86_64"))]
    work.with_simd(Scalar)
}

/// Whether these are the registers of a processor that cannot multiply and add in one: x86-64 without AVX2.
pub fn has_no_fusing<S: pulp::Simd>() -> bool {
    cfg!(target_arch = "x86_64") && TypeId::of::<S>() == TypeId::of::<pulp::Scalar128b>()
}

/// Work that leaves the registers to the compiler.
struct Plain<F>(F);

impl<F: NullaryFnOnce> WithSimd for Plain<F> {
    type Output = F::Output;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> F::Output {
        self.0.call()
    }
}

/// Work on single numbers, with the other instructions of the processor.
#[cfg(target_arch = "x86_64")]
struct Single<W>(W);

#[cfg(target_arch = "x86_64")]
impl<W: WithSimd> WithSimd for Single<W> {
    type Output = W::Output;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> W::Output {
        self.0.with_simd(Scalar)
    }
}
