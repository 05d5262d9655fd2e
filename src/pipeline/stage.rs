//! A stage: a struct of options that clap parses, and one function that runs it.

use std::path::{Path, PathBuf};

use super::context::Context;

/// A stage about to run. How its arguments are named and hinted tells the rest: those that hint at a file or folder are its inputs,
/// `--out` is what it writes, all others are parameters.
pub trait Stage {
    /// The files that it writes; the last one is there only when all are. None where it only prints.
    fn outputs(&self) -> Vec<PathBuf>;

    /// Refuses options that cannot be right.
    fn check(&self) -> anyhow::Result<()> {
        Ok(())
    }

    /// Reads, works and writes. Returns what to print.
    fn run(&self, context: &Context) -> anyhow::Result<String>;
}

/// `out.parquet` has parts `out.NAME.parquet` beside it.
pub fn part(out: &Path, name: &str) -> PathBuf {
    out.with_extension(format!("{name}.parquet"))
}
