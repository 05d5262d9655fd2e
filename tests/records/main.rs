//! Recorded motions: from files of every format to accelerations, and what becomes of them.

mod formats;
mod known_records;
mod plausibility;
mod processing;
mod pulses;
mod references;
mod sheet;
mod slips;
mod writers;
