//! What must run, and running it.
//!
//! ```text
//! options  words, lists and ranges as they stand in options, and what is wrong with a YAML file
//! stage    what every stage has: inputs, parameters, outputs, work
//! declare  what a stage says of itself, from which its command and its section of pipeline.yaml follow
//! cache    whether a stage is up to date, and if not, why; two runs in one folder
//! replace  what a stage may write over
//! files    files and folders that a user names
//! stream   read, work and write at the same time, in order
//! console  progress, notes and warnings on stderr
//! terminal where results are read: its width, its colours
//! ```

pub mod cache;
pub mod console;
pub mod declare;
pub mod files;
pub mod options;
pub mod replace;
pub mod stage;
pub mod stream;
pub mod terminal;

/// A mistake in how rockfrag was called or configured: exit code 2.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(pub String);

impl UsageError {
    /// With what was expected.
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError(message.into()).into()
    }
}
