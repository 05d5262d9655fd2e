//! The numbers that the paper publishes, ours beside them, and how ours spread over seeds.

use std::fmt::Write;
use std::path::Path;

use anyhow::Context;
use polars::prelude::DataFrame;
use serde::{Deserialize, Serialize};

use super::row::{ReadRow, table};
use super::schema;
use super::store::frame::read_frame;
use super::store::text_file;

/// The published transition between the two planes.
pub const TRANSITION: f64 = 1.30;

/// The largest file of a spread over seeds.
const MOST_MIB: u64 = 1;

const PUBLISHED: &str = include_str!("../../data/paper.csv");
const SPREAD: &str = include_str!("../../data/seed_spread.csv");

/// A published number; none where a row only holds a quantity derived from published ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Published {
    /// What it is.
    pub quantity: String,
    /// Where the paper prints it.
    pub place: String,
    /// Of which suite.
    pub suite: String,
    /// Of which structure.
    pub structure: String,
    pub published: Option<f64>,
    /// The least number that is printed so.
    pub print_low: Option<f64>,
    /// The largest.
    pub print_high: Option<f64>,
}

impl Published {
    /// Whether this is the number of that quantity, suite and structure.
    pub fn is(&self, quantity: &str, suite: &str, structure: &str) -> bool {
        self.quantity == quantity && self.suite == suite && self.structure == structure
    }

    /// The width of the interval of numbers that are printed so.
    pub fn rounding(&self) -> Option<f64> {
        Some(self.print_high? - self.print_low?)
    }

    /// Whether it is of that suite and structure.
    pub fn is_of(&self, suite: &Option<String>, structure: &str) -> bool {
        suite.as_deref() == Some(&self.suite) && structure == self.structure
    }
}

/// Our value of a quantity with one seed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SpreadRow {
    /// What it is.
    pub quantity: String,
    /// Of which suite.
    pub suite: String,
    /// Of which structure.
    pub structure: String,
    /// The seed of the whole pipeline.
    pub seed: u64,
    /// Our value.
    pub value: f64,
}

/// Reads CSV in which lines that start with # say where it comes from.
fn csv_reader(text: &str) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes())
}

/// All published numbers, in the order in which they are shown.
///
/// # Errors
/// If the table that is built in is damaged.
pub fn published() -> anyhow::Result<Vec<Published>> {
    let rows = csv_reader(PUBLISHED).into_deserialize();
    rows.collect::<Result<_, _>>().context("data/paper.csv")
}

/// The spread over seeds from a file, or the shipped one.
///
/// # Errors
/// If the file cannot be read or is no such table.
pub fn spread(path: Option<&Path>) -> anyhow::Result<Vec<SpreadRow>> {
    let name = path.map_or("data/seed_spread.csv".to_string(), |path| path.display().to_string());
    let text = match path {
        Some(path) => text_file::text(path, MOST_MIB, "a spread over seeds").with_context(|| name.clone())?,
        None => SPREAD.to_string(),
    };
    let rows = csv_reader(&text).into_deserialize();
    rows.collect::<Result<_, _>>().context(name)
}

table! {
    /// Each published number beside ours.
    pub struct PaperRow as PAPER = "paper comparison" by "compare-paper" {
        quantity: String,
        place: String,
        suite: Option<String>,
        structure: Option<String>,
        published: Option<f64>,
        ours: Option<f64>,
        spread_mean: Option<f64>,
        spread_sd: Option<f64>,
        seeds: i32,
        z: Option<f64>,
        seed_rms: Option<f64>,
        t2: Option<f64>,
        t2_p: Option<f64>,
    }
}

impl PaperRow {
    /// Ours beside a published number, with the mean and the standard deviation of `values`, ours over seeds. There is no z where the
    /// mean lies in what the print leaves open, and that is more than two of these standard deviations.
    pub fn new(number: &Published, ours: Option<f64>, values: &[f64]) -> PaperRow {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let enough = values.len() > 1;
        let (spread_mean, spread_sd) = (enough.then_some(mean), enough.then_some(variance.sqrt()));
        let is_open = |sd: f64| {
            let within = number.print_low? <= mean && mean <= number.print_high?;
            Some(within && number.rounding()? > 2.0 * sd)
        };
        let z = || {
            let sd = spread_sd.filter(|&sd| sd > 0.0 && is_open(sd) != Some(true))?;
            Some((number.published? - spread_mean?) / sd)
        };
        PaperRow {
            quantity: number.quantity.clone(),
            place: number.place.clone(),
            suite: Some(number.suite.clone()),
            structure: Some(number.structure.clone()),
            published: number.published,
            ours,
            spread_mean,
            spread_sd,
            seeds: values.len() as i32,
            z: z(),
            seed_rms: None,
            t2: None,
            t2_p: None,
        }
    }
}

/// Our values in a paper file, for the spread over seeds.
///
/// # Errors
/// If the file is no comparison with the paper.
pub fn ours(path: &Path, seed: u64) -> anyhow::Result<Vec<SpreadRow>> {
    let row = |row: PaperRow| {
        let PaperRow { quantity, suite, structure, ours, .. } = row;
        let (suite, structure) = (suite.unwrap_or_default(), structure.unwrap_or_default());
        Some(SpreadRow { quantity, suite, structure, seed, value: ours? })
    };
    Ok(PaperRow::read(path)?.into_iter().filter_map(row).collect())
}

/// The rows of the comparison that hold a number of ours.
///
/// # Errors
/// If the file is no comparison with the paper.
pub fn shown(path: &Path) -> anyhow::Result<DataFrame> {
    let frame = read_frame(path, &PAPER)?;
    let is_ours =
        frame.column(schema::ours.name)?.is_not_null() | frame.column(schema::t2.name)?.is_not_null();
    Ok(frame.filter(&is_ours)?)
}

/// The comparison as a table to read; rows that hold no number of ours are left out.
///
/// # Errors
/// If the file is no comparison with the paper.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let mut table = format!(
        "{:20} {:6} {:21} {:>10} {:>10} {:>10} {:>9} {:>7} {:>9} {:>8} {:>8}  {}\n",
        "quantity",
        "suite",
        "structure",
        "published",
        "ours",
        "mean",
        "sd",
        "z",
        "seed_rms",
        "T2",
        "T2_p",
        "place"
    );
    for row in PaperRow::read(path)?.iter().filter(|row| row.ours.or(row.t2).is_some()) {
        let number = |value: Option<f64>, decimals: usize| {
            value.map_or("-".to_string(), |value| format!("{value:.decimals$}"))
        };
        writeln!(
            table,
            "{:20} {:6} {:21} {:>10} {:>10} {:>10} {:>9} {:>7} {:>9} {:>8} {:>8}  {}",
            row.quantity,
            row.suite.as_deref().unwrap_or_default(),
            row.structure.as_deref().unwrap_or_default(),
            number(row.published, 3),
            number(row.ours, 3),
            number(row.spread_mean, 3),
            number(row.spread_sd, 3),
            number(row.z, 2),
            number(row.seed_rms, 3),
            number(row.t2, 1),
            row.t2_p.map_or("-".to_string(), probability),
            row.place,
        )?;
    }
    Ok(table)
}

/// Writes a probability with two digits that count.
fn probability(p: f64) -> String {
    if p < 0.001 { format!("{p:.1e}") } else { format!("{p:.2}") }
}
