//! One call of a stage, and what it would make of which files.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::Stage;
use super::context::{Common, Plan};
use super::paths::Read;
use crate::table::TableError;
use crate::table::file::{self, is_table};
use crate::table::keys::{files_below, names_below, read_file, resolved};
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

impl Call {
    /// Plans the call. `planned` has the keys of files not yet written.
    pub fn plan(&self, planned: &Planned) -> Result<Plan, TableError> {
        let made = Provenance::new(&self.name, self.options.clone());
        let mut plan = Plan { made, outputs: self.stage.outputs() };
        for read in self.stage.inputs() {
            let files = read.files(&plan.outputs, planned)?;
            let inputs = plan.made.inputs.entry(read.flag.to_string()).or_default();
            for (path, name) in files.iter().zip(names_below(&files)) {
                inputs.push(match planned.get(&resolved(path)).cloned() {
                    // Another run may have replaced it already: its time says nothing.
                    Some(key) => InputFile { name, key, path: path.clone(), ..InputFile::default() },
                    None => read_file(path, name)?,
                });
            }
        }
        plan.made.inputs.retain(|_, files| !files.is_empty());
        Ok(plan)
    }
}

impl Read {
    /// Returns the files, without `outputs` and with the `planned` ones that are not there yet.
    fn files(&self, outputs: &[PathBuf], planned: &Planned) -> Result<Vec<PathBuf>, TableError> {
        let outputs: Vec<PathBuf> = outputs.iter().map(|path| resolved(path)).collect();
        let mut files = Vec::new();
        for path in &self.paths {
            let folder = path.canonicalize().unwrap_or(resolved(path));
            let mut below = match path.is_dir() {
                true if self.whole_folders => files_below(path)?,
                true => file::tables(path)?,
                false => Vec::new(),
            };
            let is_read =
                |file: &Path| self.whole_folders || is_table(file) && file.parent() == Some(&folder);
            let to_come = planned.keys().filter(|file| !file.exists() && **file != folder && is_read(file));
            // Written as those that are there, they come in the same order.
            below.extend(to_come.filter_map(|file| Some(path.join(file.strip_prefix(&folder).ok()?))));
            // What the stage itself wrote into the folder is not read.
            below.retain(|file| !outputs.contains(&resolved(file)));
            below.sort_unstable();
            let is_there = path.exists() || planned.contains_key(&resolved(path));
            match path.is_dir() || !below.is_empty() {
                true => files.append(&mut below),
                false if self.optional && !is_there => {}
                false => files.push(path.clone()),
            }
        }
        Ok(files)
    }
}
