//! Synthetic ground motions against published values, and the measures of any motion against closed forms.

mod floor;
mod measures;
mod model;
#[path = "../shared/mod.rs"]
mod shared;
