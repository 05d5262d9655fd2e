//! Recorded ground motions: from records as in their files to motions ready to simulate.
//!
//! ```text
//! recorded_motion  a record as in its file
//! rotation         pairs of horizontal components, in another direction, and RotD
//! implausibility   checks that a motion can be of an earthquake
//! signal           baseline, high-pass, time step, scale
//! pulses           velocity pulses: indicator and fit
//! processing       these steps in order: from records to imported motions
//! ```

pub mod implausibility;
pub mod processing;
pub mod pulses;
mod recorded_motion;
pub mod rotation;
pub mod signal;

pub use recorded_motion::{HeaderPga, Origin, RecordedMotion};
