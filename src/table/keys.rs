//! The key of the content of a file, which shows whether what is made of it is up to date.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fs::File;
use std::path::{Path, PathBuf};

use super::TableError;
use super::file::{self, is_table};
use super::provenance::{InputFile, Provenance, joined};
use crate::source;

/// Returns all files in a folder and the folders in it, in the order of their names, without hidden files,
/// pipes and devices. A folder to which several links lead is read once.
pub fn files_below(folder: &Path) -> Result<Vec<PathBuf>, TableError> {
    let mut files = Vec::new();
    add_files(&mut files, &mut HashSet::new(), folder)?;
    Ok(files)
}

fn add_files(files: &mut Vec<PathBuf>, seen: &mut HashSet<PathBuf>, folder: &Path) -> Result<(), TableError> {
    if !seen.insert(folder.canonicalize().map_err(|source| TableError::io(folder, source))?) {
        return Ok(());
    }
    for path in file::entries(folder)? {
        match path.metadata() {
            Ok(found) if found.is_dir() => add_files(files, seen, &path)?,
            // A broken link is a file that cannot be read.
            Ok(found) if !found.is_file() => {}
            _ => files.push(path),
        }
    }
    Ok(())
}

/// Returns the names of files below the innermost folder that has all of them.
pub fn names_below(paths: &[PathBuf]) -> Vec<String> {
    let full: Vec<PathBuf> = paths.iter().map(|path| resolved(path)).collect();
    let mut folder = full.first().and_then(|path| path.parent()).unwrap_or(Path::new("")).to_path_buf();
    while !full.iter().all(|path| path.starts_with(&folder)) && folder.pop() {}
    let names = full.iter().map(|path| path.strip_prefix(&folder).unwrap_or(path).to_string_lossy());
    names.map(Cow::into_owned).collect()
}

/// Returns the one way of writing a path that need not exist.
pub fn resolved(path: &Path) -> PathBuf {
    let mut resolved = PathBuf::new();
    for part in std::path::absolute(path).unwrap_or(path.to_path_buf()).components() {
        match part {
            std::path::Component::ParentDir => {
                // Above a link is what is above its target.
                resolved = resolved.canonicalize().unwrap_or(resolved);
                resolved.pop();
            }
            part => resolved.push(part),
        }
    }
    match resolved.parent().map(Path::canonicalize) {
        Some(Ok(folder)) => folder.join(resolved.file_name().unwrap_or_default()),
        _ => resolved,
    }
}

impl Provenance {
    /// Reads the provenance of a table; `None` if another program wrote it.
    pub fn read(path: &Path) -> Result<Option<Provenance>, TableError> {
        Ok(Provenance::from_footer(file::metadata(path)?.metadata()))
    }

    /// Whether the same call wrote another file beside this one.
    pub fn is_beside(&self, other: &Path) -> bool {
        let other = Provenance::read(other).ok().flatten().filter(|other| other.output != self.output);
        other.is_some_and(|other| Provenance { output: self.output, ..other }.key() == self.key())
    }

    /// Returns it with what is stated of the tables that were read.
    pub fn with_before(self) -> Provenance {
        let read = self.inputs.values().flatten().filter(|file| is_table(&file.path));
        let made = read.filter_map(|file| Provenance::read(&file.path).ok().flatten());
        let before = made.flat_map(Provenance::all_stated).collect();
        Provenance { before, ..self }
    }
}

/// Computes the key of a table, or of the tables in a folder.
pub fn key_of(path: &Path) -> Result<String, TableError> {
    let files = file::tables(path)?;
    let read = files.iter().zip(names_below(&files));
    let read = read.map(|(path, name)| Ok(InputFile { name, key: key_of_file(path)?, path: path.clone() }));
    Ok(joined(&read.collect::<Result<Vec<_>, TableError>>()?))
}

/// Computes the key of the content of a file: the one in its footer if rockfrag wrote it, else the hash of its
/// bytes.
pub fn key_of_file(path: &Path) -> Result<String, TableError> {
    match is_table(path).then(|| Provenance::read(path)) {
        Some(Ok(Some(made))) => return Ok(made.key_of_content()),
        Some(Err(error @ TableError::Io { .. })) => return Err(error),
        _ => {}
    }
    let mut hasher = blake3::Hasher::new();
    let hashed = match source::is_pipe(path) || path == Path::new("-") {
        true => source::read(path).map(|bytes| hasher.update(&bytes)),
        false => File::open(source::split_sheet(path).0).and_then(|file| hasher.update_reader(file)),
    };
    hashed.map_err(|error| TableError::io(path, error))?;
    Ok(hasher.finalize().to_hex().to_string())
}
