//! Runs a call unless its files are up to date: the key in their footers equals the key of the call.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use super::UsageError;
use super::call::Call;
use super::context::Context;
use crate::table::TableError;
use crate::table::file::is_table;
use crate::table::keys::head;
use crate::table::provenance::Provenance;
use crate::warning::Warnings;

#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    pub summary: String,
    pub warnings: Warnings,
    /// Whether the stage ran; otherwise its files were up to date.
    pub ran: bool,
    /// The key of its files.
    pub key: String,
}

/// Returns the provenance of the files of a call if they are up to date, else the reason why not.
pub fn freshness(call: &Call, planned: &Provenance) -> Result<Provenance, String> {
    let mut last = None;
    for path in call.stage.outputs() {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        match Provenance::of_file(&path) {
            Ok(Some(made)) if made.key() == planned.key() => last = Some(made),
            Ok(Some(made)) => return Err(made.difference(planned).unwrap_or_default()),
            Ok(None) => return Err(format!("{name} does not say how it was made")),
            Err(TableError::Missing(_)) => return Err(format!("{name} is missing")),
            Err(_) => return Err(format!("{name} cannot be read")),
        }
    }
    last.ok_or_else(|| "it only prints".to_string())
}

/// Runs a call unless its files are up to date. `made` has the keys of files that the same run made before:
/// its inputs must still be these.
pub fn run(call: &Call, context: &Context, made: &HashMap<PathBuf, String>) -> anyhow::Result<Done> {
    let planned = call.provenance(made)?;
    let key = planned.key();
    if !context.common.force
        && let Ok(made) = freshness(call, &planned)
    {
        return Ok(Done { summary: made.summary, warnings: made.warnings, ran: false, key });
    }
    for path in call.stage.outputs() {
        expect_replaceable(&path, call, context.common.force)?;
    }
    let context = context.of_call(call.inputs.values().flatten(), planned);
    let summary = call.stage.run(&context)?;
    Ok(Done { summary, warnings: context.warnings(), ran: true, key })
}

/// Checks that an output is not an input, nor, unless forced, a file of another program.
fn expect_replaceable(out: &Path, call: &Call, force: bool) -> anyhow::Result<()> {
    let Ok(real) = out.canonicalize() else { return Ok(()) };
    let is_out = |path: &PathBuf| path.canonicalize().is_ok_and(|path| path == real);
    if call.inputs.values().flatten().any(is_out) {
        return Err(UsageError::because(format!("{}: is read and cannot be written too", out.display())));
    }
    if real.is_dir() {
        return Err(UsageError::because(format!("{}: is a folder; expected a file", out.display())));
    }
    if !force && !is_ours(&real) {
        let out = out.display();
        anyhow::bail!("{out}: not written by rockfrag, or damaged; --force replaces it");
    }
    Ok(())
}

/// Returns whether rockfrag wrote a file, by the footer of a table or the first bytes of a text.
pub fn is_ours(path: &Path) -> bool {
    let is_marked =
        ["html", "svg", "png", "xlsx"].iter().any(|ending| path.extension().is_some_and(|of| of == *ending));
    if is_table(path) || is_marked {
        return Provenance::of_file(path).is_ok_and(|made| made.is_some());
    }
    // Tables of evaluate as CSV or JSON need not name the model, but have columns that only rockfrag writes.
    let own = ["rockfrag", "p_nr", "p_overturning"];
    head(path).is_ok_and(|head| own.iter().any(|word| head.contains(word)))
}
