//! The rocking solver against closed forms, quadruple precision, the printed equations, and extreme input.

mod closed_forms;
mod company;
mod incremental;
mod numbers;
mod rocking;
#[path = "../shared/mod.rs"]
mod shared;
mod truth;
