//! The rocking solver: closed forms, another program in quadruple precision, the same answer in all registers, hostile input.

mod incremental;
mod noise;
mod numbers;
mod paths;
mod rocking;
#[cfg(feature = "pipeline")]
mod truth;
