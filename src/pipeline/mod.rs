//! What all stages share, and what decides whether one must run.
//!
//! ```text
//! stage     a stage: options that clap parses, and one function that runs it
//! call      one call of a stage: its options, inputs and key
//! cache     runs a call unless its files are up to date
//! context   what a stage is handed: where to write, progress, doubts
//! stream    read, work and write at the same time
//! options   types of options that several stages have
//! ```

pub mod cache;
pub mod call;
pub mod context;
pub mod options;
pub mod stage;
pub mod stream;

/// A mistake in what was asked, rather than in a file: the command exits with 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);

impl UsageError {
    /// An error that says this.
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError(message.into()).into()
    }
}
