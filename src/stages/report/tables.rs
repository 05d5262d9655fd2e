//! The tables of a folder, as far as they are there.

use std::path::{Path, PathBuf};

use crate::fragility::{Calibration, Cases, CurveFit, DemandFit, Event};
use crate::paper;
use crate::stages::evaluate::{ObjectRow, Predicted, RatesRow};
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::table::TableError;
use crate::table::file::{self, Table};
use crate::table::motions::{Motion, Motions};
use crate::table::provenance::Provenance;
use crate::table::rows::{self, Row};

/// What most of the report needs; further tables are read where they are shown.
#[derive(Default)]
pub struct Tables {
    folder: PathBuf,
    /// Responses by suite and structure.
    pub groups: Vec<Cases>,
    pub demand: Vec<DemandFit>,
    /// Of overturning, as the next.
    pub curves: Vec<CurveFit>,
    pub calibrations: Vec<Calibration>,
    /// Demand whose exceedance was fitted.
    pub limit_state: f64,
    pub compared: Vec<Comparison>,
    /// Objects with annual rates, the worst first.
    pub objects: Vec<(ObjectRow, RatesRow)>,
    /// Each file with its number of rows and, if it is ours, what made it.
    pub files: Vec<(PathBuf, u64, Option<Provenance>)>,
}

/// A column of annual rates, by which their table is known whatever it is called.
const RATES: &str = "overturning_per_year";
/// Motions of a row group that rockfrag wrote.
const MOTIONS_IN_GROUP: u64 = 64;

impl Tables {
    /// Reads what there is in a folder.
    pub fn read(folder: &Path) -> anyhow::Result<Tables> {
        let mut tables = Tables { folder: folder.to_path_buf(), ..Tables::default() };
        if let Some(path) = tables.place("responses") {
            tables.groups = responses::read(&path)?;
        }
        tables.demand = tables.rows("pex")?;
        tables.curves = tables.rows("pro")?;
        tables.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        tables.calibrations = tables.rows("pro.calibration")?;
        let exceeding: Vec<Calibration> = tables.rows("pex.calibration")?;
        tables.limit_state = exceeding.first().and_then(|row| row.limit_state).unwrap_or(paper::LIMIT_STATE);
        tables.compared = tables.rows("paper")?;
        for path in file::tables(folder)? {
            let table = Table::open(&path)?;
            if table.schema().index_of(RATES).is_ok() {
                tables.objects.extend(rows::read(&path)?.into_iter().zip(rows::read(&path)?));
            }
            let made = Provenance::of_file(&path)?;
            tables.files.push((path, table.rows(), made));
        }
        tables.objects.sort_by(|a, b| b.1.severity().total_cmp(&a.1.severity()));
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

    /// Whether a stage made one of them.
    pub fn are_of(&self, stage: &str) -> bool {
        self.files.iter().any(|(.., made)| made.as_ref().is_some_and(|made| made.stage == stage))
    }

    /// The first line that a stage has printed.
    pub fn answer_of(&self, stage: &str) -> String {
        let mut made = self.files.iter().filter_map(|(.., made)| made.as_ref());
        let summary = made.find(|made| made.stage == stage).map_or("", |made| &made.summary);
        summary.lines().next().unwrap_or_default().to_string()
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
}
