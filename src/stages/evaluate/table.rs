//! Probabilities at each intensity of a table, Parquet or CSV: peaks by their headings, structures by their
//! columns.

use std::path::Path;

use anyhow::{bail, ensure};
use arrow_array::RecordBatch;
use rayon::prelude::*;
use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{GroundMotion, MotionProbabilities, unusual_motions};
use rockfrag_core::motion::{Peaks, validate_medians};
use rockfrag_core::object::{Object, Restitution, RockingObject};
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::{Warning, Warnings};

use super::Evaluate;
use crate::answer::{StateColumns, TreeColumns, UncertaintyColumns};
use crate::inputs::Reader;
use crate::inputs::intensities;
use crate::number::counted;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::stages::shared::model_args::Models;
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::ParquetTable;
use crate::table::rows;

/// The intensities with their probabilities, and what to print. Rows may have structures of their own.
pub fn evaluate(
    call: &Evaluate,
    path: &Path,
    reader: &mut Reader,
    models: &Models,
    context: &Context,
) -> anyhow::Result<(Vec<RecordBatch>, String)> {
    let batches = match path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet")) {
        true => read_parquet(path, reader)?,
        false => {
            let columns = intensities::read(path, reader)?.into_iter();
            let columns = columns.map(|(name, column)| (name, column, true));
            let rows = RecordBatch::try_from_iter_with_nullable(columns)?;
            vec![Batch { path: path.into(), first_row: 0, rows }]
        }
    };
    let given = match call.structures.is_given() {
        true => call.structures.objects(&call.place, reader)?,
        false => Vec::new(),
    };
    let one = "a table of intensities: expected one structure, or p_rad_s, alpha_rad and eta in the table";
    ensure!(given.len() < 2, UsageError::because(one));
    let columns = batches.first().map(|batch| batch.rows.schema());
    let column = columns.and_then(|all| STRUCTURE.into_iter().find(|name| all.index_of(name).is_ok()));
    if let (Some(column), Some(_)) = (column, given.first()) {
        let both = format!("column {column} and options of a structure; leave out the one or the other");
        bail!(UsageError::because(format!("{}: {both}", path.display())));
    }
    let given = given.first().map(|object| models.rocking_object(object)).transpose()?;
    let peaks = batches.iter().map(peaks).collect::<anyhow::Result<Vec<_>>>()?;
    // A typical motion shows a wrong unit.
    let given_peaks: Vec<Peaks> = peaks.iter().flatten().copied().flatten().collect();
    validate_medians(given_peaks.iter().copied()).map_err(|problem| TableError::table(path, problem))?;
    let bar = context.bar(batches.iter().map(|batch| batch.rows.num_rows()).sum());
    let mut evaluated = Vec::new();
    for (batch, peaks) in batches.iter().zip(&peaks) {
        let (rows, warnings) = with_probabilities(batch, peaks, given.as_ref(), call, models)?;
        context.warn(warnings);
        evaluated.push(rows);
        bar.advance(batch.rows.num_rows())?;
    }
    let without = peaks.iter().flatten().filter(|peaks| peaks.is_none()).count();
    let without = if without > 0 { format!(", {without} {NO_PEAKS}") } else { String::new() };
    ensure!(!given_peaks.is_empty(), TableError::table(path, "no row with PGA and PGV"));
    Ok((evaluated, format!("{} evaluated{without}\n", counted(given_peaks.len(), "row"))))
}

const NO_PEAKS: &str = "without PGA or PGV";

/// Columns that say what a row is about.
const STRUCTURE: [&str; 7] = ["p_rad_s", "alpha_rad", "eta", "width", "height", "width_m", "height_m"];

/// The rows with their probabilities, by the structure that is given or each by its own, and the warnings
/// about them; columns of the input stand behind, but for those of the same name.
fn with_probabilities(
    batch: &Batch,
    peaks: &[Option<Peaks>],
    given: Option<&(RockingObject, Vec<Warning>)>,
    call: &Evaluate,
    models: &Models,
) -> anyhow::Result<(RecordBatch, Warnings)> {
    let mw = batch.numbers("mw")?;
    let parametric = |of: &Structure| Object::with_parameters(of, Restitution::Number(of.eta));
    let names = vec!["structure".into(); mw.len()];
    let structures = if given.is_some() { Vec::new() } else { batch.structures(&names)? };
    let evaluate = |row: usize| {
        let Some(motion) = peaks[row] else {
            let unknown = UncertaintyColumns { warnings: Some(NO_PEAKS.to_string()), ..Default::default() };
            return Ok(((StateColumns::default(), TreeColumns::default()), unknown));
        };
        let own;
        let (rocking_object, about_model) = match given {
            Some(given) => given,
            None => {
                own = models.rocking_object(&parametric(&structures[row]).at(&call.place))?;
                &own
            }
        };
        let peaks = motion.clamp_to_recorded();
        let mut warnings = [about_model.clone(), rocking_object.warnings(peaks)].concat();
        warnings.extend((peaks != motion).then_some(Warning::AtRim));
        let motion = GroundMotion {
            pga_m_s2: Some(peaks.pga_m_s2),
            pgv_m_s: Some(peaks.pgv_m_s),
            mw: mw[row].or(call.magnitude),
            vs30_m_s: None,
        };
        warnings.extend(unusual_motions(motion.mw, None));
        let MotionProbabilities { states, budget, magnitude } = motion.probabilities(rocking_object);
        let probabilities = (StateColumns::new(states), TreeColumns::new(&motion, rocking_object, states));
        Ok((probabilities, UncertaintyColumns::new(warnings, &budget, magnitude, peaks)))
    };
    let rows: Vec<_> = (0..mw.len()).into_par_iter().map(evaluate).collect();
    // The first error in the order of the rows, whichever thread meets one first.
    let rows: Vec<_> = rows.into_iter().collect::<anyhow::Result<_>>()?;
    let (probabilities, uncertainties): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let (states, trees): (Vec<_>, Vec<_>) = probabilities.into_iter().unzip();
    let warned = uncertainties.iter().enumerate().flat_map(|(row, of)| {
        let place = format!("row {}", batch.first_row + row + 1);
        of.warnings().into_iter().map(move |warning| (warning, place.clone()))
    });
    let own = rows::side_by_side(&[
        rows::batch::<StateColumns>(&states)?,
        rows::batch::<TreeColumns>(&trees)?,
        rows::batch::<UncertaintyColumns>(&uncertainties)?,
    ])?;
    let fields = batch.rows.schema().fields().clone();
    let mut kept: Vec<usize> = (0..fields.len()).collect();
    kept.retain(|at| own.schema().index_of(fields[*at].name()).is_err());
    Ok((rows::side_by_side(&[own, batch.rows.project(&kept)?])?, warned.collect()))
}

/// The peaks of each row with both, m/s2 and m/s.
fn peaks(batch: &Batch) -> anyhow::Result<Vec<Option<Peaks>>> {
    let schema = batch.rows.schema();
    let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
    let column = |peak: Peak| -> anyhow::Result<Vec<Option<f64>>> {
        let (name, unit) =
            intensities::column_of_peak(&names, peak).map_err(|error| error.in_file(&batch.path))?;
        let values = batch.numbers(name)?.into_iter().enumerate().map(|(row, value)| {
            let is_possible = value.is_none_or(|value| value >= 0.0);
            ensure!(is_possible, batch.value_error(row, name, "expected 0 or more"));
            Ok(value.map(|value| value * unit))
        });
        values.collect()
    };
    let both = column(Peak::Pga)?.into_iter().zip(column(Peak::Pgv)?);
    Ok(both.map(|(pga, pgv)| Some(Peaks { pga_m_s2: pga?, pgv_m_s: pgv? })).collect())
}

/// The columns of a Parquet table, without samples, under the names that the user gives.
fn read_parquet(path: &Path, reader: &mut Reader) -> anyhow::Result<Vec<Batch>> {
    let table = ParquetTable::open(path)?;
    let renamed = table.batches(|column| column != "acceleration_m_s2").map(|batch| {
        let (batch, mut columns) = (batch?, Vec::new());
        for (field, column) in batch.rows.schema().fields().iter().zip(batch.rows.columns()) {
            columns.push((reader.name(field.name()), column.clone(), true));
        }
        Ok(Batch { rows: RecordBatch::try_from_iter_with_nullable(columns)?, ..batch })
    });
    renamed.collect()
}
