//! run: all stages of pipeline.yaml in order, skipping what is up to date.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::compare_paper::ComparePaper;
use super::config::Config;
use super::fit_pex::FitPex;
use super::fit_pro::FitPro;
use super::ida::Ida;
use super::import_motions::ImportMotions;
use super::rank_ims::RankIms;
use super::report::Report;
use super::sample_scenarios::SampleScenarios;
use super::simulate::Simulate;
use super::synthesize_motions::SynthesizeMotions;
use super::universality::Universality;
use crate::pipeline::UsageError;
use crate::pipeline::cache::{self, Freshness, freshness};
use crate::pipeline::claim::Claim;
use crate::pipeline::console::Console;
use crate::pipeline::stage::Stage;

/// The files of a run, in one folder.
#[derive(Debug, Clone)]
pub struct Files {
    /// Of sample-scenarios.
    pub scenarios: PathBuf,
    /// Of synthesize-motions or import-motions.
    pub motions: PathBuf,
    /// Of simulate.
    pub responses: PathBuf,
    /// Of ida.
    pub ida: PathBuf,
    /// Of fit-pex.
    pub pex: PathBuf,
    /// Of fit-pro.
    pub pro: PathBuf,
    /// Of universality.
    pub universality: PathBuf,
    /// Of rank-ims.
    pub ranking: PathBuf,
    /// Of compare-paper.
    pub paper: PathBuf,
    /// The folder itself.
    pub folder: PathBuf,
    /// Of report.
    pub report: PathBuf,
}

impl Files {
    /// In this folder.
    pub fn in_folder(folder: &Path) -> Files {
        let file = |name: &str| folder.join(name);
        Files {
            scenarios: file("scenarios.parquet"),
            motions: file("motions.parquet"),
            responses: file("responses.parquet"),
            ida: file("ida.parquet"),
            pex: file("pex.parquet"),
            pro: file("pro.parquet"),
            universality: file("universality.parquet"),
            ranking: file("ranking.parquet"),
            paper: file("paper.parquet"),
            folder: folder.to_path_buf(),
            report: file("report.html"),
        }
    }
}

/// The stages that a configuration asks for, in order.
///
/// # Errors
/// If an option is out of range, or two stages make the motions.
pub fn stages(config: &Config, files: &Files) -> anyhow::Result<Vec<Box<dyn Stage>>> {
    let mut stages: Vec<Box<dyn Stage>> = Vec::new();
    if let Some(options) = &config.sample_scenarios {
        stages.push(Box::new(SampleScenarios::new(options, files.scenarios.clone())?));
    }
    if let Some(options) = &config.synthesize_motions {
        let (input, out) = (files.scenarios.clone(), files.motions.clone());
        stages.push(Box::new(SynthesizeMotions::new(options, input, out)?));
    }
    if let Some(options) = &config.import_motions {
        if config.synthesize_motions.is_some() {
            return Err(UsageError::because(
                "both synthesize-motions and import-motions make the motions; leave one of them out",
            ));
        }
        stages.push(Box::new(ImportMotions::new(options, files.motions.clone())?));
    }
    if let Some(options) = &config.simulate {
        stages.push(Box::new(Simulate::new(options, files.motions.clone(), files.responses.clone())?));
    }
    if let Some(options) = &config.ida {
        stages.push(Box::new(Ida::new(options, files.motions.clone(), files.ida.clone())?));
    }
    if let Some(options) = &config.fit_pex {
        stages.push(Box::new(FitPex::new(options, files.responses.clone(), files.pex.clone())?));
    }
    if let Some(options) = &config.fit_pro {
        stages.push(Box::new(FitPro::new(options, files.responses.clone(), files.pro.clone())?));
    }
    if let Some(options) = &config.universality {
        let (input, out) = (files.responses.clone(), files.universality.clone());
        stages.push(Box::new(Universality::new(options, input, out)?));
    }
    if let Some(options) = &config.rank_ims {
        let (responses, motions) = (files.responses.clone(), Some(files.motions.clone()));
        stages.push(Box::new(RankIms::new(options, responses, motions, files.ranking.clone())?));
    }
    if let Some(options) = &config.compare_paper {
        let inputs = [files.pex.clone(), files.pro.clone(), files.responses.clone()];
        stages.push(Box::new(ComparePaper::new(options, inputs, files.paper.clone())?));
    }
    if let Some(options) = &config.report {
        stages.push(Box::new(Report::new(options, files.folder.clone(), files.report.clone())?));
    }
    Ok(stages)
}

/// Runs the stages in order, after other runs in the same folder.
///
/// # Errors
/// That of the first stage that fails.
pub fn run(stages: &[Box<dyn Stage>], force: bool, console: &Console) -> anyhow::Result<()> {
    let _claimed = match stages.first() {
        Some(stage) => cache::claim_folder(stage.as_ref(), Claim::Alone, console)?,
        None => None,
    };
    stages.iter().try_for_each(|stage| cache::run(stage.as_ref(), force, console))
}

/// What a run would do and why, without doing it.
///
/// # Errors
/// If an input that no stage makes is missing.
pub fn dry_run(stages: &[Box<dyn Stage>], force: bool) -> anyhow::Result<String> {
    let mut text = String::new();
    let mut anew: Vec<PathBuf> = Vec::new();
    for stage in stages {
        let waits =
            stage.inputs().into_iter().find(|(_, source)| anew.iter().any(|path| path == source.name()));
        let state = match waits {
            Some((role, _)) => Freshness::Stale(format!("the {role} are made anew")),
            None if force => Freshness::Stale("--force".to_string()),
            None => freshness(stage.as_ref(), &stage.provenance()?),
        };
        let verdict = match &state {
            Freshness::UpToDate => "up to date".to_string(),
            Freshness::Stale(reason) => format!("would run: {reason}"),
        };
        writeln!(text, "{:20} {verdict}", stage.subcommand())?;
        if let serde_json::Value::Object(parameters) = stage.parameters() {
            for (name, value) in parameters {
                writeln!(text, "    {name}: {value}")?;
            }
        }
        for path in stage.outputs() {
            writeln!(text, "    -> {}", path.display())?;
        }
        if state != Freshness::UpToDate {
            anew.extend(stage.outputs());
        }
    }
    Ok(text)
}
