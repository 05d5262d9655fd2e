//! One structure, as the command line gives it.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Deserialize, Serialize};

use super::structures::{StructureSpec, Structures};
use crate::pipeline::UsageError;

/// One structure on the command line.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "Structure")]
pub struct StructureOptions {
    /// Frequency parameter of the structure, rad/s
    #[arg(long)]
    pub p: Option<f64>,
    /// Slenderness of the structure, rad
    #[arg(long)]
    pub alpha: Option<f64>,
    /// Coefficient of restitution [default: that of the fits, or that of the dimensions]
    #[arg(long)]
    pub eta: Option<f64>,
    /// In place of p and alpha: width of the block or column, m
    #[arg(long, value_name = "M")]
    pub width: Option<f64>,
    /// Height of the block or column, m
    #[arg(long, value_name = "M")]
    pub height: Option<f64>,
    /// Of a frame: mass of the beam over that of all columns
    #[arg(long, value_name = "RATIO")]
    pub beam_mass_ratio: Option<f64>,
    /// In place of them: YAML or CSV file of structures
    #[arg(long, value_name = "FILE", conflicts_with_all = ["p", "alpha", "eta", "width", "height", "beam_mass_ratio"])]
    pub structures: Option<PathBuf>,
    /// Name of the structure in that file [default: the only one]
    #[arg(long, requires = "structures")]
    pub name: Option<String>,
}

impl StructureOptions {
    /// Whether there is any.
    pub fn is_given(&self) -> bool {
        [self.p, self.alpha, self.eta, self.width, self.height, self.beam_mass_ratio]
            .iter()
            .any(Option::is_some)
            || self.structures.is_some()
    }

    /// Makes the path of a structures file relative to `folder`, that of the pipeline file.
    pub fn resolve_paths(&mut self, folder: &Path) {
        if let Some(structures) = &mut self.structures {
            *structures = folder.join(&*structures);
        }
    }

    /// The structure as it is given, or as it is in the file.
    ///
    /// # Errors
    /// If it is not in the file, or the file cannot be read.
    pub fn spec(&self) -> anyhow::Result<StructureSpec> {
        let Some(path) = &self.structures else {
            return Ok(StructureSpec {
                name: None,
                p: self.p,
                alpha: self.alpha,
                eta: self.eta,
                width: self.width,
                height: self.height,
                beam_mass_ratio: self.beam_mass_ratio,
            });
        };
        let mut structures = Structures::File(path.clone()).resolve()?;
        let names: Vec<String> = structures.iter().map(|structure| structure.name.clone()).collect();
        let place = match &self.name {
            Some(name) => names.iter().position(|known| known == name),
            None => (names.len() == 1).then_some(0),
        };
        let Some(place) = place else {
            return Err(UsageError::because(format!(
                "{}: expected --name with one of {}",
                path.display(),
                names.join(", ")
            )));
        };
        Ok(StructureSpec::from(structures.swap_remove(place)))
    }
}
