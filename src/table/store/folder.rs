//! A folder of Parquet files, which stands wherever one file may: its rows are those of its files, in the order of names.

use std::path::{Path, PathBuf};

use super::partition::Partition;
use super::provenance::recorded_in_file;
use crate::table::TableError;

/// The Parquet files that a path stands for: itself, or those in the folder.
///
/// # Errors
/// If the folder cannot be read, holds none, or lacks some of the partitions that its files say there are.
pub fn files(path: &Path) -> Result<Vec<PathBuf>, TableError> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let files = parquet_files(path)?;
    if files.is_empty() {
        return Err(unusable(
            path,
            "a folder without Parquet files; expected part-00000.parquet and so on".to_string(),
        ));
    }
    expect_complete(path, &files)?;
    Ok(files)
}

/// Which partition a file says it is.
///
/// # Errors
/// If it is missing or unreadable.
pub fn partition_of(file: &Path) -> Result<Option<Partition>, TableError> {
    Ok(recorded_in_file(file)?.and_then(|recorded| Partition::among(&recorded.provenance.parameters)))
}

/// The file of a folder that is this partition, whether or not the others are there already.
///
/// # Errors
/// If it is missing, or is a partition of another number.
pub fn partition(folder: &Path, wanted: Partition) -> Result<PathBuf, TableError> {
    let file = folder.join(wanted.file_name());
    let of = match partition_of(&file)? {
        Some(Partition { of, .. }) => of,
        None => parquet_files(folder)?.len() as u64,
    };
    if of == wanted.of {
        return Ok(file);
    }
    Err(unusable(
        folder,
        format!("a folder of {of} partitions; expected {}, as in partition {wanted}", wanted.of),
    ))
}

/// The Parquet files in a folder, in the order of names, without hidden ones.
///
/// # Errors
/// If it cannot be read.
pub fn parquet_files(folder: &Path) -> Result<Vec<PathBuf>, TableError> {
    let entries = std::fs::read_dir(folder).map_err(|source| TableError::io(folder, source))?;
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(|source| TableError::io(folder, source))?.path();
        let hidden = path.file_name().is_none_or(|name| name.to_string_lossy().starts_with(['.', '_']));
        if !hidden && path.extension().is_some_and(|extension| extension == "parquet") {
            files.push(path);
        }
    }
    files.sort_unstable();
    Ok(files)
}

/// That no partition is missing, and none of another cut is left over. Files of other programs do not say what they are.
fn expect_complete(folder: &Path, files: &[PathBuf]) -> Result<(), TableError> {
    let partitions = files.iter().map(|file| partition_of(file)).collect::<Result<Option<Vec<_>>, _>>()?;
    let Some(partitions) = partitions else { return Ok(()) };
    let of = partitions[0].of;
    if let Some(at) = partitions.iter().position(|partition| partition.of != of) {
        let (file, other) = (files[at].display(), partitions[at].of);
        return Err(unusable(
            folder,
            format!("{file} is one of {other} partitions, others of {of}; remove the old ones"),
        ));
    }
    match (0..of).zip(&partitions).find(|(index, partition)| *index != partition.index) {
        Some((index, _)) => Err(missing(folder, index, of)),
        None if (partitions.len() as u64) < of => Err(missing(folder, partitions.len() as u64, of)),
        None => Ok(()),
    }
}

fn missing(folder: &Path, index: u64, of: u64) -> TableError {
    let partition = Partition { index, of };
    unusable(folder, format!("{} is missing; make it with --partition {partition}", partition.file_name()))
}

fn unusable(folder: &Path, problem: String) -> TableError {
    TableError::Folder { path: folder.to_path_buf(), problem }
}
