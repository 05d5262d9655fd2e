//! A stage: a struct of options, parsed by clap, and a function that runs it.

use std::path::{Path, PathBuf};

use super::context::Context;

/// A stage with its options. Arguments with the value hint of a file or folder are inputs, `--out` is the
/// output, all others are parameters.
pub trait Stage {
    /// Returns the files that it writes, the last one written last; none if it only prints.
    fn outputs(&self) -> Vec<PathBuf>;

    /// Checks the options.
    fn check(&self) -> anyhow::Result<()> {
        Ok(())
    }

    /// Runs the stage. Returns the text to print.
    fn run(&self, context: &Context) -> anyhow::Result<String>;
}

/// Returns `out.NAME.parquet`, a further output beside `out.parquet`.
pub fn part(out: &Path, name: &str) -> PathBuf {
    out.with_extension(format!("{name}.parquet"))
}
