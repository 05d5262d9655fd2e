//! The command as a user calls it.

mod bad_input;
mod common;
mod evaluate;
mod export;
mod import;
mod kill;
mod partitions;
mod pipeline;
mod validate;
