//! Stages that share their work between processes: which part of a table is whose, and what its file is called.

use std::path::{Path, PathBuf};

use super::simulate::{Simulate, SimulateOptions};
use crate::pipeline::UsageError;
use crate::pipeline::options::Parsed;
use crate::pipeline::stage::beside;
use crate::table::folder;
use crate::table::partition::Partition;
use crate::table::source::Source;

/// The motions of a partition.
pub struct Share {
    /// Where they are.
    pub input: Source,
    /// Which partition the output is, if any.
    pub partition: Option<Partition>,
    /// The part of the input that counts, if not all of it.
    pub rows: Option<Partition>,
}

impl Share {
    /// That of partition `asked` of a table: of a folder its file of that number, of a file an equal share of its rows. What a
    /// file that is a partition itself becomes is the same partition.
    ///
    /// # Errors
    /// If the folder has no such partition, or the file is another one.
    pub fn of(input: Source, asked: Option<Partition>) -> anyhow::Result<Share> {
        match (&input, asked) {
            (Source::Path(folder), Some(asked)) if folder.is_dir() => {
                let input = folder::partition(folder, asked)?.into();
                Ok(Share { input, partition: Some(asked), rows: None })
            }
            (Source::Path(file), asked) if file.is_file() => match (folder::partition_of(file)?, asked) {
                (Some(own), Some(asked)) if own != asked => Err(UsageError::because(format!(
                    "{} is partition {own}; expected it without --partition {asked}",
                    file.display()
                ))),
                (Some(own), _) => Ok(Share { input, partition: Some(own), rows: None }),
                (None, asked) => Ok(Share { input, partition: asked, rows: asked }),
            },
            _ => Ok(Share { input, partition: asked, rows: asked }),
        }
    }
}

/// The file that a stage writes: `out`, or in the folder `out` the file of its partition. Without `out` it is `name` beside the
/// input, a folder if there is a partition.
pub fn file_of(out: Option<&Path>, input: &Path, name: &str, partition: Option<Partition>) -> PathBuf {
    let out = match (out, partition) {
        (Some(out), _) => out.to_path_buf(),
        (None, Some(_)) => beside(input, name),
        (None, None) => beside(input, &format!("{name}.parquet")),
    };
    let in_folder = is_folder(&out) || partition.is_some() && out.extension().is_none();
    let whole = Partition { index: 0, of: 1 };
    if in_folder { out.join(partition.unwrap_or(whole).file_name()) } else { out }
}

/// simulate, from a folder into a folder: a stage for each file. None where either is a file.
///
/// # Errors
/// If the folder is incomplete, or as [`Simulate::new`].
pub fn each_file(
    options: &SimulateOptions,
    input: &Path,
    out: Option<&Path>,
) -> anyhow::Result<Option<Vec<Simulate>>> {
    let Some(out) = out.filter(|out| is_folder(out) || out.extension().is_none()) else { return Ok(None) };
    if !input.is_dir() || options.partition.is_some() {
        return Ok(None);
    }
    if options.trace.is_some() {
        return Err(UsageError::because("trace needs one file; name it with --in or --out"));
    }
    let stage = |file: &PathBuf| {
        let partition = folder::partition_of(file)?.map(Parsed);
        let options = SimulateOptions { partition, ..options.clone() };
        Simulate::new(&options, file, out.join(file.file_name().unwrap_or_default()))
    };
    folder::files(input)?.iter().map(stage).collect::<anyhow::Result<_>>().map(Some)
}

/// Whether a path is a folder, or is written as one.
fn is_folder(path: &Path) -> bool {
    path.is_dir() || path.as_os_str().to_string_lossy().ends_with('/')
}
