//! One subcommand a file, or a folder with its options beside it: read, call the domain, write. Besides these:
//!
//! ```text
//! registry  all stages in order: the subcommands, pipeline.yaml
//! shared    what several stages need: options of structures, groups of responses, fits that are read back
//! ```

pub mod compare_paper;
pub mod evaluate;
pub mod export;
pub mod fit_pex;
pub mod fit_pro;
pub mod ida;
pub mod import_motions;
pub mod init;
pub mod inspect;
pub mod rank_ims;
pub mod registry;
pub mod report;
pub mod run;
pub mod sample_scenarios;
pub mod seed_spread;
pub mod shared;
pub mod simulate;
pub mod synthesize_motions;
pub mod universality;
pub mod validate;
