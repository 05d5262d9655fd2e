//! The measures of a motions file by motion, without its samples.

use std::collections::{BTreeSet, HashMap};
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use super::TableError;
use super::motions::STAGES;
use super::records::RECORDS;
use super::schema::{self, Column, Kind};
use super::store::columns::Columns;
use super::store::reader::OpenTable;
use super::store::source::Source;
use super::synthetic_motions::MOTIONS;
use crate::motion::Quantity;

/// The measures besides the peaks and periods of Eq. 13, and what they are.
const FURTHER: [(Column, Quantity); 6] = [
    (schema::pgd_m, Quantity::Length),
    (schema::arias_m_s, Quantity::AriasIntensity),
    (schema::cav_m_s, Quantity::Velocity),
    (schema::d5_75_s, Quantity::Duration),
    (schema::d5_95_s, Quantity::Duration),
    (schema::housner_m, Quantity::Length),
];

/// The units at the end of the names of columns, the longer ones first.
const UNITS: [(&str, Quantity); 4] = [
    ("_m_s2", Quantity::Acceleration),
    ("_m_s", Quantity::Velocity),
    ("_m", Quantity::Length),
    ("_s", Quantity::Duration),
];

/// A measure of all motions.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionMeasure {
    /// Its column without the unit, as `d5_95` or `sa_0p50`: what it is called once it is dimensionless.
    pub name: String,
    /// What it is.
    pub quantity: Quantity,
    /// Its value in each row of the file, where there is one.
    pub values: Vec<Option<f64>>,
}

/// The measures of a motions file.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionMeasures {
    path: PathBuf,
    rows: HashMap<String, usize>,
    pga_m_s2: Vec<Option<f64>>,
    /// The durations, Arias intensity, CAV, PGD, Housner intensity and spectral accelerations that the file has.
    pub further: Vec<MotionMeasure>,
}

impl MotionMeasures {
    /// Reads them, and those of the user's `own`; a file that someone else wrote may lack any.
    ///
    /// # Errors
    /// If the file is missing, unreadable, empty, of another stage, lacks motion_id or holds a value that it must not.
    pub fn read(source: impl Into<Source>, own: &[OwnMeasure]) -> Result<MotionMeasures, TableError> {
        let source = source.into();
        let further: Vec<(Column, Quantity)> =
            FURTHER.into_iter().chain(own.iter().map(|own| (own.column, own.quantity))).collect();
        let narrow = [schema::motion_id, schema::pga_m_s2];
        let is_wanted = |name: &str| {
            let mut known = narrow.iter().chain(further.iter().map(|(column, _)| column));
            known.any(|column| column.name == name) || schema::is_spectral_acceleration(name)
        };
        let mut all = MotionMeasures {
            path: source.name().to_path_buf(),
            rows: HashMap::new(),
            pga_m_s2: Vec::new(),
            further: Vec::new(),
        };
        for batch in OpenTable::open_at(source, &STAGES, is_wanted)?.whole()? {
            all.append(&batch?.columns(), &further)?;
        }
        all.further.retain(|measure| measure.values.iter().any(Option::is_some));
        Ok(all)
    }

    fn append(&mut self, columns: &Columns, further: &[(Column, Quantity)]) -> Result<(), TableError> {
        for (row, id) in columns.labels(&schema::motion_id)?.into_iter().enumerate() {
            self.rows.insert(id, self.pga_m_s2.len() + row);
        }
        self.pga_m_s2.extend(columns.optional_numbers(&schema::pga_m_s2)?);
        let mut measures = Vec::new();
        for (column, quantity) in further {
            measures.push((column.name.to_string(), *quantity, columns.optional_numbers(column)?));
        }
        let spectral = columns.spectral_accelerations()?.into_iter();
        measures.extend(spectral.map(|column| (column.name, Quantity::Acceleration, column.values)));
        let is_first = self.further.is_empty();
        for (place, (column, quantity, values)) in measures.into_iter().enumerate() {
            if is_first {
                self.further.push(MotionMeasure { name: without_unit(&column), quantity, values });
            } else {
                self.further[place].values.extend(values);
            }
        }
        Ok(())
    }

    /// The row of a motion whose responses were made with this PGA, m/s2.
    ///
    /// # Errors
    /// In words, if the file has no such motion, or one with another PGA.
    pub fn row(&self, motion_id: &str, pga_m_s2: f64) -> anyhow::Result<usize> {
        let file = self.path.display();
        let Some(&row) = self.rows.get(motion_id) else {
            anyhow::bail!("{file}: no motion '{motion_id}'; expected the motions that the responses are to");
        };
        match self.pga_m_s2[row] {
            Some(pga) if (pga - pga_m_s2).abs() > SAME_PGA * pga_m_s2 => anyhow::bail!(
                "{file}: row {row}, column '{}': motion '{motion_id}' has {pga}, its responses {pga_m_s2}; expected the \
                 motions that the responses are to",
                schema::pga_m_s2.name
            ),
            _ => Ok(row),
        }
    }
}

/// A measure of the user's own: the unit at the end of the name of its column tells what it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnMeasure {
    column: Column,
    quantity: Quantity,
}

impl FromStr for OwnMeasure {
    type Err = String;

    fn from_str(name: &str) -> Result<OwnMeasure, String> {
        let Some((_, quantity)) = UNITS.iter().find(|(unit, _)| name.ends_with(unit)) else {
            return Err(format!(
                "'{name}': expected a column whose name ends in its unit: _m_s2, _m_s, _m or _s"
            ));
        };
        // As the names of other columns it lives as long as the program.
        let column = Column::new(name.to_string().leak(), Kind::Float64, "", "a number, or null");
        Ok(OwnMeasure { column, quantity: *quantity })
    }
}

impl fmt::Display for OwnMeasure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.column.name)
    }
}

/// The columns of a motions file that are none of rockfrag's, so that no stage takes them unasked.
///
/// # Errors
/// If the file is missing, unreadable or of another stage.
pub fn own_columns(source: &Source) -> Result<Vec<String>, TableError> {
    let known = MOTIONS.columns.iter().chain(RECORDS.columns);
    let is_own = |name: &str| {
        known.clone().all(|column| column.name != name) && !schema::is_spectral_acceleration(name)
    };
    let table = OpenTable::open_at(source, &STAGES, is_own)?;
    let schemas = table.schemas()?;
    let names =
        schemas.iter().flat_map(|(_, schema)| schema.fields().iter().map(|field| field.name().clone()));
    Ok(names.collect::<BTreeSet<_>>().into_iter().collect())
}

/// Peaks of one motion differ by less than this share.
const SAME_PGA: f64 = 1e-6;

fn without_unit(column: &str) -> String {
    UNITS.iter().find_map(|(unit, _)| column.strip_suffix(unit)).unwrap_or(column).to_string()
}
