//! Fragility: the probability of rocking too far, and of overturning, given the intensity of the motion
//! (sections 2.3 and 3).
//!
//! ```text
//! cases        the responses of one structure to one suite of motions; measure: the measures of Eq. 13
//! demand       P_ex: regressions of the demand in safe rocking (Eqs. 14 to 18)
//! overturning  P_ro: curves of single and hybrid measures (Eqs. 19 to 24); parameter: the numbers of either
//! tree         the tree that joins them (Eq. 12); paper_model: the tree by the paper's fits
//! surface      P_ro and P_ex of any structure; calibration: the surface by one's own responses
//! peaks        PGA and PGV together
//! model        the model that predicts: the calibrated surface, or the paper's fits
//! capacity     the lognormal distribution of the capacities of an incremental dynamic analysis
//! ```

mod along;
mod calibration;
mod capacity;
mod cases;
mod demand;
mod measure;
mod model;
mod overturning;
mod paper_model;
mod parameter;
mod peaks;
mod surface;
mod tree;

pub use along::{Along, Ratio, limit_states_at};
pub use calibration::{Calibration, Scenarios};
pub use capacity::{CapacityFit, KnownCapacity, fit_capacities};
pub use cases::{Cases, Cluster, Event, Group, MOST_CASES, Sample};
pub use demand::{DemandFit, DemandModel, DemandOptions, PLANE, ScanPoint};
pub use demand::{fit_demand, fit_plane, fit_planes, fit_power_law, scan_transition, transition};
pub use demand::{ln_median_demand, p_exceeding};
pub use measure::{Measure, Pair};
pub use model::Model;
pub use overturning::{CurveOptions, OverturningFit, fit_curve, fit_curves};
pub use overturning::{beta, hybrid_measure, lambda, mu, p_overturning};
pub use paper_model::paper_probabilities;
pub use parameter::{Parameter, ParameterRow};
pub use peaks::{JointPeaks, Peak, RatioGiven};
pub use surface::{Kind, logit_exceeding, logit_overturning};
pub use tree::{GivenRocking, LimitState, Probabilities, Probability, Z_95};
pub use tree::{p_failure, p_failure_given_rocking, p_no_rocking};
