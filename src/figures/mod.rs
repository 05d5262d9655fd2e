//! The figures of responses and fits, numbered as in the paper where they are of the paper's. Of nothing to
//! draw, a figure has no panels.

pub mod answers;
pub mod common;
mod demand;
mod map;
mod motion;
mod planes;
mod probability;
mod studies;

pub use common::Fits;
pub use demand::{demand, quality, regressions};
pub use map::maps;
pub use motion::{envelope, motion, similarity};
pub use planes::planes;
pub use probability::{exceedance, hybrids, overturning};
pub use studies::{ida, validation};
