//! One call of a stage. It runs unless its tables are up to date: the key in their footers equals the key of
//! the call. What is no table is a view, which is written each time.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::Stage;
use super::context::{Common, Context};
use super::options::UsageError;
use super::paths::{Files, Read};
use crate::source::{is_pipe, split_sheet};
use crate::table::TableError;
use crate::table::file::tables;
use crate::table::frame::Format;
use crate::table::keys::{files_below, key_of_file, names_below, resolved};
use crate::table::provenance::{InputFile, Provenance};

/// Keys of files that other calls of a run make, by [`resolved`] path.
pub type Planned = HashMap<PathBuf, String>;

pub struct Call {
    pub name: String,
    pub stage: Box<dyn Stage>,
    pub common: Common,
    /// All options of the stage but files, by flag.
    pub options: BTreeMap<String, Value>,
}

#[derive(Debug, Clone, Default)]
pub struct Plan {
    pub made: Provenance,
    pub outputs: Vec<PathBuf>,
}

#[derive(Debug, Clone)]
pub struct Done {
    /// With what it prints, its warnings, and how files of people were read.
    pub made: Provenance,
    /// Whether the stage ran; otherwise its files were up to date.
    pub ran: bool,
}

impl Plan {
    pub fn output(&self, output: usize) -> Provenance {
        Provenance { output, ..self.made.clone() }
    }

    pub fn keys(&self) -> impl Iterator<Item = (PathBuf, String)> + '_ {
        let outputs = self.outputs.iter().enumerate();
        outputs.map(|(place, path)| (resolved(path), self.output(place).key_of_content()))
    }

    /// Checks that none of these files is read, a folder, a pipe or a device nor, unless forced, read-only or
    /// of another program.
    pub fn expect_replaceable(&self, outs: &[PathBuf], common: &Common) -> anyhow::Result<()> {
        let inputs = self.made.inputs.values().flatten();
        let read: HashSet<PathBuf> =
            inputs.filter_map(|file| split_sheet(&file.path).0.canonicalize().ok()).collect();
        for out in outs {
            // A pipe may have no other name.
            let real = out.canonicalize().unwrap_or(out.clone());
            let problem = match () {
                _ if read.contains(&real) => "is read and cannot be written too",
                _ if real.is_dir() => "is a folder; expected a file",
                _ if is_pipe(&real) => "is a pipe or device; expected a file",
                _ if common.force || !out.exists() => continue,
                _ if real.metadata()?.permissions().readonly() => "is read-only; --force replaces it",
                _ if self.is_ours(out, common.is_run) => continue,
                _ => {
                    let problem = "is there already, not known as rockfrag's; --force replaces it";
                    return Err(TableError::table(out, problem).into());
                }
            };
            return Err(UsageError::because(format!("{}: {problem}", out.display())));
        }
        Ok(())
    }

    fn is_ours(&self, path: &Path, is_run: bool) -> bool {
        let is_ending = |ending: &&str| path.extension() == Some(ending.as_ref());
        match self.outputs.iter().any(|out| out == path) {
            _ if ["html", "svg", "png"].iter().any(is_ending) => names_rockfrag(path),
            _ if !is_view(path) => Provenance::read(path).is_ok_and(|made| made.is_some()),
            true => is_run,
            // The numbers of a figure go with it, or with its page.
            false => [path.with_extension("svg")].iter().chain(&self.outputs).any(|of| names_rockfrag(of)),
        }
    }
}

impl Call {
    /// Plans the call. `planned` has the keys of files not yet written.
    pub fn plan(&self, planned: &Planned) -> Result<Plan, TableError> {
        let made = Provenance::new(&self.name, self.options.clone());
        let Files { read, written, .. } = self.stage.files();
        let mut plan = Plan { made, outputs: written };
        for read in read {
            let files = files(&read, &plan.outputs, planned)?;
            let inputs = files.iter().zip(names_below(&files)).map(|(path, name)| {
                let key = planned.get(&resolved(path)).cloned().map_or_else(|| key_of_file(path), Ok)?;
                Ok(InputFile { name, key, path: path.clone() })
            });
            if !files.is_empty() {
                plan.made.inputs.insert(read.flag.to_string(), inputs.collect::<Result<_, TableError>>()?);
            }
        }
        Ok(plan)
    }

    /// Returns what the call prints, if all its tables are up to date, else the reason why not.
    pub fn freshness(&self, plan: &Plan) -> Result<Done, String> {
        let mut last = Err("it only prints".to_string());
        for (place, path) in plan.outputs.iter().enumerate() {
            let refuse = |why| Err(format!("{} {why}", path.file_name().unwrap_or_default().display()));
            let planned = plan.output(place);
            last = match Provenance::read(path) {
                _ if is_view(path) => return refuse("is written each time"),
                Ok(Some(made)) if made.key() == planned.key() => Ok(made),
                Ok(Some(made)) => return made.difference(&planned).map_or(refuse("is another file"), Err),
                Err(TableError::Missing(_)) => return refuse("is missing"),
                _ => return refuse("does not say how it was made"),
            };
        }
        let made = last?;
        match self.stage.format() {
            Format::Text => Ok(Done { made, ran: false }),
            _ => Err("what it prints is not in its file".to_string()),
        }
    }

    /// Runs the call unless its files are up to date. `made` has the keys of files that the same run made
    /// before: its inputs must still be these.
    pub fn run(&self, common: &Common, made: &mut Planned) -> anyhow::Result<Done> {
        let plan = self.plan(made)?;
        made.extend(plan.keys());
        if !common.force
            && let Ok(done) = self.freshness(&plan)
        {
            return Ok(done);
        }
        let context = Context::new(common, plan);
        context.plan.expect_replaceable(&context.plan.outputs, common)?;
        // What is read while another run replaces it may fail in many ways.
        let summary = self.stage.run(&context).map_err(|error| match context.expect_unchanged() {
            Err(changed) => changed.into(),
            Ok(()) => error,
        })?;
        context.persist()?;
        Ok(Done { made: context.made(&summary), ran: true })
    }
}

/// Returns the files that are read, also the `planned` ones.
fn files(read: &Read, outputs: &[PathBuf], planned: &Planned) -> Result<Vec<PathBuf>, TableError> {
    let outputs: Vec<PathBuf> = outputs.iter().map(|path| resolved(path)).collect();
    let mut files = Vec::new();
    for path in &read.paths {
        let whole = resolved(path);
        let is_folder_to_come = || planned.keys().any(|file| *file != whole && file.starts_with(&whole));
        if path.is_dir() {
            let mut below = if read.whole_folders { files_below(path)? } else { tables(path)? };
            // What the stage itself wrote into the folder is not read.
            below.retain(|file| !outputs.contains(&resolved(file)));
            files.append(&mut below);
        } else if path.exists() || planned.contains_key(&whole) || !(read.optional || is_folder_to_come()) {
            files.push(path.clone());
        }
    }
    Ok(files)
}

pub fn is_view(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending != "parquet")
}

/// How pages and figures, and pictures, name us.
const GENERATORS: [&str; 2] = ["name=\"generator\" content=\"rockfrag ", "Software\0rockfrag "];

/// Whether the beginning of a page or figure says that rockfrag made it.
fn names_rockfrag(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head));
    let head = String::from_utf8_lossy(&head);
    read.is_ok() && GENERATORS.iter().any(|name| head.contains(name))
}
