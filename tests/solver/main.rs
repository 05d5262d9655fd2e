//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

mod company;
mod dense_scan;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
mod truth;
