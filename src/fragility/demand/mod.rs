//! P_ex: regressions of the demand in safe rocking (Eqs. 14 to 18).

pub(crate) mod group;
pub(crate) mod inference;
pub(crate) mod regressions;
pub(crate) mod sample;
pub(crate) mod smooth;
pub(crate) mod transition;

pub use group::{Form, Regression, RegressionOptions, Regressions, Replicate};
pub use inference::DemandRefits;
pub use inference::{DemandInference, DemandReplicate};
pub use regressions::{Biplanar, PLANE, Plane, fit_biplanar, fit_plane, fit_univariate, rms_difference};
pub use sample::DemandSample;
pub use smooth::{SmoothFit, fit_smooth};
pub use transition::{Break, ScanPoint, Transition, TransitionSearch, transition_limits};
