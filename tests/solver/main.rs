//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

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
