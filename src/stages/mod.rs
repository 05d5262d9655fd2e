//! One subcommand a file: read, call the domain, write. Besides: config (pipeline.yaml, the options of all), structures (as
//! a user names them), groups (the responses of a suite and structure), fits (the choice among those of pex and pro files).

pub mod compare_paper;
pub mod config;
pub mod evaluate;
pub mod fit_pex;
pub mod fit_pro;
pub mod fits;
pub mod groups;
pub mod inspect;
pub mod run;
pub mod sample_scenarios;
pub mod seed_spread;
pub mod simulate;
pub mod structures;
pub mod synthesize_motions;
