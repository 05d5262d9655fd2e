//! What a call would make, of which files.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::table::keys::resolved;
use crate::table::provenance::Provenance;

/// What a call would make.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    pub made: Provenance,
    /// The files to read.
    pub files: Vec<PlannedFile>,
    pub outputs: Vec<PathBuf>,
}

/// A file to read, with the key of its content and when it was last changed, if that tells anything.
#[derive(Debug, Clone)]
pub struct PlannedFile {
    pub path: PathBuf,
    pub key: String,
    pub modified: Option<SystemTime>,
}

pub fn modified_at(path: &Path) -> Option<SystemTime> {
    path.metadata().and_then(|found| found.modified()).ok()
}

impl Plan {
    /// Returns the provenance of one of the outputs.
    pub fn output(&self, output: usize) -> Provenance {
        Provenance { output, ..self.made.clone() }
    }

    /// Returns the keys of the outputs.
    pub fn keys(&self) -> impl Iterator<Item = (PathBuf, String)> + '_ {
        let outputs = self.outputs.iter().enumerate();
        outputs.map(|(place, path)| (resolved(path), self.output(place).key()))
    }
}
