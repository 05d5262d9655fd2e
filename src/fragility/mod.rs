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

pub(crate) mod capacity;
pub(crate) mod case;
pub(crate) mod clusters;
pub(crate) mod curve;
pub mod demand;
pub(crate) mod group;
pub(crate) mod index;
pub(crate) mod model;
pub mod overturning;
pub(crate) mod predictor;
pub(crate) mod resampled;
pub(crate) mod slice;

pub use capacity::{CapacityFit, KnownCapacity, fit_capacities};
pub use case::{Case, Event, Measure};
pub use clusters::{Clusters, SharedBy, cells};
pub use curve::{p_exceeding, p_failure, p_failure_given_rocking, p_no_rocking, p_overturning};
pub use demand::{
    Biplanar, Break, DemandInference, DemandRefits, DemandReplicate, DemandSample, PLANE, Plane, ScanPoint,
    SmoothFit, Transition, TransitionSearch, fit_biplanar, fit_plane, fit_smooth, fit_univariate,
    rms_difference, transition_limits,
};
pub use group::{CaseGroup, Progress, Uncertainty, unwatched};
pub use index::{Probability, ProbitIndex};
pub use model::{DemandLaw, DemandModel, FragilityModel, GivenRocking, LimitState, Probabilities};
pub use overturning::{
    CurveInference, CurveModel, CurveParameter, CurveRefits, EventSample, OverturningFit, fit_overturning,
    fit_with_interaction, fit_with_spline, has_few_events,
};
pub use predictor::{OutOfRange, Predicted, Predictor, ranges};
pub use resampled::{ReplicateLimits, ResampledModel};
pub use slice::{Lognormal, Peak, Slice};
