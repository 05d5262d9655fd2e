//! inspect: what a file holds and where it came from, or how it is read.

mod own;

use std::path::PathBuf;

use arrow_array::ArrayRef;
use arrow_schema::{DataType, Field};
use clap::{Args, ValueHint};
use parquet::arrow::arrow_reader::ArrowReaderMetadata;
use parquet::arrow::arrow_reader::statistics::StatisticsConverter;
use rockfrag_core::units::Unit;
use serde::{Deserialize, Serialize};

use crate::number::visible;
use crate::pipeline::options::number;
use crate::stages::shared::reading_args::ListArgs;
use crate::table::columns::numbers;
use crate::table::file::{ParquetTable, is_table};
use crate::table::frame::{self, Format};
use crate::table::provenance::{Provenance, on_command_line};
use crate::table::{dictionary, rows};

/// Show what a file holds and where it came from, or how a list, hazard, table of motions or record is read
#[derive(Debug, Args)]
pub struct Inspect {
    /// A Parquet file, or a folder of them; a file of your own
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    file: PathBuf,
    /// Print the first N rows in place of the columns
    #[arg(long, value_name = "N")]
    head: Option<usize>,
    /// text, csv or json
    #[arg(long, default_value = "text")]
    pub format: Format,
    /// Years represented by ground-motion fields
    #[arg(long, value_name = "YEARS", value_parser = number(1.0..=1e9, "years of 1 and more"))]
    effective_years: Option<f64>,
    #[command(flatten)]
    list: ListArgs,
    /// Time step of a record, s
    #[arg(long, value_name = "S", value_parser = number(1e-6..=10.0, "a time step above 0 s and up to 10 s"))]
    dt: Option<f64>,
    /// Unit of acceleration of a record
    #[arg(long, value_parser = Unit::parse_acceleration)]
    unit: Option<Unit>,
    /// Column of a record: number, heading, or all
    #[arg(long, value_name = "N|NAME|all")]
    column: Option<String>,
}

#[derive(Serialize, Deserialize)]
struct ColumnRow {
    column: String,
    unit: String,
    minimum: Option<f64>,
    maximum: Option<f64>,
    nulls: Option<i64>,
    meaning: String,
}

#[derive(Serialize)]
struct Inspected {
    file: String,
    rows: usize,
    made: Option<Provenance>,
    columns: Vec<ColumnRow>,
}

impl Inspect {
    pub fn run(&self) -> anyhow::Result<String> {
        if !self.file.is_dir() && !is_table(&self.file) {
            return self.own();
        }
        let table = ParquetTable::open(&self.file)?;
        if let Some(head) = self.head {
            let shown = frame::show(&frame::read(&table.head(head))?, self.format)?;
            return Ok(if self.format == Format::Text { cut(&shown) } else { shown });
        }
        let (file, fields) = (table.metadata(), table.schema().fields());
        let columns = fields.iter().map(|field| column(field, file)).collect::<Result<Vec<_>, _>>()?;
        let made = Provenance::from_footer(file.metadata());
        if self.format == Format::Json {
            let (file, rows) = (self.file.display().to_string(), table.rows());
            return Ok(serde_json::to_string_pretty(&Inspected { file, rows, made, columns })? + "\n");
        }
        let shown = frame::show(&frame::from_batch(&rows::batch(&columns)?)?, self.format)?;
        if self.format == Format::Csv {
            return Ok(shown);
        }
        let mut lines = vec![format!("{}: {} rows", self.file.display(), table.rows())];
        lines.extend(made.map_or(vec!["not written by rockfrag".to_string()], origin));
        Ok(cut(&above(&lines, &shown)))
    }
}

/// Lines about a file, above a table of its columns.
fn above(lines: &[String], table: &str) -> String {
    let lines = lines.iter().map(|line| format!("{}\n", visible(line, &[])));
    lines.collect::<String>() + "\n" + table
}

fn origin(made: Provenance) -> Vec<String> {
    let options = made.arguments.iter().flat_map(|(name, value)| on_command_line(name, value));
    let warnings = made.warnings.lines().into_iter().map(|line| format!("warning: {line}"));
    let first = format!("made by {}, rockfrag {}", made.stage, made.version);
    std::iter::once(first).chain(options.chain(warnings).map(|line| format!("  {line}"))).collect()
}

const WIDTH: usize = 100;

/// Lines that fit the terminal; what is cut stands in the other formats.
fn cut(text: &str) -> String {
    let lines = text.lines().map(|line| match line.char_indices().nth(WIDTH) {
        None => format!("{line}\n"),
        Some(_) => format!("{}...\n", line.chars().take(WIDTH - 3).collect::<String>().trim_end()),
    });
    lines.collect()
}

fn column(field: &Field, file: &ArrowReaderMetadata) -> parquet::errors::Result<ColumnRow> {
    let (unit, meaning) = dictionary::entry(field.name()).unwrap_or_default();
    let (groups, columns) = (file.metadata().row_groups(), file.parquet_schema());
    let leaf = (0..columns.num_columns()).find(|leaf| columns.get_column_root(*leaf).name() == field.name());
    let one = if let DataType::List(item) = field.data_type() { item } else { field };
    let known = StatisticsConverter::from_column_index(leaf.unwrap_or_default(), one, columns)?;
    let known = known.with_missing_null_counts_as_zero(false);
    let ends = |ends: &ArrayRef| numbers(ends).into_iter().flatten().flatten();
    let nulls = known.row_group_null_counts(groups)?.iter().sum::<Option<u64>>();
    Ok(ColumnRow {
        column: field.name().clone(),
        unit: if unit == "1" { String::new() } else { unit.to_string() },
        minimum: ends(&known.row_group_mins(groups)?).reduce(f64::min),
        maximum: ends(&known.row_group_maxes(groups)?).reduce(f64::max),
        nulls: nulls.filter(|_| !groups.is_empty()).map(|nulls| nulls as i64),
        meaning: meaning.to_string(),
    })
}
