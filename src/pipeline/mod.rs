//! The frame of all stages: options, up-to-date check, output, progress.
//!
//! ```text
//! paths     what a path is to a stage: a type for each kind
//! call      one call of a stage: its options, and the files that it reads
//! cache     runs a call unless its files are up to date
//! context   what a call would make, and output, progress and warnings of the running stage
//! stream    concurrent reading, work and writing
//! options   option types of several stages
//! ```

pub mod cache;
pub mod call;
pub mod context;
pub mod options;
pub mod paths;
pub mod stream;

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Map, Value};

use self::context::Context;
use self::paths::Read;

/// A struct of options, parsed by clap, and a function that runs it. As serde writes them, without the
/// paths, the options enter the key of what is made.
pub trait Stage {
    /// Returns the files of options in a run that gives none, by flag, in the folder of the run. Options
    /// with a default have it there too, and need no word.
    fn in_run(_: &InRun) -> Vec<(&'static str, &'static str)>
    where
        Self: Sized,
    {
        Vec::new()
    }

    /// Returns all files that it reads.
    fn inputs(&self) -> Vec<Read>;

    /// Returns all files that it writes, the last one written last; none if it only prints.
    fn outputs(&self) -> Vec<PathBuf>;

    /// Returns whether the text of the stage is what people make a folder for.
    fn is_answer(&self) -> bool {
        false
    }

    /// Checks the options, before any stage of a run begins.
    fn check(&self) -> anyhow::Result<()> {
        Ok(())
    }

    /// Runs the stage. Returns the text to print.
    fn run(&self, context: &Context) -> anyhow::Result<String>;
}

/// A run as one of its stages sees it.
pub struct InRun<'a> {
    /// The options of all stages.
    pub sections: &'a BTreeMap<String, Map<String, Value>>,
    /// The options of this stage.
    pub section: &'a Map<String, Value>,
}

impl InRun<'_> {
    pub fn has(&self, stage: &str) -> bool {
        self.sections.contains_key(stage)
    }

    /// Returns the motions that all stages take: those of a floor if there are any.
    pub fn motions(&self) -> &'static str {
        if self.has("floor-motions") { "floor.parquet" } else { "motions.parquet" }
    }
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
