//! The tables of a folder, as far as they are there.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::fragility::{Calibration, Cases, DemandFit, Event, OverturningFit};
use crate::paper;
use crate::rocking::Outcome;
use crate::stages::ida::{CapacityFitRow, CapacityRow};
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::studies::{RankedSet, ReliabilityBin, Validation};
use crate::table::TableError;
use crate::table::file::{Table, files};
use crate::table::motions::{Motion, Motions};
use crate::table::provenance::Provenance;
use crate::table::rows::{self, Row};

/// What the report shows.
pub struct Tables {
    /// Responses by suite and structure.
    pub groups: Vec<Cases>,
    pub demand: Vec<DemandFit>,
    pub curves: Vec<OverturningFit>,
    /// Of overturning.
    pub calibrations: Vec<Calibration>,
    /// Demand |theta|max / alpha whose exceedance is drawn.
    pub limit_state: f64,
    pub compared: Vec<Comparison>,
    pub capacities: Vec<CapacityRow>,
    pub capacity_fits: Vec<CapacityFitRow>,
    pub stripes: Vec<Stripe>,
    pub validations: Vec<Validation>,
    pub bins: Vec<ReliabilityBin>,
    pub ranked: Vec<RankedSet>,
    /// Some motions from the middle of the file.
    pub motions: Vec<Motion>,
    pub files: Vec<FileMade>,
}

/// How many motions overturn a structure at one intensity.
pub struct Stripe {
    pub suite: Option<String>,
    pub structure: String,
    pub intensity: f64,
    pub n: usize,
    pub events: usize,
}

/// A table and what made it.
pub struct FileMade {
    pub name: String,
    pub rows: u64,
    /// None of another program.
    pub made: Option<Provenance>,
}

/// Rows of a row group of motions that rockfrag wrote.
const MOTIONS_IN_GROUP: u64 = 64;
/// Files that are listed.
const LISTED: [&str; 14] = [
    "scenarios",
    "motions",
    "responses",
    "pex",
    "pro",
    "pex.calibration",
    "pro.calibration",
    "paper",
    "ida",
    "ida.fragility",
    "evaluated",
    "validation",
    "validation.reliability",
    "ranking",
];

impl Tables {
    /// Reads all that a folder holds.
    pub fn read(folder: &Path) -> anyhow::Result<Tables> {
        let curves: Vec<OverturningFit> = read(folder, "pro")?;
        let files = LISTED
            .iter()
            .filter_map(|name| Some(made(&place(folder, name)?)))
            .collect::<Result<Vec<_>, _>>()?;
        let limit_state =
            files.iter().find(|file| file.name == "pex.parquet").and_then(FileMade::limit_state);
        Ok(Tables {
            groups: place(folder, "responses")
                .map(|path| responses::read(&path))
                .transpose()?
                .unwrap_or_default(),
            demand: read(folder, "pex")?,
            curves: curves.into_iter().filter(|fit| fit.event == Event::Overturning).collect(),
            calibrations: read(folder, "pro.calibration")?,
            limit_state: limit_state.unwrap_or(paper::LIMIT_STATE),
            compared: read(folder, "paper")?,
            capacities: read(folder, "ida")?,
            capacity_fits: read(folder, "ida.fragility")?,
            stripes: place(folder, "ida.stripes").map(|path| stripes(&path)).transpose()?.unwrap_or_default(),
            validations: read(folder, "validation")?,
            bins: read(folder, "validation.reliability")?,
            ranked: read(folder, "ranking")?,
            motions: place(folder, "motions").map(|path| motions(&path)).transpose()?.unwrap_or_default(),
            files,
        })
    }
}

impl FileMade {
    fn limit_state(&self) -> Option<f64> {
        self.made.as_ref()?.arguments.get("limit-state")?.first()?.split(',').next()?.parse().ok()
    }
}

/// The file of a table, or the folder of its partitions; none where it is not there.
fn place(folder: &Path, name: &str) -> Option<PathBuf> {
    let (file, parts) = (folder.join(format!("{name}.parquet")), folder.join(name));
    if file.exists() { Some(file) } else { Some(parts).filter(|parts| parts.is_dir()) }
}

fn read<R: Row>(folder: &Path, name: &str) -> Result<Vec<R>, TableError> {
    place(folder, name).map_or(Ok(Vec::new()), |path| rows::read(&path))
}

fn made(path: &Path) -> Result<FileMade, TableError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let first = files(path)?.swap_remove(0);
    Ok(FileMade { name, rows: Table::open(path)?.rows(), made: Provenance::of_file(&first)? })
}

/// The motions of a row group in the middle of the file.
fn motions(path: &Path) -> Result<Vec<Motion>, TableError> {
    let motions = Motions::open(path, None)?;
    let middle = (motions.rows() / MOTIONS_IN_GROUP / 2) as usize;
    let Some(part) = motions.parts().nth(middle).or_else(|| motions.parts().next()) else {
        return Ok(Vec::new());
    };
    let some = motions.read(part?, MOTIONS_IN_GROUP as usize)?.next();
    Ok(some.transpose()?.map_or(Vec::new(), |(_, motions)| motions))
}

fn stripes(path: &Path) -> Result<Vec<Stripe>, TableError> {
    type Key = (Option<String>, String, u64);
    let mut counts: BTreeMap<Key, [usize; 2]> = BTreeMap::new();
    let table = Table::open(path)?;
    for batch in table.batches(&|name| ["suite", "structure", "intensity", "outcome"].contains(&name)) {
        let batch = batch?;
        let columns = batch.columns();
        let (suites, outcomes) = (columns.texts("suite")?, columns.required_texts("outcome")?);
        let structures = columns.required_texts("structure")?;
        for (row, intensity) in columns.required_numbers("intensity")?.into_iter().enumerate() {
            let key = (suites[row].clone(), structures[row].clone(), intensity.to_bits());
            let [n, events] = counts.entry(key).or_default();
            *n += 1;
            *events += usize::from(outcomes[row] == Outcome::Overturning.to_string());
        }
    }
    let stripe = |((suite, structure, bits), [n, events]): (Key, [usize; 2])| Stripe {
        suite,
        structure,
        intensity: f64::from_bits(bits),
        n,
        events,
    };
    Ok(counts.into_iter().map(stripe).collect())
}
