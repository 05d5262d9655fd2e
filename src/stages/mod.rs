//! One subcommand a file, or a folder with its options beside it: read, call the domain, write. Besides these:
//!
//! ```text
//! registry           all stages in order: the subcommands, pipeline.yaml
//! structures         structures as a user names them; structure_options one of them on the command line
//! motions            records and peaks of motions, under distinct names
//! measures           which intensity measures are taken
//! partitions         which part of a table a process works on, and what its file is called
//! groups             the responses of a suite and structure
//! uncertainty        the limits of confidence that are asked for
//! fits, chosen_fits  the choice among those of pex and pro files, and where they hold
//! resampled_fits     the same in each resample
//! ```

pub mod compare_paper;
pub mod evaluate;
pub mod export;
pub mod fit_pex;
pub mod fit_pro;
pub mod ida;
pub mod import_motions;
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
