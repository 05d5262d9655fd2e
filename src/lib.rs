//! Dimensionless fragility curves for rocking structures in near-fault earthquakes.
//!
//! Begin with [`rocking::reference`]: Eqs. 4 to 6 as they are printed, the equation of motion, uplift and
//! impact.
//!
//! rockfrag implements the system of Dimitrakopoulos & Paraskeva (2015), "Dimensionless fragility curves for
//! rocking response to near-fault excitations", as a pipeline of stages over Parquet files:
//!
//! ```text
//! sample-scenarios -> scenarios -> synthesize-motions -> motions -> simulate -> responses
//!                                  records -> import-motions ----^                  |-> fit-pex -> pex --|
//!                                                                                   |-> fit-pro -> pro --|-> compare-paper
//!                                                                                   |-> rank-ims         |-> evaluate
//!                                                                                   |-> validate         |-> export
//!                                                              all of these files, in figures and a page --> report
//! run: all of pipeline.yaml, skipping what is up to date        inspect: what a file holds and where it came from
//! ```
//!
//! | the paper | here |
//! |---|---|
//! | sections 2.1.1 to 2.1.3, Eqs. 1 to 3 and 13: scenarios, motions, intensity measures | [`motion`] |
//! | section 2.2, Eqs. 4 to 7: the rocking response | [`rocking`] |
//! | sections 2.3 and 3, Eqs. 12 and 14 to 24: fragility | [`fragility`] |
//! | what it prints: set-up, Table II, worked example | [`paper`] |
//! | beyond it: recorded motions | [`records`] |
//! | beyond it: annual rates at a site | [`hazard`] |
//! | beyond it: ranking of measures, validation | [`studies`] |
//! | what the fits rest on | [`statistics`] |
//!
//! These know no files, threads or command line, nor do [`export`], which words fragility for other programs,
//! and [`report`], which draws it. [`table`] reads and writes the files, [`pipeline`] decides what must run,
//! [`stages`] joins them: a file or folder a subcommand. `docs/review/architecture.md` has the picture.

pub mod cli;
pub mod export;
pub mod fragility;
pub mod hazard;
pub mod keyword;
pub mod motion;
pub mod number;
pub mod paper;
pub mod pipeline;
pub mod plausibility;
pub mod random;
pub mod records;
pub mod report;
pub mod rocking;
pub mod sheet;
pub mod stages;
pub mod statistics;
pub mod studies;
pub mod table;
pub mod units;
pub mod warning;
