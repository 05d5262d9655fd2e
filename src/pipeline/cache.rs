//! Runs a call unless its files are up to date: the key in their footers equals the key of the call.

use std::path::Path;

use super::call::{Call, Planned};
use super::context::{Context, Plan};
use super::options::UsageError;
use crate::source::{is_pipe, split_sheet};
use crate::table::TableError;
use crate::table::marks::is_ours;
use crate::table::provenance::Provenance;
use crate::warning::Warnings;

#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    pub summary: String,
    pub warnings: Warnings,
    /// Whether the stage ran; otherwise its files were up to date.
    pub ran: bool,
    /// The keys of its files.
    pub keys: Planned,
}

/// Returns the provenance of the last file of a call if all are up to date, else the reason why not.
pub fn freshness(plan: &Plan) -> Result<Provenance, String> {
    let mut last = None;
    for (place, path) in plan.outputs.iter().enumerate() {
        let planned = plan.output(place);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match Provenance::read(path) {
            Ok(Some(made)) if made.key() == planned.key() => {
                if let Some(other) = made.further.iter().find_map(|further| changed(path, further)) {
                    return Err(format!("{other} is missing or changed"));
                }
                last = Some(made);
            }
            Ok(Some(made)) => {
                return Err(made.difference(&planned).unwrap_or(format!("{name} is another file")));
            }
            Ok(None) => return Err(format!("{name} does not say how it was made")),
            Err(TableError::Missing(_)) => return Err(format!("{name} is missing")),
            Err(_) => return Err(format!("{name} cannot be read")),
        }
    }
    last.ok_or_else(|| "it only prints".to_string())
}

/// Returns the name of a further file of the one at `path` that has not its hash.
pub fn changed<'a>(path: &Path, (name, hash): (&'a String, &String)) -> Option<&'a str> {
    let bytes = std::fs::read(path.with_file_name(name));
    let is_same = bytes.is_ok_and(|bytes| *blake3::hash(&bytes).to_hex() == **hash);
    (!is_same).then_some(name)
}

/// Runs a call unless its files are up to date. `made` has the keys of files that the same run made before:
/// its inputs must still be these.
pub fn run(call: &Call, context: &Context, made: &Planned) -> anyhow::Result<Done> {
    let plan = call.plan(made)?;
    let keys = plan.keys().collect();
    if !context.common.force
        && let Ok(made) = freshness(&plan)
    {
        return Ok(Done { summary: made.summary, warnings: made.warnings, ran: false, keys });
    }
    for path in &plan.outputs {
        expect_replaceable(path, &plan, context.common.force)?;
    }
    let context = context.begin(plan);
    // What is read while another run replaces it may fail in many ways.
    let summary = call.stage.run(&context).map_err(|error| match context.expect_unchanged() {
        Err(changed) => changed.into(),
        Ok(()) => error,
    })?;
    context.persist()?;
    Ok(Done { summary, warnings: context.warnings(), ran: true, keys })
}

/// Checks that an output is neither an input nor a pipe nor, unless forced, a table of another program. What
/// is no table is checked when it is written.
fn expect_replaceable(out: &Path, plan: &Plan, force: bool) -> anyhow::Result<()> {
    let Ok(real) = out.canonicalize() else { return Ok(()) };
    let mut read = plan.made.inputs.values().flatten().map(|file| split_sheet(&file.path).0);
    let is_read = read.any(|path| path.canonicalize().is_ok_and(|path| path == real));
    let problem = match () {
        _ if is_read => "is read and cannot be written too",
        _ if real.is_dir() => "is a folder; expected a file",
        _ if is_pipe(&real) => "is a pipe or device; expected a file",
        _ if !force && real.metadata()?.permissions().readonly() => "is read-only; --force replaces it",
        _ if force || is_text(&real) || is_ours(&real, &[]) => return Ok(()),
        _ => return Err(TableError::not_ours(out).into()),
    };
    Err(UsageError::because(format!("{}: {problem}", out.display())))
}

/// Returns whether files of this ending have no mark, but headings or keys.
fn is_text(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "csv" || ending == "json")
}
