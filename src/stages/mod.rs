//! One subcommand a file: read, call the domain, write.

pub mod compare_paper;
pub mod fit_pex;
pub mod fit_pro;
pub mod groups;
pub mod inspect;
pub mod run;
pub mod sample_scenarios;
pub mod seed_spread;
pub mod simulate;
pub mod structures;
pub mod synthesize_motions;
