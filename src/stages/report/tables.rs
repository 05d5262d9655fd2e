//! The tables of a report, each known by its columns, whatever its name.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use rockfrag_core::fragility::{Calibration, Cases, Event, Measure, Predictors};
use rockfrag_core::paper;
use rockfrag_core::studies::comparison::Comparison;
use strum::{EnumProperty, VariantArray};

use crate::answer::{Answer, AnswerTable};
use crate::document::response::Trace;
use crate::figures::{Fits, VP};
use crate::stages::shared::motion_columns::MotionColumns;
use crate::stages::shared::responses;
use crate::table::TableError;
use crate::table::file::{self, ParquetTable};
use crate::table::keys::key_of;
use crate::table::motions::{self, MotionRow, is_motion_column};
use crate::table::provenance::{Provenance, joined};
use crate::table::responses::TraceRow;
use crate::table::rows::{self, Row};
use crate::table::writer::MOTIONS_IN_GROUP;

/// The most responses that are drawn of a file.
const MOST_TRACES: usize = 50;

/// What a table holds, in words, and columns that tell it from those behind it. Answers for the motions of a
/// table come before these motions, whose columns they keep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display, strum::EnumProperty, strum::VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum Kind {
    #[strum(props(columns = "variant p_overturning"))]
    Variants,
    #[strum(props(columns = "structure p_overturning"))]
    Answers,
    #[strum(serialize = "probabilities under motions", props(columns = "p_ro"))]
    Probabilities,
    #[strum(props(columns = "acceleration_m_s2 dt_s"))]
    Motions,
    #[strum(serialize = "responses over time", props(columns = "theta_over_alpha time_s"))]
    Traces,
    #[strum(props(columns = "outcome intensity scale"))]
    Stripes,
    #[strum(props(columns = "outcome edp alpha_rad"))]
    Responses,
    #[strum(serialize = "overturning intensities", props(columns = "capacity overturning_intensity"))]
    Capacities,
    #[strum(serialize = "distributions of overturning intensities", props(columns = "theta beta n_safe"))]
    CapacityFits,
    #[strum(props(columns = "ln_s tau n_clusters"))]
    Calibrations,
    #[strum(serialize = "curves of overturning", props(columns = "event coefficients auc"))]
    Curves,
    #[strum(serialize = "regressions of the demand", props(columns = "model coefficients range_low"))]
    Planes,
    #[strum(serialize = "parameters of fits", props(columns = "parameter value standard_error"))]
    Parameters,
    #[strum(serialize = "numbers of the paper", props(columns = "published ours"))]
    Paper,
    #[strum(serialize = "observed shares", props(columns = "predicted share"))]
    Reliability,
    #[strum(props(columns = "observed expected log_score"))]
    Validation,
    #[strum(props(columns = "scenario_id gamma"))]
    Scenarios,
    #[strum(serialize = "another program's table")]
    Other,
}

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
        let made = if path.is_dir() { None } else { Provenance::read(path)? };
        let has = |name: &str| table.schema().index_of(name).is_ok();
        let is_it = |kind: &&Kind| kind.get_str("columns").is_some_and(|names| names.split(' ').all(has));
        let kind = Kind::VARIANTS.iter().copied().find(|kind| is_it(&kind)).unwrap_or(Kind::Other);
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
    /// Responses by suite and structure.
    pub groups: Vec<Cases>,
    pub fits: Fits,
    pub compared: Vec<Comparison>,
    pub answers: Vec<AnswerTable>,
    pub traces: Vec<Trace>,
    /// What is not shown, and why.
    pub left_out: Vec<String>,
    /// Whether files were given, in an order that means something, rather than a folder.
    pub are_files: bool,
}

impl Tables {
    /// Reads files, and of folders what is a table.
    pub fn read(paths: &[PathBuf]) -> anyhow::Result<Tables> {
        let mut tables = Tables { are_files: paths.iter().all(|path| !path.is_dir()), ..Tables::default() };
        for path in paths {
            let files = files_of(path)?;
            let expected = "expected those of simulate, fit-pro, ida or evaluate";
            anyhow::ensure!(!files.is_empty(), "{}: no tables; {expected}", path.display());
            let items = files.iter().map(|file| Item::read(file)).collect::<Result<Vec<_>, _>>()?;
            tables.items.extend(items);
        }
        tables.leave_out_strangers();
        let calibrations: Vec<Calibration> = tables.rows(Kind::Calibrations)?;
        let (exceeding, calibrations): (Vec<_>, Vec<_>) =
            calibrations.into_iter().partition(|row| row.limit_state.is_some());
        let fit_pex = tables.made_by("fit-pex");
        let floor = fit_pex.and_then(|made| made.arguments.get("rotation-floor")?.as_f64());
        tables.fits = Fits {
            demand: tables.rows(Kind::Planes)?,
            curves: tables.rows(Kind::Curves)?,
            calibrations,
            limit_state: exceeding.first().and_then(|row| row.limit_state).unwrap_or(paper::LIMIT_STATE),
            rotation_floor: floor.unwrap_or_default(),
        };
        tables.fits.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        let read = |item: &Item| responses::read(&item.path, &tables.columns(item)?);
        let groups = tables.of(Kind::Responses).map(read).collect::<anyhow::Result<Vec<_>>>()?;
        tables.groups = groups.concat();
        tables.compared = tables.rows(Kind::Paper)?;
        for item in &tables.items {
            match item.kind {
                Kind::Answers => tables.answers.push(AnswerTable::read(&item.path, item.made.as_ref())?),
                Kind::Traces => tables.traces.extend(read_traces(&item.path)?),
                Kind::Other | Kind::Probabilities => {
                    tables.left_out.push(format!("{} is not shown: it holds {}.", item.name(), item.kind));
                }
                _ => {}
            }
        }
        tables.leave_out_incomparable();
        Ok(tables)
    }

    /// Columns of the motions of responses: the velocity of the pulse, and measures of curves.
    fn columns(&self, responses: &Item) -> anyhow::Result<MotionColumns> {
        let motions = self.of(Kind::Motions).find(|item| responses.input("in").as_ref() == Some(&item.key));
        let Some(motions) = motions else { return Ok(MotionColumns::default()) };
        let known = ParquetTable::open(&motions.path)?;
        let measures = self.fits.curves.iter().flat_map(|fit| [Some(fit.im_x.clone()), fit.im_y.clone()]);
        let columns = measures.flatten().filter(|measure| matches!(measure, Measure::Column(_)));
        let wanted = columns.chain([Measure::Column(VP.to_string())]);
        let wanted = wanted.filter(|column| known.schema().index_of(column.as_str()).is_ok());
        MotionColumns::read(&wanted.map(Predictors::one).collect::<Vec<_>>(), Some(&motions.path))
    }

    /// Leaves out what is in another time, under another motion or over another peak than the first answers.
    fn leave_out_incomparable(&mut self) {
        // Where no object has an answer there is no time.
        let when = |table: &AnswerTable| table.rows.iter().find_map(Answer::when);
        let first = self.answers.iter().find_map(when).unwrap_or_default();
        for other in self.answers.extract_if(.., |table| when(table).is_some_and(|when| when != first)) {
            let (file, when) = (other.file(), when(&other).unwrap_or_default());
            self.left_out.push(format!("{file} is not shown: it is {when}, not {first}."));
        }
    }

    /// Leaves out tables that were made of others than are there: names of structures alone do not tell.
    fn leave_out_strangers(&mut self) {
        let made_of = |item: &Item| match item.kind {
            Kind::Planes | Kind::Curves | Kind::Calibrations | Kind::Parameters => ("in", Kind::Responses),
            Kind::Capacities | Kind::CapacityFits | Kind::Stripes => ("in", Kind::Motions),
            Kind::Paper => ("pro", Kind::Curves),
            _ => ("fits", Kind::Calibrations),
        };
        let all: Vec<(Kind, String)> = self.items.iter().map(|item| (item.kind, item.key.clone())).collect();
        let is_stranger = |item: &mut Item| {
            let (flag, of) = made_of(item);
            let mut keys = all.iter().filter(|(kind, _)| *kind == of).map(|(_, key)| key).peekable();
            item.input(flag).is_some_and(|key| keys.peek().is_some() && keys.all(|other| *other != key))
        };
        let strangers = self.items.extract_if(.., is_stranger);
        for item in strangers {
            let what = made_of(&item).1;
            self.left_out.push(format!("{} is not shown: it belongs to other {what}.", item.name()));
        }
    }

    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(move |item| item.kind == kind)
    }

    pub fn rows<R: Row>(&self, kind: Kind) -> Result<Vec<R>, TableError> {
        let tables = self.of(kind).map(|item| rows::read(&item.path)).collect::<Result<Vec<_>, _>>()?;
        Ok(tables.into_iter().flatten().collect())
    }

    pub fn made(&self) -> impl Iterator<Item = &Provenance> {
        self.items.iter().filter_map(|item| item.made.as_ref())
    }

    pub fn made_by(&self, stage: &str) -> Option<&Provenance> {
        self.made().find(|made| made.stage == stage)
    }

    /// The motions of a row group in the middle of the file of them that the responses are to.
    pub fn motions(&self) -> Result<Vec<MotionRow>, TableError> {
        let used: Vec<String> = self.of(Kind::Responses).filter_map(|item| item.input("in")).collect();
        let mut motions = self.of(Kind::Motions);
        let item = motions.find(|item| used.is_empty() || used.contains(&item.key));
        let Some(item) = item else { return Ok(Vec::new()) };
        let table = motions::open(&item.path, None)?;
        let middle = table.rows() / MOTIONS_IN_GROUP / 2;
        let parts = || motions::parts(&table, is_motion_column, MOTIONS_IN_GROUP);
        let some = parts().nth(middle).or_else(|| parts().next()).map(|part| part()).transpose()?;
        Ok(some.into_iter().flatten().next().map_or(Vec::new(), |some| some.motions))
    }
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

/// The first responses over time of a file.
fn read_traces(path: &Path) -> Result<Vec<Trace>, TableError> {
    let rows = rows::read::<TraceRow>(path)?;
    let traces = rows.chunk_by(|a, b| a.motion_id == b.motion_id && a.structure == b.structure);
    Ok(traces.take(MOST_TRACES).map(|trace| Trace(trace.to_vec())).collect())
}
