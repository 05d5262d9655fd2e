//! The bootstrap: resamples, and sums over many of them at once; folds of cases that are left out together.

pub(crate) mod bootstrap;
pub(crate) mod case_terms;
pub(crate) mod folds;
pub(crate) mod limits;
pub(crate) mod monomials;
pub(crate) mod normal_equations;

pub use bootstrap::{Draws, Resamples, Sizes, Strata, TOGETHER, bootstrap, bootstrap_each};
pub use folds::{Folds, Gain, gain};
pub use limits::{BootstrapLimits, acceleration, bootstrap_limits};
