//! The key of a file, which shows whether what is made of it is up to date.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::TableError;
use super::file::{self, is_table};
use super::provenance::Provenance;

/// The bytes of a page or figure that are searched for its provenance.
const HEAD: u64 = 8192;

impl Provenance {
    /// Reads the provenance of a table, page or figure; `None` if another program wrote it.
    pub fn of_file(path: &Path) -> Result<Option<Provenance>, TableError> {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("html" | "svg") => Ok(Provenance::of_text(&head(path)?)),
            Some("png" | "xlsx") => {
                let bytes = std::fs::read(path).map_err(|source| TableError::io(path, source))?;
                Ok(Provenance::of_picture(&bytes).or_else(|| Provenance::of_workbook(bytes)))
            }
            _ => Ok(Provenance::of_footer(file::metadata(path)?.metadata())),
        }
    }
}

/// Returns all files, those in folders included, in the order of their names, without hidden files.
pub fn files_below(paths: &[PathBuf]) -> Result<Vec<PathBuf>, TableError> {
    let mut files = Vec::new();
    for path in paths {
        match path.is_dir() {
            true => files.extend(files_below(&file::entries(path)?)?),
            false => files.push(path.clone()),
        }
    }
    Ok(files)
}

/// Reads the beginning of a file as text.
pub fn head(path: &Path) -> Result<String, TableError> {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.map_err(|source| TableError::io(path, source))?;
    Ok(String::from_utf8_lossy(&head).into_owned())
}

/// Computes the key of an input: the one in the file if rockfrag wrote it, otherwise the hash of its bytes;
/// for a folder, the hash of the keys of its tables, or of all files if there is no table.
pub fn key_of(path: &Path) -> Result<String, TableError> {
    key_with(path, &HashMap::new())
}

/// Computes the same with the keys of files that are not made yet.
pub fn key_with(path: &Path, planned: &HashMap<PathBuf, String>) -> Result<String, TableError> {
    if let Some(key) = planned.get(path) {
        return Ok(key.clone());
    }
    if path.is_dir() {
        let mut files = files_below(&[path.to_path_buf()])?;
        let to_come = planned.keys().filter(|file| file.starts_with(path) && !file.exists());
        files.extend(to_come.cloned());
        files.sort_unstable();
        if files.iter().any(|file| is_table(file)) {
            files.retain(|file| is_table(file));
        }
        let keys = files.iter().map(|file| key_with(file, planned)).collect::<Result<Vec<_>, _>>()?;
        return Ok(blake3::hash(keys.join(" ").as_bytes()).to_hex().to_string());
    }
    if is_table(path)
        && let Ok(Some(made)) = Provenance::of_file(path)
    {
        return Ok(made.key());
    }
    let mut hasher = blake3::Hasher::new();
    let read = File::open(path).and_then(|file| hasher.update_reader(file).map(|_| ()));
    read.map_err(|source| TableError::io(path, source))?;
    Ok(hasher.finalize().to_hex().to_string())
}
