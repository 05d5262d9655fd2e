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
    #[arg(long)]
    pub simd: Option<Word<Simd>>,
    /// Motions whose response over time is written too, beside the output as NAME.trace.parquet
    #[arg(long, value_name = "ID,...")]
    pub trace: Option<Several<String>>,
    /// Only partition i of n, i from 0 to n - 1: of a folder its file part-0000i.parquet, of a file an equal share of the motions;
    /// the output is then a folder, too
    #[arg(long, value_name = "I/N", conflicts_with = "trace")]
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
