//! The tables of a folder, as far as they are there.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::fragility::{Calibration, Cases, CurveFit, DemandFit, Event, Measure};
use crate::keyword::Keyword;
use crate::motion::Suite;
use crate::paper;
use crate::stages::evaluate::{Answer, DoubtsRow, ObjectRow, Predicted, RatesRow};
use crate::stages::shared::responses;
use crate::studies::paper::Comparison;
use crate::table::TableError;
use crate::table::file::{self, Table};
use crate::table::keys::key_of;
use crate::table::motions::{self, Motion};
use crate::table::provenance::Provenance;
use crate::table::rows::{self, Row};
use crate::table::writer::MOTIONS_IN_GROUP;

/// What most of the report needs; further tables are read where they are shown.
#[derive(Default)]
pub struct Tables {
    folder: PathBuf,
    /// Responses by suite and structure.
    pub groups: Vec<Cases>,
    pub demand: Vec<DemandFit>,
    /// Of overturning.
    pub curves: Vec<CurveFit>,
    /// Of overturning.
    pub calibrations: Vec<Calibration>,
    /// Demand whose exceedance was fitted.
    pub limit_state: f64,
    pub compared: Vec<Comparison>,
    /// Objects with annual rates, the worst first.
    pub objects: Vec<Answer<RatesRow>>,
    /// Each file with its number of rows and, if it is ours, what made it.
    pub files: Vec<(PathBuf, usize, Option<Provenance>)>,
    /// What is not shown, and why.
    pub left_out: Vec<String>,
    strangers: Vec<&'static str>,
}

/// A column of annual rates, by which their table is known whatever it is called.
const RATES: &str = "overturning_per_year";

/// Structure and, of synthetic motions, suite.
pub fn title(structure: &str, suite: Option<&str>) -> String {
    let synthetic = suite.filter(|suite| *suite != Suite::Record.as_str());
    synthetic.map_or(structure.to_string(), |suite| format!("{structure}, {suite}"))
}

/// The same of some cases.
pub fn name(cases: &Cases) -> String {
    title(&cases.structure.name, cases.suite.as_deref())
}

impl Tables {
    pub fn read(folder: &Path) -> anyhow::Result<Tables> {
        let mut tables = Tables { folder: folder.to_path_buf(), ..Tables::default() };
        for path in file::tables(folder)? {
            tables.files.push((path.clone(), Table::open(&path)?.rows(), Provenance::of_file(&path)?));
        }
        tables.leave_out_strangers()?;
        if let Some(path) = tables.place("responses") {
            tables.groups = responses::read(&path)?;
        }
        if tables.files.is_empty() && tables.groups.is_empty() {
            let folder = folder.display();
            anyhow::bail!("{folder}: no tables; expected those of simulate, fit-pro, ida or evaluate");
        }
        tables.demand = tables.rows("pex")?;
        tables.curves = tables.rows("pro")?;
        tables.curves.retain(|fit| fit.event == Event::Overturning && !fit.coefficients.is_empty());
        tables.calibrations = tables.rows("pro.calibration")?;
        let exceeding: Vec<Calibration> = tables.rows("pex.calibration")?;
        tables.limit_state = exceeding.first().and_then(|row| row.limit_state).unwrap_or(paper::LIMIT_STATE);
        tables.compared = tables.rows("paper")?;
        tables.read_objects()?;
        Ok(tables)
    }

    /// Reads the objects with annual rates: all tables of them, if they are of one hazard and time.
    fn read_objects(&mut self) -> anyhow::Result<()> {
        let mut first = None;
        for (path, _, made) in &self.files {
            if Table::open(path)?.schema().index_of(RATES).is_err() {
                continue;
            }
            let made = made.as_ref();
            let question = made.map(|made| (made.inputs.get("hazard"), made.arguments.get("years")));
            let question = question.unwrap_or_default();
            if *first.get_or_insert(question) != question {
                let file = path.file_name().unwrap_or_default().to_string_lossy();
                self.left_out.push(format!("{file} is not shown: it is of another hazard or time."));
                continue;
            }
            let objects = rows::read::<ObjectRow>(path)?.into_iter().zip(rows::read::<RatesRow>(path)?);
            let objects = objects.zip(rows::read::<DoubtsRow>(path)?);
            let answer = |((object, row), doubts)| Answer { object, row, doubts, ..Answer::default() };
            self.objects.extend(objects.map(answer));
        }
        self.objects.sort_by(|a, b| b.row.severity().total_cmp(&a.row.severity()));
        Ok(())
    }

    /// Leaves out the tables that were made of other responses, motions or fits than those of the folder:
    /// names of structures alone do not tell.
    fn leave_out_strangers(&mut self) -> Result<(), TableError> {
        let key = |name: &str| self.place(name).map(|path| key_of(&path)).transpose();
        let input = |name: &str, flag: &str| {
            let path = self.folder.join(format!("{name}.parquet"));
            let (.., made) = self.files.iter().find(|(file, ..)| *file == path)?;
            let keys = made.as_ref()?.inputs.get(flag)?;
            keys.split(' ').next().map(str::to_string)
        };
        let responses = key("responses")?.or(input("pro", "in"));
        let motions = input("responses", "in").or(key("motions")?);
        // On a floor the responses are to its motions, which are made of these.
        let ground = if key("floor")? == motions { None } else { key("motions")? };
        let strangers = [
            ("motions", ground, motions.clone(), "responses"),
            ("ida", input("ida", "in"), motions, "motions"),
            ("pex", input("pex", "in"), responses.clone(), "responses"),
            ("pro", input("pro", "in"), responses.clone(), "responses"),
            ("ranking", input("ranking", "in"), responses, "responses"),
            ("paper", input("paper", "pro"), key("pro")?, "fits"),
            ("validation", input("validation", "fits"), key("pro")?, "fits"),
            ("evaluated", input("evaluated", "fits"), key("pro")?, "fits"),
        ];
        for (name, has, expected, what) in strangers {
            if has.is_some() && expected.is_some() && has != expected {
                let its = format!("{name}.");
                let is_its = |file: &OsStr| file.to_string_lossy().starts_with(&its);
                self.files.retain(|(path, ..)| !path.file_name().is_some_and(is_its));
                self.strangers.push(name);
                self.left_out.push(format!("{name}.parquet is not shown: it belongs to other {what}."));
            }
        }
        Ok(())
    }

    /// The rows of a table; none where it is not there.
    pub fn rows<R: Row>(&self, name: &str) -> Result<Vec<R>, TableError> {
        self.place(name).map_or(Ok(Vec::new()), |path| rows::read(&path))
    }

    /// The file of a table, or the folder of its partitions.
    fn place(&self, name: &str) -> Option<PathBuf> {
        if self.strangers.iter().any(|stranger| name.split('.').next() == Some(stranger)) {
            return None;
        }
        let (file, parts) = (self.folder.join(format!("{name}.parquet")), self.folder.join(name));
        if file.exists() { Some(file) } else { Some(parts).filter(|parts| parts.is_dir()) }
    }

    /// What made each file that is ours.
    pub fn made(&self) -> impl Iterator<Item = &Provenance> {
        self.files.iter().filter_map(|(.., made)| made.as_ref())
    }

    pub fn made_by(&self, stage: &str) -> Option<&Provenance> {
        self.made().find(|made| made.stage == stage)
    }

    /// The first line that a stage has printed.
    pub fn answer_of(&self, stage: &str) -> Option<&str> {
        self.made_by(stage)?.summary.lines().next()
    }

    /// The calibration of overturning with some cases.
    pub fn calibration(&self, cases: &Cases) -> Option<&Calibration> {
        self.calibrations.iter().find(|row| row.group() == cases.group())
    }

    /// The curve of overturning of some cases over these measures.
    pub fn curve(&self, cases: &Cases, im_x: Measure, im_y: Option<Measure>) -> Option<&CurveFit> {
        let mut its = self.curves.iter().filter(|fit| fit.group() == cases.group());
        its.find(|fit| (fit.im_x, fit.im_y) == (im_x, im_y))
    }

    /// The motions of a row group in the middle of the file.
    pub fn motions(&self) -> Result<Vec<Motion>, TableError> {
        let Some(path) = self.place("motions") else { return Ok(Vec::new()) };
        let table = motions::open(&path, None)?;
        let middle = table.rows() / MOTIONS_IN_GROUP / 2;
        let part = motions::parts(&table).nth(middle).or_else(|| motions::parts(&table).next());
        let some = part.map(|part| motions::read_part(&table, part?, MOTIONS_IN_GROUP)?.next().transpose());
        Ok(some.transpose()?.flatten().map_or(Vec::new(), |(_, motions)| motions))
    }
}
