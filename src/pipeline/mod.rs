//! The frame of all stages: options, up-to-date check, output, progress.

pub mod call;
pub mod context;
pub mod options;
pub mod paths;
pub mod stream;

use self::context::Context;
pub use self::options::UsageError;
use self::paths::Files;
use crate::table::frame::Format;

/// A struct of options, which serde makes of what is given, and a function that runs it. As serde writes
/// them, without the paths, the options enter the key of what is made.
pub trait Stage {
    fn files(&self) -> Files;

    /// Checks the options, before any stage of a run begins.
    fn check(&self) -> anyhow::Result<()> {
        Ok(())
    }

    /// Returns the format of what it prints. Tables that are up to date have the text alone in their footer.
    fn format(&self) -> Format {
        Format::Text
    }

    fn run(&self, context: &Context) -> anyhow::Result<String>;
}
