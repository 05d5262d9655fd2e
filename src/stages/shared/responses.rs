//! The responses of each suite and structure, as the fits take them.

use std::collections::HashMap;
use std::path::Path;

use crate::fragility::{CaseRow, Cases, CasesBuilder};
use crate::keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, Structure};
use crate::stages::shared::motions::known;
use crate::table::TableError;
use crate::table::columns::Columns;
use crate::table::file::Table;

/// What is read of a response.
const COLUMNS: [&str; 19] = [
    "motion_id",
    "suite",
    "structure",
    "p_rad_s",
    "alpha_rad",
    "eta",
    "outcome",
    "edp",
    "mw",
    "re_km",
    "earthquake",
    "pga_m_s2",
    "pgv_m_s",
    "im1",
    "im2",
    "im3",
    "im4",
    "im5",
    "im6",
];

/// Reads the responses in a file or folder, grouped by suite and structure in the order in which these first
/// come.
pub fn read(path: &Path) -> anyhow::Result<Vec<Cases>> {
    read_with(path, &[], |_, _| Ok(Vec::new()))
}

/// The same with candidate measures: `candidates` gives their values for the motion of this name and a
/// structure.
pub fn read_with(
    path: &Path,
    names: &[String],
    candidates: impl Fn(&str, &Structure) -> anyhow::Result<Vec<f64>>,
) -> anyhow::Result<Vec<Cases>> {
    let table = Table::open(path)?;
    let mut groups: Vec<CasesBuilder> = Vec::new();
    let mut places: HashMap<(Option<String>, String), usize> = HashMap::new();
    for batch in table.batches(&|name| COLUMNS.contains(&name)) {
        let batch = batch?;
        let columns = batch.columns();
        let rows = Rows::read(&columns)?;
        for (row, structure) in rows.structures.iter().enumerate() {
            let name = (rows.suites[row].clone(), structure.name.clone());
            let next = groups.len();
            let place = *places.entry(name).or_insert_with_key(|(suite, _)| {
                groups.push(CasesBuilder::new(suite.as_deref(), structure.clone(), names));
                next
            });
            let values = candidates(&rows.motions[row], structure)?;
            groups[place].push(&rows.case(row, &values))?;
        }
    }
    match groups.is_empty() {
        true => Err(TableError::table(path, "no responses; expected at least one").into()),
        false => Ok(groups.into_iter().map(CasesBuilder::finish).collect()),
    }
}

/// Some responses, as columns.
struct Rows {
    motions: Vec<String>,
    suites: Vec<Option<String>>,
    structures: Vec<Structure>,
    outcomes: Vec<Outcome>,
    earthquakes: Vec<Option<String>>,
    edp: Vec<f64>,
    pga_m_s2: Vec<f64>,
    pgv_m_s: Vec<f64>,
    mw: Vec<f64>,
    re_km: Vec<f64>,
    /// IM1 to IM6.
    im: [Vec<f64>; 6],
}

impl Rows {
    fn read(columns: &Columns) -> Result<Rows, TableError> {
        let names = columns.required_texts("structure")?;
        let (p, alpha) = (columns.required_numbers("p_rad_s")?, columns.required_numbers("alpha_rad")?);
        let eta = columns.required_numbers("eta")?;
        let structure =
            |(row, name)| Structure { name, p_rad_s: p[row], alpha_rad: alpha[row], eta: eta[row] };
        let outcomes = columns.required_texts("outcome")?;
        let outcome = |(row, word): (usize, &String)| {
            keyword::parse(word).map_err(|unknown| columns.value_error(row, "outcome", unknown.to_string()))
        };
        let rows = Rows {
            motions: columns.required_texts("motion_id")?,
            suites: columns.texts("suite")?,
            structures: names.into_iter().enumerate().map(structure).collect(),
            outcomes: outcomes.iter().enumerate().map(outcome).collect::<Result<_, _>>()?,
            earthquakes: columns.texts("earthquake")?,
            edp: columns.numbers("edp")?,
            pga_m_s2: columns.required_numbers("pga_m_s2")?,
            pgv_m_s: columns.required_numbers("pgv_m_s")?,
            mw: columns.numbers("mw")?,
            re_km: columns.numbers("re_km")?,
            im: [
                columns.numbers("im1")?,
                columns.numbers("im2")?,
                columns.numbers("im3")?,
                columns.required_numbers("im4")?,
                columns.required_numbers("im5")?,
                columns.numbers("im6")?,
            ],
        };
        let lacks = |row: &usize| rows.edp[*row].is_nan() && rows.outcomes[*row] != Outcome::Overturning;
        match (0..columns.rows()).find(lacks) {
            Some(row) => Err(columns.value_error(row, "edp", "null; expected a number unless it overturns")),
            None => Ok(rows),
        }
    }

    fn case<'a>(&'a self, row: usize, candidates: &'a [f64]) -> CaseRow<'a> {
        let Structure { p_rad_s, alpha_rad, eta, .. } = self.structures[row];
        let [im1, im2, im3, im4, im5, im6] = self.im.each_ref().map(|column| column[row]);
        CaseRow {
            p_rad_s,
            alpha_rad,
            eta,
            outcome: self.outcomes[row],
            edp: known(self.edp[row]).filter(|_| self.outcomes[row] != Outcome::Overturning),
            measures: IntensityMeasures {
                im1: known(im1),
                im2: known(im2),
                im3: known(im3),
                im4,
                im5,
                im6: known(im6),
            },
            pga_m_s2: self.pga_m_s2[row],
            pgv_m_s: self.pgv_m_s[row],
            mw: known(self.mw[row]),
            re_km: known(self.re_km[row]),
            earthquake: self.earthquakes[row].as_deref(),
            candidates,
        }
    }
}
