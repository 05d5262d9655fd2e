//! What is done to recorded accelerations before they are used, each step a function of samples alone.
//!
//! ```text
//! baseline  the mean or a line removed
//! filter    zero-phase high-pass
//! resample  another time step
//! rotate    two horizontal components in another direction, and RotD
//! scale     factors, given or to a peak
//! ```

mod baseline;
mod filter;
mod resample;
mod rotate;
mod scale;

pub use baseline::Baseline;
pub use filter::{HighPass, HighPassScratch};
pub use resample::{resample, resampled_length};
pub use rotate::{HorizontalPair, RotD};
pub use scale::Scaling;
