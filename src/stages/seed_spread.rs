//! seed-spread: the whole pipeline with one seed after the other, to see how far its numbers move by chance.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;

use super::compare_paper::ComparePaper;
use super::registry::Config;
use super::run::run;
use crate::pipeline::UsageError;
use crate::pipeline::cache::May;
use crate::pipeline::console::Console;
use crate::pipeline::declare::Declare;
use crate::pipeline::replace;
use crate::pipeline::stage::{Stage, folder_of};
use crate::table::paper::{self, SpreadRow};

/// How many seeds, and where to.
#[derive(Debug, Clone, Args)]
pub struct SeedSpreadOptions {
    /// Number of seeds, from 1 on
    #[arg(long, default_value = "20", value_name = "N")]
    pub seeds: u64,
    /// CSV file to write: each number with each seed
    #[arg(long, default_value = "seed_spread.csv", value_name = "FILE")]
    pub out: PathBuf,
}

/// Repeats the pipeline of a file and gathers the numbers that the paper publishes.
///
/// # Errors
/// Those of the stages.
pub fn seed_spread(
    pipeline: &Path,
    options: &SeedSpreadOptions,
    may: May,
    console: &Console,
) -> anyhow::Result<()> {
    let config = Config::read(pipeline)?;
    if config.compare_paper.is_none() {
        return Err(UsageError::because(format!(
            "{}: no compare-paper, whose numbers seed-spread gathers; add 'compare-paper: {{}}'",
            pipeline.display()
        )));
    }
    let out = options.out.as_path();
    if !may.overwrite && !is_new_or_own(out) {
        return Err(replace::refusal(out, replace::FOREIGN, "seed-spread"));
    }
    let folder = folder_of(out);
    let mut rows: Vec<SpreadRow> = Vec::new();
    for seed in 1..=options.seeds {
        console.note(&format!("seed {seed} of {}", options.seeds));
        let scratch = tempfile::Builder::new().prefix(".seed-spread.").tempdir_in(folder)?;
        let numbers = scratch.path().join(ComparePaper::OUTPUT.file);
        let stages = config.clone().with_seed(seed).stages(scratch.path())?;
        run(&needed_for(&numbers, stages), May { force: true, ..May::default() }, console)?;
        rows.extend(paper::ours(&numbers, seed)?);
    }
    let mut partial = tempfile::NamedTempFile::new_in(folder)?;
    {
        let (version, pipeline) = (env!("CARGO_PKG_VERSION"), pipeline.display());
        writeln!(partial, "# rockfrag {version}: rockfrag seed-spread {pipeline} --seeds {}", options.seeds)?;
        let mut writer = csv::Writer::from_writer(&mut partial);
        rows.iter().try_for_each(|row| writer.serialize(row))?;
        writer.flush()?;
    }
    partial.persist(&options.out).with_context(|| options.out.display().to_string())?;
    Ok(())
}

/// Whether a file is not there, is empty, or is such a spread.
fn is_new_or_own(out: &Path) -> bool {
    let is_empty = std::fs::metadata(out).map_or(true, |there| there.len() == 0);
    is_empty || paper::spread(Some(out)).is_ok_and(|rows| !rows.is_empty())
}

/// Those of the stages of a run, in order, on which a file depends.
fn needed_for(file: &Path, stages: Vec<Box<dyn Stage>>) -> Vec<Box<dyn Stage>> {
    let mut files = vec![file.to_path_buf()];
    let mut needed = Vec::new();
    for stage in stages.into_iter().rev() {
        if stage.outputs().iter().any(|output| files.contains(output)) {
            files.extend(stage.inputs().iter().map(|(_, source)| source.name().to_path_buf()));
            needed.push(stage);
        }
    }
    needed.reverse();
    needed
}
