//! Recorded ground motions: from records as in their files to motions ready to simulate.

pub mod implausibility;
pub mod processing;
pub mod pulses;
mod recorded_motion;
pub mod rotation;
pub mod signal;

pub use recorded_motion::{HeaderPga, Origin, RecordedMotion};
