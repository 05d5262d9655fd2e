//! Probabilities at each intensity of a table.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

use arrow_array::RecordBatch;
use rayon::prelude::*;

use super::intensities::{self, peaks};
use super::object::{ErrorsRow, Predicted, Subject, texts};
use super::point::TreeRow;
use crate::fragility::Peak;
use crate::hazard::Motion;
use crate::number::counted;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::rocking::Structure;
use crate::stages::shared::hazard::Renamed;
use crate::stages::shared::model_args::Models;
use crate::stages::shared::motions::known;
use crate::stages::shared::objects::Object;
use crate::stages::shared::spec::Place;
use crate::stages::shared::structures::{StructureArgs, warnings_of};
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::rows;
use crate::warning::{Warning, Warnings};

/// What is predicted for, and what speaks against it.
type Known = (Subject, Vec<Warning>);

/// Reads intensities, and returns them with their probabilities, and what to print.
pub fn evaluate(
    path: &Path,
    renamed: &[Renamed],
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
    if given.is_empty() && *place != Place::default() {
        return Err(UsageError::because(
            "a table with structures of its own: they stand on the ground; give one structure by options",
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
    let subject = |object: &Object| {
        object.structure().map_err(UsageError::because)?;
        Subject::of(object, object.directions.as_deref().unwrap_or_default(), models)
    };
    let given = given.first().map(subject).transpose()?;
    let mut known = HashMap::new();
    let evaluate = |batch: &Batch| of_batch(batch, given.as_ref(), models, &mut known, context);
    let evaluated = batches.iter().map(evaluate).collect::<anyhow::Result<Vec<RecordBatch>>>()?;
    match batches.iter().map(|batch| batch.rows.num_rows()).sum() {
        0 => Err(TableError::table(path, "no rows; expected intensities").into()),
        rows => Ok((evaluated, format!("{} evaluated\n", counted(rows, "row")))),
    }
}

/// The rows with their probabilities; columns of the input stand behind, but for those of the same name.
fn of_batch(
    batch: &Batch,
    given: Option<&Known>,
    models: &Models,
    known_structures: &mut HashMap<[u64; 3], Known>,
    context: &Context,
) -> anyhow::Result<RecordBatch> {
    let [pga, pgv] = [peaks(batch, Peak::Pga)?, peaks(batch, Peak::Pgv)?];
    let mw = batch.numbers("mw")?;
    let structures = if given.is_some() { Vec::new() } else { intensities::structures(batch)? };
    let key =
        |structure: &Structure| [structure.p_rad_s, structure.alpha_rad, structure.eta].map(f64::to_bits);
    for structure in &structures {
        if let Entry::Vacant(place) = known_structures.entry(key(structure)) {
            let (model, mut warnings) = models.model(structure)?;
            warnings.extend(warnings_of(structure));
            let subject = Subject { directions: vec![(structure.clone(), model)], unknowns: Vec::new() };
            place.insert((subject, warnings));
        }
    }
    let of_row = |row: usize| {
        let (subject, of_structure) = given.unwrap_or_else(|| &known_structures[&key(&structures[row])]);
        let mut warnings = of_structure.clone();
        warnings.extend(subject.warnings([pga[row], pgv[row]]));
        let motion = Motion { pga_m_s2: Some(pga[row]), pgv_m_s: Some(pgv[row]), mw: known(mw[row]) };
        let (tree, budget) = TreeRow::new(&motion, subject);
        ((tree.with_warnings(texts(&warnings)), ErrorsRow::of(&budget)), warnings)
    };
    let (rows_of_all, warnings): (Vec<(TreeRow, ErrorsRow)>, Vec<Vec<Warning>>) =
        (0..batch.rows.num_rows()).into_par_iter().map(of_row).unzip();
    let (trees, errors): (Vec<TreeRow>, Vec<ErrorsRow>) = rows_of_all.into_iter().unzip();
    for (row, warnings) in warnings.into_iter().enumerate() {
        let place = format!("row {}", batch.first_row + row as u64 + 1);
        context.warn(warnings.into_iter().map(|warning| (warning, place.clone())).collect::<Warnings>());
    }
    let own = rows::side_by_side(&[rows::batch(&trees)?, rows::batch(&errors)?])?;
    let schema = batch.rows.schema();
    let kept: Vec<usize> = (0..schema.fields().len())
        .filter(|&at| own.schema().index_of(schema.field(at).name()).is_err())
        .collect();
    rows::side_by_side(&[own, batch.rows.project(&kept)?])
}
