//! The options of ida.

use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::measure::ScaledMeasure;
use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{Word, check, defaults};
use crate::rocking::{Scan, Simd};
use crate::stages::shared::structure_options::StructuresOptions;

/// Which structures, and the intensities at which they are simulated.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct IdaOptions {
    /// Intensity to scan: scale (the factor on the motion), pga (g), pgv (m/s), im4, im5 or im6 (Eq. 13, for each structure)
    #[arg(long, default_value = "scale")]
    pub measure: Word<ScaledMeasure>,
    /// Smallest intensity, in the unit of --measure
    #[arg(long, default_value = "0.1", value_name = "IM")]
    pub from: f64,
    /// Largest intensity, in the unit of --measure
    #[arg(long, default_value = "10", value_name = "IM")]
    pub to: f64,
    /// Steps between them, in equal ratios; their ends are the stripes
    #[arg(long, default_value = "60", value_name = "N")]
    pub steps: usize,
    /// How often to halve a step where the structure rocks, which sets the resolution; near the tipping point, four times more
    #[arg(long, default_value = "4", value_name = "N")]
    pub halvings: u32,
    /// Relative error of the intensities at which the outcome changes
    #[arg(long, default_value = "0.001", value_name = "SHARE")]
    pub tolerance: f64,
    #[command(flatten)]
    #[serde(flatten)]
    pub structure: StructuresOptions,
    /// Vector instructions of the solver, as in simulate [default: the fastest of this processor]
    #[arg(long, help_heading = None::<&str>)]
    pub simd: Option<Word<Simd>>,
}

/// Upper bounds that no scan needs to exceed.
const MOST_STEPS: usize = 10_000;
const MOST_HALVINGS: u32 = 12;

impl Default for IdaOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for IdaOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        self.structure.resolve_path(folder);
    }
}

impl IdaOptions {
    pub(super) fn scan(&self) -> anyhow::Result<Scan> {
        let IdaOptions { from, to, steps, halvings, tolerance, .. } = *self;
        check(from > 0.0 && from.is_finite(), "from", from, "an intensity above 0")?;
        check(to > from && to.is_finite(), "to", to, &format!("an intensity above {from}"))?;
        check((1..=MOST_STEPS).contains(&steps), "steps", steps, &format!("1 to {MOST_STEPS}"))?;
        check(halvings <= MOST_HALVINGS, "halvings", halvings, &format!("0 to {MOST_HALVINGS}"))?;
        check((1e-9..=0.5).contains(&tolerance), "tolerance", tolerance, "a share from 1e-9 to 0.5")?;
        Ok(Scan::new(from, to, steps, halvings, tolerance))
    }
}
