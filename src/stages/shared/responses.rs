//! The responses of each suite and structure, as the fits take them.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;

use rayon::prelude::*;

use crate::fragility::{Cases, Cluster, Group, MOST_CASES, Measure};
use crate::keyword::Keyword;
use crate::motion::Suite;
use crate::number::counted;
use crate::rocking::{Outcome, Structure};
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::Table;
use crate::table::frame;

/// What is read of a response besides the measures of Eq. 13.
const COLUMNS: &str =
    "suite motion_id structure p_rad_s alpha_rad eta outcome edp mw re_km earthquake pga_m_s2 pgv_m_s";

/// The parameters of a structure.
const PARAMETERS: [&str; 3] = ["p_rad_s", "alpha_rad", "eta"];

/// Gives further measures by name, a column each, of the motions of these names and a structure.
pub type Candidates<'a> = &'a dyn Fn(&[&str], &Structure) -> anyhow::Result<Vec<(String, Vec<f64>)>>;

/// Reads the responses in a file or folder, grouped by suite and structure in the order in which these first
/// come.
pub fn read(path: &Path) -> anyhow::Result<Vec<Cases>> {
    read_with(path, None)
}

/// Reads responses to motions of the ground.
pub fn read_of_ground(path: &Path) -> anyhow::Result<Vec<Cases>> {
    let all = read(path)?;
    match all.iter().any(|cases| is_floor(&cases.suite)) {
        true => {
            let problem = "responses to motions of a floor; expected those of the ground";
            Err(TableError::table(path, problem).into())
        }
        false => Ok(all),
    }
}

/// Whether a suite is of motions of a floor.
pub fn is_floor(suite: &Option<String>) -> bool {
    suite.as_ref().is_some_and(|suite| suite.ends_with(Suite::OF_FLOOR))
}

/// Reads responses with candidate measures.
pub fn read_with(path: &Path, candidates: Option<Candidates>) -> anyhow::Result<Vec<Cases>> {
    let table = Table::open(path)?;
    let (mut all, mut hashes) = (Vec::new(), Vec::new());
    let measures: Vec<&str> = Measure::SCALAR.iter().map(|measure| measure.as_str()).collect();
    for batch in table.batches(&|name| measures.contains(&name) || COLUMNS.split(' ').any(|one| one == name))
    {
        add(&mut all, &mut hashes, &batch?, candidates)?;
    }
    if all.is_empty() {
        return Err(TableError::table(path, "no responses; expected at least one").into());
    }
    hashes.par_sort_unstable();
    let repeated = hashes.windows(2).filter(|pair| pair[0] == pair[1]).count();
    if repeated > 0 {
        let problem = format!("{}; keep one of each", counted(repeated, "repeated response"));
        return Err(TableError::table(path, problem).into());
    }
    all.iter_mut().for_each(Cases::sort_clusters);
    Ok(all)
}

/// Adds the responses of a batch to the cases of their suites and structures, and a hash of suite, structure,
/// motion and PGA of each.
fn add(
    all: &mut Vec<Cases>,
    hashes: &mut Vec<u64>,
    batch: &Batch,
    candidates: Option<Candidates>,
) -> anyhow::Result<()> {
    let (suites, names) = (batch.texts("suite")?, batch.required_texts("structure")?);
    let [p_rad_s, alpha_rad, eta] = PARAMETERS.map(|name| batch.required_numbers(name));
    let (p_rad_s, alpha_rad, eta) = (p_rad_s?, alpha_rad?, eta?);
    let parameters: Vec<_> = (0..eta.len()).map(|row| [p_rad_s[row], alpha_rad[row], eta[row]]).collect();
    let outcomes = batch.required_words::<Outcome>("outcome")?;
    let edp = demands(batch, &outcomes)?;
    let (pga, pgv) = (batch.required_numbers("pga_m_s2")?, batch.required_numbers("pgv_m_s")?);
    let (mw, re_km) = (or_nan(batch.numbers("mw")?), or_nan(batch.numbers("re_km")?));
    let earthquakes = batch.texts("earthquake")?;
    let measures = Measure::SCALAR.iter().map(|measure| match measure {
        Measure::Im4 | Measure::Im5 => batch.required_numbers(measure.as_str()),
        other => batch.numbers(other.as_str()).map(or_nan),
    });
    let measures = measures.collect::<Result<Vec<_>, TableError>>()?;
    for (row, motion) in batch.texts("motion_id")?.iter().enumerate().filter(|(_, motion)| motion.is_some()) {
        let mut hash = DefaultHasher::new();
        (&suites[row], &names[row], motion, pga[row].to_bits()).hash(&mut hash);
        hashes.push(hash.finish());
    }
    let motions = candidates.map(|_| batch.required_texts("motion_id")).transpose()?;
    let groups = (0..names.len()).map(|row| Group { suite: suites[row].as_deref(), structure: &names[row] });
    for rows in frame::groups(groups)? {
        let group = Group { suite: suites[rows[0]].as_deref(), structure: &names[rows[0]] };
        let cases = find_cases(all, batch, group, &rows, &parameters)?;
        cases.outcome.extend(rows.iter().map(|&row| outcomes[row]));
        cases.edp.extend(rows.iter().map(|&row| edp[row]));
        cases.pga_m_s2.extend(rows.iter().map(|&row| pga[row]));
        cases.pgv_m_s.extend(rows.iter().map(|&row| pgv[row]));
        cases.mw.extend(rows.iter().map(|&row| mw[row]));
        for (measure, column) in Measure::SCALAR.into_iter().zip(&measures) {
            cases.column_mut(measure).extend(rows.iter().map(|&row| column[row]));
        }
        for &row in &rows {
            cases.push_cluster(Cluster::of(earthquakes[row].as_deref(), mw[row], re_km[row]));
        }
        let Some((candidates, motions)) = candidates.zip(motions.as_ref()) else { continue };
        let motions: Vec<&str> = rows.iter().map(|&row| &*motions[row]).collect();
        for (name, values) in candidates(&motions, &cases.structure)? {
            match cases.candidates.iter_mut().find(|(known, _)| *known == name) {
                Some((_, column)) => column.extend(values),
                None => cases.candidates.push((name, values)),
            }
        }
    }
    Ok(())
}

/// The cases of a suite and structure, which have room for these rows and their p, alpha and eta.
fn find_cases<'a>(
    all: &'a mut Vec<Cases>,
    batch: &Batch,
    group: Group,
    rows: &[usize],
    parameters: &[[f64; 3]],
) -> Result<&'a mut Cases, TableError> {
    let name = group.structure;
    let place = all.iter().position(|cases| cases.group() == group).unwrap_or(all.len());
    if place == all.len() {
        let structure = batch.structure(rows[0], name, parameters[rows[0]])?;
        all.push(Cases::new(group.suite, structure));
    }
    let cases = &mut all[place];
    expect_same(batch, &cases.structure, rows, parameters)?;
    if cases.len() + rows.len() > MOST_CASES {
        let problem = format!("more than {MOST_CASES} responses of '{name}'; take a sample of the rows");
        return Err(TableError::table(&batch.path, problem));
    }
    Ok(cases)
}

fn or_nan(numbers: Vec<Option<f64>>) -> Vec<f64> {
    numbers.into_iter().map(|number| number.unwrap_or(f64::NAN)).collect()
}

/// The demands, which only overturned structures lack.
fn demands(batch: &Batch, outcomes: &[Outcome]) -> Result<Vec<f64>, TableError> {
    let mut edp = or_nan(batch.numbers("edp")?);
    for (row, (edp, outcome)) in edp.iter_mut().zip(outcomes).enumerate() {
        if *outcome == Outcome::Overturning {
            *edp = f64::NAN;
        } else if edp.is_nan() {
            return Err(batch.value_error(row, "edp", "null; expected a number unless it overturns"));
        }
    }
    Ok(edp)
}

/// Checks that these rows have the p, alpha and eta of a structure.
fn expect_same(
    batch: &Batch,
    structure: &Structure,
    rows: &[usize],
    parameters: &[[f64; 3]],
) -> Result<(), TableError> {
    let name = &structure.name;
    let known = [structure.p_rad_s, structure.alpha_rad, structure.eta];
    let Some(&row) = rows.iter().find(|&&row| parameters[row] != known) else { return Ok(()) };
    let found = parameters[row];
    batch.structure(row, name, found)?;
    let other = (0..3).find(|&k| found[k] != known[k]).unwrap_or(0);
    let problem = format!(
        "{}; structure '{name}' has {} in another row: give each structure its own name",
        found[other], known[other]
    );
    Err(batch.value_error(row, PARAMETERS[other], problem))
}
