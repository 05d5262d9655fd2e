//! Plain loops in the widest registers of the processor.

use pulp::NullaryFnOnce;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

/// Runs `work` compiled for the widest registers that the processor has; its loops, and what it calls, must be inlined to
/// gain by it. The results have the same bits on any processor: no operation is fused or reordered.
pub fn widest<T>(work: impl NullaryFnOnce<Output = T>) -> T {
    #[cfg(target_arch = "x86_64")]
    if let Some(machine) = V4::try_new() {
        return machine.vectorize(work);
    } else if let Some(machine) = V3::try_new() {
        return machine.vectorize(work);
    }
    work.call()
}
