//! Synthetic ground motions against numpy, and the measures of any motion against closed forms.

mod floor;
mod measures;
mod model;
#[path = "../shared/mod.rs"]
mod shared;
