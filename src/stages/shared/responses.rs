//! The responses of each suite and structure, as the fits take them.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

use anyhow::ensure;
use rayon::prelude::*;
use rockfrag_core::fragility::{Case, Cases, Cluster, Group, MOST_CASES};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::rocking::{Outcome, Structure};

use super::motion_columns::MotionColumns;
use crate::number::counted;
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::ParquetTable;
use crate::table::responses::{OutcomeWord, ResponseRow};
use crate::table::{frame, rows};

/// Reads the responses in a file or folder, with columns of their motions, grouped by suite and structure in
/// the order in which these first come.
pub fn read(path: &Path, motions: &MotionColumns) -> anyhow::Result<Vec<Cases>> {
    let table = ParquetTable::open(path)?;
    let (mut all, mut hashes) = (Vec::new(), Vec::new());
    let columns = rows::schema::<ResponseRow>();
    for batch in table.batches(|name| columns.index_of(name).is_ok()) {
        add(&mut all, &mut hashes, &batch?, motions)?;
    }
    ensure!(!all.is_empty(), TableError::table(path, "no responses; expected at least one"));
    hashes.par_sort_unstable();
    let repeated = hashes.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let problem = || format!("{}; keep one of each", counted(repeated, "repeated response"));
    ensure!(repeated == 0, TableError::table(path, problem()));
    all.iter_mut().for_each(Cases::sort_clusters);
    Ok(all)
}

/// Adds the responses of a batch to the cases of their suites and structures, and a hash of suite, structure,
/// motion and PGA of each.
fn add(
    all: &mut Vec<Cases>,
    hashes: &mut Vec<u64>,
    batch: &Batch,
    motions: &MotionColumns,
) -> anyhow::Result<()> {
    let (suites, names) = (batch.texts("suite")?, batch.required_texts("structure")?);
    let (structures, outcomes) = (batch.structures(&names)?, outcomes(batch)?);
    let (pga, pgv) = (batch.required_numbers("pga_m_s2")?, batch.required_numbers("pgv_m_s")?);
    let (mw, re_km, earthquakes) =
        (batch.numbers("mw")?, batch.numbers("re_km")?, batch.texts("earthquake")?);
    let measures = rows::from_batch::<IntensityMeasures>(batch)?;
    for (row, motion) in batch.texts("motion_id")?.iter().enumerate().filter(|(_, motion)| motion.is_some()) {
        let mut hash = DefaultHasher::new();
        (&suites[row], &names[row], motion, pga[row].to_bits()).hash(&mut hash);
        hashes.push(hash.finish());
    }
    let columns = motions.of_responses(batch)?;
    let groups = (0..names.len()).map(|row| Group { suite: suites[row].as_deref(), structure: &names[row] });
    for rows in frame::groups(groups)? {
        let group = Group { suite: suites[rows[0]].as_deref(), structure: &names[rows[0]] };
        let place = all.iter().position(|cases| cases.group() == group).unwrap_or(all.len());
        if place == all.len() {
            all.push(Cases::new(group.suite, structures[rows[0]].clone()));
        }
        let cases = &mut all[place];
        let name = group.structure;
        let problem = || format!("more than {MOST_CASES} responses of '{name}'; take a sample of the rows");
        ensure!(cases.all.len() + rows.len() <= MOST_CASES, TableError::table(&batch.path, problem()));
        for &row in &rows {
            expect_same(batch, row, &structures[row], &cases.structure)?;
            let case = Case {
                outcome: outcomes[row],
                measures: measures[row],
                peaks: Peaks { pga_m_s2: pga[row], pgv_m_s: pgv[row] },
                mw: mw[row],
                cluster: 0,
            };
            cases.push(case, Cluster::new(earthquakes[row].as_deref(), mw[row], re_km[row]));
            for (name, quantity, values) in &columns {
                let value =
                    quantity.map_or(values[row], |of| of.dimensionless(values[row], &structures[row]));
                cases.columns.entry(name.to_string()).or_default().push(value);
            }
        }
    }
    Ok(())
}

fn outcomes(batch: &Batch) -> Result<Vec<Outcome>, TableError> {
    let words = batch.required_texts("outcome")?.into_iter().zip(batch.numbers("edp")?);
    let outcomes = words.enumerate().map(|(row, (word, edp))| {
        let word: OutcomeWord = word.parse().map_err(|unknown| batch.value_error(row, "outcome", unknown))?;
        let problem = "null; expected a number unless it overturns";
        word.with_demand(edp).ok_or_else(|| batch.value_error(row, "edp", problem))
    });
    outcomes.collect()
}

/// Checks that a row has the p, alpha and eta that its structure has in the rows before.
fn expect_same(batch: &Batch, row: usize, found: &Structure, known: &Structure) -> Result<(), TableError> {
    let mut both =
        found.parameters().into_iter().zip(known.parameters()).zip(["p_rad_s", "alpha_rad", "eta"]);
    let Some(((found, expected), column)) = both.find(|((found, known), _)| found != known) else {
        return Ok(());
    };
    let problem = format!(
        "{found}; structure '{}' has {expected} in another row: give each structure its own name",
        known.name
    );
    Err(batch.value_error(row, column, problem))
}
