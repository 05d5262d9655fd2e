//! Recorded motions: from files of every format to accelerations, and what becomes of them.

#![cfg(feature = "pipeline")]

mod known_records;
mod plausibility;
mod processing;
mod pulses;
mod quirks;
mod references;
mod round_trips;
mod writers;
