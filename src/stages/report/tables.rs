//! The tables of a folder, as far as they are there.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::fragility::{Calibration, Cases, DemandFit, Event, OverturningFit};
use crate::paper;
use crate::rocking::Outcome;
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::table::TableError;
use crate::table::file::{self, Table};
use crate::table::motions::{Motion, Motions};
use crate::table::provenance::Provenance;
use crate::table::rows::{self, Row};

/// What most of the report needs; further tables are read where they are shown.
pub struct Tables {
    folder: PathBuf,
    /// Responses by suite and structure.
    pub groups: Vec<Cases>,
    pub demand: Vec<DemandFit>,
    /// Of overturning, as the next.
    pub curves: Vec<OverturningFit>,
    pub calibrations: Vec<Calibration>,
    pub compared: Vec<Comparison>,
    /// The worst first.
    pub objects: Vec<ObjectRates>,
    pub files: Vec<FileMade>,
}

/// What evaluate predicts for an object over a hazard, as far as its table has it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct ObjectRates {
    pub structure: String,
    pub width_m: Option<f64>,
    pub height_m: Option<f64>,
    pub friction: Option<f64>,
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Option<f64>,
    pub failure_per_year_low: Option<f64>,
    pub failure_per_year_high: Option<f64>,
    pub overturning_per_year: Option<f64>,
    pub overturning_per_year_low: Option<f64>,
    pub overturning_per_year_high: Option<f64>,
    pub years: Option<f64>,
    pub p_overturning: Option<f64>,
    pub p_overturning_low: Option<f64>,
    pub p_overturning_high: Option<f64>,
    pub doubts: Option<String>,
}

/// A table and what made it.
pub struct FileMade {
    pub path: PathBuf,
    pub rows: u64,
    /// None of another program.
    pub made: Option<Provenance>,
}

/// The column of annual rates of objects, whatever their file is called.
const RATES: &str = "overturning_per_year";
/// Motions of a row group that rockfrag wrote.
const MOTIONS_IN_GROUP: u64 = 64;

impl Tables {
    /// Reads what there is in a folder.
    pub fn read(folder: &Path) -> anyhow::Result<Tables> {
        let mut tables = Tables {
            folder: folder.to_path_buf(),
            groups: Vec::new(),
            demand: Vec::new(),
            curves: Vec::new(),
            calibrations: Vec::new(),
            compared: Vec::new(),
            objects: Vec::new(),
            files: Vec::new(),
        };
        if let Some(path) = tables.place("responses") {
            tables.groups = responses::read(&path)?;
        }
        tables.demand = tables.rows("pex")?;
        tables.curves = tables.rows("pro")?;
        tables.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        tables.calibrations = tables.rows("pro.calibration")?;
        tables.compared = tables.rows("paper")?;
        for path in file::tables(folder)? {
            let table = Table::open(&path)?;
            if table.schema().index_of(RATES).is_ok() {
                tables.objects.extend(rows::read::<ObjectRates>(&path)?);
            }
            tables.files.push(FileMade { rows: table.rows(), made: Provenance::of_file(&path)?, path });
        }
        let rate = |object: &ObjectRates| object.overturning_per_year.or(object.overturning_per_year_high);
        tables.objects.sort_by(|a, b| rate(b).unwrap_or(-1.0).total_cmp(&rate(a).unwrap_or(-1.0)));
        Ok(tables)
    }

    /// The rows of a table; none where it is not there.
    pub fn rows<R: Row>(&self, name: &str) -> Result<Vec<R>, TableError> {
        self.place(name).map_or(Ok(Vec::new()), |path| rows::read(&path))
    }

    /// The file of a table, or the folder of its partitions.
    fn place(&self, name: &str) -> Option<PathBuf> {
        let (file, parts) = (self.folder.join(format!("{name}.parquet")), self.folder.join(name));
        if file.exists() { Some(file) } else { Some(parts).filter(|parts| parts.is_dir()) }
    }

    /// The demand whose exceedance was fitted.
    pub fn limit_state(&self) -> f64 {
        let mut made =
            self.files.iter().filter_map(|file| file.made.as_ref()).filter(|made| made.stage == "fit-pex");
        let given = made
            .next()
            .and_then(|made| made.arguments.get("limit-state")?.first()?.split(',').next()?.parse().ok());
        given.unwrap_or(paper::LIMIT_STATE)
    }

    /// The motions of a row group in the middle of the file.
    pub fn motions(&self) -> Result<Vec<Motion>, TableError> {
        let Some(path) = self.place("motions") else { return Ok(Vec::new()) };
        let motions = Motions::open(&path, None)?;
        let middle = (motions.rows() / MOTIONS_IN_GROUP / 2) as usize;
        let part = motions.parts().nth(middle).or_else(|| motions.parts().next());
        let some = part.map(|part| motions.read(part?, MOTIONS_IN_GROUP as usize)?.next().transpose());
        Ok(some.transpose()?.flatten().map_or(Vec::new(), |(_, motions)| motions))
    }

    /// Of an incremental dynamic analysis: numbers of motions and of those that overturn, by structure and intensity.
    pub fn stripes(
        &self,
    ) -> Result<BTreeMap<(Option<String>, String), BTreeMap<u64, [usize; 2]>>, TableError> {
        let mut counts: BTreeMap<_, BTreeMap<u64, [usize; 2]>> = BTreeMap::new();
        let Some(path) = self.place("ida.stripes") else { return Ok(counts) };
        let table = Table::open(&path)?;
        for batch in table.batches(&|name| ["suite", "structure", "intensity", "outcome"].contains(&name)) {
            let batch = batch?;
            let columns = batch.columns();
            let (suites, outcomes) = (columns.texts("suite")?, columns.required_texts("outcome")?);
            let (structures, levels) =
                (columns.required_texts("structure")?, columns.required_numbers("intensity")?);
            for (row, level) in levels.into_iter().enumerate() {
                let of_structure = counts.entry((suites[row].clone(), structures[row].clone())).or_default();
                let [n, events] = of_structure.entry(level.to_bits()).or_default();
                (*n, *events) =
                    (*n + 1, *events + usize::from(outcomes[row] == Outcome::Overturning.to_string()));
            }
        }
        Ok(counts)
    }
}
