//! The command as a user calls it.

mod bad_input;
mod common;
mod evaluate;
mod kill;
mod pipeline;
