//! The figures of responses and fits, numbered as in the paper where they are of the paper's. Of nothing to
//! draw, a figure has no panels.

pub mod answers;
pub mod common;
mod demand;
mod motion;
mod probability;
mod studies;
mod universality;

pub use common::Fits;
pub use demand::{VP, demand, planes, quality, regressions};
pub use motion::{envelope, motion, similarity};
pub use probability::{exceedance, hybrids, maps, overturning};
pub use studies::{ida, validation};
pub use universality::universality;
