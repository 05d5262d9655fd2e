//! The tables of a report, each known by its columns, whatever its name.

use std::path::{Path, PathBuf};

use arrow_schema::Schema;

use super::evaluations;
use crate::fragility::{Calibration, Cases, Event};
use crate::keyword::{Keyword, keywords};
use crate::paper;
use crate::report::answers::Evaluation;
use crate::report::compare;
use crate::report::figures::Fits;
use crate::report::response::Trace;
use crate::rocking::Outcome;
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::table::TableError;
use crate::table::answers::{Answer, FragilityRow};
use crate::table::file::{self, Table};
use crate::table::keys::key_of;
use crate::table::motions::{self, Motion};
use crate::table::provenance::{Provenance, joined};
use crate::table::rows::{self, Row};
use crate::table::writer::MOTIONS_IN_GROUP;

keywords! {
    /// What a table holds, in words.
    pub enum Kind {
        Motions = "motions",
        Traces = "responses over time",
        Stripes = "stripes",
        Responses = "responses",
        Capacities = "overturning intensities",
        CapacityFits = "distributions of overturning intensities",
        Rates = "annual rates",
        Fragility = "fragility curves",
        Probabilities = "probabilities under motions",
        Calibrations = "calibrations",
        Curves = "curves of overturning",
        Planes = "regressions of the demand",
        Parameters = "parameters of fits",
        Paper = "numbers of the paper",
        Reliability = "observed shares",
        Validation = "validation",
        Ranking = "ranking of measures",
        Scenarios = "scenarios",
        Other = "another program's table",
    }
}

impl Kind {
    /// Columns by which it is known; the first kind of which a table has all counts.
    fn columns(self) -> &'static str {
        match self {
            Kind::Motions => "acceleration_m_s2 dt_s",
            Kind::Traces => "theta_over_alpha time_s",
            Kind::Stripes => "outcome intensity scale",
            Kind::Responses => "outcome edp alpha_rad",
            Kind::Capacities => "capacity overturning_intensity",
            Kind::CapacityFits => "theta beta n_safe",
            Kind::Rates => "overturning_per_year p_overturning",
            Kind::Fragility => "p_rocking p_failure p_overturning",
            Kind::Probabilities => "p_ro",
            Kind::Calibrations => "ln_s tau n_clusters",
            Kind::Curves => "event coefficients aic",
            Kind::Planes => "model coefficients range_low",
            Kind::Parameters => "parameter value standard_error",
            Kind::Paper => "published ours",
            Kind::Reliability => "predicted share",
            Kind::Validation => "observed expected log_score",
            Kind::Ranking => "loss rank measures",
            Kind::Scenarios => "scenario_id gamma",
            Kind::Other => "",
        }
    }

    fn from_schema(schema: &Schema) -> Kind {
        let has_all = |kind: &&Kind| {
            let mut columns = kind.columns().split(' ').filter(|column| !column.is_empty());
            columns.all(|column| schema.index_of(column).is_ok())
        };
        Kind::ALL.iter().find(has_all).copied().unwrap_or(Kind::Other)
    }
}

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
        let table = Table::open(path)?;
        let kind = Kind::from_schema(table.schema());
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
    are_files: bool,
}

impl Tables {
    /// Reads files, and the tables of folders. A file that is no table is an error; in a folder it is passed
    /// over.
    pub fn read(paths: &[PathBuf]) -> anyhow::Result<Tables> {
        let mut tables = Tables { are_files: paths.iter().all(|path| !path.is_dir()), ..Tables::default() };
        for path in paths {
            if path.is_dir() && file::tables(path).is_ok_and(|files| files.is_empty()) {
                anyhow::bail!(
                    "{}: no tables; expected those of simulate, fit-pro, ida or evaluate",
                    path.display()
                );
            }
            for file in files_of(path)? {
                tables.items.push(Item::read(&file)?);
            }
        }
        tables.leave_out_strangers();
        let groups = tables.of(Kind::Responses).map(|item| responses::read(&item.path));
        tables.groups = groups.collect::<anyhow::Result<Vec<_>>>()?.concat();
        if tables.groups.len() > 2 {
            tables.groups.sort_by(|a, b| overturning(b).total_cmp(&overturning(a)));
        }
        let exceeding: Vec<Calibration> = tables.rows(Kind::Calibrations)?;
        let limit_state = exceeding.iter().find_map(|row: &Calibration| row.limit_state);
        tables.fits = Fits {
            demand: tables.rows(Kind::Planes)?,
            curves: tables.rows(Kind::Curves)?,
            calibrations: exceeding.into_iter().filter(|row| row.limit_state.is_none()).collect(),
            limit_state: limit_state.unwrap_or(paper::LIMIT_STATE),
        };
        tables.fits.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        tables.compared = tables.rows(Kind::Paper)?;
        for item in &tables.items {
            match item.kind {
                Kind::Rates => tables.evaluations.push(evaluations::read(&item.path, item.made.as_ref())?),
                Kind::Fragility => tables.fragilities.extend(evaluations::read_fragility(&item.path)?),
                Kind::Traces => tables.traces.extend(evaluations::read_traces(&item.path)?),
                Kind::Other | Kind::Probabilities => {
                    let (name, words) = (item.name(), item.kind);
                    tables.left_out.push(format!("{name} is not shown: it holds {words}."));
                }
                _ => {}
            }
        }
        // Probabilities over another peak, or in other times, do not compare.
        let over = tables.fragilities.first().and_then(|first| first.row.over);
        for other in tables.fragilities.extract_if(.., |answer| answer.row.over != over) {
            let name = other.object.structure;
            tables.left_out.push(format!("{name} is not shown: its fragility is over another peak."));
        }
        // Where no object has an answer there is no time.
        let mut whens = tables.evaluations.iter().map(|evaluation| evaluation.when.clone());
        let first = whens.find(|when| !when.is_empty()).unwrap_or_default();
        for silent in tables.evaluations.iter_mut().filter(|evaluation| evaluation.when.is_empty()) {
            silent.when.clone_from(&first);
        }
        for other in tables.evaluations.extract_if(.., |evaluation| evaluation.when != first) {
            let (file, when) = (other.file(), other.when);
            tables.left_out.push(format!("{file} is not shown: it is {when}, not {first}."));
        }
        Ok(tables)
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
                Kind::Planes | Kind::Curves | Kind::Calibrations | Kind::Parameters | Kind::Ranking => {
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

    /// Two evaluations of objects of the same names: before and after, in the order of the files.
    pub fn comparison(&self) -> Option<[&Evaluation; 2]> {
        let [before, after] = &self.evaluations[..] else { return None };
        (self.are_files && !compare::pairs(before, after).is_empty()).then_some([before, after])
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
    pub fn motions(&self) -> Result<Vec<Motion>, TableError> {
        let Some(item) = self.of(Kind::Motions).next() else { return Ok(Vec::new()) };
        let table = motions::open(&item.path, None)?;
        let middle = table.rows() / MOTIONS_IN_GROUP / 2;
        let part = motions::parts(&table).nth(middle).or_else(|| motions::parts(&table).next());
        let some = part.map(|part| motions::read_part(&table, part?, MOTIONS_IN_GROUP)?.next().transpose());
        Ok(some.transpose()?.flatten().map_or(Vec::new(), |(_, motions)| motions))
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
    let folders = file::entries(path)?.into_iter().filter(|entry| entry.is_dir());
    files.extend(folders.filter(|folder| Table::open(folder).is_ok()));
    Ok(files)
}
