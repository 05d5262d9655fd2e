//! Velocity pulses in records: indicator (Baker 2007; Shahi & Baker 2014), and fit of the pulse of Eq. 1.

pub mod fit;
pub mod indicator;
pub mod wavelet;

pub use fit::FittedPulse;
pub use indicator::{PulseIndicator, Verdict, strongest_direction};
