//! The options of evaluate.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::keyword::{self, Keyword, keywords};
use crate::pipeline::declare::StageOptions;
use crate::pipeline::options::{Parsed, Word, defaults};
use crate::stages::shared::fits::FitsOptions;
use crate::stages::shared::structure_options::StructureOptions;
use crate::table::schema::headings::Headings;
use crate::table::store::source::Target;

/// What is asked, of which fits and structure.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct EvaluateOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub fits: FitsOptions,
    /// How to compute limits: delta (from standard errors), or from the resamples of fit-pex and fit-pro --bootstrap: percentile or
    /// bc (bias-corrected)
    #[arg(long, default_value = "delta", help_heading = "Fits")]
    pub limits: Word<LimitsBy>,
    /// Limit state of P_ex by the universal surface: a demand |theta|max / alpha from 0.02 to 0.5 [default: 0.1]
    #[arg(long, value_name = "DEMAND", help_heading = "Fits")]
    pub limit_state: Option<f64>,
    #[command(flatten)]
    #[serde(flatten)]
    pub structure: StructureOptions,
    #[command(flatten)]
    #[serde(flatten)]
    pub point: PointOptions,
    #[command(flatten)]
    #[serde(flatten)]
    pub hazard: HazardOptions,
    /// Which headings of the file of --hazard or --in stand for which columns, as pga_g=PGA,annual_rate_of_exceedance=rate
    #[arg(long, value_name = "COLUMN=HEADING,...", help_heading = "Hazard of a site")]
    pub columns: Option<Parsed<Headings>>,
    /// Format of the answer: table (to read), csv, json, or parquet (with --out) [default: by the ending of --out, or table]
    #[arg(long, help_heading = "Output")]
    pub format: Option<Word<Format>>,
}

impl Default for EvaluateOptions {
    fn default() -> Self {
        defaults()
    }
}

impl EvaluateOptions {
    /// The headings of files that are not the names of columns.
    pub(super) fn headings(&self) -> Headings {
        self.columns.clone().map_or(Headings::default(), |Parsed(headings)| headings)
    }
}

impl StageOptions for EvaluateOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        self.structure.structures.resolve_path(folder);
        if let Some(hazard) = &mut self.hazard.hazard {
            *hazard = folder.join(&*hazard);
        }
    }
}

/// One intensity.
#[derive(Debug, Clone, PartialEq, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "One intensity")]
pub struct PointOptions {
    /// Peak ground acceleration, g
    #[arg(long, value_name = "G", conflicts_with = "hazard")]
    pub pga: Option<f64>,
    /// Peak ground velocity, m/s
    #[arg(long, value_name = "M/S", conflicts_with = "hazard")]
    pub pgv: Option<f64>,
    /// Period of the velocity pulse, s, if the measure needs it
    #[arg(long, value_name = "S", conflicts_with = "hazard")]
    pub tp: Option<f64>,
    /// Mean period, s, if the measure needs it
    #[arg(long, value_name = "S", conflicts_with = "hazard")]
    pub tm: Option<f64>,
}

/// The hazard of a site.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
#[command(next_help_heading = "Hazard of a site")]
pub struct HazardOptions {
    /// CSV file with the columns pga_g, pga_m_s2 or pgv_m_s, and annual_rate_of_exceedance or
    /// probability_of_exceedance_in_50_years (or another number) or return_period (years); or PGA and PGV with
    /// annual_rate_of_occurrence
    #[arg(long, value_name = "FILE")]
    pub hazard: Option<PathBuf>,
    /// p PGV / PGA of all motions, for a hazard of one peak only: p in rad/s, PGV in m/s, PGA in m/s2 (not g), usually 0.1 to 0.6
    /// [default: distributed as in the motions of the fits]
    #[arg(long)]
    pub ratio: Option<f64>,
    /// Time of exposure, years
    #[arg(long, default_value = "50", value_name = "YEARS")]
    pub years: f64,
}

impl Default for HazardOptions {
    fn default() -> Self {
        defaults()
    }
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

keywords!(LimitsBy { Delta = "delta", Percentile = "percentile", BiasCorrected = "bc" } but &[
    ("profile", "profile limits are of the parameters of a curve, in the columns *_profile_* of fit-pro"),
]);

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

impl Format {
    /// The format of a file by how its name ends.
    pub(super) fn of(target: &Target) -> Format {
        let ending = target.path().and_then(Path::extension).unwrap_or_default().to_string_lossy();
        keyword::parse(&ending).unwrap_or(Format::Table)
    }

    pub(super) fn ending(self) -> &'static str {
        match self {
            Format::Table => "txt",
            other => other.as_str(),
        }
    }
}
