//! What files and folders say of themselves: where they come from, what they hold, the ranges of their columns.

use std::path::{Path, PathBuf};

use parquet::arrow::ArrowWriter;

use super::fingerprint::Fingerprint;
use super::folder;
use super::footer::{Footer, of_file};
use super::partition::Partition;
use super::provenance::{Provenance, Recorded, recorded_in_file};
use super::source::{MemoryTable, Source};
use crate::table::TableError;

/// Reads only the end of a Parquet file, or of each in a folder.
///
/// # Errors
/// If it is missing or no Parquet file.
pub fn footer(path: &Path) -> Result<Footer, TableError> {
    let files = folder::files(path)?;
    let mut whole = of_file(&files[0])?;
    for file in &files[1..] {
        whole.add(of_file(file)?);
    }
    Ok(whole)
}

/// What a Parquet file records of how it was made, or `None` where another program wrote it. That of a folder is of what its files have in common:
/// no partition, the inputs of the first one, and the fingerprint of all.
///
/// # Errors
/// If the file is missing, not readable as Parquet, or of a later format than is known here, or the folder is incomplete.
pub fn recorded(path: &Path) -> Result<Option<Recorded>, TableError> {
    if !path.is_dir() {
        return recorded_in_file(path);
    }
    let all_recorded = folder::files(path)?
        .iter()
        .map(|file| recorded_in_file(file))
        .collect::<Result<Option<Vec<_>>, _>>()?;
    let Some(all_recorded) = all_recorded else { return Ok(None) };
    let mut provenance = all_recorded[0].provenance.clone();
    provenance.parameters = Partition::without(provenance.parameters);
    let content = hash_of_all(all_recorded.iter().map(|recorded| recorded.content.as_str()));
    Ok(Some(Recorded { cache_key: provenance.cache_key(), provenance, content }))
}

/// The fingerprint of what an input holds: as recorded by rockfrag, or the hash of its bytes if another program wrote
/// it. A table in memory with the columns of one of our files has that of the file.
///
/// # Errors
/// As [`recorded`], or if a file is unreadable, or a table holds what Parquet does not.
pub fn content_of(source: impl Into<Source>) -> Result<String, TableError> {
    match source.into() {
        Source::Path(path) => {
            let files = folder::files(&path)?;
            let contents = files.iter().map(|file| content_of_file(file)).collect::<Result<Vec<_>, _>>()?;
            if path.is_dir() {
                Ok(hash_of_all(contents.iter().map(String::as_str)))
            } else {
                Ok(contents.concat())
            }
        }
        Source::Memory(table) => content_of_table(&table),
    }
}

fn content_of_table(table: &MemoryTable) -> Result<String, TableError> {
    if table.schema.fields().iter().all(|field| Fingerprint::knows(field.data_type())) {
        let mut fingerprint = Fingerprint::new(table.schema.clone());
        table.batches.iter().for_each(|batch| fingerprint.update(batch));
        return Ok(fingerprint.finish());
    }
    let mut hasher = blake3::Hasher::new();
    let encode = |hasher: &mut blake3::Hasher| {
        let mut writer = ArrowWriter::try_new(hasher, table.schema.clone(), None)?;
        table.batches.iter().try_for_each(|batch| writer.write(batch))?;
        writer.close()
    };
    encode(&mut hasher)
        .map_err(|error| TableError::Read { path: table.name.clone(), message: error.to_string() })?;
    Ok(format!("bytes:{}", hasher.finalize().to_hex()))
}

fn hash_of_all<'a>(contents: impl Iterator<Item = &'a str>) -> String {
    let mut whole = blake3::Hasher::new();
    for content in contents {
        whole.update(content.as_bytes()).update(b"\n");
    }
    format!("folder:{}", whole.finalize().to_hex())
}

fn content_of_file(path: &Path) -> Result<String, TableError> {
    if let Some(recorded) = recorded_in_file(path)? {
        return Ok(recorded.content);
    }
    let mut hasher = blake3::Hasher::new();
    let file = std::fs::File::open(path).map_err(|source| TableError::io(path, source))?;
    hasher.update_reader(file).map_err(|source| TableError::io(path, source))?;
    Ok(format!("bytes:{}", hasher.finalize().to_hex()))
}

/// Checks that the inputs still hold what they held before they were read: rows of one file must not say that they come from
/// another.
///
/// # Errors
/// If an input has changed or gone.
pub fn expect_unchanged(provenance: &Provenance) -> Result<(), TableError> {
    let changed = |(role, path): &(&String, &PathBuf)| {
        content_of(path).ok().as_ref() != provenance.inputs.get(role.as_str())
    };
    match provenance.sources.iter().find(changed) {
        Some((_, path)) => Err(TableError::Changed { path: path.clone() }),
        None => Ok(()),
    }
}
