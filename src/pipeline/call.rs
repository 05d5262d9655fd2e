//! One call of a stage, as clap has parsed it: its parameters, inputs and key.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use clap::{Arg, ArgMatches, Command, ValueHint};

use super::stage::Stage;
use crate::table::TableError;
use crate::table::provenance::{Provenance, key_of};

/// What is read of a folder of fits.
pub const FITS: [&str; 4] =
    ["pro.calibration.parquet", "pex.calibration.parquet", "pro.parquet", "pex.parquet"];

/// A call.
pub struct Call {
    pub name: String,
    pub stage: Box<dyn Stage>,
    /// The resolved values of all options but files, by their flags.
    pub arguments: BTreeMap<String, Vec<String>>,
    /// The files and folders that it reads, or words that stand for some (the name of a site), by their flags.
    pub inputs: BTreeMap<String, Vec<PathBuf>>,
}

/// Whether an argument names something that a stage reads: a file, or a folder of fits.
pub fn is_input(arg: &Arg) -> bool {
    matches!(arg.get_value_hint(), ValueHint::FilePath | ValueHint::DirPath)
}

impl Call {
    /// Takes apart what clap has parsed of this command.
    pub fn new(command: &Command, matches: &ArgMatches, stage: Box<dyn Stage>) -> Call {
        let (mut arguments, mut inputs) = (BTreeMap::new(), BTreeMap::new());
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
        Call { name: command.get_name().to_string(), stage, arguments, inputs }
    }

    /// What its files will say of how they were made. `planned` has the keys of files that are yet to be made.
    pub fn provenance(&self, planned: &HashMap<PathBuf, String>) -> Result<Provenance, TableError> {
        let is_word = |path: &Path| path.extension().is_none() && !path.exists();
        let key = |path: &Path| match planned.get(path) {
            Some(key) => Ok(key.clone()),
            None if is_word(path) => Ok(path.display().to_string()),
            None => key_of(path),
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
