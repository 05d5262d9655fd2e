//! Probabilities at each intensity of a table.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

use arrow_array::RecordBatch;
use rayon::prelude::*;

use super::intensities::{self, peaks};
use super::object::{DoubtsRow, Subject};
use super::point::TreeRow;
use crate::fragility::Peak;
use crate::hazard::Motion;
use crate::number::counted;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::plausibility::judge_peaks;
use crate::rocking::Structure;
use crate::stages::shared::model_args::Models;
use crate::stages::shared::motions::known;
use crate::stages::shared::objects::Object;
use crate::stages::shared::spec::{Place, Restitution, Spec};
use crate::stages::shared::structures::StructureArgs;
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::rows;
use crate::warning::{Warning, Warnings};

/// What is predicted for, and the warnings about it.
type Known = (Subject, Vec<Warning>);

/// Reads intensities, and returns them with their probabilities, and what to print.
pub fn evaluate(
    path: &Path,
    renamed: &[(String, String)],
    structures: &StructureArgs,
    place: &Place,
    models: &Models,
    context: &Context,
) -> anyhow::Result<(Vec<RecordBatch>, String)> {
    let batches = intensities::read(path, renamed)?;
    let given = if structures.is_given() { structures.objects(place)?.0 } else { Vec::new() };
    if given.len() > 1 {
        return Err(UsageError::because(
            "a table of intensities: expected one structure, or p_rad_s, alpha_rad and eta in the table",
        ));
    }
    let of_structures = ["p_rad_s", "alpha_rad", "eta", "width", "height", "width_m", "height_m"];
    let columns = batches.first().map(|batch| batch.rows.schema());
    let column = columns.and_then(|all| of_structures.into_iter().find(|name| all.index_of(name).is_ok()));
    if let Some(column) = column.filter(|_| !given.is_empty()) {
        let path = path.display();
        return Err(UsageError::because(format!(
            "{path}: column {column} and options of a structure; leave out the one or the other"
        )));
    }
    let given = given.first().map(|object| subject(object, models)).transpose()?;
    let mut of_rows = HashMap::new();
    let mut evaluated = Vec::new();
    for batch in &batches {
        let structures = if given.is_some() { Vec::new() } else { intensities::structures(batch)? };
        for structure in &structures {
            if let Entry::Vacant(entry) = of_rows.entry(key(structure)) {
                let spec = Spec::of_structure(structure.clone(), Restitution::Number).at(place);
                entry.insert(subject(&Object::new(spec), models)?);
            }
        }
        let of_row = |row: usize| given.as_ref().unwrap_or_else(|| &of_rows[&key(&structures[row])]);
        evaluated.push(of_batch(batch, of_row, context)?);
    }
    match batches.iter().map(|batch| batch.rows.num_rows()).sum() {
        0 => Err(TableError::table(path, "no rows; expected intensities").into()),
        rows => Ok((evaluated, format!("{} evaluated\n", counted(rows, "row")))),
    }
}

/// What distinguishes structures.
fn key(structure: &Structure) -> [u64; 3] {
    [structure.p_rad_s, structure.alpha_rad, structure.eta].map(f64::to_bits)
}

fn subject(object: &Object, models: &Models) -> anyhow::Result<Known> {
    object.structure().map_err(UsageError::because)?;
    Subject::of(object, object.directions.as_deref().unwrap_or_default(), models)
}

/// The rows with their probabilities; columns of the input stand behind, but for those of the same name.
fn of_batch<'a>(
    batch: &Batch,
    of_row: impl Fn(usize) -> &'a Known + Sync,
    context: &Context,
) -> anyhow::Result<RecordBatch> {
    let [pga, pgv] = [peaks(batch, Peak::Pga)?, peaks(batch, Peak::Pgv)?];
    for (row, (&pga, &pgv)) in pga.iter().zip(&pgv).enumerate() {
        judge_peaks(pga, pgv).map_err(|problem| batch.value_error(row, "pgv_m_s", problem))?;
    }
    let mw = batch.magnitudes()?;
    let evaluate = |row: usize| {
        let (subject, of_structure) = of_row(row);
        let mut warnings = of_structure.clone();
        warnings.extend(subject.warnings([pga[row], pgv[row]]));
        let [pga_m_s2, pgv_m_s] = [pga[row], pgv[row]].map(Some);
        let motion = Motion { pga_m_s2, pgv_m_s, mw: known(mw[row]), vs30_m_s: None };
        let (tree, budget) = TreeRow::new(&motion, subject);
        (tree, (DoubtsRow::new(&warnings, &budget), warnings))
    };
    let (trees, others): (Vec<_>, Vec<_>) = (0..batch.rows.num_rows()).into_par_iter().map(evaluate).unzip();
    let (doubts, warnings): (Vec<DoubtsRow>, Vec<Vec<Warning>>) = others.into_iter().unzip();
    for (row, warnings) in warnings.into_iter().enumerate() {
        let place = format!("row {}", batch.first_row + row as u64 + 1);
        context.warn(warnings.into_iter().map(|warning| (warning, place.clone())).collect::<Warnings>());
    }
    let own = rows::side_by_side(&[rows::batch::<TreeRow>(&trees)?, rows::batch(&doubts)?])?;
    let schema = batch.rows.schema();
    let kept: Vec<usize> = (0..schema.fields().len())
        .filter(|&at| own.schema().index_of(schema.field(at).name()).is_err())
        .collect();
    rows::side_by_side(&[own, batch.rows.project(&kept)?])
}
