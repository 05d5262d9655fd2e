//! The rocking solver: closed forms, another program in quadruple precision, the equations written plainly, hostile input.

mod company;
mod dense_scan;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
mod truth;
