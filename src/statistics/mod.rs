//! Statistics that know nothing of rocking.
//!
//! ```text
//! linear         least squares; binary: probit regression by maximum likelihood (Eqs. 21 and 22)
//! fit            coefficients, covariance and status of either; design: the matrix; newton: the maximiser
//! clusters       errors where cases of one cluster depend on each other; folds: whole clusters left out
//! scores         AUC, Brier and log score of probabilities
//! normal         the standard normal distribution; distributions: t, F, chi squared
//! ```

mod binary;
pub mod clusters;
mod design;
pub mod distributions;
mod fit;
mod folds;
mod linear;
pub mod newton;
pub mod normal;
pub mod scores;

pub use binary::{LEAST_EVENTS, ProbitFit, log_likelihood, probit, tested_probit};
pub use fit::{Estimate, Fit, FitStatus, Limits, dot, predict, variance};
pub use folds::Folds;
pub use linear::{LinearFit, least_squares, tested_least_squares};
