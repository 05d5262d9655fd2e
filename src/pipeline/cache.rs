//! Runs a call unless its tables are up to date: the key in their footers equals the key of the call. What is
//! no table is a view, which is written each time.

use std::collections::HashSet;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use rockfrag_core::warning::Warnings;

use super::call::{Call, Planned};
use super::context::{Caller, Context, Plan};
use super::options::UsageError;
use crate::source::{is_pipe, split_sheet};
use crate::table::TableError;
use crate::table::provenance::Provenance;

#[derive(Debug, Clone, PartialEq)]
pub struct Done {
    pub summary: String,
    pub warnings: Warnings,
    /// Whether the stage ran; otherwise its files were up to date.
    pub ran: bool,
}

/// Returns the provenance of the last table of a call, with what it prints, if all are up to date, else the
/// reason why not.
pub fn freshness(call: &Call, plan: &Plan) -> Result<Provenance, String> {
    let mut last = None;
    for (place, path) in plan.outputs.iter().enumerate() {
        let planned = plan.output(place);
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if is_view(path) {
            return Err(format!("{name} is written each time"));
        }
        match Provenance::read(path) {
            Ok(Some(made)) if made.key() == planned.key() => last = Some(made),
            Ok(Some(made)) => {
                return Err(made.difference(&planned).unwrap_or(format!("{name} is another file")));
            }
            Ok(None) => return Err(format!("{name} does not say how it was made")),
            Err(TableError::Missing(_)) => return Err(format!("{name} is missing")),
            Err(_) => return Err(format!("{name} cannot be read")),
        }
    }
    let made = last.ok_or_else(|| "it only prints".to_string())?;
    match call.stage.printed(&made.summary) {
        Ok(Some(summary)) => Ok(Provenance { summary, ..made }),
        _ => Err("what it prints is not in its file".to_string()),
    }
}

/// Runs a call unless its files are up to date. `made` has the keys of files that the same run made before:
/// its inputs must still be these.
pub fn run(call: &Call, context: &Context, made: &mut Planned) -> anyhow::Result<Done> {
    let plan = call.plan(made)?;
    made.extend(plan.keys());
    if !context.common.force
        && let Ok(made) = freshness(call, &plan)
    {
        return Ok(Done { summary: made.summary, warnings: made.warnings, ran: false });
    }
    let context = context.begin(plan);
    expect_replaceable(&context.plan.outputs, &context)?;
    // What is read while another run replaces it may fail in many ways.
    let summary = call.stage.run(&context).map_err(|error| match context.expect_unchanged() {
        Err(changed) => changed.into(),
        Ok(()) => error,
    })?;
    // Something else may have come meanwhile.
    expect_replaceable(&context.written(), &context)?;
    context.persist()?;
    Ok(Done { summary, warnings: context.warnings(), ran: true })
}

/// Checks that none of these files is read, a folder, a pipe or a device nor, unless forced, read-only or of
/// another program.
pub fn expect_replaceable(outs: &[PathBuf], context: &Context) -> anyhow::Result<()> {
    let inputs = context.plan.made.inputs.values().flatten();
    let read: HashSet<PathBuf> =
        inputs.filter_map(|file| split_sheet(&file.path).0.canonicalize().ok()).collect();
    for out in outs {
        let Ok(real) = out.canonicalize() else { continue };
        let problem = match () {
            _ if read.contains(&real) => "is read and cannot be written too",
            _ if real.is_dir() => "is a folder; expected a file",
            _ if is_pipe(&real) => "is a pipe or device; expected a file",
            _ if context.common.force => continue,
            _ if real.metadata()?.permissions().readonly() => "is read-only; --force replaces it",
            _ if is_ours(out, context) => continue,
            _ => return Err(TableError::not_ours(out).into()),
        };
        return Err(UsageError::because(format!("{}: {problem}", out.display())));
    }
    Ok(())
}

/// Endings of views: of pages and figures, which name rockfrag, and of what has no place for a name.
const NAMED: [&str; 3] = ["html", "svg", "png"];
const UNNAMED: [&str; 4] = ["csv", "json", "xlsx", "xml"];

fn ends_in(path: &Path, endings: &[&str]) -> bool {
    path.extension().is_some_and(|ending| endings.iter().any(|one| ending == *one))
}

pub fn is_view(path: &Path) -> bool {
    ends_in(path, &NAMED) || ends_in(path, &UNNAMED)
}

fn is_ours(path: &Path, context: &Context) -> bool {
    match () {
        _ if ends_in(path, &NAMED) => names_rockfrag(path),
        // The numbers of a figure go with it, or with its page.
        _ if is_view(path) && !context.plan.outputs.contains(&path.to_path_buf()) => {
            names_rockfrag(&path.with_extension("svg"))
                || context.plan.outputs.iter().any(|out| names_rockfrag(out))
        }
        _ if is_view(path) => context.caller == Caller::Run,
        _ => Provenance::read(path).is_ok_and(|made| made.is_some()),
    }
}

/// How pages and figures, and pictures, name us.
const GENERATORS: [&[u8]; 2] = [b"name=\"generator\" content=\"rockfrag ", b"Software\0rockfrag "];
/// The most bytes before that.
const HEAD: u64 = 4096;

/// Whether the beginning of a page or figure says that rockfrag made it.
fn names_rockfrag(path: &Path) -> bool {
    let mut head = Vec::new();
    // A pipe would wait for its writer.
    let read = path.is_file().then(|| File::open(path)?.take(HEAD).read_to_end(&mut head));
    let names = |name: &&[u8]| head.windows(name.len()).any(|bytes| bytes == *name);
    read.is_some_and(|read| read.is_ok()) && GENERATORS.iter().any(names)
}
