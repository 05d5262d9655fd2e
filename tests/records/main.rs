//! Recorded motions: formats, processing, pulses.

mod formats;
mod known_records;
mod plausibility;
mod processing;
mod pulses;
mod references;
#[path = "../shared/mod.rs"]
mod shared;
mod slips;
mod traits;
mod writers;
