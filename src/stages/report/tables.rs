//! The tables of a report, each known by its columns, whatever its name.

use std::path::{Path, PathBuf};

use super::evaluations;
use crate::fragility::{Calibration, Cases, Event};
use crate::paper;
use crate::report::compare;
use crate::report::figures::Fits;
use crate::report::rated::Evaluation;
use crate::report::response::TracedResponse;
use crate::rocking::Outcome;
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::table::TableError;
use crate::table::file::{self, Table};
use crate::table::keys::key_of;
use crate::table::motions::{self, Motion};
use crate::table::provenance::{Provenance, joined};
use crate::table::rows::{self, Row};
use crate::table::writer::MOTIONS_IN_GROUP;

/// What a table holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Scenarios,
    Motions,
    Traces,
    Stripes,
    Responses,
    Capacities,
    CapacityFits,
    Rates,
    Probabilities,
    Calibrations,
    Curves,
    Planes,
    Parameters,
    Paper,
    Validation,
    Reliability,
    Ranking,
    Other,
}

/// Columns by which each kind is known, and what it is called; the first that has all counts.
const KINDS: [(Kind, &str, &str); 18] = [
    (Kind::Motions, "acceleration_m_s2 dt_s", "motions"),
    (Kind::Traces, "theta_over_alpha time_s", "responses over time"),
    (Kind::Stripes, "outcome intensity scale", "stripes"),
    (Kind::Responses, "outcome edp alpha_rad", "responses"),
    (Kind::Capacities, "capacity overturning_intensity", "overturning intensities"),
    (Kind::CapacityFits, "theta beta n_safe", "distributions of overturning intensities"),
    (Kind::Rates, "overturning_per_year p_overturning", "annual rates"),
    (Kind::Probabilities, "p_ro", "probabilities under motions"),
    (Kind::Probabilities, "p_overturns", "probabilities under motions"),
    (Kind::Calibrations, "ln_s tau n_clusters", "calibrations"),
    (Kind::Curves, "event coefficients aic", "curves of overturning"),
    (Kind::Planes, "model coefficients range_low", "regressions of the demand"),
    (Kind::Parameters, "parameter value standard_error", "parameters of fits"),
    (Kind::Paper, "published ours", "numbers of the paper"),
    (Kind::Reliability, "predicted share", "observed shares"),
    (Kind::Validation, "observed expected log_score", "validation"),
    (Kind::Ranking, "loss rank measures", "ranking of measures"),
    (Kind::Scenarios, "scenario_id gamma", "scenarios"),
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
        let table = Table::open(path)?;
        let has = |columns: &str| columns.split(' ').all(|column| table.schema().index_of(column).is_ok());
        let kind = KINDS.iter().find(|(_, columns, _)| has(columns)).map_or(Kind::Other, |(kind, ..)| *kind);
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

    /// What it holds, in words.
    pub fn words(&self) -> &'static str {
        KINDS
            .iter()
            .find(|(kind, ..)| *kind == self.kind)
            .map_or("another program's table", |(.., words)| words)
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
    pub traces: Vec<TracedResponse>,
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
        let overturning =
            |cases: &Cases| cases.count(Outcome::Overturned) as f64 / cases.all.len().max(1) as f64;
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
        let evaluations: Vec<Evaluation> = tables
            .of(Kind::Rates)
            .map(|item| evaluations::read(&item.path, item.made.as_ref()))
            .collect::<Result<_, _>>()?;
        tables.keep_of_one_time(evaluations);
        let traced = tables
            .of(Kind::Traces)
            .map(|item| evaluations::read_traces(&item.path))
            .collect::<Result<Vec<_>, _>>()?;
        tables.traces = traced.into_iter().flatten().collect();
        for item in &tables.items {
            if matches!(item.kind, Kind::Other | Kind::Probabilities) {
                let (name, words) = (item.name(), item.words());
                tables.left_out.push(format!("{name} is not shown: it holds {words}."));
            }
        }
        Ok(tables)
    }

    /// Keeps the evaluations of the first one's exposure time: probabilities in other times do not compare.
    fn keep_of_one_time(&mut self, evaluations: Vec<Evaluation>) {
        let first = evaluations.first().map(|first| (first.years, first.when.clone()));
        for evaluation in evaluations {
            match first.as_ref().is_none_or(|(years, _)| *years == evaluation.years) {
                true => self.evaluations.push(evaluation),
                false => {
                    let (file, when) = (&evaluation.file, &evaluation.when);
                    let first = first.as_ref().map_or("", |(_, when)| when);
                    self.left_out.push(format!("{file} is not shown: it is {when}, not {first}."));
                }
            }
        }
    }

    /// Leaves out the tables that were made of other responses, motions or fits than those that are there:
    /// names of structures alone do not tell.
    fn leave_out_strangers(&mut self) {
        let keys = |kind: Kind| -> Vec<String> { self.of(kind).map(|item| item.key.clone()).collect() };
        let of_flag = |kind: Kind, flag: &str| -> Vec<String> {
            self.of(kind).filter_map(|item| item.input(flag)).collect()
        };
        let or = |first: Vec<String>, second: Vec<String>| if first.is_empty() { second } else { first };
        let responses = or(keys(Kind::Responses), of_flag(Kind::Curves, "in").into_iter().take(1).collect());
        let motions = or(of_flag(Kind::Responses, "in"), keys(Kind::Motions));
        let (fits, calibrations) = (keys(Kind::Curves), keys(Kind::Calibrations));
        let rules: [(&[Kind], &str, &[String], &str); 5] = [
            (
                &[Kind::Planes, Kind::Curves, Kind::Calibrations, Kind::Parameters, Kind::Ranking],
                "in",
                &responses,
                "responses",
            ),
            (&[Kind::Capacities, Kind::CapacityFits, Kind::Stripes], "in", &motions, "motions"),
            (&[Kind::Paper], "pro", &fits, "fits"),
            (&[Kind::Validation, Kind::Reliability, Kind::Rates], "fits", &calibrations, "fits"),
            (&[Kind::Motions], "", &motions, "responses"),
        ];
        let mut left_out = Vec::new();
        let stranger = |item: &Item| -> Option<&str> {
            let (.., flag, expected, what) = rules.iter().find(|(kinds, ..)| kinds.contains(&item.kind))?;
            let has = if flag.is_empty() { Some(item.key.clone()) } else { item.input(flag) };
            // The motions of the ground may stand beside those of a floor that were made of them.
            let is_ground =
                item.kind == Kind::Motions && keys(Kind::Motions).iter().any(|key| motions.contains(key));
            let is_stranger = !expected.is_empty() && has.is_some_and(|has| !expected.contains(&has));
            (is_stranger && !is_ground).then_some(*what)
        };
        let mut kept = Vec::new();
        let told: Vec<Option<String>> =
            self.items.iter().map(|item| stranger(item).map(str::to_string)).collect();
        for (item, what) in std::mem::take(&mut self.items).into_iter().zip(told) {
            match what {
                None => kept.push(item),
                Some(what) => {
                    if !SILENT.contains(&item.kind) && item.kind != Kind::Calibrations {
                        left_out.push(format!("{} is not shown: it belongs to other {what}.", item.name()));
                    }
                }
            }
        }
        self.items = kept;
        self.left_out = left_out;
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
