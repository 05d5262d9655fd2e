//! A folder of Parquet files, which stands wherever one file may: its rows are those of its files, in the order of names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::partition::Partition;
use super::provenance::{Provenance, difference, recorded_in_file};
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
    expect_one_table(path, &files)?;
    Ok(files)
}

/// The parameter that stands for the whole table which the input of a partition is a partition of. Without it all partitions
/// read the same input.
pub const WHOLE_INPUT: &str = "whole-input";

/// What partitions of one table have in common: the fingerprint of all that they depend on but which partition they are.
///
/// # Errors
/// If the file is missing or unreadable.
pub fn whole_of(file: &Path) -> Result<String, TableError> {
    let whole = recorded_in_file(file)?.map(|recorded| {
        let Provenance { stage, parameters, inputs, .. } = recorded.provenance;
        let inputs = parameters.get(WHOLE_INPUT).is_none().then_some(inputs);
        serde_json::json!([stage, Partition::without(parameters), inputs])
    });
    let hash =
        |whole: serde_json::Value| blake3::hash(whole.to_string().as_bytes()).to_hex()[..16].to_string();
    Ok(whole.map_or("files of other programs".to_string(), hash))
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
/// If it is missing, or is another partition, or one of another number.
pub fn partition(folder: &Path, wanted: Partition) -> Result<PathBuf, TableError> {
    let file = folder.join(wanted.file_name());
    let of = match partition_of(&file)? {
        Some(there) if there.of == wanted.of && there != wanted => {
            return Err(unusable(folder, misnamed(&file, there)));
        }
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

/// That no partition is missing, none is there twice, and none is left over of another cut or made in another way. Files of
/// other programs do not say what they are.
fn expect_one_table(folder: &Path, files: &[PathBuf]) -> Result<(), TableError> {
    let recorded = files.iter().map(|file| recorded_in_file(file)).collect::<Result<Option<Vec<_>>, _>>()?;
    let Some(recorded) = recorded else { return Ok(()) };
    let made: Vec<&Provenance> = recorded.iter().map(|recorded| &recorded.provenance).collect();
    let partitions = made.iter().map(|made| Partition::among(&made.parameters)).collect::<Option<Vec<_>>>();
    let Some(partitions) = partitions else { return Ok(()) };
    let of = partitions[0].of;
    if let Some(at) = partitions.iter().position(|partition| partition.of != of) {
        let (file, other) = (files[at].display(), partitions[at].of);
        return Err(unusable(
            folder,
            format!("{file} is one of {other} partitions, others of {of}; remove the old ones"),
        ));
    }
    let mut seen: BTreeMap<u64, usize> = BTreeMap::new();
    for (at, partition) in partitions.iter().enumerate() {
        if let Some(other) = seen.insert(partition.index, at) {
            let is_copy = file_name(&files[at]) != partition.file_name();
            let (copy, other) = if is_copy { (at, other) } else { (other, at) };
            let (copy, other) = (file_name(&files[copy]), file_name(&files[other]));
            let problem =
                format!("{copy} is partition {partition}, as is {other}; expected it once: remove {copy}");
            return Err(unusable(folder, problem));
        }
    }
    match (0..of).zip(&partitions).find(|(index, partition)| *index != partition.index) {
        Some((index, _)) if !seen.contains_key(&index) => return Err(missing(folder, index, of)),
        Some((index, partition)) => {
            return Err(unusable(folder, misnamed(&files[index as usize], *partition)));
        }
        None if (partitions.len() as u64) < of => return Err(missing(folder, partitions.len() as u64, of)),
        None => {}
    }
    let others = || (1..made.len()).map(|at| (at, unlike(made[0], made[at], &file_name(&files[0]))));
    match others().find_map(|(at, unlike)| Some((at, unlike?))) {
        Some((at, unlike)) => {
            let (file, partition) = (file_name(&files[at]), partitions[at]);
            let way_out = format!("make it again with --partition {partition}, or the others");
            Err(unusable(folder, format!("{file} {unlike}; expected partitions of one table: {way_out}")))
        }
        None => Ok(()),
    }
}

/// How a partition was made otherwise than the first one, in words.
pub fn unlike(first: &Provenance, other: &Provenance, first_name: &str) -> Option<String> {
    let parameters = |made: &Provenance| Partition::without(made.parameters.clone());
    match difference(&parameters(first), &parameters(other)) {
        Some((name, ..)) if name == WHOLE_INPUT => {
            let roles: Vec<&str> = other.inputs.keys().map(String::as_str).collect();
            Some(format!("is made of other {} than {first_name}", roles.join(" and ")))
        }
        Some((name, there, here)) => Some(format!("has {name} {here}, but {first_name} has {there}")),
        None if first.parameters.get(WHOLE_INPUT).is_some() => None,
        None => {
            let is_other = |(role, content): &(&String, &String)| first.inputs.get(*role) != Some(*content);
            let (role, _) = other.inputs.iter().find(is_other)?;
            Some(format!("is made of other {role} than {first_name}"))
        }
    }
}

/// The name of a file without its folders.
pub fn file_name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// What a file is that has the name of another partition.
fn misnamed(file: &Path, partition: Partition) -> String {
    let (name, expected) = (file_name(file), partition.file_name());
    format!("{name} holds partition {partition}; expected that in {expected}: rename it, or make both again")
}

fn missing(folder: &Path, index: u64, of: u64) -> TableError {
    let partition = Partition { index, of };
    unusable(folder, format!("{} is missing; make it with --partition {partition}", partition.file_name()))
}

fn unusable(folder: &Path, problem: String) -> TableError {
    TableError::Folder { path: folder.to_path_buf(), problem }
}
