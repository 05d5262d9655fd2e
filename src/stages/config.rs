//! pipeline.yaml: the stages of a run and their options.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::compare_paper::ComparePaperOptions;
use super::fit_pex::FitPexOptions;
use super::fit_pro::FitProOptions;
use super::ida::IdaOptions;
use super::import_motions::ImportMotionsOptions;
use super::rank_ims::RankImsOptions;
use super::report::ReportOptions;
use super::sample_scenarios::SampleScenariosOptions;
use super::simulate::SimulateOptions;
use super::synthesize_motions::SynthesizeMotionsOptions;
use super::universality::UniversalityOptions;
use crate::pipeline::UsageError;
use crate::pipeline::yaml::explain;
use crate::table::text_file;

/// The largest file: many thousand structures.
const MOST_MIB: u64 = 1;

/// The whole file. A stage that is left out is not run.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct Config {
    /// Seed of the stages that draw random numbers, unless they have their own.
    pub seed: Option<u64>,
    /// Folder of all files, relative to this one.
    pub out: Option<PathBuf>,
    /// Options of sample-scenarios.
    pub sample_scenarios: Option<SampleScenariosOptions>,
    /// Options of synthesize-motions.
    pub synthesize_motions: Option<SynthesizeMotionsOptions>,
    /// Options of import-motions, which makes the motions in place of synthesize-motions.
    pub import_motions: Option<ImportMotionsOptions>,
    /// Options of simulate.
    pub simulate: Option<SimulateOptions>,
    /// Options of ida.
    pub ida: Option<IdaOptions>,
    /// Options of fit-pex.
    pub fit_pex: Option<FitPexOptions>,
    /// Options of fit-pro.
    pub fit_pro: Option<FitProOptions>,
    /// Options of universality.
    pub universality: Option<UniversalityOptions>,
    /// Options of rank-ims.
    pub rank_ims: Option<RankImsOptions>,
    /// Options of compare-paper.
    pub compare_paper: Option<ComparePaperOptions>,
    /// Options of report.
    pub report: Option<ReportOptions>,
}

impl Config {
    /// Reads the file.
    ///
    /// # Errors
    /// If it is missing, is no YAML (with line and column), or has an unknown key (naming the nearest known one) or a
    /// value of another type.
    pub fn read(path: &Path) -> anyhow::Result<Config> {
        let text = text_file::text(path, MOST_MIB, "a pipeline file")
            .map_err(|error| UsageError::because(format!("{}: {error}", path.display())))?;
        let mut config: Config = serde_saphyr::from_str(&text)
            .map_err(|error| UsageError::because(format!("{}: {}", path.display(), explain(&error))))?;
        config.spread_seed();
        let folder = path.parent().unwrap_or(Path::new(""));
        if let Some(import) = &mut config.import_motions {
            import.resolve_paths(folder);
        }
        if let Some(simulate) = &mut config.simulate {
            simulate.resolve_paths(folder);
        }
        if let Some(ida) = &mut config.ida {
            ida.resolve_paths(folder);
        }
        Ok(config)
    }

    /// Gives the seed of the file to each stage that has none of its own.
    pub fn spread_seed(&mut self) {
        if let (Some(seed), Some(options)) = (self.seed, &mut self.sample_scenarios) {
            options.seed = options.seed.or(Some(seed));
        }
        if let (Some(seed), Some(options)) = (self.seed, &mut self.synthesize_motions) {
            options.seed = options.seed.or(Some(seed));
        }
        if let (Some(seed), Some(options)) = (self.seed, &mut self.fit_pex) {
            options.seed = options.seed.or(Some(seed));
        }
        if let (Some(seed), Some(options)) = (self.seed, &mut self.fit_pro) {
            options.seed = options.seed.or(Some(seed));
        }
    }

    /// The same run with another seed in all stages.
    pub fn with_seed(&self, seed: u64) -> Config {
        let mut config = self.clone();
        config.seed = Some(seed);
        if let Some(options) = &mut config.sample_scenarios {
            options.seed = None;
        }
        if let Some(options) = &mut config.synthesize_motions {
            options.seed = None;
        }
        if let Some(options) = &mut config.fit_pex {
            options.seed = None;
        }
        if let Some(options) = &mut config.fit_pro {
            options.seed = None;
        }
        config.spread_seed();
        config
    }
}
