//! Guards what a user of the binary sees: tables, numbers, help and messages. All of it goes through the binary and through
//! plain Parquet readers, so that it survives any rewrite of the inside.
//!
//! Run it with `cargo test --test guard`. A difference fails the test and leaves a `.snap.new` beside the snapshot
//! (`INSTA_UPDATE=no` leaves none). After a wanted change, write the snapshots anew with
//! `INSTA_UPDATE=always cargo test --test guard`, look at `git diff`, and commit them with the change. A renamed column shows as
//! the same hash under another name in `snapshots/fingerprints`; any other new hash there is another number. `tests/command`
//! guards its messages in the same way (`INSTA_UPDATE=always cargo test --test command`). The paper's whole run is compared by
//! `cargo test --release --test guard -- --ignored`, which takes half a minute.
//!
//! Hashes hold for glibc on x86-64 with AVX2 and FMA: without them the mean period (by an FFT) and what is fitted (by `exp` and `ln`)
//! differ by rounding; scenarios, accelerations and rotations do not.

#![cfg(feature = "pipeline")]

mod help;
mod paper_run;
mod pipeline;
mod report;
mod snapshot;
mod tables;
