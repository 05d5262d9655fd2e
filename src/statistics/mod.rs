//! Statistics that know nothing of rocking: regressions, likelihoods, tests and their limits.
//!
//! ```text
//! estimate      estimates, limits and quantiles
//! columns       numbers of many cases, in memory or in a file without a name, read in blocks; sorted: in order of size
//! design        the columns of a regression, and whether they can be told apart
//! regression    least squares with standard errors and limits
//! link, binary  maximum likelihood of binary outcomes, or Firth's penalised; separation: whether there is a maximum
//! newton        the method that finds it; derivatives: sums over the cases, in wide registers
//! search        roots and minima in one variable, by argmin
//! influence     what each case adds to a fit: jackknife, clustered errors, first step of a refit
//! goodness      tests of fit and scores; distribution: Student's t, F, chi squared, Poisson binomial
//! ```

pub(crate) mod binary;
pub(crate) mod columns;
pub(crate) mod derivatives;
pub(crate) mod design;
pub(crate) mod distribution;
pub(crate) mod estimate;
pub(crate) mod goodness;
pub(crate) mod influence;
pub(crate) mod link;
pub(crate) mod newton;
pub(crate) mod regression;
pub(crate) mod search;
pub(crate) mod separation;
pub(crate) mod sorted;
pub(crate) mod spread;

pub use binary::Estimator;
pub use binary::{BinaryError, BinaryFit, binary_regression};
pub use derivatives::Score;
pub use distribution::PoissonBinomial;
pub use distribution::{chi_squared_upper_tail, f_upper_tail, t_quantile};
pub use estimate::{Estimate, Limits};
pub use goodness::{Test, hosmer_lemeshow, likelihood_ratio, reset};
pub use goodness::{auc, brier_score, expected_log_score, log_score};
pub use link::ln_probability_series;
pub use link::{Information, Link};
pub use regression::{LinearFit, RegressionError, least_squares};
pub use search::{minimum, root};
pub use separation::is_separated;
pub use spread::Spread;

use crate::keyword::keywords;

/// Whether there is a fit, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStatus {
    Ok,
    /// There is, but its own tests reject it, and it is off by more than a little.
    Misfit,
    /// There is, but its median lies far outside of the data: it says little about where it is.
    FarMedian,
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
    Misfit = "misfit",
    FarMedian = "far_median",
    Falling = "falling",
    TooFewCases = "too_few_cases",
    TooFewEvents = "too_few_events",
    Separated = "separated",
    Constant = "constant",
    Collinear = "collinear",
    NotConverged = "not_converged",
});

impl FitStatus {
    /// Whether there is a fit that can answer, if with doubts.
    pub fn is_usable(self) -> bool {
        matches!(self, FitStatus::Ok | FitStatus::Misfit | FitStatus::FarMedian)
    }
}
