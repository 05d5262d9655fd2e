//! P_ro: curves of the probability of overturning (Eqs. 19 to 24).
//!
//! ```text
//! curves     scalar and hybrid curves, and curves with terms more, against which they are tested
//! bent       the same with an index that bends, where tests reject the straight one
//! parameter  lambda, mu and beta from the coefficients of the regression; profile: their limits by the profile likelihood
//! inference  how uncertain a curve is
//! refits     curves fitted anew in resamples; expansion: what makes these fast
//! group      all curves of a group of cases
//! ```
pub(crate) mod bent;
pub(crate) mod curves;
pub(crate) mod expansion;
pub(crate) mod group;
pub(crate) mod inference;
pub(crate) mod parameter;
pub(crate) mod profile;
pub(crate) mod refits;

pub use bent::{BentFit, Gap};
pub use curves::{CurveModel, LEAST_EVENTS, OverturningFit, fit_overturning, has_few_events};
pub use curves::{fit_with_interaction, fit_with_spline};
pub use group::{Curve, CurveOptions, Pair, ParameterInference};
pub use inference::CurveInference;
pub use parameter::CurveParameter;
pub use refits::CurveRefits;
