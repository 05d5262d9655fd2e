//! Stages that share their work between processes: which part of a table is whose, and what its file is called.

use std::path::Path;

use serde_json::Value;

use crate::pipeline::UsageError;
use crate::pipeline::declare::Files;
use crate::table::store::folder;
use crate::table::store::partition::Partition;
use crate::table::store::source::{Source, Target};

/// The input of a stage that may work on a partition only.
pub struct PartitionedInput {
    pub source: Source,
    /// Which partition the output is, if any.
    pub partition: Option<Partition>,
    /// The part of the input that counts, if not all of it.
    pub rows: Option<Partition>,
    /// Of what table the input is a partition, if it is one.
    whole: Option<String>,
}

impl PartitionedInput {
    /// Finds partition `asked` of a table: of a folder its file of that number, of a file an equal share of its rows. What a
    /// file that is a partition itself becomes is the same partition.
    ///
    /// # Errors
    /// If the folder has no such partition, or the file is another one.
    pub fn new(source: Source, asked: Option<Partition>) -> anyhow::Result<PartitionedInput> {
        match (&source, asked) {
            (Source::Path(folder), Some(asked)) if folder.is_dir() => {
                let file = folder::partition(folder, asked)?;
                let whole = Some(folder::whole_of(&file)?);
                Ok(PartitionedInput { source: file.into(), partition: Some(asked), rows: None, whole })
            }
            (Source::Path(file), asked) if file.is_file() => match (of_file(file), asked) {
                (Some(own), Some(asked)) if own != asked => Err(UsageError::because(format!(
                    "{} is partition {own}; expected it without --partition {asked}",
                    file.display()
                ))),
                (Some(own), _) => {
                    let whole = Some(folder::whole_of(file)?);
                    Ok(PartitionedInput { source, partition: Some(own), rows: None, whole })
                }
                (None, asked) => Ok(PartitionedInput { source, partition: asked, rows: asked, whole: None }),
            },
            _ => Ok(PartitionedInput { source, partition: asked, rows: asked, whole: None }),
        }
    }

    /// Parameters of the stage with which partition this is, and of what.
    pub fn add_to(&self, parameters: Value) -> Value {
        let mut parameters = Partition::add_to(self.partition, parameters);
        if let Some(whole) = &self.whole {
            parameters[folder::WHOLE_INPUT] = whole.as_str().into();
        }
        parameters
    }
}

/// Which partition a file is; whoever reads it says what is wrong with one that does not tell.
fn of_file(file: &Path) -> Option<Partition> {
    folder::partition_of(file).unwrap_or_default()
}

/// The output of a stage that may work on a partition only: `file`, or where `--out` is a folder the file of the partition in
/// it. Where nobody says, a partition goes into a folder beside the input.
///
/// # Errors
/// If the output is asked for under the name of another kind of file.
pub fn out_of_partition(files: &Files, file: &str, partition: Option<Partition>) -> anyhow::Result<Target> {
    let (asked, out) = (files.asked(file).is_some(), files.out(file)?);
    let Some(path) = out.path() else { return Ok(out) };
    let path = if asked || partition.is_none() { path.to_path_buf() } else { path.with_extension("") };
    let own = partition.unwrap_or(Partition { index: 0, of: 1 }).file_name();
    if is_folder(&path) || partition.is_some() && path.extension().is_none() {
        return Ok(path.join(own).into());
    }
    if let Some(partition) = partition.filter(|_| path.file_name().is_none_or(|name| name != &*own)) {
        return Err(UsageError::because(format!(
            "out is {}; partition {partition} is a file in a folder: expected the name of the folder, such as {}",
            path.display(),
            path.with_extension("").display()
        )));
    }
    Ok(path.into())
}

/// Whether a path is a folder, or is written as one.
pub fn is_folder(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().to_string_lossy().ends_with('/')
}
