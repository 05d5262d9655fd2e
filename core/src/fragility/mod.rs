//! Fragility: the probability of exceeding a rotation limit, and of overturning, given the intensity of the
//! motion (sections 2.3 and 3).

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
pub use cases::{Case, Cases, Cluster, Event, Group, MeasureRanges, Sample};
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
