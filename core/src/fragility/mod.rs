//! Fragility: the probability of exceeding a rotation limit, and of overturning, given the intensity of the
//! motion (sections 2.3 and 3).
//!
//! ```text
//! cases        the responses of one structure to one suite of motions; measure_names: the measures of Eq. 13
//! demand       P_ex: regressions of the demand in safe rocking (Eqs. 14 to 18)
//! overturning  P_ro: curves of single and hybrid measures (Eqs. 19 to 24); parameter: their parameters
//! tree         the event tree that joins them (Eq. 12)
//! surface      P_ro and P_ex of any structure; calibration: the surface, calibrated by responses
//! magnitude    the magnitude that an answer assumes
//! model_point  the estimate, a limit, or the value with one error of the model
//! model        the model that predicts: the calibrated surface, or the paper's fits
//! on_floor     the motions of a floor; ready: an object and its models, ready for many motions
//! joint_peaks  PGV / PGA of motions of one PGA or PGV; given_peak: probabilities given that peak alone
//! capacity     the lognormal distribution of the capacities of an incremental dynamic analysis
//! ```

mod calibration;
mod capacity;
mod cases;
mod demand;
mod given_peak;
mod joint_peaks;
mod magnitude;
mod measure_names;
mod model;
mod model_point;
mod on_floor;
mod overturning;
mod parameter;
mod ready;
mod surface;
mod tree;

pub use calibration::{Calibration, LogitTerms, ObservedOutcome};
pub use capacity::{CapacityFit, KnownCapacity, fit_capacities};
pub use cases::MOST_CASES;
pub use cases::{Case, Cases, Cluster, Event, Group, Sample};
pub use demand::{DemandFit, DemandModel, PLANE, TransitionPoint};
pub use demand::{fit_demand, fit_law, fit_planes, scan_transition, transition};
pub use demand::{ln_median_demand, p_exceeding};
pub use given_peak::GivenPeak;
pub use joint_peaks::{JointPeaks, Peak, RatioGiven};
pub use magnitude::{AssumedMagnitude, MagnitudeSource};
pub use measure_names::{Measure, Predictors};
pub use model::{Model, RockingDirection, paper_probabilities};
pub(crate) use model_point::ModelPoint;
pub use model_point::Tau;
pub use on_floor::UpliftIntensities;
pub use overturning::{CurveFit, fit_curve, fit_curves};
pub use overturning::{DeltaEstimate, beta, hybrid_measure, lambda, mu, p_overturning};
pub use parameter::{Parameter, ParameterRow};
pub(crate) use ready::ReadyObject;
pub use surface::MotionKind;
pub use tree::{GivenRocking, LimitState, LimitStates, Probabilities};
pub use tree::{independent_failure, p_failure, p_failure_given_rocking, p_no_rocking};
