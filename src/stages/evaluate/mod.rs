//! evaluate: probabilities at one intensity, at each of a table, or over the hazard of a site.

mod answer;
mod point;
mod rates;
mod table;

use std::path::PathBuf;

use clap::Args;

pub use self::table::EvaluateTable;

use super::chosen_fits::ChosenFits;
use super::fits::FitsOptions;
use super::resampled_fits;
use super::structure_options::StructureOptions;
use crate::fragility::{ReplicateLimits, ResampledModel};
use crate::keyword::keywords;
use crate::pipeline::cache;
use crate::pipeline::console::Console;
use crate::pipeline::options::Word;
use crate::pipeline::stage::beside;
use crate::table::source::Source;

/// What is asked, of which fits and structure.
#[derive(Debug, Clone, Args)]
pub struct EvaluateOptions {
    #[command(flatten, next_help_heading = "Fits")]
    fits: FitsOptions,
    #[command(flatten, next_help_heading = "Structure")]
    structure: StructureOptions,
    #[command(flatten, next_help_heading = "One intensity")]
    point: PointOptions,
    #[command(flatten, next_help_heading = "Many intensities")]
    table: TableOptions,
    #[command(flatten, next_help_heading = "Hazard of a site")]
    hazard: HazardOptions,
    /// delta (of the standard errors), or from the resamples of fit-pex and fit-pro --bootstrap: percentile, or bc (bias-corrected)
    #[arg(long, default_value = "delta", help_heading = "Fits")]
    limits: Word<LimitsBy>,
    /// File to write [default: stdout; of a table: evaluated.parquet beside it]
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,
    /// table (to read), csv, json, or parquet (with --out)
    #[arg(long, default_value = "table", help_heading = "Output")]
    format: Word<Format>,
}

#[derive(Debug, Clone, Args)]
struct PointOptions {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G")]
    pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S")]
    pgv: Option<f64>,
    /// Period of the velocity pulse, s, where the measure needs it
    #[arg(long, value_name = "S")]
    tp: Option<f64>,
    /// Mean period, s, where the measure needs it
    #[arg(long, value_name = "S")]
    tm: Option<f64>,
}

#[derive(Debug, Clone, Args)]
struct TableOptions {
    /// Parquet table with pga_m_s2 and pgv_m_s, and where they differ p_rad_s, alpha_rad, eta, tp_s, tm_s
    #[arg(long = "in", value_name = "FILE", conflicts_with_all = ["pga", "pgv", "tp", "tm", "format"])]
    input: Option<PathBuf>,
}

#[derive(Debug, Clone, Args)]
struct HazardOptions {
    /// CSV file: pga_g or pgv_m_s with annual_rate_of_exceedance, or both with annual_rate_of_occurrence
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pga", "pgv", "tp", "tm", "input"])]
    hazard: Option<PathBuf>,
    /// p PGV / PGA of the motions, where the hazard knows one peak only
    #[arg(long, requires = "hazard")]
    ratio: Option<f64>,
    /// Time of exposure, years
    #[arg(long, default_value = "50")]
    years: f64,
}

/// Where limits come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LimitsBy {
    /// The standard errors of the fits.
    Delta,
    /// The fits of resampled cases.
    Percentile,
    /// The same, corrected for their bias.
    BiasCorrected,
}

keywords!(LimitsBy { Delta = "delta", Percentile = "percentile", BiasCorrected = "bc" });

/// How an answer is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// To read.
    Table,
    /// Comma-separated values.
    Csv,
    /// A list of objects.
    Json,
    /// As all files of the pipeline.
    Parquet,
}

keywords!(Format { Table = "table", Csv = "csv", Json = "json", Parquet = "parquet" });

impl LimitsBy {
    /// The fits, with their resamples where limits need them.
    fn choose(self, options: &FitsOptions) -> anyhow::Result<ChosenFits> {
        let chosen = options.choose()?;
        let limits = match self {
            LimitsBy::Delta => return Ok(chosen),
            LimitsBy::Percentile => ReplicateLimits::Percentile,
            LimitsBy::BiasCorrected => ReplicateLimits::BiasCorrected,
        };
        let replicates = resampled_fits::read(options, &chosen)?;
        Ok(ChosenFits { resampled: Some(ResampledModel { replicates, limits }), ..chosen })
    }

    /// The files that the fits come from, by the role each plays.
    fn fit_files(self, options: &FitsOptions) -> anyhow::Result<Vec<(&'static str, Source)>> {
        let mut files = vec![("pex", options.pex.clone()), ("pro", options.pro.clone())];
        if self != LimitsBy::Delta {
            let [pex, pro] = resampled_fits::files(options)?;
            files.extend([("pex bootstrap", pex.into()), ("pro bootstrap", pro.into())]);
        }
        Ok(files)
    }
}

/// Answers what the options ask: into a file, or as text that is to be printed.
///
/// # Errors
/// If an input cannot be used, an option is out of range, or the output cannot be written.
pub fn evaluate(options: &EvaluateOptions, force: bool, console: &Console) -> anyhow::Result<String> {
    if let Some(input) = &options.table.input {
        let out = options.out.clone().unwrap_or_else(|| beside(input, "evaluated.parquet"));
        let stage = EvaluateTable::new(&options.fits, options.limits.0, &options.structure, input, out)?;
        return cache::run_alone(&stage, force, console).map(|()| String::new());
    }
    let fits = options.limits.0.choose(&options.fits)?;
    fits.warn_of_few_events(console);
    let structure = options.structure.structure(fits.model.eta)?;
    fits.warn_of_eta(&structure, console);
    let answer = match &options.hazard.hazard {
        Some(path) => rates::answer(&options.hazard, path, &fits, &structure, console)?,
        None => point::answer(&options.point, &fits, &structure, console)?,
    };
    answer.deliver(options)
}
