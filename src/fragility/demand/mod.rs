//! P_ex: regressions of the demand in safe rocking (Eqs. 14 to 18).
//!
//! ```text
//! regressions  univariate, plane and biplanar; transition: where the two planes meet; smooth: a smooth transition instead
//! inference    how uncertain a regression is, and refits in resamples
//! group        all regressions of a group of cases: Table II and more
//! ```

pub(crate) mod group;
pub(crate) mod inference;
pub(crate) mod regressions;
pub(crate) mod smooth;
pub(crate) mod transition;

pub use group::{Form, Regression, RegressionOptions, Regressions, Replicate};
pub use inference::DemandRefits;
pub use inference::{DemandInference, DemandReplicate};
pub use regressions::{
    Biplanar, PLANE, Plane, USEFUL_R2, fit_biplanar, fit_plane, fit_univariate, plane_sample, rms_difference,
};
pub use smooth::{SmoothFit, fit_smooth};
pub use transition::{Break, ScanPoint, Transition, TransitionSearch, transition_limits};
