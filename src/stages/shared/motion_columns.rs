//! Columns of the motions as further measures of fits.

use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use polars_core::prelude::{Column, DataFrame};
use rockfrag_core::fragility::{Measure, Predictors};
use rockfrag_core::motion::Dimension;

use crate::number::listed;
use crate::pipeline::UsageError;
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::ParquetTable;
use crate::table::frame;

const ID: &str = "motion_id";
/// The units at the end of the names of columns, the longer ones first.
const UNITS: [(&str, Dimension); 4] = [
    ("_m_s2", Dimension::Acceleration),
    ("_m_s", Dimension::Velocity),
    ("_m", Dimension::Length),
    ("_s", Dimension::Duration),
];
/// Units that are not converted.
const OTHER_UNITS: [&str; 7] = ["_cm_s2", "_cm_s", "_ms", "_cm", "_mm", "_km", "_g"];

/// The name of a column, what it measures, and its values.
pub type MotionColumn<'a> = (&'a str, Option<Dimension>, Vec<f64>);

/// Columns of the motions file.
#[derive(Default)]
pub struct MotionColumns {
    path: PathBuf,
    /// The columns, and what each measures; a dimensionless one stays as it is.
    columns: Vec<(String, Option<Dimension>)>,
    /// The name of each motion, and its values; NaN where one is missing.
    motions: DataFrame,
}

impl MotionColumns {
    /// Checks that measures which are asked for can be had.
    pub fn check(asked: &[Predictors], motions: Option<&Path>) -> anyhow::Result<()> {
        for name in names(asked) {
            let expected = "expected im1 to im6, im3_inv, or a column of the motions with --motions";
            let problem = format!("pairs: no measure '{name}'; {expected}");
            ensure!(motions.is_some(), UsageError::because(problem));
            let is_other = OTHER_UNITS.iter().any(|unit| name.ends_with(unit));
            let expected = "expected _m_s2, _m_s, _m or _s at its end, or no unit";
            let problem = format!("pairs: the unit of '{name}' is not SI; {expected}");
            ensure!(!is_other, UsageError::because(problem));
        }
        Ok(())
    }

    /// Reads the columns that are asked for; none without motions.
    pub fn read(asked: &[Predictors], motions: Option<&Path>) -> anyhow::Result<MotionColumns> {
        let Some(path) = motions else { return Ok(MotionColumns::default()) };
        let table = ParquetTable::open(path)?;
        let known: Vec<&String> = table.schema().fields().iter().map(|field| field.name()).collect();
        let mut read = MotionColumns { path: path.to_path_buf(), ..MotionColumns::default() };
        for name in names(asked) {
            if !known.iter().any(|known| *known == name) {
                let (file, known) = (path.display(), listed(&known, usize::MAX));
                let problem =
                    format!("{file}: no column '{name}'; expected im1 to im6, im3_inv or one of {known}");
                return Err(UsageError::because(problem));
            }
            read.columns.push((name.to_string(), quantity(name)));
        }
        let wanted = |name: &str| name == ID || read.columns.iter().any(|(own, _)| own == name);
        for batch in table.batches(wanted) {
            let batch = batch?;
            let mut columns = vec![Column::new(ID.into(), batch.required_texts(ID)?)];
            for (name, _) in &read.columns {
                let values = batch.numbers(name)?.into_iter().map(|value| value.unwrap_or(f64::NAN));
                columns.push(Column::new(name.into(), values.collect::<Vec<_>>()));
            }
            read.motions.vstack_mut_owned(DataFrame::new(batch.rows.num_rows(), columns)?)?;
        }
        let is_empty = read.motions.height() == 0;
        ensure!(!is_empty, TableError::table(path, "no motions; expected at least one"));
        let mut known = HashSet::new();
        if let Some(id) = read.motions.column(ID)?.str()?.iter().flatten().find(|id| !known.insert(*id)) {
            let problem = format!("motion '{id}' is there twice; expected each once");
            return Err(TableError::table(path, problem).into());
        }
        Ok(read)
    }

    /// Returns the columns of the motions of responses, and what each measures.
    pub fn of_responses(&self, batch: &Batch) -> anyhow::Result<Vec<MotionColumn<'_>>> {
        if self.columns.is_empty() {
            return Ok(Vec::new());
        }
        let ids = batch.required_texts(ID)?;
        let responses = DataFrame::new(ids.len(), vec![Column::new(ID.into(), &ids)])?;
        let joined = frame::left_join(&responses, &self.motions, ID)?;
        let columns = self.columns.iter().map(|(name, quantity)| {
            let values = joined.column(name)?.f64()?.iter().zip(&ids).map(|(value, id)| {
                value.with_context(|| {
                    let file = self.path.display();
                    format!("{file}: no motion '{id}'; expected the motions of the responses")
                })
            });
            Ok((name.as_str(), *quantity, values.collect::<anyhow::Result<Vec<f64>>>()?))
        });
        columns.collect()
    }
}

/// The columns among measures.
fn names(asked: &[Predictors]) -> BTreeSet<&str> {
    let measures = asked.iter().flat_map(Predictors::measures);
    let names =
        measures.map(|measure| if let Measure::Column(name) = measure { Some(name.as_str()) } else { None });
    names.flatten().collect()
}

/// What a column measures, by the unit at its end; none of a dimensionless one.
fn quantity(name: &str) -> Option<Dimension> {
    if name == "arias_m_s" {
        return Some(Dimension::AriasIntensity);
    }
    UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map(|(_, quantity)| *quantity)
}
