//! What a stage may write over: what it wrote itself, and nothing that it reads. All else is the user's.

use std::fs::{File, Metadata};
use std::io::Read;
use std::path::{Path, PathBuf};

use super::UsageError;
use super::stage::{Stage, folder_of};
use crate::table::TableError;
use crate::table::store::folder::{file_name, parquet_files, unlike};
use crate::table::store::partition::Partition;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::Source;

/// The owner of a file that says nothing of rockfrag.
pub const FOREIGN: &str = "a file that rockfrag did not make";

/// Of one that was cut off or damaged.
const UNREADABLE: &str = "not readable, and so nobody knows who made it";

/// The bytes at the start of a text by which a stage knows it for its own.
const HEAD: u64 = 2048;

/// What to do about a file in the way.
const WAY_OUT: &str = "name another with --out, or replace it with --overwrite";

/// Checks that no target of a stage is one of its inputs, nor, unless it is to `overwrite` them, a file that anything else has
/// written, or a partition of another cut.
///
/// # Errors
/// With the file that would be lost, and what it is.
pub fn check(stage: &dyn Stage, planned: &Provenance, overwrite: bool) -> anyhow::Result<()> {
    for target in stage.outputs() {
        let failed = |what: &str| Err(UsageError::because(format!("{}: {what}", target.display())));
        if let Some(role) = input_that_is(stage, &target) {
            let name = stage.name();
            return failed(&format!(
                "{name} reads it (the {role}); expected another file to write: --out FILE"
            ));
        }
        let Ok(there) = std::fs::metadata(&target) else { continue };
        if !there.is_file() {
            return failed("there is something that is not a file; name another with --out");
        }
        if !overwrite && let Some(owner) = other_owner(stage, &target, &there) {
            return Err(refusal(&target, &owner, stage.name()));
        }
    }
    if overwrite { Ok(()) } else { expect_same_cut(stage, planned) }
}

/// That a file is left as it is.
pub fn refusal(target: &Path, owner: &str, stage: &str) -> anyhow::Error {
    let path = target.display();
    UsageError::because(format!("{path}: {owner}; expected a new file, or one that {stage} made: {WAY_OUT}"))
}

/// The role of the input that a target is, or in whose folder of tables it would stand.
fn input_that_is(stage: &dyn Stage, target: &Path) -> Option<&'static str> {
    let (file, folder) = (identity(target), identity(folder_of(target)));
    let is_same = |other: &Path, own: &Option<_>| own.is_some() && identity(other) == *own;
    let is_table = target.extension().is_some_and(|extension| extension == "parquet");
    let is_target = |(_, source): &(&'static str, Source)| match source {
        Source::Path(path) if path.is_dir() => is_table && is_same(path, &folder),
        Source::Path(path) => is_same(path, &file),
        Source::Memory(_) => false,
    };
    stage.inputs().into_iter().find(is_target).map(|(role, _)| role)
}

/// Which file a path leads to, by whatever name, link or letter case.
#[cfg(unix)]
fn identity(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata(path).ok().map(|file| (file.dev(), file.ino()))
}

/// Which file a path leads to, by whatever name, symbolic link or letter case; hard links are not seen through.
#[cfg(not(unix))]
fn identity(path: &Path) -> Option<PathBuf> {
    path.canonicalize().ok()
}

/// Who wrote a file, in words, if it was not this stage. Of an empty one nothing can be lost.
fn other_owner(stage: &dyn Stage, target: &Path, there: &Metadata) -> Option<String> {
    if there.len() == 0 {
        return None;
    }
    match stage.recorded(target) {
        Ok(Some(recorded)) if recorded.provenance.stage == stage.name() => None,
        Ok(Some(recorded)) => Some(format!("made by {}", recorded.provenance.stage)),
        Err(TableError::NotParquet { .. }) => Some(UNREADABLE.to_string()),
        _ if head(target).is_some_and(|head| stage.is_own_text(&head)) => None,
        _ => Some(FOREIGN.to_string()),
    }
}

fn head(path: &Path) -> Option<String> {
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(HEAD).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// That a partition does not come among those of another cut, nor in the place of another one.
fn expect_same_cut(stage: &dyn Stage, planned: &Provenance) -> anyhow::Result<()> {
    let own = Partition::among(&planned.parameters);
    for target in stage.outputs() {
        for (file, made) in made_in_folder(stage, &target, own.is_some()) {
            let there = Partition::among(&made.parameters);
            let fits = if file == target { there == own } else { there.map(|p| p.of) == own.map(|p| p.of) };
            if !fits {
                let words = |partition: Option<Partition>| {
                    partition.map_or("the whole".to_string(), |partition| format!("partition {partition}"))
                };
                return Err(UsageError::because(format!(
                    "{}: {} is there, and this is {}; expected a folder of one cut: {WAY_OUT}",
                    file.display(),
                    words(there),
                    words(own)
                )));
            }
        }
    }
    Ok(())
}

/// Says in which way a partition is made otherwise than those in its folder, which then cannot be read as one table.
pub fn unlike_others(stage: &dyn Stage, planned: &Provenance) -> Option<String> {
    Partition::among(&planned.parameters)?;
    let of_target = |target: PathBuf| {
        let made = made_in_folder(stage, &target, true).into_iter().filter(|(file, _)| *file != target);
        let unlike = made.filter_map(|(file, made)| unlike(&made, planned, &file_name(&file))).next()?;
        Some(format!("{} {unlike}", target.display()))
    };
    let found = stage.outputs().into_iter().find_map(of_target)?;
    Some(format!("{found}; a folder is read only if all its partitions are made alike"))
}

/// How this stage made the target that is there, and, of a partition, the first and the last file in its folder. Those of a larger
/// cut come last; all would be many to open for each of many partitions.
fn made_in_folder(stage: &dyn Stage, target: &Path, is_partition: bool) -> Vec<(PathBuf, Provenance)> {
    let mut files = vec![target.to_path_buf()];
    if is_partition {
        let there = parquet_files(folder_of(target)).unwrap_or_default();
        let ends = there.first().into_iter().chain(there.last());
        files.extend(ends.filter(|file| file.file_name() != target.file_name()).cloned());
        files.dedup();
    }
    let made = |file: PathBuf| Some((stage.recorded(&file).ok()??.provenance, file));
    let made = files.into_iter().filter_map(made).filter(|(made, _)| made.stage == stage.name());
    made.map(|(made, file)| (file, made)).collect()
}
