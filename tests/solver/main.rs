//! The rocking solver: closed forms, another program in quadruple precision, the same answer in all registers, hostile input.

#[cfg(feature = "pipeline")]
mod dense_scan;
mod incremental;
mod noise;
mod numbers;
mod rocking;
mod simd;
#[cfg(feature = "pipeline")]
mod truth;
