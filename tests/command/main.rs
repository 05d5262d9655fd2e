//! The command as a user calls it.

mod bad_input;
mod common;
mod evaluate;
mod export;
mod ida;
mod import;
mod kill;
mod pipeline;
mod together;
mod universality;
mod validate;
