//! seed-spread: the whole pipeline with one seed after the other, to see how far its numbers move by chance.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;

use super::config::Config;
use super::run::{Files, run, stages};
use crate::pipeline::console::Console;
use crate::pipeline::stage::folder_of;
use crate::table::paper::{self, SpreadRow};

/// How many seeds, and where to.
#[derive(Debug, Clone, Args)]
pub struct SeedSpreadOptions {
    /// Seeds 1 to N
    #[arg(long, default_value = "20")]
    pub seeds: u64,
    /// CSV file of every number with every seed
    #[arg(long, default_value = "seed_spread.csv")]
    pub out: PathBuf,
}

/// Repeats the pipeline of `config` and gathers the numbers that the paper publishes.
///
/// # Errors
/// Those of the stages.
pub fn seed_spread(config: &Config, options: &SeedSpreadOptions, console: &Console) -> anyhow::Result<()> {
    let folder = folder_of(&options.out);
    let mut rows: Vec<SpreadRow> = Vec::new();
    for seed in 1..=options.seeds {
        console.note(&format!("seed {seed} of {}", options.seeds));
        let scratch = tempfile::Builder::new().prefix(".seed-spread.").tempdir_in(folder)?;
        let files = Files::in_folder(scratch.path());
        let numbers_only = Config { report: None, ..config.with_seed(seed) };
        run(&stages(&numbers_only, &files)?, true, console)?;
        rows.extend(paper::ours(&files.paper, seed)?);
    }
    let mut partial = tempfile::NamedTempFile::new_in(folder)?;
    {
        let mut writer = csv::Writer::from_writer(&mut partial);
        rows.iter().try_for_each(|row| writer.serialize(row))?;
        writer.flush()?;
    }
    partial.persist(&options.out).with_context(|| options.out.display().to_string())?;
    Ok(())
}
