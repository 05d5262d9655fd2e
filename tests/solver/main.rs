//! The rocking solver: closed forms, another program in quadruple precision, the same answer in all registers, hostile input.

mod incremental;
mod noise;
mod numbers;
mod rocking;
mod simd;
#[cfg(feature = "pipeline")]
mod truth;
