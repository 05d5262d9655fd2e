//! One call of a stage, as parsed by clap: its parameters, inputs and key.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Command, FromArgMatches};

use super::Stage;
use super::context::{COMMON, Common};
use super::files::{Role, files_of, role};
use crate::table::TableError;
use crate::table::file::Partition;
use crate::table::keys::key_with;
use crate::table::provenance::Provenance;

/// Files of an input that are named in what is made of it.
const MOST_NAMED: usize = 4;

pub struct Call {
    pub name: String,
    pub stage: Box<dyn Stage>,
    pub common: Common,
    /// Values of all options except files, defaults included, by flag.
    pub arguments: BTreeMap<String, Vec<String>>,
    /// Files and folders to read, or words in their place (a site name), by flag.
    pub inputs: BTreeMap<String, Vec<PathBuf>>,
}

impl Call {
    pub fn new(command: &Command, matches: &ArgMatches, stage: Box<dyn Stage>) -> anyhow::Result<Call> {
        let mut arguments: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut inputs: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
        for arg in command.get_arguments() {
            let id = arg.get_id().as_str();
            let flag = arg.get_long().unwrap_or(id).to_string();
            let Ok(Some(values)) = matches.try_get_raw(id) else { continue };
            let values = values.map(PathBuf::from);
            match role(arg) {
                Role::Output => {}
                Role::Parameter if arg.get_help_heading() == Some(COMMON) => {}
                Role::Parameter => {
                    let texts = values.map(|value| value.to_string_lossy().into_owned());
                    arguments.insert(flag, texts.collect());
                }
                role => {
                    inputs.insert(flag, values.flat_map(|path| files_of(role, path)).collect());
                }
            }
        }
        // A partition reads one file of a folder, whatever comes and goes beside it.
        if let Some(partition) = arguments.get("partition").and_then(|values| values.first()?.parse().ok()) {
            let part = |path: &PathBuf| Partition::file_of(partition, path).ok().filter(|_| path.is_dir());
            inputs.values_mut().flatten().for_each(|path| *path = part(path).unwrap_or(path.clone()));
        }
        let (name, common) = (command.get_name().to_string(), Common::from_arg_matches(matches)?);
        Ok(Call { name, stage, common, arguments, inputs })
    }

    /// Returns the provenance of its files. `planned` has the keys of files not yet written.
    pub fn provenance(&self, planned: &HashMap<PathBuf, String>) -> Result<Provenance, TableError> {
        let is_word = |path: &Path| path.extension().is_none() && !path.exists();
        let key = |path: &Path| match planned.get(path) {
            None if is_word(path) => Ok(path.display().to_string()),
            _ => key_with(path, planned),
        };
        let inputs = self.inputs.iter().map(|(flag, paths)| {
            let keys = paths.iter().map(|path| key(path)).collect::<Result<Vec<_>, _>>()?;
            Ok((flag.clone(), keys.join(" ")))
        });
        let name = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let names =
            |paths: &Vec<PathBuf>| paths.iter().take(MOST_NAMED).map(name).collect::<Vec<_>>().join(", ");
        Ok(Provenance {
            files: self.inputs.iter().map(|(flag, paths)| (flag.clone(), names(paths))).collect(),
            stage: self.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            arguments: self.arguments.clone(),
            inputs: inputs.collect::<Result<_, TableError>>()?,
            ..Provenance::default()
        })
    }
}
