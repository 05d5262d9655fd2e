//! Tables of intensities, Parquet or CSV: peaks by their headings, structures by their columns.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{Field, Schema};

use crate::fragility::Peak;
use crate::pipeline::UsageError;
use crate::plausibility::judge_peak;
use crate::rocking::Structure;
use crate::sheet::{Heading, Sheet};
use crate::stages::shared::hazard::{Renamed, headings, peak, rename};
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::Table;

/// Reads the rows of a table.
pub fn read(path: &Path, renamed: &[Renamed]) -> anyhow::Result<Vec<Batch>> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) {
        return Ok(vec![Batch { path: path.into(), first_row: 0, rows: read_csv(path, renamed)? }]);
    }
    let table = Table::open(path)?;
    Ok(table.batches(&|_| true).collect::<Result<_, TableError>>()?)
}

/// A peak of each row, m/s2 or m/s.
pub fn peaks(batch: &Batch, wanted: Peak) -> anyhow::Result<Vec<f64>> {
    let schema = batch.rows.schema();
    let found = schema.fields().iter().filter_map(|field| {
        let (peak, unit) = peak(&Heading::of(field.name()))?;
        (peak == wanted).then(|| (field.name().clone(), unit))
    });
    let found: Vec<(String, f64)> = found.collect();
    let (column, expected) = match wanted {
        Peak::Pga => ("pga_m_s2", "pga_m_s2 or pga_g"),
        Peak::Pgv => ("pgv_m_s", "pgv_m_s"),
    };
    if let [(first, _), (second, _), ..] = &found[..] {
        let path = batch.path.display();
        return Err(UsageError::because(format!("{path}: columns {first} and {second}; leave out one")));
    }
    let [(name, unit)] = &found[..] else {
        let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        return Err(UsageError::because(format!(
            "{}: columns {}; expected {expected}; --columns {column}=HEADING renames one",
            batch.path.display(),
            names.join(", ")
        )));
    };
    let judged = |(row, value): (usize, f64)| match judge_peak(wanted == Peak::Pgv, value * unit) {
        Ok(()) => Ok(value * unit),
        Err(possible) => Err(batch.value_error(row, expected, format!("expected {possible}")).into()),
    };
    batch.numbers(name)?.into_iter().enumerate().map(judged).collect()
}

/// The structure of each row.
pub fn structures(batch: &Batch) -> anyhow::Result<Vec<Structure>> {
    let (p, alpha) = (batch.required_numbers("p_rad_s")?, batch.required_numbers("alpha_rad")?);
    let eta = batch.required_numbers("eta")?;
    let structure = |row: usize| Ok(batch.structure(row, "structure", [p[row], alpha[row], eta[row]])?);
    (0..batch.rows.num_rows()).map(structure).collect()
}

/// The columns of a CSV table: numbers where all cells are, else text. Peaks are kept under their headings.
fn read_csv(path: &Path, renamed: &[Renamed]) -> anyhow::Result<RecordBatch> {
    let mut sheet = Sheet::parse(&std::fs::read(path).map_err(|source| TableError::io(path, source))?)
        .map_err(|error| TableError::table(path, error.to_string()))?;
    rename(&mut sheet, renamed)?;
    if sheet.lines.is_empty() {
        let problem = format!("no rows under {}; expected intensities", headings(&sheet));
        return Err(TableError::table(path, problem).into());
    }
    let column = |at: usize| -> (Field, ArrayRef) {
        let number = |row: usize| match sheet.cell(row, at) {
            "" => Some(None),
            _ => sheet.number(row, at).ok().map(Some),
        };
        let rows = 0..sheet.lines.len();
        let array: ArrayRef = match rows.clone().map(number).collect::<Option<Vec<_>>>() {
            Some(values) => Arc::new(Float64Array::from(values)),
            None => Arc::new(StringArray::from_iter_values(rows.map(|row| sheet.cell(row, at)))),
        };
        let heading = &sheet.headings[at];
        let name = match heading.name.as_str() {
            "p" => "p_rad_s",
            "alpha" => "alpha_rad",
            "tp" => "tp_s",
            "tm" => "tm_s",
            "magnitude" => "mw",
            _ => &heading.text,
        };
        (Field::new(name, array.data_type().clone(), true), array)
    };
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = (0..sheet.columns).map(column).unzip();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays)?)
}
