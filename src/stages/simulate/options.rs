//! The options of simulate.

use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{Parsed, Several, Word, check, defaults};
use crate::rocking::{Simd, Structure};
use crate::stages::shared::structures::{StructureSpec, Structures};
use crate::table::store::partition::Partition;

/// Which structures, and which motions to look at.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct SimulateOptions {
    /// Frequency parameter of the structure, rad/s
    #[arg(long, default_value = "2.5")]
    pub p: f64,
    /// Slenderness of the structure, rad
    #[arg(long, default_value = "0.20")]
    pub alpha: f64,
    /// Coefficient of restitution
    #[arg(long, default_value = "0.92")]
    pub eta: f64,
    /// Structures from a YAML or CSV file: p, alpha, eta; or width and height of a block (m), with beam-mass-ratio for
    /// a frame
    #[arg(long, conflicts_with_all = ["p", "alpha", "eta"])]
    pub structures: Option<Structures>,
    /// Vector instructions of the solver: scalar (one motion at a time), or avx2 or avx512 (several at once), which give the same
    /// bits and differ from scalar by rounding [default: the fastest of this processor]
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
        if let Some(structures) = &mut self.structures {
            structures.resolve_path(folder);
        }
    }
}

impl SimulateOptions {
    pub(in crate::stages) fn simd(&self) -> anyhow::Result<Simd> {
        let Some(Word(simd)) = self.simd else { return Ok(Simd::fastest()) };
        check(simd.is_available(), "simd", Word(simd), "one that this processor has")?;
        Ok(simd)
    }

    pub(in crate::stages) fn structures(&self) -> anyhow::Result<Vec<Structure>> {
        match &self.structures {
            Some(structures) => structures.resolve(),
            None => {
                let one = StructureSpec {
                    p: Some(self.p),
                    alpha: Some(self.alpha),
                    eta: Some(self.eta),
                    ..StructureSpec::default()
                };
                Ok(vec![one.structure()?])
            }
        }
    }
}
