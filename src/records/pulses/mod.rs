//! Velocity pulses in records.
//!
//! ```text
//! indicator  whether a record holds a pulse (Baker 2007), and in which direction (Shahi & Baker 2014)
//! fit        the pulse of Eq. 1 that is nearest to a record
//! wavelet    the Daubechies wavelet of order 4 and the continuous wavelet transform with it
//! ```

pub mod fit;
pub mod indicator;
pub mod wavelet;

pub use fit::FittedPulse;
pub use indicator::{PulseIndicator, Verdict, strongest_direction};
pub use wavelet::WaveletScratch;
