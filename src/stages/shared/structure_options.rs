//! Structures, as the command line gives them.

use std::path::Path;

use clap::Args;
use serde::{Deserialize, Serialize};

use super::structures::{Restitution, StructureSpec, Structures};
use crate::pipeline::UsageError;
use crate::rocking::Structure;

/// The parameters of one structure on the command line.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "Structure")]
pub struct StructureParameters {
    /// Frequency parameter of the structure, rad/s
    #[arg(long, value_name = "RAD/S")]
    pub p: Option<f64>,
    /// Slenderness of the structure, rad
    #[arg(long, value_name = "RAD")]
    pub alpha: Option<f64>,
    /// Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    #[arg(long)]
    pub eta: Option<Restitution>,
    /// Width of the block or column, m; replaces p and alpha
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub width: Option<f64>,
    /// Height of the block or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub height: Option<f64>,
    /// For a frame: mass of the beam over the mass of all columns
    #[arg(long, value_name = "RATIO", conflicts_with_all = ["p", "alpha"])]
    pub beam_mass_ratio: Option<f64>,
}

impl StructureParameters {
    /// Whether there is any.
    pub fn is_given(&self) -> bool {
        *self != StructureParameters::default()
    }

    /// The structure, without a name.
    pub fn spec(&self) -> StructureSpec {
        let StructureParameters { p, alpha, eta, width, height, beam_mass_ratio } = *self;
        StructureSpec { name: None, p, alpha, eta, width, height, beam_mass_ratio }
    }
}

/// Structures on the command line: the parameters of one, or a file of some.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "Structure")]
pub struct StructuresOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub parameters: StructureParameters,
    /// YAML, CSV or Parquet file of structures: name; p, alpha and eta, or width and height (m), for a frame also beam_mass_ratio
    /// (beam-mass-ratio in YAML). Other columns are ignored. Or the word paper, for the two of the paper
    #[arg(long, value_name = "FILE", conflicts_with_all = ["p", "alpha", "eta", "width", "height", "beam_mass_ratio"])]
    pub structures: Option<Structures>,
}

impl StructuresOptions {
    /// Whether there is any.
    pub fn is_given(&self) -> bool {
        self.parameters.is_given() || self.structures.is_some()
    }

    /// Makes the path of a file relative to `folder`, that of the pipeline file.
    pub fn resolve_path(&mut self, folder: &Path) {
        if let Some(structures) = &mut self.structures {
            structures.resolve_path(folder);
        }
    }

    /// All structures, checked.
    ///
    /// # Errors
    /// If there is none, a file cannot be read, or one is impossible.
    pub fn resolve(&self) -> anyhow::Result<Vec<Structure>> {
        match &self.structures {
            Some(structures) => structures.resolve(),
            None if !self.parameters.is_given() => Err(UsageError::because(
                "no structure; expected --width M --height M of a block; or --p, --alpha and --eta; or --structures FILE; --structures paper for the two of the paper",
            )),
            None => Ok(vec![self.parameters.spec().structure()?]),
        }
    }
}

/// One structure on the command line.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "Structure")]
pub struct StructureOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub structures: StructuresOptions,
    /// Name of the structure in the file of --structures [default: the only one]
    #[arg(long, requires = "structures")]
    pub name: Option<String>,
}

impl StructureOptions {
    /// The structure as it is given, or as it is in the file: by its name, or as the one of the fits.
    ///
    /// # Errors
    /// If it is not in the file, or the file cannot be read.
    pub fn spec(&self, of_fits: Option<&str>) -> anyhow::Result<StructureSpec> {
        let StructuresOptions { parameters, structures } = &self.structures;
        let Some(structures) = structures else { return Ok(parameters.spec()) };
        let mut all = structures.resolve()?;
        let names: Vec<String> = all.iter().map(|structure| structure.name.clone()).collect();
        let place = match &self.name {
            Some(name) => names.iter().position(|known| known == name),
            None if names.len() == 1 => Some(0),
            None => names.iter().position(|known| of_fits == Some(known)),
        };
        let Some(place) = place else {
            let none = self.name.as_ref().map_or(String::new(), |name| format!("no structure '{name}'; "));
            let expected = format!("{none}expected --name with one of {}", names.join(", "));
            return Err(UsageError::because(format!("{structures}: {expected}")));
        };
        Ok(StructureSpec::from(all.swap_remove(place)))
    }
}
