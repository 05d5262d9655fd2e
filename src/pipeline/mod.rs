//! The frame of all stages: options, up-to-date check, output, progress.
//!
//! ```text
//! stage     a stage: a struct of options, and a function that runs it
//! call      one call of a stage: its options, inputs and key
//! cache     runs a call unless its files are up to date
//! files     which arguments are files, and where they are by default
//! context   output, progress and warnings of a running stage
//! stream    concurrent reading, work and writing
//! options   option types of several stages
//! ```

pub mod cache;
pub mod call;
pub mod context;
pub mod files;
pub mod options;
pub mod stage;
pub mod stream;

/// A mistake in a call, rather than in a file: the command exits with 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);

impl UsageError {
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError(message.into()).into()
    }
}
