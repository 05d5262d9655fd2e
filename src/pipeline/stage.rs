//! What every stage has.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use polars::prelude::DataFrame;
use serde_json::Value;

use super::console::Console;
use super::terminal::Terminal;
use crate::table::TableError;
use crate::table::store::contents::{content_of, recorded};
use crate::table::store::provenance::{Provenance, Recorded};
use crate::table::store::source::{Source, Target};

/// A stage about to run: files in, parameters, files out.
pub trait Stage {
    /// The subcommand.
    fn name(&self) -> &'static str;

    /// The tables it reads, by the role each plays.
    fn inputs(&self) -> Vec<(&'static str, Source)>;

    /// What it writes; the last one is complete only when all are.
    fn targets(&self) -> Vec<Target>;

    /// All that its rows depend on besides the inputs.
    fn parameters(&self) -> Value;

    /// Does the work and says in a few words what came of it, or nothing where [`Stage::show`] says all.
    ///
    /// # Errors
    /// If an input cannot be used or an output not be written.
    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String>;

    /// Words for whoever called, after the work is done or found up to date.
    ///
    /// # Errors
    /// If an output cannot be read.
    fn show(&self, _terminal: &Terminal) -> anyhow::Result<String> {
        Ok(String::new())
    }

    /// The rows of the table that it shows, with all columns, for a program; none where it shows no table.
    ///
    /// # Errors
    /// If an output cannot be read.
    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        Ok(None)
    }

    /// The files it writes.
    fn outputs(&self) -> Vec<PathBuf> {
        self.targets().iter().filter_map(|target| target.path().map(Path::to_path_buf)).collect()
    }

    /// What an output that is there says of how it was made; `None` where another program wrote it.
    ///
    /// # Errors
    /// If it is missing or unreadable.
    fn recorded(&self, output: &Path) -> Result<Option<Recorded>, TableError> {
        recorded(output)
    }

    /// Whether a text, of which this is the start, is one that this stage writes.
    fn is_own_text(&self, _head: &str) -> bool {
        false
    }

    /// What its files will say of how they were made.
    ///
    /// # Errors
    /// If an input is missing or unreadable.
    fn provenance(&self) -> anyhow::Result<Provenance> {
        let content =
            |(role, source): &(&str, Source)| Ok((role.to_string(), content_of_role(role, source)?));
        let sources = self.inputs();
        let inputs = sources.iter().map(content).collect::<Result<BTreeMap<_, _>, TableError>>()?;
        Ok(Provenance::new(self.name(), self.parameters(), inputs).of_sources(places(&sources)))
    }
}

/// Where inputs can be looked at again, by their roles.
pub fn places(inputs: &[(&'static str, Source)]) -> BTreeMap<String, PathBuf> {
    let place = |(role, source): &(&'static str, Source)| match source {
        Source::Path(path) => Some((role.to_string(), path.clone())),
        Source::Memory(_) => None,
    };
    inputs.iter().filter_map(place).collect()
}

/// What an input holds ([`content_of`]).
///
/// # Errors
/// As there; of a file of another kind with what plays this role.
pub fn content_of_role(role: &str, source: &Source) -> Result<String, TableError> {
    content_of(source).map_err(|error| match (error, MAKERS.iter().find(|(other, _)| *other == role)) {
        (TableError::NoParquet { path, .. }, Some((_, maker))) => {
            TableError::NoParquet { path, expected: format!("the {role} that {maker}") }
        }
        (error, _) => error,
    })
}

/// Who makes what plays a role, in words.
const MAKERS: [(&str, &str); 7] = [
    ("scenarios", "sample-scenarios makes"),
    ("motions", "synthesize-motions makes, or import-motions of records and CSV"),
    ("responses", "simulate makes"),
    ("pex", "fit-pex makes"),
    ("pro", "fit-pro makes"),
    (
        "intensities",
        "a Parquet table with pga_m_s2 and pgv_m_s has, or a CSV file whose name ends in .csv; a hazard is for --hazard",
    ),
    ("rates", "evaluate --hazard hazard.csv --out rates.parquet writes"),
];

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// `name` in the folder of `path`.
pub fn beside(path: &Path, name: &str) -> PathBuf {
    path.with_file_name(name)
}
