//! Dimensionless fragility curves for rocking structures in near-fault earthquakes.
//!
//! rockfrag implements the system of Dimitrakopoulos & Paraskeva (2015), "Dimensionless fragility curves for rocking
//! response to near-fault excitations", as a pipeline of stages over Parquet files:
//!
//! ```text
//! sample-scenarios -> scenarios -> synthesize-motions -> motions -> simulate -> responses
//!                                  records -> import-motions ----^                  |-> fit-pex -> pex --|
//!                                                                                   |-> fit-pro -> pro --|-> compare-paper
//!                                                                                   |-> rank-ims         |-> evaluate
//!                                                                                                         |-> export
//!                            responses of many structures, to test the curves of one on --|-> universality
//!                                                       responses of other motions, to test the fits on --|-> validate
//!                                                                 all of these files, in figures and a page --|-> report
//! run: all of pipeline.yaml, skipping what is up to date        inspect: what a file holds and where it came from
//! ```
//!
//! | the paper | here |
//! |---|---|
//! | sections 2.1.1 to 2.1.3, Eqs. 1 and 13: scenarios, motions, intensity measures | [`motion`] |
//! | section 2.2: the rocking response | [`rocking`] |
//! | sections 2.3 and 3, Eqs. 12 and 14 to 24: fragility | [`fragility`] |
//! | beyond it: recorded motions | [`records`] |
//! | beyond it: annual rates at a site | [`hazard`] |
//! | beyond it: ranking of measures, universality, validation | [`studies`] |
//! | what the fits rest on | [`statistics`], [`resampling`] |
//!
//! These know no files, threads or command line, nor do [`export`], which words fragility for other programs, and
//! [`report`], which draws it. [`table`] reads and writes the files, [`pipeline`] decides what must run, [`stages`] joins
//! them: a file or folder a subcommand. `docs/architecture.md` has the picture.

#![deny(clippy::disallowed_methods)]

#[cfg(feature = "pipeline")]
mod allocator;
#[cfg(feature = "pipeline")]
pub mod cli;
#[cfg(feature = "pipeline")]
pub mod export;
pub mod fragility;
pub mod hazard;
pub mod keyword;
pub mod motion;
pub mod normal;
#[cfg(feature = "pipeline")]
pub mod pipeline;
pub mod random;
pub mod records;
#[cfg(feature = "pipeline")]
pub mod report;
pub mod resampling;
pub mod rocking;
#[cfg(feature = "pipeline")]
pub mod stages;
pub mod statistics;
pub mod studies;
#[cfg(feature = "pipeline")]
pub mod table;
pub mod units;
mod wide;
