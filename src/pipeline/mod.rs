//! The frame of all stages: options, up-to-date check, output, progress.
//!
//! ```text
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
pub mod stream;

use std::path::PathBuf;

use self::context::Context;

/// A struct of options, parsed by clap, and a function that runs it. What its arguments are, says
/// [`files::role`].
pub trait Stage {
    /// Returns the files that it writes, the last one written last; none if it only prints.
    fn outputs(&self) -> Vec<PathBuf>;

    /// Checks the options, before any stage of a run begins.
    fn check(&self) -> anyhow::Result<()> {
        Ok(())
    }

    /// Runs the stage. Returns the text to print.
    fn run(&self, context: &Context) -> anyhow::Result<String>;
}

/// A mistake in a call, rather than in a file: the command exits with 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);

impl UsageError {
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError(message.into()).into()
    }
}
