//! Whether a stage is up to date: the cache key recorded in its files equals that of what it would do.

use std::fs::{File, TryLockError};

use super::console::Console;
use super::replace;
use super::stage::{Stage, folder_of};
use super::terminal::Weight;
use crate::table::TableError;
use crate::table::store::folder::{file_name, partition_of};
use crate::table::store::partition::Partition;
use crate::table::store::provenance::{self, Provenance};
use crate::table::store::source::Source;

/// What a run may do that it does not do by itself.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct May {
    /// Run stages that are up to date.
    pub force: bool,
    /// Write over files that something else has written.
    pub overwrite: bool,
}

/// Whether a stage must run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Freshness {
    /// Its files hold what it would write.
    UpToDate,
    /// They do not; why.
    Stale(String),
}

/// Compares the files of a stage with what it would write.
pub fn freshness(stage: &dyn Stage, planned: &Provenance) -> Freshness {
    let outputs = stage.outputs();
    if outputs.is_empty() {
        return Freshness::Stale("it writes no file".to_string());
    }
    for path in outputs {
        match stage.recorded(&path) {
            Ok(Some(recorded)) if recorded.cache_key == planned.cache_key() => {}
            Ok(Some(recorded)) => return Freshness::Stale(difference(&recorded.provenance, planned)),
            Ok(None) => {
                return Freshness::Stale(format!("{} does not say how it was made", file_name(&path)));
            }
            Err(TableError::Missing { .. }) => {
                return Freshness::Stale(format!("{} is not there", file_name(&path)));
            }
            Err(_) => return Freshness::Stale(format!("{} cannot be read", file_name(&path))),
        }
    }
    Freshness::UpToDate
}

/// Runs a stage by itself unless it is up to date, and says which; of files that are, it tells the warnings again. It waits for a
/// run of a whole pipeline in its folder.
///
/// # Errors
/// Those of the stage.
pub fn run_alone(stage: &dyn Stage, may: May, console: &Console) -> anyhow::Result<()> {
    let _lock = lock_folder(stage, Access::Shared, console)?;
    for warning in warnings_if_fresh(stage, may, console)? {
        console.tell(&shortened(&warning));
    }
    Ok(())
}

/// The most letters of a warning that is told again.
const MOST_LETTERS: usize = 600;

fn shortened(warning: &str) -> String {
    match warning.char_indices().nth(MOST_LETTERS) {
        Some((end, _)) => format!("{}... (rockfrag inspect has all of it)", &warning[..end]),
        None => warning.to_string(),
    }
}

/// What else may happen in a folder while a run writes into it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Access {
    /// Nothing: the run reads again what it has written.
    Exclusive,
    /// Other runs whose files are whole by themselves.
    Shared,
}

/// Locks the folder of the files of a stage, which is made if need be, until what is returned is dropped. Waits for other runs
/// that may not write there meanwhile. A file system that knows no locks locks nothing.
///
/// # Errors
/// If the folder cannot be made.
pub fn lock_folder(stage: &dyn Stage, access: Access, console: &Console) -> anyhow::Result<Option<File>> {
    let outputs = stage.outputs();
    let Some(folder) = outputs.last().map(|path| folder_of(path)) else { return Ok(None) };
    std::fs::create_dir_all(folder).map_err(|source| TableError::io(folder, source))?;
    let Ok(file) = File::open(folder) else { return Ok(None) };
    let tried = match access {
        Access::Exclusive => file.try_lock(),
        Access::Shared => file.try_lock_shared(),
    };
    if let Err(TryLockError::WouldBlock) = tried {
        console.note(&format!("waiting for another run in {}", folder.display()));
        let waited = match access {
            Access::Exclusive => file.lock(),
            Access::Shared => file.lock_shared(),
        };
        return Ok(waited.is_ok().then_some(file));
    }
    Ok(Some(file))
}

/// Runs a stage unless it is up to date, and says which, and how many warnings its files have.
///
/// # Errors
/// Those of the stage.
pub fn run(stage: &dyn Stage, may: May, console: &Console) -> anyhow::Result<()> {
    let warnings = warnings_if_fresh(stage, may, console)?;
    if let (Some(first), Some(file)) = (warnings.first(), stage.outputs().pop()) {
        let count = warnings.len();
        match &console.expected {
            // Nobody needs to see them.
            Some(_) => warnings.iter().for_each(|warning| console.tell(warning)),
            None if count == 1 => console.tell(&shortened(first)),
            None => console.note(&format!("{count} warnings as before: rockfrag inspect {}", file.display())),
        }
    }
    Ok(())
}

/// Runs a stage unless it is up to date; then, the warnings of its files.
fn warnings_if_fresh(stage: &dyn Stage, may: May, console: &Console) -> anyhow::Result<Vec<String>> {
    let planned = stage.provenance()?;
    let partition = Partition::among(&planned.parameters);
    let name =
        &partition.map_or(stage.name().to_string(), |partition| format!("{} {partition}", stage.name()));
    replace::check(stage, &planned, may.overwrite)?;
    if !may.force && freshness(stage, &planned) == Freshness::UpToDate {
        console.stage(name, "up to date", Weight::Faint);
        let recorded = stage.outputs().last().map(|path| stage.recorded(path)).transpose()?.flatten();
        return Ok(recorded.map_or(Vec::new(), |recorded| recorded.provenance.warnings.all()));
    }
    for path in stage.outputs() {
        let folder = folder_of(&path);
        std::fs::create_dir_all(folder).map_err(|source| TableError::io(folder, source))?;
    }
    let start = std::time::Instant::now();
    // What this stage warns of stands in its files too.
    let console = &Console { warnings: planned.warnings.clone(), ..console.clone() };
    warn_of_partitions(stage, console);
    if let Some(warning) = replace::unlike_others(stage, &planned) {
        console.warn(&warning);
    }
    let summary = stage.execute(&planned, console)?;
    let took_s = start.elapsed().as_secs_f64();
    if !summary.is_empty() {
        console.stage(name, &format!("{summary} in {took_s:.2} s"), Weight::Plain);
    }
    Ok(Vec::new())
}

/// Says so where a stage that puts together all that it reads is given a partition.
pub fn warn_of_partitions(stage: &dyn Stage, console: &Console) {
    if Partition::among(&stage.parameters()).is_some() {
        return;
    }
    for (_, source) in stage.inputs() {
        if let Source::Path(path) = source
            && path.is_file()
            && let Ok(Some(partition)) = partition_of(&path)
            && partition.of > 1
        {
            let (path, folder) = (path.display(), folder_of(&path).display());
            console.warn(&format!(
                "{path} is partition {partition}, counted from 0; give the folder, {folder}, to read all"
            ));
        }
    }
}

/// The first thing in which two ways of making a file differ.
fn difference(before: &Provenance, now: &Provenance) -> String {
    if before.stage != now.stage {
        return format!("the file there is the output of {}", before.stage);
    }
    if before.version != now.version {
        return format!("made by version {}, this is {}", before.version, now.version);
    }
    if let Some((name, old, new)) = provenance::difference(&before.parameters, &now.parameters) {
        return format!("{name} changed from {old} to {new}");
    }
    let changed = now.inputs.iter().find(|(role, content)| before.inputs.get(*role) != Some(content));
    match changed {
        Some((role, _)) => format!("the {role} changed"),
        None => "its parameters changed".to_string(),
    }
}
