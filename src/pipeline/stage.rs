//! A stage: a struct of options, parsed by clap, and a function that runs it.

use std::path::PathBuf;

use super::context::Context;

/// A stage with its options. What its arguments are, says [`super::files::role`].
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
