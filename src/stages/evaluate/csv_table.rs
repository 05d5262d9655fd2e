//! A table of intensities in a CSV file: what a Parquet file would hold, with units in its headings.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, anyhow, bail};
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{Field, Schema};

use crate::fragility::Peak;
use crate::pipeline::options;
use crate::stages::shared::hazard::Cell;
use crate::table::schema::headings::{Headings, NO_SPECTRAL, is_spectral};
use crate::table::schema::{self, Column};
use crate::table::store::source::MemoryTable;
use crate::table::store::text_file::{self, CsvText};

/// The largest file: a million rows.
const MOST_MIB: u64 = 64;

/// Numbers beside the peaks, and their names without a unit.
const NUMBERS: [(Column, &str); 5] = [
    (schema::p_rad_s, "p"),
    (schema::alpha_rad, "alpha"),
    (schema::eta, "eta"),
    (schema::tp_s, "tp"),
    (schema::tm_s, "tm"),
];

/// What a column holds.
#[derive(Clone, Copy)]
enum Of {
    /// A peak in the unit of its heading.
    Peak(Cell, &'static str),
    /// A number, or nothing.
    Number(&'static str),
    /// Anything, which goes along.
    Other,
}

impl Of {
    fn named(name: &str) -> Of {
        let number = || NUMBERS.iter().find(|(column, short)| [column.name, short].contains(&name));
        match (Cell::of(name), number()) {
            (Some(cell @ Cell::Peak(Peak::Pga, _)), _) => Of::Peak(cell, schema::pga_m_s2.name),
            (Some(cell @ Cell::Peak(Peak::Pgv, _)), _) => Of::Peak(cell, schema::pgv_m_s.name),
            (_, Some((column, _))) => Of::Number(column.name),
            _ => Of::Other,
        }
    }
}

/// Whether a file is one of these, by how its name ends.
pub fn is_csv(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"))
}

/// Reads the table: pga_g or pga_m_s2, pgv_m_s, and p, alpha, eta, tp and tm where they are; other columns as they stand.
///
/// # Errors
/// If the file cannot be read, lacks a peak, or holds what is no number.
pub fn read(path: &Path, headings: &Headings) -> anyhow::Result<MemoryTable> {
    let read = || of(&text_file::text(path, MOST_MIB, "a table of intensities")?, headings);
    let rows = read().with_context(|| path.display().to_string())?;
    Ok(MemoryTable { name: path.to_path_buf(), schema: rows.schema(), batches: vec![rows] })
}

fn of(text: &str, headings: &Headings) -> anyhow::Result<RecordBatch> {
    let is_known = |name: &str| {
        !matches!(Of::named(name), Of::Other)
            || headings.headings().any(|other| text_file::plain(other) == name)
    };
    let mut table = CsvText::new(text, is_known)?;
    table.rename(headings).map_err(|error| anyhow!(error))?;
    let (names, named) = (table.names.clone(), table.headings.clone());
    let columns: Vec<(usize, Of)> =
        (0..named.len()).filter(|&at| !named[at].is_empty()).map(|at| (at, Of::named(&names[at]))).collect();
    for (peak, expected) in [(schema::pga_m_s2.name, "pga_g or pga_m_s2"), (schema::pgv_m_s.name, "pgv_m_s")]
    {
        if !columns.iter().any(|(_, of)| matches!(of, Of::Peak(_, name) if *name == peak)) {
            let spectral = named.iter().find(|heading| is_spectral(heading));
            let spectral = spectral.map_or(String::new(), |heading| {
                format!("; '{heading}' is a spectral acceleration, and {NO_SPECTRAL}")
            });
            bail!(
                "columns {}; expected {expected}{spectral}; --columns {}=HEADING takes another heading",
                named.join(", "),
                expected.split(' ').next().unwrap_or_default()
            );
        }
    }
    let rows = table.rows().collect::<Result<Vec<_>, String>>().map_err(|error| anyhow!(error))?;
    if rows.is_empty() {
        bail!("no rows; expected intensities under the headings");
    }
    let array = |&(at, of): &(usize, Of)| -> anyhow::Result<(String, ArrayRef)> {
        let cells = rows.iter().map(|(line, row)| (line, row.get(at).unwrap_or_default()));
        let refused = |line: &u64, text: &str, expected: String| {
            anyhow!("line {line}, column '{}': '{text}'; {expected}", named[at])
        };
        let empty = |text: &str| text.is_empty().then_some(None);
        Ok(match of {
            Of::Peak(cell, name) => {
                let peak = |(line, text): (&u64, &str)| {
                    cell.read(text).map_err(|expected| refused(line, text, format!("expected {expected}")))
                };
                let values = cells.map(peak).collect::<anyhow::Result<Vec<f64>>>()?;
                (name.to_string(), Arc::new(Float64Array::from(values)) as ArrayRef)
            }
            Of::Number(name) => {
                let number = |(line, text): (&u64, &str)| match empty(text) {
                    Some(nothing) => Ok(nothing),
                    None => options::number(text).map(Some).map_err(|expected| refused(line, text, expected)),
                };
                let values = cells.map(number).collect::<anyhow::Result<Vec<Option<f64>>>>()?;
                (name.to_string(), Arc::new(Float64Array::from(values)) as ArrayRef)
            }
            Of::Other => (named[at].clone(), kept(&cells.map(|(_, text)| text).collect::<Vec<_>>())),
        })
    };
    let arrays = columns.iter().map(array).collect::<anyhow::Result<Vec<_>>>()?;
    for (at, (name, _)) in arrays.iter().enumerate() {
        if arrays[..at].iter().any(|(other, _)| other == name) {
            bail!("two columns of {name}: {}; keep one", named.join(", "));
        }
    }
    let fields = arrays.iter().map(|(name, array)| Field::new(name, array.data_type().clone(), true));
    let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
    Ok(RecordBatch::try_new(schema, arrays.into_iter().map(|(_, array)| array).collect())?)
}

/// A column that goes along: whole numbers, numbers, or else text.
fn kept(cells: &[&str]) -> ArrayRef {
    fn all<T: std::str::FromStr>(cells: &[&str]) -> Option<Vec<Option<T>>> {
        cells
            .iter()
            .map(|cell| if cell.is_empty() { Some(None) } else { cell.parse().ok().map(Some) })
            .collect()
    }
    match (all::<i64>(cells), all::<f64>(cells)) {
        (Some(counts), _) => Arc::new(Int64Array::from(counts)),
        (None, Some(numbers)) => Arc::new(Float64Array::from(numbers)),
        (None, None) => Arc::new(StringArray::from(cells.to_vec())),
    }
}
