//! Fragility: the probability of rocking too far, and of overturning, given the intensity of the motion (sections 2.3
//! and 3).
//!
//! ```text
//! case         one response as the fits see it, the measures of Eq. 13, and the events that curves are about
//! cases        cases by the million; sample: those of a regression or a curve
//! clusters     which responses may depend on each other
//! group        what all fits of a group share: its cases, the limits that are asked for, progress
//! demand       P_ex: regressions of the demand in safe rocking (Eqs. 14 to 18), their inference and resamples
//! overturning  P_ro: curves of scalar and hybrid measures (Eqs. 19 to 24), their inference and resamples
//! probability  the tree that joins them (Eq. 12), and limits of probabilities by the delta method
//! held_out     how curves do on magnitudes and distances that they have not seen
//! predictor    a fit as a function of ln IM, straight or bent, with the range of its data
//! model        the fits joined: all probabilities at an intensity; resampled their limits from resampled fits
//! peaks        how PGA and PGV of motions go together
//! slice        the same along one peak, PGA or PGV, at a fixed p PGV / PGA
//! universal    the surface that is shipped: the same probabilities for any structure, without fits of one's own
//! answering    what these two have in common: fits, or the surface
//! capacity     the lognormal distribution of the capacities of an incremental dynamic analysis
//! ```

mod answering;
pub(crate) mod capacity;
pub(crate) mod case;
pub(crate) mod cases;
pub(crate) mod clusters;
pub mod demand;
pub(crate) mod group;
pub(crate) mod held_out;
pub(crate) mod model;
pub mod overturning;
mod peaks;
pub(crate) mod predictor;
pub(crate) mod probability;
pub(crate) mod resampled;
pub(crate) mod sample;
pub(crate) mod slice;
pub mod universal;

pub use answering::Fragility;
pub use capacity::{CapacityFit, KnownCapacity, fit_capacities};
pub use case::{Case, Event, Measure};
pub use cases::{CaseTable, Cases, Placed};
pub use clusters::{Clusters, SharedBy};
pub use demand::{
    Biplanar, Break, DemandInference, DemandRefits, DemandReplicate, PLANE, Plane, ScanPoint, SmoothFit,
    Transition, TransitionSearch, USEFUL_R2, fit_biplanar, fit_plane, fit_smooth, fit_univariate,
    plane_sample, rms_difference, transition_limits,
};
pub use group::{Progress, Uncertainty, unwatched};
pub use held_out::HeldOut;
pub use model::{DemandLaw, DemandModel, FragilityModel, GivenRocking, LimitState, Probabilities};
pub use overturning::{
    BentFit, CurveInference, CurveModel, CurveParameter, CurveRefits, Gap, OverturningFit, fit_overturning,
    fit_with_interaction, fit_with_spline, has_few_events,
};
pub use peaks::{JointPeaks, RatioGiven};
pub use predictor::{BENT_TERMS, Bend, OutOfRange, Predicted, Predictor};
pub use probability::{Probability, ProbitIndex};
pub use probability::{p_exceeding, p_failure, p_failure_given_rocking, p_no_rocking, p_overturning};
pub use resampled::{ReplicateLimits, ResampledModel};
pub use sample::{MANY as MANY_CLUSTERS, Sample};
pub use slice::{Lognormal, Peak, PeaksDoubt, STRONGEST_PGA_M_S2, Slice, doubt_of_peaks, doubt_of_ratio};
pub use universal::UniversalModel;
