//! Statistics that know nothing of rocking: regressions, likelihoods, tests and their limits.

pub(crate) mod binary;
pub(crate) mod dependence;
pub(crate) mod derivatives;
pub(crate) mod design_matrix;
pub(crate) mod distribution;
pub(crate) mod firth;
pub(crate) mod goodness;
pub(crate) mod influence;
pub(crate) mod limits;
pub(crate) mod link;
pub(crate) mod link_series;
pub(crate) mod newton;
pub(crate) mod overlap;
pub(crate) mod poisson_binomial;
pub(crate) mod regression;
pub(crate) mod separation;
pub(crate) mod skill;
pub(crate) mod spline;
pub(crate) mod triangle;

pub use binary::{BinaryError, BinaryFit, binary_regression};
pub use derivatives::Score;
pub use distribution::{chi_squared_upper_tail, f_upper_tail, t_quantile};
pub use firth::Estimator;
pub use goodness::{Test, hosmer_lemeshow, likelihood_ratio, reset};
pub use limits::{BootstrapLimits, Limits, acceleration, bootstrap_limits};
pub use link::{Information, Link};
pub use link_series::ln_probability_series;
pub use poisson_binomial::PoissonBinomial;
pub use regression::{Estimate, LinearFit, RegressionError, least_squares};
pub use separation::is_separated;
pub use skill::{auc, brier_score, expected_log_score, log_score};
pub use spline::natural_spline;

use crate::keyword::keywords;

/// Whether there is a fit, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStatus {
    /// There is.
    Ok,
    /// There is, but what it is about falls as the measure (of two, the hybrid or the first) grows.
    Falling,
    /// Fewer cases than the fit needs.
    TooFewCases,
    /// Fewer events, or fewer non-events, than say anything about a probability.
    TooFewEvents,
    /// The measure tells the outcomes apart without overlap: the likelihood has no maximum.
    Separated,
    /// A measure, or the demand, does not vary.
    Constant,
    /// The measures do not vary independently of each other.
    Collinear,
    /// The iterations did not come to an end.
    NotConverged,
}

keywords!(FitStatus {
    Ok = "ok",
    Falling = "falling",
    TooFewCases = "too_few_cases",
    TooFewEvents = "too_few_events",
    Separated = "separated",
    Constant = "constant",
    Collinear = "collinear",
    NotConverged = "not_converged",
});
