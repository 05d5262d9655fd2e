//! Fragility: the probability of rocking too far, and of overturning, given the intensity of the motion (sections 2.3
//! and 3).
//!
//! ```text
//! case         one response as the fits see it: outcome, demand and intensity measures
//! regression   least squares with standard errors and limits
//! student      the t distribution behind those limits
//! demand       P_ex: univariate, plane and biplanar regressions of the demand in safe rocking (Eqs. 14-18)
//! transition   where the two planes meet
//! probit       maximum likelihood of binary outcomes
//! separation   whether that likelihood has a maximum at all
//! overturning  P_ro: fragility curves of scalar and hybrid measures (Eqs. 19-24)
//! skill        how well fitted probabilities tell the outcomes apart
//! curve        the probabilities themselves, and the tree that joins them (Eqs. 12 and 14)
//! index        their limits of confidence, by the delta method
//! predictor    a fit as a linear function of ln IM, with the range of its data
//! model        the fits joined: all probabilities at an intensity
//! slice        the same along one peak, PGA or PGV, at a fixed p PGV / PGA
//! ```

mod case;
mod curve;
mod demand;
mod index;
mod model;
mod overturning;
mod predictor;
mod probit;
mod regression;
mod separation;
mod skill;
mod slice;
mod student;
mod transition;

pub use case::{Case, Measure};
pub use curve::{p_exceeding, p_failure, p_failure_given_rocking, p_no_rocking, p_overturning};
pub use demand::{Biplanar, Plane, fit_biplanar, fit_plane, fit_univariate, rms_difference};
pub use index::{Probability, ProbitIndex};
pub use model::{DemandLaw, DemandModel, FragilityModel, GivenRocking, LimitState, Probabilities};
pub use overturning::{EventSample, OverturningFit, Z_95, fit_overturning};
pub use predictor::{OutOfRange, Predicted, Predictor};
pub use probit::{ProbitError, ProbitFit, probit};
pub use regression::{Estimate, LinearFit, RegressionError, least_squares};
pub use separation::is_separated;
pub use skill::{auc, brier_score};
pub use slice::{Lognormal, Peak, Slice};
pub use student::t_quantile;
pub use transition::{ScanPoint, Transition, find_transition};

use crate::keyword::keywords;

/// Whether there is a fit, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStatus {
    /// There is.
    Ok,
    /// Fewer cases than the fit needs.
    TooFewCases,
    /// Fewer events, or fewer non-events, than say anything about a probability.
    TooFewEvents,
    /// The measure tells the outcomes apart without overlap: the likelihood has no maximum.
    Separated,
    /// The measures do not vary independently of each other.
    Singular,
    /// The iterations did not come to an end.
    NotConverged,
}

keywords!(FitStatus {
    Ok = "ok",
    TooFewCases = "too_few_cases",
    TooFewEvents = "too_few_events",
    Separated = "separated",
    Singular = "singular",
    NotConverged = "not_converged",
});
