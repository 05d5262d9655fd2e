//! Velocity pulses in records: whether there is one (Baker 2007; Shahi & Baker 2014), and the pulse of Eq. 1
//! that is nearest to it.

pub mod fit;
pub mod indicator;
pub mod wavelet;

pub use fit::FittedPulse;
pub use indicator::{PulseIndicator, Verdict, strongest_direction};
