//! The options by which stages take fits, and the models that these are.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use crate::doubt::Doubt;
use crate::fragility::{Kind, Model};
use crate::pipeline::options::number;
use crate::rocking::Structure;

/// The fits of a call.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Model")]
pub struct FitsArgs {
    /// Folder with fits
    #[arg(long, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub fits: Option<PathBuf>,
    /// Name
    #[arg(long)]
    pub name: Option<String>,
    /// Suite
    #[arg(long)]
    pub suite: Option<Kind>,
    /// Model
    #[arg(long)]
    pub model: Option<String>,
    /// Limit state
    #[arg(long, default_value = "0.1", value_parser = number(1e-6..=10.0, "a demand"))]
    pub limit_state: f64,
}

/// Models.
pub struct FittedModels {
    kind: Kind,
    limit_state: f64,
}

impl FitsArgs {
    /// The models.
    pub fn models(&self) -> anyhow::Result<FittedModels> {
        Ok(FittedModels { kind: self.suite.unwrap_or(Kind::Recorded), limit_state: self.limit_state })
    }
}

impl FittedModels {
    /// The model of a structure.
    pub fn model(&self, structure: &Structure) -> anyhow::Result<(Model, Vec<Doubt>)> {
        Ok((Model::shipped(self.kind, structure, self.limit_state), Vec::new()))
    }

    /// All fitted.
    pub fn structures(&self) -> Vec<Structure> {
        Vec::new()
    }
}
