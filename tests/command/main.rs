//! The command as a user calls it.

#![cfg(feature = "pipeline")]

mod bad_input;
mod clusters;
mod common;
mod evaluate;
mod export;
mod ida;
mod import;
mod kill;
mod partitions;
mod pipeline;
mod rank_ims;
mod report;
#[path = "../guard/snapshot.rs"]
mod snapshot;
mod together;
mod universal;
mod universality;
mod validate;
