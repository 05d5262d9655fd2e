//! What several stages share: groups of responses, structures, fits that are read back, partitions.

pub mod chosen_fits;
pub mod fits;
pub mod groups;
pub mod measures;
pub mod motions;
pub mod partitions;
pub mod reasons;
pub mod resampled_fits;
pub mod structure_options;
pub mod structures;
pub mod uncertainty;
