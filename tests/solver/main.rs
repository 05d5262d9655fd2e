//! The rocking solver: closed forms, another program in quadruple precision, the equations written plainly, hostile input.

mod company;
#[cfg(feature = "pipeline")]
mod dense_scan;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
#[cfg(feature = "pipeline")]
mod truth;
