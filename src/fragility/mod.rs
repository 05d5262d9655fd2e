//! Fragility: the probability of rocking too far, and of overturning, given the intensity of the motion (sections 2.3
//! and 3).
//!
//! ```text
//! case             one response as the fits see it: outcome, demand and intensity measures
//! demand_sample    the cases of a regression of the demand, event_sample those of a curve
//! demand           P_ex: univariate, plane and biplanar regressions of the demand in safe rocking (Eqs. 14-18)
//! transition       where the two planes meet
//! smooth           a smooth transition in place of the break
//! overturning      P_ro: fragility curves of scalar and hybrid measures (Eqs. 19-24)
//! curve_parameter  lambda, mu and beta of a curve from the coefficients of its regression
//! curve            the probabilities themselves, and the tree that joins them (Eqs. 12 and 14)
//! index            the limits of probabilities, by the delta method
//! predictor        a fit as a linear function of ln IM, with the range of its data
//! model            the fits joined: all probabilities at an intensity
//! slice            the same along one peak, PGA or PGV, at a fixed p PGV / PGA
//! capacity         the lognormal distribution of capacities of an incremental dynamic analysis
//! bent_curve       curves with a spline or an interaction more
//! resampled        their limits from the fits of resampled cases
//! skill            how well probabilities tell the outcomes apart
//! forecast         what the curves foretell of cases that were not fitted
//! validation       such forecasts against what happened
//! poisson_binomial the number of events of unequal probability
//! transfer         the curve of a structure alone, to be asked about another
//! universality     how it fares there
//! pooled           one curve for all structures, with what they differ in
//! candidate        sets of measures, ranking_sample the cases in which they are ranked
//! rating           how well a set predicts: rate_demand that of P_ex, rate_overturning that of P_ro
//! folds            which clusters are left out together, and gains paired over clusters
//! contest          all sets that compete, ranking their order and forward selection
//!
//! regression       least squares with standard errors and limits
//! binary           maximum likelihood of binary outcomes
//! link             how its index becomes a probability
//! newton           the method that finds the maximum
//! separation       whether there is a maximum at all
//! design_matrix    the columns of a regression
//! derivatives      sums over its cases, in wide registers
//! triangle         where the numbers of a symmetric matrix stand
//! overlap          the proof that there is one, for many predictors
//! dependence       whether the predictors can be told apart
//! spline           columns that bend a line
//! goodness         whether a model fits
//! distribution     Student's t, F and chi squared
//! firth            the penalised likelihood for few events or separation
//!
//! influence         what each case adds to a fit: jackknife, clustered errors, first step of a refit
//! profile           limits by the profile likelihood
//! bootstrap         resampling within the cells of the design
//! case_terms        sums over cases in many resamples at once
//! demand_refits     regressions of the demand from them, by normal_equations
//! curve_refits      curves from them, by an expansion of the likelihood in monomials with the series of link_series
//! limits            percentile and BCa limits from the replicates
//! curve_inference   all of these for a curve, demand_inference for a regression of the demand
//! ```

mod bent_curve;
mod binary;
mod bootstrap;
mod candidate;
mod capacity;
mod case;
mod case_terms;
mod contest;
mod curve;
mod curve_inference;
mod curve_parameter;
mod curve_refits;
mod demand;
mod demand_inference;
mod demand_refits;
mod demand_sample;
mod dependence;
mod derivatives;
mod design_matrix;
mod distribution;
mod event_sample;
mod expansion;
mod firth;
mod folds;
mod forecast;
mod goodness;
mod index;
mod influence;
mod limits;
mod link;
mod link_series;
mod model;
mod monomials;
mod newton;
mod normal_equations;
mod overlap;
mod overturning;
mod poisson_binomial;
mod pooled;
mod predictor;
mod profile;
mod ranking;
mod ranking_sample;
mod rate_demand;
mod rate_overturning;
mod rating;
mod regression;
mod resampled;
mod separation;
mod skill;
mod slice;
mod smooth;
mod spline;
mod transfer;
mod transition;
mod triangle;
mod universality;
mod validation;

pub use bent_curve::{fit_with_interaction, fit_with_spline};
pub use binary::{BinaryError, BinaryFit, binary_regression};
pub use bootstrap::{Resamples, Strata, TOGETHER, bootstrap, bootstrap_each};
pub use candidate::{Candidate, Form};
pub use capacity::{CapacityFit, KnownCapacity, fit_capacities};
pub use case::{Case, Measure};
pub use contest::{Contest, RankingRules};
pub use curve::{p_exceeding, p_failure, p_failure_given_rocking, p_no_rocking, p_overturning};
pub use curve_inference::CurveInference;
pub use curve_parameter::CurveParameter;
pub use curve_refits::CurveRefits;
pub use demand::{Biplanar, PLANE, Plane, fit_biplanar, fit_plane, fit_univariate, rms_difference};
pub use demand_inference::{DemandInference, DemandReplicate};
pub use demand_refits::DemandRefits;
pub use demand_sample::DemandSample;
pub use derivatives::Score;
pub use distribution::{chi_squared_upper_tail, f_upper_tail, t_quantile};
pub use event_sample::EventSample;
pub use firth::Estimator;
pub use folds::{Folds, Gain, gain};
pub use forecast::{Forecast, Forecasts, Foretold};
pub use goodness::{Test, hosmer_lemeshow, likelihood_ratio, reset};
pub use index::{Probability, ProbitIndex};
pub use limits::{BootstrapLimits, Limits, acceleration, bootstrap_limits};
pub use link::{Information, Link};
pub use link_series::ln_probability_series;
pub use model::{DemandLaw, DemandModel, FragilityModel, GivenRocking, LimitState, Probabilities};
pub use overturning::{CurveModel, OverturningFit, fit_overturning, has_few_events};
pub use poisson_binomial::PoissonBinomial;
pub use pooled::{PooledFit, PooledPart, PooledStructure, PooledTerm, PooledTerms, fit_pooled};
pub use predictor::{OutOfRange, Predicted, Predictor, ranges};
pub use ranking::{OfPaper, Ranked};
pub use ranking_sample::{FurtherMeasure, RankingSample, Target};
pub use rating::{Rating, ReliabilityGroup, Skill, Unseen};
pub use regression::{Estimate, LinearFit, RegressionError, least_squares};
pub use resampled::{ReplicateLimits, ResampledModel};
pub use separation::is_separated;
pub use skill::{auc, brier_score, expected_log_score, log_score};
pub use slice::{Lognormal, Peak, Slice};
pub use smooth::{SmoothFit, fit_smooth};
pub use spline::natural_spline;
pub use transfer::{Branch, Curve, CurveForm, CurveSubject};
pub use transition::{Break, ScanPoint, Transition, TransitionSearch, transition_limits};
pub use universality::{BesideOwn, Transfer, Verdict};
pub use validation::{Validation, calibration_in_the_large, calibration_slope, wilson_limits};

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
