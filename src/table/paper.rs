//! The numbers that the paper publishes, ours beside them, and how ours spread over seeds.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use anyhow::Context;
use arrow_array::{ArrayRef, Float64Array, Int32Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use polars::prelude::DataFrame;
use serde::{Deserialize, Serialize};

use super::frame::read_frame;
use super::schema::{self, Column, PAPER};
use super::text_file;

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
    /// The number.
    pub published: Option<f64>,
}

impl Published {
    /// Whether this is the number of that quantity, suite and structure.
    pub fn is(&self, quantity: &str, suite: &str, structure: &str) -> bool {
        self.quantity == quantity && self.suite == suite && self.structure == structure
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

/// All published numbers, in the order in which they are shown.
///
/// # Errors
/// If the table that is built in is damaged.
pub fn published() -> anyhow::Result<Vec<Published>> {
    let rows = csv::Reader::from_reader(PUBLISHED.as_bytes()).into_deserialize();
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
    let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
    rows.collect::<Result<_, _>>().context(name)
}

/// A published number beside ours.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperRow {
    /// The published number.
    pub published: Published,
    /// Ours, from the files at hand.
    pub ours: Option<f64>,
    /// Mean of ours over seeds.
    pub mean: Option<f64>,
    /// Standard deviation of ours over seeds.
    pub sd: Option<f64>,
    /// How many seeds.
    pub seeds: i32,
}

impl PaperRow {
    /// With the mean and the standard deviation of `values`, ours over seeds.
    pub fn new(published: Published, ours: Option<f64>, values: &[f64]) -> PaperRow {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let enough = values.len() > 1;
        PaperRow {
            published,
            ours,
            mean: enough.then_some(mean),
            sd: enough.then_some(variance.sqrt()),
            seeds: values.len() as i32,
        }
    }

    /// (published - mean) / standard deviation.
    fn z(&self) -> Option<f64> {
        let sd = self.sd.filter(|&sd| sd > 0.0)?;
        Some((self.published.published? - self.mean?) / sd)
    }
}

/// The rows of the paper file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[PaperRow]) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&Published) -> &str| -> ArrayRef {
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| value(&row.published))))
    };
    let number = |value: fn(&PaperRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        text(|p| &p.quantity),
        text(|p| &p.place),
        text(|p| &p.suite),
        text(|p| &p.structure),
        number(|row| row.published.published),
        number(|row| row.ours),
        number(|row| row.mean),
        number(|row| row.sd),
        Arc::new(Int32Array::from_iter_values(rows.iter().map(|row| row.seeds))),
        number(PaperRow::z),
    ];
    RecordBatch::try_new(PAPER.schema(), columns)
}

/// Our values in a paper file, for the spread over seeds.
///
/// # Errors
/// If the file is no comparison with the paper.
pub fn ours(path: &Path, seed: u64) -> anyhow::Result<Vec<SpreadRow>> {
    let frame = read_frame(path, &PAPER)?;
    let cells = Cells { frame: &frame };
    let row = |row| {
        Some(SpreadRow {
            quantity: cells.text(&schema::QUANTITY, row),
            suite: cells.text(&schema::SUITE, row),
            structure: cells.text(&schema::STRUCTURE, row),
            seed,
            value: cells.number(&schema::OURS, row)?,
        })
    };
    Ok((0..frame.height()).filter_map(row).collect())
}

/// The comparison as a table to read; rows that we have no number for are left out.
///
/// # Errors
/// If the file is no comparison with the paper.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let frame = read_frame(path, &PAPER)?;
    let cells = Cells { frame: &frame };
    let mut table = format!(
        "{:20} {:6} {:21} {:>10} {:>10} {:>10} {:>9} {:>7}  {}\n",
        "quantity", "suite", "structure", "published", "ours", "mean", "sd", "z", "place"
    );
    for row in (0..frame.height()).filter(|&row| cells.number(&schema::OURS, row).is_some()) {
        let number = |column, decimals: usize| {
            cells.number(column, row).map_or("-".to_string(), |value| format!("{value:.decimals$}"))
        };
        writeln!(
            table,
            "{:20} {:6} {:21} {:>10} {:>10} {:>10} {:>9} {:>7}  {}",
            cells.text(&schema::QUANTITY, row),
            cells.text(&schema::SUITE, row),
            cells.text(&schema::STRUCTURE, row),
            number(&schema::PUBLISHED, 3),
            number(&schema::OURS, 3),
            number(&schema::SPREAD_MEAN, 3),
            number(&schema::SPREAD_SD, 3),
            number(&schema::Z, 2),
            cells.text(&schema::PLACE, row),
        )?;
    }
    Ok(table)
}

/// Single values of a frame.
struct Cells<'a> {
    frame: &'a DataFrame,
}

impl Cells<'_> {
    fn text(&self, column: &Column, row: usize) -> String {
        let cell = || self.frame.column(column.name).ok()?.str().ok()?.get(row);
        cell().unwrap_or_default().to_string()
    }

    fn number(&self, column: &Column, row: usize) -> Option<f64> {
        self.frame.column(column.name).ok()?.f64().ok()?.get(row)
    }
}
