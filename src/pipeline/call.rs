//! One call of a stage, as parsed by clap: its parameters, inputs and key.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use clap::{Arg, ArgMatches, Command, ValueHint};

use super::stage::Stage;
use crate::table::TableError;
use crate::table::file::Partition;
use crate::table::keys::key_with;
use crate::table::provenance::Provenance;

/// The files that are read from a folder of fits.
pub const FITS: [&str; 4] =
    ["pro.calibration.parquet", "pex.calibration.parquet", "pro.parquet", "pex.parquet"];

/// A call of a stage.
pub struct Call {
    pub name: String,
    pub stage: Box<dyn Stage>,
    /// Values of all options except files, defaults included, by flag.
    pub arguments: BTreeMap<String, Vec<String>>,
    /// Files and folders to read, or words in their place (a site name), by flag.
    pub inputs: BTreeMap<String, Vec<PathBuf>>,
}

/// Returns whether an argument is an input: a file, or a folder of fits.
pub fn is_input(arg: &Arg) -> bool {
    matches!(arg.get_value_hint(), ValueHint::FilePath | ValueHint::DirPath)
}

impl Call {
    /// Makes a call from the matches of a command.
    pub fn new(command: &Command, matches: &ArgMatches, stage: Box<dyn Stage>) -> Call {
        let mut arguments: BTreeMap<String, Vec<String>> = BTreeMap::new();
        let mut inputs: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
        for arg in
            command.get_arguments().filter(|arg| arg.get_help_heading() != Some(super::context::COMMON))
        {
            let id = arg.get_id().as_str();
            let flag = arg.get_long().unwrap_or(id).to_string();
            let Ok(Some(values)) = matches.try_get_raw(id) else { continue };
            let values: Vec<PathBuf> = values.map(PathBuf::from).collect();
            if arg.get_value_hint() == ValueHint::DirPath {
                inputs.insert(
                    flag,
                    values.iter().flat_map(|folder| FITS.map(|name| folder.join(name))).collect(),
                );
            } else if is_input(arg) {
                inputs.insert(flag, values);
            } else if flag != "out" {
                let text = |value: PathBuf| value.to_string_lossy().into_owned();
                arguments.insert(flag, values.into_iter().map(text).collect());
            }
        }
        // A partition reads one file of a folder, whatever comes and goes beside it.
        if let Some(partition) = arguments.get("partition").and_then(|values| values.first()?.parse().ok()) {
            let part = |path: &PathBuf| Partition::file_of(partition, path).ok().filter(|_| path.is_dir());
            inputs.values_mut().flatten().for_each(|path| *path = part(path).unwrap_or(path.clone()));
        }
        Call { name: command.get_name().to_string(), stage, arguments, inputs }
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
        Ok(Provenance {
            stage: self.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            arguments: self.arguments.clone(),
            inputs: inputs.collect::<Result<_, TableError>>()?,
            ..Provenance::default()
        })
    }
}
