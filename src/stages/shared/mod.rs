//! What several stages share.
//!
//! ```text
//! structures         structures as a user names them; structure_options one of them on the command line
//! motions            records and peaks of motions, under distinct names
//! measures           which intensity measures are taken
//! partitions         which part of a table a process works on, and what its file is called
//! groups             the responses of a suite and structure; counts: annual rates counted among them
//! hazard             tables of hazard as users have them; line: probabilities along the intensities of one
//! uncertainty        the limits of confidence that are asked for
//! fits, chosen_fits  the choice among those of pex and pro files, and where they hold
//! resampled_fits     the same in each resample
//! answers            what answers, fits or the surface; surface: that of all structures
//! transfers          how curves did on other structures than their own
//! ```

pub mod answers;
pub mod chosen_fits;
pub mod counts;
pub mod fits;
pub mod groups;
pub mod hazard;
pub mod line;
pub mod measures;
pub mod motions;
pub mod partitions;
pub mod reasons;
pub mod resampled_fits;
pub mod structure_options;
pub mod structures;
pub mod surface;
pub mod transfers;
pub mod uncertainty;
