//! Probabilities at each intensity of a table.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{Field, Schema};
use rayon::prelude::*;

use super::Evaluate;
use super::object::{Predicted, TreeRow, texts};
use crate::fragility::{Model, Peak, Scenarios};
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::rocking::Structure;
use crate::sheet::{Heading, Sheet};
use crate::stages::shared::hazard::{headings, peak, rename};
use crate::stages::shared::motions::known;
use crate::stages::shared::structures::warnings_of;
use crate::table::TableError;
use crate::table::columns::Columns;
use crate::table::file::Table;
use crate::table::rows;
use crate::warning::{Warning, Warnings};

/// The model of each structure by its parameters.
type Models = HashMap<[u64; 3], (Structure, Model, Vec<Warning>)>;

/// Reads intensities, and writes them with their probabilities.
pub fn run(options: &Evaluate, path: &Path, context: &Context) -> anyhow::Result<String> {
    let is_csv = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv"));
    let table = if is_csv { None } else { Some(Table::open(path)?) };
    let batches: Vec<RecordBatch> = match &table {
        Some(table) => {
            table.batches(&|_| true).map(|batch| Ok(batch?.rows)).collect::<Result<_, TableError>>()?
        }
        None => vec![read_csv(options, path)?],
    };
    let given = if options.structures.is_given() { options.structures.resolve()? } else { Vec::new() };
    if given.len() > 1 {
        return Err(UsageError::because(
            "a table of intensities: expected one structure, or p_rad_s, alpha_rad and eta in the table",
        ));
    }
    let (mut models, mut evaluated, mut first_row) = (Models::new(), Vec::new(), 0);
    for batch in batches {
        let columns = Columns { path, first_row, batch: &batch };
        evaluated.push(evaluate(options, &columns, given.first(), &mut models, context)?);
        first_row += batch.num_rows() as u64;
    }
    match first_row {
        0 => Err(TableError::table(path, "no rows; expected intensities").into()),
        rows => options.write(&evaluated, || format!("{rows} intensities evaluated\n"), context),
    }
}

/// The rows with their probabilities; columns of the input stand behind, but for those of the same name.
fn evaluate(
    options: &Evaluate,
    columns: &Columns,
    given: Option<&Structure>,
    models: &mut Models,
    context: &Context,
) -> anyhow::Result<RecordBatch> {
    let [pga, pgv] = [peaks(columns, Peak::Pga)?, peaks(columns, Peak::Pgv)?];
    let [tp, tm] = [columns.numbers("tp_s")?, columns.numbers("tm_s")?];
    let structures = match given {
        Some(structure) => vec![structure.clone(); columns.rows()],
        None => structures(columns)?,
    };
    let fitted = options.fits.models()?;
    let key =
        |structure: &Structure| [structure.p_rad_s, structure.alpha_rad, structure.eta].map(f64::to_bits);
    for structure in &structures {
        if let Entry::Vacant(place) = models.entry(key(structure)) {
            let (model, mut warnings) = fitted.model(structure)?;
            warnings.extend(warnings_of(structure));
            place.insert((structure.clone(), model, warnings));
        }
    }
    let of_row = |row: usize| {
        let (structure, model, of_structure) = &models[&key(&structures[row])];
        let measures = IntensityMeasures::new(structure, pga[row], pgv[row], known(tp[row]), known(tm[row]));
        let mut warnings = of_structure.clone();
        warnings.extend(model.warnings(structure, &measures));
        let tree =
            TreeRow::new([pga[row], pgv[row]], &model.probabilities(structure, &measures, Scenarios::One));
        (tree.with_warnings(texts(&warnings)), warnings)
    };
    let (trees, warnings): (Vec<TreeRow>, Vec<Vec<Warning>>) =
        (0..columns.rows()).into_par_iter().map(of_row).unzip();
    let place = |row: usize| format!("row {}", columns.first_row + row as u64);
    let warnings = warnings.into_iter().enumerate().flat_map(|(row, warnings)| {
        let place = place(row);
        warnings.into_iter().map(move |warning| (warning, place.clone()))
    });
    context.warn(warnings.collect::<Warnings>());
    let own = rows::batch(&trees)?;
    let schema = columns.batch.schema();
    let kept: Vec<usize> = (0..schema.fields().len())
        .filter(|&at| own.schema().index_of(schema.field(at).name()).is_err())
        .collect();
    rows::side_by_side(&[own, columns.batch.project(&kept)?])
}

/// A peak of each row, m/s2 or m/s.
fn peaks(columns: &Columns, wanted: Peak) -> anyhow::Result<Vec<f64>> {
    let schema = columns.batch.schema();
    let found = schema.fields().iter().find_map(|field| {
        let (peak, unit) = peak(&Heading::of(field.name()))?;
        (peak == wanted).then(|| (field.name().clone(), unit))
    });
    let expected = if wanted == Peak::Pga { "pga_m_s2 or pga_g" } else { "pgv_m_s" };
    let Some((name, unit)) = found else {
        let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        return Err(UsageError::because(format!(
            "{}: columns {}; expected {expected}; --columns {}=HEADING renames one",
            columns.path.display(),
            names.join(", "),
            expected.split(' ').next().unwrap_or_default()
        )));
    };
    let values = columns.numbers(&name)?;
    match values.iter().position(|value| !(*value >= 0.0 && value.is_finite())) {
        Some(row) => Err(columns.value_error(row, expected, "expected a number of 0 or more").into()),
        None => Ok(values.into_iter().map(|value| value * unit).collect()),
    }
}

fn structures(columns: &Columns) -> anyhow::Result<Vec<Structure>> {
    let (p, alpha) = (columns.required_numbers("p_rad_s")?, columns.required_numbers("alpha_rad")?);
    let eta = columns.required_numbers("eta")?;
    let structure = |row: usize| {
        Structure::new("structure", p[row], alpha[row], eta[row])
            .map_err(|error| columns.value_error(row, "p_rad_s", error.to_string()).into())
    };
    (0..columns.rows()).map(structure).collect()
}

/// The columns of a CSV table: numbers where all cells are, else text. Peaks are kept under their headings.
fn read_csv(options: &Evaluate, path: &Path) -> anyhow::Result<RecordBatch> {
    let mut sheet = Sheet::parse(&std::fs::read(path).map_err(|source| TableError::io(path, source))?)
        .map_err(|error| TableError::table(path, error.to_string()))?;
    rename(&mut sheet, &options.columns)?;
    if sheet.lines.is_empty() {
        return Err(TableError::table(
            path,
            format!("no rows under {}; expected intensities", headings(&sheet)),
        )
        .into());
    }
    let column = |at: usize| -> (Field, ArrayRef) {
        let rows = 0..sheet.lines.len();
        let number = |row: usize| match sheet.cell(row, at) {
            "" => Some(None),
            _ => sheet.number(row, at).ok().map(Some),
        };
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
            _ => &heading.text,
        };
        (Field::new(name, array.data_type().clone(), true), array)
    };
    let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = (0..sheet.columns).map(column).unzip();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays)?)
}
