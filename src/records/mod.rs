//! Recorded ground motions: from files of the strong-motion networks to motions that are simulated. Pure
//! functions: nothing here knows files.
//!
//! ```text
//! recorded_motion  a record as its file gives it, and what the user says of files
//! formats          from the bytes of a file to records, one file a format
//! pairs            which horizontal components belong together
//! rotation         two horizontal components in another direction, and RotD
//! plausibility     whether a motion can be that of an earthquake
//! signal           steps on samples alone: baseline, high-pass, time step, scale
//! pulses           whether a record holds a velocity pulse, and which
//! processing       all of these in order: from records to the motions that are imported of them
//! ```

pub mod formats;
pub mod pairs;
pub mod plausibility;
pub mod processing;
pub mod pulses;
mod recorded_motion;
pub mod rotation;
pub mod signal;

pub use formats::{Format, RecordFileError, read_records};
pub use recorded_motion::{HeaderPga, ReadOptions, RecordedMotion, UnitSource};
