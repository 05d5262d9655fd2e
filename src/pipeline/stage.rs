//! What every stage has.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::console::Console;
use crate::table::TableError;
use crate::table::provenance::{Provenance, Stamp, content_of, stamp};

/// A stage about to run: files in, parameters, files out.
pub trait Stage {
    /// The subcommand.
    fn subcommand(&self) -> &'static str;

    /// The files it reads, by the role each plays.
    fn inputs(&self) -> Vec<(&'static str, PathBuf)>;

    /// The files it writes; the last one is complete only when all are.
    fn outputs(&self) -> Vec<PathBuf>;

    /// All that its rows depend on besides the inputs.
    fn parameters(&self) -> Value;

    /// Does the work and says in a few words what came of it.
    ///
    /// # Errors
    /// If an input cannot be used or an output not be written.
    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String>;

    /// What an output that is there says of how it was made; `None` where another program wrote it.
    ///
    /// # Errors
    /// If it is missing or unreadable.
    fn recorded(&self, output: &Path) -> Result<Option<Stamp>, TableError> {
        stamp(output)
    }

    /// What its files will say of how they were made.
    ///
    /// # Errors
    /// If an input is missing or unreadable.
    fn provenance(&self) -> Result<Provenance, TableError> {
        let content = |(role, path): (&str, PathBuf)| Ok((role.to_string(), content_of(&path)?));
        let inputs =
            self.inputs().into_iter().map(content).collect::<Result<BTreeMap<_, _>, TableError>>()?;
        let sources = self.inputs().into_iter().map(|(role, path)| (role.to_string(), path)).collect();
        Ok(Provenance::new(self.subcommand(), self.parameters(), inputs).of_sources(sources))
    }
}

/// The folder of a file.
pub fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// `name` in the folder of `path`.
pub fn beside(path: &Path, name: &str) -> PathBuf {
    path.with_file_name(name)
}

/// `pex.parquet` becomes `pex.scan.parquet`: a further output of the same stage.
pub fn with_part(path: &Path, part: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}.{part}.parquet"))
}
