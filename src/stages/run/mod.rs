//! run: all stages of pipeline.yaml in order, skipping what is up to date.

pub mod findings;

use std::fmt::Write;
use std::path::PathBuf;

use crate::pipeline::cache::{self, Access, Freshness, May, freshness};
use crate::pipeline::console::Console;
use crate::pipeline::replace;
use crate::pipeline::stage::Stage;

/// Runs the stages in order, after other runs in the same folder.
///
/// # Errors
/// That of the first stage that fails.
pub fn run(stages: &[Box<dyn Stage>], may: May, console: &Console) -> anyhow::Result<()> {
    let _lock = match stages.first() {
        Some(stage) => cache::lock_folder(stage.as_ref(), Access::Exclusive, console)?,
        None => None,
    };
    stages.iter().try_for_each(|stage| cache::run(stage.as_ref(), may, console))
}

/// What a run would do and why, without doing it.
///
/// # Errors
/// If an input that no stage makes is missing.
pub fn dry_run(stages: &[Box<dyn Stage>], may: May) -> anyhow::Result<String> {
    let mut text = String::new();
    let mut anew: Vec<PathBuf> = Vec::new();
    for stage in stages {
        let waits =
            stage.inputs().into_iter().find(|(_, source)| anew.iter().any(|path| path == source.name()));
        let state = match waits {
            Some((role, _)) => Freshness::Stale(format!("the {role} will be made again")),
            None if may.force => Freshness::Stale("--force".to_string()),
            None => freshness(stage.as_ref(), &stage.provenance()?),
        };
        let refused = match waits {
            Some(_) => None,
            None => replace::check(stage.as_ref(), &stage.provenance()?, may.overwrite).err(),
        };
        let verdict = match (&state, refused) {
            (_, Some(reason)) => format!("would be refused: {reason}"),
            (Freshness::UpToDate, None) => "up to date".to_string(),
            (Freshness::Stale(reason), None) => format!("would run: {reason}"),
        };
        writeln!(text, "{:20} {verdict}", stage.name())?;
        if let serde_json::Value::Object(parameters) = stage.parameters() {
            for (name, value) in parameters {
                writeln!(text, "    {name}: {value}")?;
            }
        }
        for path in stage.outputs() {
            writeln!(text, "    -> {}", path.display())?;
        }
        if state != Freshness::UpToDate {
            anew.extend(stage.outputs());
        }
    }
    Ok(text)
}
