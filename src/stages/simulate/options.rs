//! The options of simulate.

use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{Parsed, Several, Word, check, defaults};
use crate::rocking::Simd;
use crate::stages::shared::structure_options::StructuresOptions;
use crate::table::store::partition::Partition;

/// Which structures, and which motions to look at.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct SimulateOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub structure: StructuresOptions,
    /// Vector instructions of the solver: scalar, neon, avx2 or avx512; all give the same bits [default: the fastest of this
    /// processor]
    #[arg(long, help_heading = None::<&str>)]
    pub simd: Option<Word<Simd>>,
    /// Also write the rotation over time for these motions, to NAME.trace.parquet beside the output
    #[arg(long, value_name = "ID,...", help_heading = None::<&str>)]
    pub trace: Option<Several<String>>,
    /// Simulate only partition i of n, with i from 0 to n - 1: the file part-0000i.parquet of a folder, or an equal share of the
    /// motions of a file. The output is then a folder
    #[arg(long, value_name = "I/N", conflicts_with = "trace", help_heading = None::<&str>)]
    pub partition: Option<Parsed<Partition>>,
}

impl Default for SimulateOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for SimulateOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        self.structure.resolve_path(folder);
    }
}

/// The vector instructions that are asked for, or the fastest.
///
/// # Errors
/// If this processor does not have them.
pub fn simd(asked: Option<Word<Simd>>) -> anyhow::Result<Simd> {
    let Some(Word(simd)) = asked else { return Ok(Simd::fastest()) };
    check(simd.is_available(), "simd", Word(simd), "one that this processor has")?;
    Ok(simd)
}
