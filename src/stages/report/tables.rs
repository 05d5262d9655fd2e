//! The tables of a report, each known by its columns, whatever its name.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use rockfrag_core::fragility::{Calibration, Cases, Event, LimitStates, Peak};
use rockfrag_core::hazard::{Fragility, FragilityPoint};
use rockfrag_core::paper;
use rockfrag_core::rocking::Outcome;
use rockfrag_core::studies::comparison::Comparison;
use rockfrag_core::units::G_M_S2;

use crate::document::answers::Evaluation;
use crate::document::response::Trace;
use crate::figures::Fits;
use crate::stages::evaluate::pages;
use crate::stages::shared::responses;
use crate::table::TableError;
use crate::table::answers::{Answer, CurveRow, FragilityRow, ObjectRow, RatesRow, UncertaintyRow};
use crate::table::file::{self, ParquetTable};
use crate::table::keys::key_of;
use crate::table::motions::{self, MotionRow, is_motion_column};
use crate::table::provenance::{Provenance, joined};
use crate::table::responses::TraceRow;
use crate::table::rows::{self, Row};
use crate::table::writer::MOTIONS_IN_GROUP;

/// The most responses that are drawn of a file.
const MOST_TRACES: usize = 50;

/// What a table holds, in words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "snake_case")]
pub enum Kind {
    Motions,
    #[strum(serialize = "responses over time")]
    Traces,
    Stripes,
    Responses,
    #[strum(serialize = "overturning intensities")]
    Capacities,
    #[strum(serialize = "distributions of overturning intensities")]
    CapacityFits,
    #[strum(serialize = "annual rates")]
    Rates,
    #[strum(serialize = "fragility curves")]
    Fragility,
    #[strum(serialize = "probabilities under motions")]
    Probabilities,
    Calibrations,
    #[strum(serialize = "curves of overturning")]
    Curves,
    #[strum(serialize = "regressions of the demand")]
    Planes,
    #[strum(serialize = "parameters of fits")]
    Parameters,
    #[strum(serialize = "numbers of the paper")]
    Paper,
    #[strum(serialize = "observed shares")]
    Reliability,
    Validation,
    Scenarios,
    #[strum(serialize = "another program's table")]
    Other,
}

/// Columns by which a table is known; the first kind of which it has all counts.
const COLUMNS: [(Kind, &str); 17] = [
    (Kind::Motions, "acceleration_m_s2 dt_s"),
    (Kind::Traces, "theta_over_alpha time_s"),
    (Kind::Stripes, "outcome intensity scale"),
    (Kind::Responses, "outcome edp alpha_rad"),
    (Kind::Capacities, "capacity overturning_intensity"),
    (Kind::CapacityFits, "theta beta n_safe"),
    (Kind::Rates, "overturning_per_year p_overturning"),
    (Kind::Fragility, "p_rocking p_failure p_overturning"),
    (Kind::Probabilities, "p_ro"),
    (Kind::Calibrations, "ln_s tau n_clusters"),
    (Kind::Curves, "event coefficients aic"),
    (Kind::Planes, "model coefficients range_low"),
    (Kind::Parameters, "parameter value standard_error"),
    (Kind::Paper, "published ours"),
    (Kind::Reliability, "predicted share"),
    (Kind::Validation, "observed expected log_score"),
    (Kind::Scenarios, "scenario_id gamma"),
];

/// Tables of which the page shows nothing of their own: others are made of them, or stand beside them.
const SILENT: [Kind; 4] = [Kind::Scenarios, Kind::Parameters, Kind::Stripes, Kind::Capacities];

/// A table that is read.
pub struct Item {
    pub path: PathBuf,
    pub kind: Kind,
    pub rows: usize,
    /// What made it, if it is ours.
    pub made: Option<Provenance>,
    key: String,
}

impl Item {
    fn read(path: &Path) -> Result<Item, TableError> {
        let table = ParquetTable::open(path)?;
        let has = |columns: &str| columns.split(' ').all(|name| table.schema().index_of(name).is_ok());
        let kind = COLUMNS.iter().find(|(_, columns)| has(columns)).map_or(Kind::Other, |(kind, _)| *kind);
        let made = if path.is_dir() { None } else { Provenance::read(path)? };
        Ok(Item { path: path.to_path_buf(), kind, rows: table.rows(), made, key: key_of(path)? })
    }

    /// The key of the first file that an option of its stage has read.
    fn input(&self, flag: &str) -> Option<String> {
        let files = self.made.as_ref()?.inputs.get(flag)?;
        Some(if flag == "fits" { files.first()?.key.clone() } else { joined(files) })
    }

    pub fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// What most of the report needs; further tables are read where they are shown.
#[derive(Default)]
pub struct Tables {
    pub items: Vec<Item>,
    /// Responses by suite and structure, those that overturn most first.
    pub groups: Vec<Cases>,
    pub fits: Fits,
    pub compared: Vec<Comparison>,
    pub evaluations: Vec<Evaluation>,
    pub fragilities: Vec<Answer<FragilityRow>>,
    pub traces: Vec<Trace>,
    /// What is not shown, and why.
    pub left_out: Vec<String>,
    /// Whether files were given, in an order that means something, rather than a folder.
    pub are_files: bool,
}

impl Tables {
    /// Reads files, and the tables of folders. A file that is no table is an error; in a folder it is passed
    /// over.
    pub fn read(paths: &[PathBuf]) -> anyhow::Result<Tables> {
        let mut tables = Tables { are_files: paths.iter().all(|path| !path.is_dir()), ..Tables::default() };
        for path in paths {
            let files = files_of(path)?;
            if files.is_empty() {
                let expected = "expected those of simulate, fit-pro, ida or evaluate";
                anyhow::bail!("{}: no tables; {expected}", path.display());
            }
            let items = files.iter().map(|file| Item::read(file)).collect::<Result<Vec<_>, _>>()?;
            tables.items.extend(items);
        }
        tables.leave_out_strangers();
        let groups = tables.of(Kind::Responses).map(|item| responses::read(&item.path));
        tables.groups = groups.collect::<anyhow::Result<Vec<_>>>()?.concat();
        if tables.groups.len() > 2 {
            tables.groups.sort_by(|a, b| overturning(b).total_cmp(&overturning(a)));
        }
        let calibrations: Vec<Calibration> = tables.rows(Kind::Calibrations)?;
        let (exceeding, calibrations): (Vec<_>, Vec<_>) =
            calibrations.into_iter().partition(|row| row.limit_state.is_some());
        tables.fits = Fits {
            demand: tables.rows(Kind::Planes)?,
            curves: tables.rows(Kind::Curves)?,
            calibrations,
            limit_state: exceeding.first().and_then(|row| row.limit_state).unwrap_or(paper::LIMIT_STATE),
        };
        tables.fits.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        tables.compared = tables.rows(Kind::Paper)?;
        for item in &tables.items {
            match item.kind {
                Kind::Rates => tables.evaluations.push(read_evaluation(item)?),
                Kind::Fragility => tables.fragilities.extend(read_fragility(&item.path)?),
                Kind::Traces => tables.traces.extend(read_traces(&item.path)?),
                Kind::Other | Kind::Probabilities => {
                    let (name, words) = (item.name(), item.kind);
                    tables.left_out.push(format!("{name} is not shown: it holds {words}."));
                }
                _ => {}
            }
        }
        tables.leave_out_incomparable();
        Ok(tables)
    }

    /// Leaves out fragilities over another peak than the first, and probabilities in another time.
    fn leave_out_incomparable(&mut self) {
        let over = self.fragilities.first().and_then(|first| first.row.over);
        for other in self.fragilities.extract_if(.., |answer| answer.row.over != over) {
            let name = other.object.structure;
            self.left_out.push(format!("{name} is not shown: its fragility is over another peak."));
        }
        // Where no object has an answer there is no time.
        let mut times = self.evaluations.iter().map(|evaluation| evaluation.when.clone());
        let first = times.find(|when| !when.is_empty()).unwrap_or_default();
        for other in self.evaluations.extract_if(.., |one| !one.when.is_empty() && one.when != first) {
            let (file, when) = (other.file(), other.when);
            self.left_out.push(format!("{file} is not shown: it is {when}, not {first}."));
        }
        self.evaluations.iter_mut().for_each(|evaluation| evaluation.when.clone_from(&first));
    }

    /// Leaves out the tables that were made of other responses, motions or fits than those that are there:
    /// names of structures alone do not tell.
    fn leave_out_strangers(&mut self) {
        let responses = match &self.keys(Kind::Responses)[..] {
            [] => self.inputs(Kind::Curves, "in").into_iter().take(1).collect(),
            keys => keys.to_vec(),
        };
        let motions = match &self.inputs(Kind::Responses, "in")[..] {
            [] => self.keys(Kind::Motions),
            inputs => inputs.to_vec(),
        };
        let (fits, calibrations) = (self.keys(Kind::Curves), self.keys(Kind::Calibrations));
        // The motions of the ground may stand beside those of a floor that were made of them.
        let has_motions = self.keys(Kind::Motions).iter().any(|key| motions.contains(key));
        let mut kept = Vec::new();
        for item in std::mem::take(&mut self.items) {
            let (has, expected, what) = match item.kind {
                Kind::Planes | Kind::Curves | Kind::Calibrations | Kind::Parameters => {
                    (item.input("in"), &responses, "responses")
                }
                Kind::Capacities | Kind::CapacityFits | Kind::Stripes => {
                    (item.input("in"), &motions, "motions")
                }
                Kind::Paper => (item.input("pro"), &fits, "fits"),
                Kind::Validation | Kind::Reliability | Kind::Rates => {
                    (item.input("fits"), &calibrations, "fits")
                }
                Kind::Motions if !has_motions => (Some(item.key.clone()), &motions, "responses"),
                _ => (None, &motions, ""),
            };
            if expected.is_empty() || has.is_none_or(|has| expected.contains(&has)) {
                kept.push(item);
            } else if !SILENT.contains(&item.kind) && item.kind != Kind::Calibrations {
                self.left_out.push(format!("{} is not shown: it belongs to other {what}.", item.name()));
            }
        }
        self.items = kept;
    }

    fn keys(&self, kind: Kind) -> Vec<String> {
        self.of(kind).map(|item| item.key.clone()).collect()
    }

    /// The keys of the files that an option of the stage has read.
    fn inputs(&self, kind: Kind, flag: &str) -> Vec<String> {
        self.of(kind).filter_map(|item| item.input(flag)).collect()
    }

    /// The tables of a kind.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(move |item| item.kind == kind)
    }

    /// The rows of all tables of a kind.
    pub fn rows<R: Row>(&self, kind: Kind) -> Result<Vec<R>, TableError> {
        let tables = self.of(kind).map(|item| rows::read(&item.path)).collect::<Result<Vec<_>, _>>()?;
        Ok(tables.into_iter().flatten().collect())
    }

    /// What made each table that is ours.
    pub fn made(&self) -> impl Iterator<Item = &Provenance> {
        self.items.iter().filter_map(|item| item.made.as_ref())
    }

    pub fn made_by(&self, stage: &str) -> Option<&Provenance> {
        self.made().find(|made| made.stage == stage)
    }

    /// The first line that a stage has printed.
    pub fn answer_of(&self, stage: &str) -> Option<&str> {
        self.made_by(stage)?.summary.lines().next()
    }

    /// The motions of a row group in the middle of the first file of them.
    pub fn motions(&self) -> Result<Vec<MotionRow>, TableError> {
        let Some(item) = self.of(Kind::Motions).next() else { return Ok(Vec::new()) };
        let table = motions::open(&item.path, None)?;
        let middle = table.rows() / MOTIONS_IN_GROUP / 2;
        let parts = || motions::parts(&table, is_motion_column, MOTIONS_IN_GROUP);
        let some = parts().nth(middle).or_else(|| parts().next()).map(|part| part()).transpose()?;
        Ok(some.into_iter().flatten().next().map_or(Vec::new(), |some| some.motions))
    }
}

/// The share of the motions that overturn.
fn overturning(cases: &Cases) -> f64 {
    cases.count(Outcome::Overturned) as f64 / cases.all.len().max(1) as f64
}

/// A file; of a folder its tables, and folders of partitions in it.
fn files_of(path: &Path) -> Result<Vec<PathBuf>, TableError> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let mut files = file::tables(path)?;
    for folder in file::entries(path)?.into_iter().filter(|entry| entry.is_dir()) {
        match ParquetTable::open(&folder) {
            Ok(_) => files.push(folder),
            Err(TableError::Io { path, cause }) if cause.kind() != ErrorKind::PermissionDenied => {
                return Err(TableError::io(&path, cause));
            }
            Err(_) => {}
        }
    }
    Ok(files)
}

fn read_evaluation(item: &Item) -> Result<Evaluation, TableError> {
    let (objects, doubts) = (rows::read::<ObjectRow>(&item.path)?, rows::read::<UncertaintyRow>(&item.path)?);
    let mut answers = Vec::new();
    for ((object, row), doubts) in objects.into_iter().zip(rows::read::<RatesRow>(&item.path)?).zip(doubts) {
        let object = ObjectRow { file: item.name(), ..object };
        answers.push(Answer { object, row, doubts, ..Answer::default() });
    }
    Ok(pages::over_hazard(answers, &item.made.clone().unwrap_or_default()))
}

/// The fragility curves of a file, those that need least first.
fn read_fragility(path: &Path) -> Result<Vec<Answer<FragilityRow>>, TableError> {
    let mut all = Vec::new();
    for curve in rows::read::<CurveRow>(path)?.chunk_by(|a, b| a.structure == b.structure) {
        let points = curve.iter().map(|row| FragilityPoint {
            intensity: row.pga_g.map(|pga_g| pga_g * G_M_S2).or(row.pgv_m_s).unwrap_or_default(),
            p: LimitStates { rocking: row.p_rocking, failure: row.p_failure, overturning: row.p_overturning },
        });
        let over = if curve[0].pga_g.is_some() { Peak::Pga } else { Peak::Pgv };
        let object = ObjectRow { structure: curve[0].structure.clone(), ..ObjectRow::default() };
        let curve = Some(Fragility::from_points(over, points.collect()));
        let row = FragilityRow { over: Some(over), curve, ..FragilityRow::default() };
        all.push(Answer { object, row, ..Answer::default() });
    }
    Ok(all)
}

/// The first responses over time of a file.
fn read_traces(path: &Path) -> Result<Vec<Trace>, TableError> {
    let rows = rows::read::<TraceRow>(path)?;
    let traces = rows.chunk_by(|a, b| a.motion_id == b.motion_id && a.structure == b.structure);
    Ok(traces.take(MOST_TRACES).map(|trace| Trace(trace.to_vec())).collect())
}
