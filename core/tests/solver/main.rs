//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

mod body;
mod closed_forms;
mod company;
mod incremental;
mod noise;
mod numbers;
mod reference;
mod rocking;
#[path = "../shared/mod.rs"]
mod shared;
mod truth;
