//! Tables of intensities, Parquet or CSV: peaks by their headings, structures by their columns.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{Field, Schema};

use crate::fragility::Peak;
use crate::number::counted;
use crate::pipeline::UsageError;
use crate::plausibility::judge_peak;
use crate::rocking::Structure;
use crate::sheet::{Heading, Sheet};
use crate::stages::shared::hazard::{headings, peak, rename};
use crate::stages::shared::object_list::describes_object;
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::Table;

/// Reads the rows of a table.
pub fn read(path: &Path, renamed: &[(String, String)]) -> anyhow::Result<Vec<Batch>> {
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
    let mut found: Vec<(String, f64)> = found.collect();
    let (column, expected) = match wanted {
        Peak::Pga => ("pga_m_s2", "pga_m_s2 or pga_g"),
        Peak::Pgv => ("pgv_m_s", "pgv_m_s"),
    };
    if let Some(own) = found.iter().position(|(name, _)| name == column) {
        found = vec![found.swap_remove(own)];
    }
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
        Err(_) if value.is_nan() => Err(batch.value_error(row, column, "no value").into()),
        Err(possible) => Err(batch.value_error(row, column, format!("expected {possible}")).into()),
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
fn read_csv(path: &Path, renamed: &[(String, String)]) -> anyhow::Result<RecordBatch> {
    let mut sheet = Sheet::parse(&std::fs::read(path).map_err(|source| TableError::io(path, source))?)
        .map_err(|error| TableError::table(path, error.to_string()))?;
    rename(&mut sheet, renamed)?;
    let of_object = |heading: &&Heading| describes_object(heading);
    if let Some(heading) = sheet.headings.iter().find(of_object) {
        let problem = format!(
            "column '{}' describes an object; expected peaks, mw, p_rad_s, alpha_rad and eta: describe one \
             object by options, or list objects in --structures",
            heading.text
        );
        return Err(TableError::table(path, problem).into());
    }
    if sheet.headings.is_empty() || sheet.lines.is_empty() {
        let (rows, headings) = (counted(sheet.lines.len(), "row"), headings(&sheet));
        let problem = format!("{rows} under {headings}; expected intensities under pga_g and pgv_m_s");
        return Err(TableError::table(path, problem).into());
    }
    let column = |at: usize| -> Result<(Field, ArrayRef), TableError> {
        let heading = &sheet.headings[at];
        let number = |row: usize| match sheet.cell(row, at) {
            "" => Ok(None),
            _ => sheet.number(row, at).map(Some),
        };
        let rows = 0..sheet.lines.len();
        let array: ArrayRef = match rows.clone().map(number).collect::<Result<Vec<_>, _>>() {
            Ok(values) => Arc::new(Float64Array::from(values)),
            Err(error) if peak(heading).is_some() => return Err(TableError::table(path, error.to_string())),
            Err(_) => Arc::new(StringArray::from_iter_values(rows.map(|row| sheet.cell(row, at)))),
        };
        let name = match heading.name.as_str() {
            "m" | "magnitude" => "mw",
            "p" => "p_rad_s",
            "alpha" => "alpha_rad",
            "tp" => "tp_s",
            "tm" => "tm_s",
            _ => &heading.text,
        };
        Ok((Field::new(name, array.data_type().clone(), true), array))
    };
    let columns = (0..sheet.columns).map(column).collect::<Result<Vec<_>, _>>()?;
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = columns.into_iter().unzip();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays)?)
}
