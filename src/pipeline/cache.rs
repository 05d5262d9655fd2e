//! Whether a stage is up to date: the plan recorded in its files equals the plan of what it would do.

use std::path::Path;

use serde_json::Value;

use super::claim::{Claim, Claimed, claim};
use super::console::Console;
use super::stage::{Stage, folder_of};
use super::terminal::Weight;
use crate::table::TableError;
use crate::table::provenance::Provenance;

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
    for path in stage.outputs() {
        match stage.recorded(&path) {
            Ok(Some(stamp)) if stamp.plan == planned.plan() => {}
            Ok(Some(stamp)) => return Freshness::Stale(difference(&stamp.provenance, planned)),
            Ok(None) => return Freshness::Stale(format!("{} was not made by rockfrag", path.display())),
            Err(TableError::Missing { .. }) => {
                return Freshness::Stale(format!("{} is not there", file_name(&path)));
            }
            Err(_) => return Freshness::Stale(format!("{} cannot be read", file_name(&path))),
        }
    }
    Freshness::UpToDate
}

/// Runs a stage by itself unless it is up to date, and says which. It waits for a run of a whole pipeline in its folder.
///
/// # Errors
/// Those of the stage.
pub fn run_alone(stage: &dyn Stage, force: bool, console: &Console) -> anyhow::Result<()> {
    let _claimed = claim_folder(stage, Claim::Shared, console)?;
    run(stage, force, console)
}

/// Claims the folder of the files of a stage, which is made if need be.
///
/// # Errors
/// If it cannot be made.
pub fn claim_folder(stage: &dyn Stage, kind: Claim, console: &Console) -> anyhow::Result<Option<Claimed>> {
    let outputs = stage.outputs();
    let Some(folder) = outputs.last().map(|path| folder_of(path)) else { return Ok(None) };
    std::fs::create_dir_all(folder).map_err(|source| TableError::io(folder, source))?;
    Ok(Some(claim(folder, kind, console)))
}

/// Runs a stage unless it is up to date, and says which.
///
/// # Errors
/// Those of the stage.
pub fn run(stage: &dyn Stage, force: bool, console: &Console) -> anyhow::Result<()> {
    let planned = stage.provenance()?;
    let name = stage.subcommand();
    if !force && freshness(stage, &planned) == Freshness::UpToDate {
        console.stage(name, "up to date", Weight::Faint);
        return Ok(());
    }
    for path in stage.outputs() {
        let folder = folder_of(&path);
        std::fs::create_dir_all(folder).map_err(|source| TableError::io(folder, source))?;
    }
    let start = std::time::Instant::now();
    let summary = stage.execute(&planned, console)?;
    let took_s = start.elapsed().as_secs_f64();
    console.stage(name, &format!("{summary} in {took_s:.2} s"), Weight::Plain);
    Ok(())
}

/// The first thing in which two ways of making a file differ.
fn difference(before: &Provenance, now: &Provenance) -> String {
    if before.stage != now.stage {
        return format!("the file there is the output of {}", before.stage);
    }
    if before.version != now.version {
        return format!("made by version {}, this is {}", before.version, now.version);
    }
    if let (Value::Object(old), Value::Object(new)) = (&before.parameters, &now.parameters)
        && let Some((name, value)) = new.iter().find(|(name, value)| old.get(*name) != Some(value))
    {
        let old = old.get(name).map_or("nothing".to_string(), short);
        return format!("{name} changed from {old} to {}", short(value));
    }
    let changed = now.inputs.iter().find(|(role, content)| before.inputs.get(*role) != Some(content));
    match changed {
        Some((role, _)) => format!("the {role} changed"),
        None => "its parameters changed".to_string(),
    }
}

fn short(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 60 { format!("{}...", text.chars().take(57).collect::<String>()) } else { text }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
