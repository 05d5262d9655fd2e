//! The command as a user calls it.

#![cfg(feature = "pipeline")]

mod bad_input;
mod clusters;
mod common;
mod evaluate;
mod export;
mod ida;
mod import;
mod input_slips;
mod kill;
mod overwrite;
mod partitions;
mod pipeline;
mod printed;
mod rank_ims;
mod report;
mod shipped;
mod site_files;
mod slips;
#[path = "../guard/snapshot.rs"]
mod snapshot;
mod start;
mod together;
mod universal;
mod universality;
mod validate;
