//! Columns of the motions as further measures of fits.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use rockfrag_core::fragility::{Measure, Predictors};
use rockfrag_core::motion::Dimension;
use rockfrag_core::rocking::Structure;

use crate::number::listed;
use crate::pipeline::UsageError;
use crate::table::TableError;
use crate::table::file::ParquetTable;

/// The units at the end of the names of columns, the longer ones first.
const UNITS: [(&str, Dimension); 4] = [
    ("_m_s2", Dimension::Acceleration),
    ("_m_s", Dimension::Velocity),
    ("_m", Dimension::Length),
    ("_s", Dimension::Duration),
];
/// Units that are not converted.
const OTHER_UNITS: [&str; 7] = ["_cm_s2", "_cm_s", "_ms", "_cm", "_mm", "_km", "_g"];

/// Columns of the motions file, by motion.
#[derive(Default)]
pub struct MotionColumns {
    path: PathBuf,
    /// The columns, and what each measures; a dimensionless one stays as it is.
    columns: Vec<(String, Option<Dimension>)>,
    /// The values of each motion, by its name; NaN where one is missing.
    motions: HashMap<String, Vec<f64>>,
}

impl MotionColumns {
    /// Checks that measures which are asked for can be had.
    pub fn check(asked: &[Predictors], motions: Option<&Path>) -> anyhow::Result<()> {
        for name in names(asked) {
            if motions.is_none() {
                let expected = "expected im1 to im6, im3_inv, or a column of the motions with --motions";
                return Err(UsageError::because(format!("pairs: no measure '{name}'; {expected}")));
            }
            if OTHER_UNITS.iter().any(|unit| name.ends_with(unit)) {
                let expected = "expected _m_s2, _m_s, _m or _s at its end, or no unit";
                return Err(UsageError::because(format!(
                    "pairs: the unit of '{name}' is not SI; {expected}"
                )));
            }
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
        let wanted = |name: &str| name == "motion_id" || read.columns.iter().any(|(own, _)| own == name);
        for batch in table.batches(wanted) {
            let batch = batch?;
            let values = read.columns.iter().map(|(column, _)| batch.numbers(column));
            let values = values.collect::<Result<Vec<_>, _>>()?;
            for (row, id) in batch.required_texts("motion_id")?.into_iter().enumerate() {
                let its = values.iter().map(|values| values[row].unwrap_or(f64::NAN)).collect();
                if read.motions.insert(id.to_string(), its).is_some() {
                    let problem = format!("motion '{id}' is there twice; expected each once");
                    return Err(TableError::table(path, problem).into());
                }
            }
        }
        Ok(read)
    }

    /// Returns the value of each column for a motion, made dimensionless for a structure.
    pub fn values(
        &self,
        motion: &str,
        structure: &Structure,
    ) -> anyhow::Result<impl Iterator<Item = (&str, f64)>> {
        let values = self.motions.get(motion).with_context(|| {
            let file = self.path.display();
            format!("{file}: no motion '{motion}'; expected the motions of the responses")
        })?;
        Ok(self.columns.iter().zip(values).map(|((name, quantity), value)| {
            (name.as_str(), quantity.map_or(*value, |quantity| quantity.dimensionless(*value, structure)))
        }))
    }

    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }
}

/// The columns among measures, each once.
fn names(asked: &[Predictors]) -> Vec<&str> {
    let mut names = Vec::new();
    for measure in asked.iter().flat_map(Predictors::measures) {
        if let Measure::Column(name) = measure
            && !names.contains(&name.as_str())
        {
            names.push(name);
        }
    }
    names
}

/// What a column measures, by the unit at its end; none of a dimensionless one.
fn quantity(name: &str) -> Option<Dimension> {
    if name == "arias_m_s" {
        return Some(Dimension::AriasIntensity);
    }
    UNITS.iter().find(|(unit, _)| name.ends_with(unit)).map(|(_, quantity)| *quantity)
}
