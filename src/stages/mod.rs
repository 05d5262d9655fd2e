//! One subcommand a file: read, call the domain, write. Besides: config (pipeline.yaml, the options of all), structures (as
//! a user names them), groups (the responses of a suite and structure), pex_group and pro_group (their fits), uncertainty (the
//! limits that both are asked for).

pub mod compare_paper;
pub mod config;
pub mod fit_pex;
pub mod fit_pro;
pub mod groups;
pub mod inspect;
pub mod pex_group;
pub mod pro_group;
pub mod run;
pub mod sample_scenarios;
pub mod seed_spread;
pub mod simulate;
pub mod structures;
pub mod synthesize_motions;
pub mod uncertainty;
