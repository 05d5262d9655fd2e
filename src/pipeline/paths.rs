//! What a stage reads, and the names of what it writes.
//!
//! Paths are no part of the options that enter a key: what is read enters by name and content ([`Read`]),
//! what is written does not enter.

use std::path::{Path, PathBuf};

use crate::table::file::Partition;

/// Words in place of a path, by option.
const WORDS: [(&str, &[&str]); 2] = [("structures", &["paper"]), ("site", &["rock", "soil", "none"])];

pub fn is_word(option: &str, text: &str) -> bool {
    WORDS.iter().any(|(of, words)| *of == option && words.contains(&text))
}

/// The files of a call.
pub struct Files {
    pub read: Vec<Read>,
    /// The last one is written last; none if the call only prints.
    pub written: Vec<PathBuf>,
    /// How the name of the last one may end.
    pub endings: &'static [&'static str],
}

impl Files {
    pub fn tables<P: AsRef<Path>>(
        read: impl IntoIterator<Item = Read>,
        written: impl IntoIterator<Item = P>,
    ) -> Files {
        let written = written.into_iter().map(|path| path.as_ref().to_path_buf()).collect();
        Files { read: read.into_iter().collect(), written, endings: &["parquet"] }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Read {
    pub flag: &'static str,
    pub paths: Vec<PathBuf>,
    /// Whether all files in a folder and below are read, not only the tables in it.
    pub whole_folders: bool,
    /// Whether files that are not there are left out.
    pub optional: bool,
}

impl Read {
    /// Reads what is no word in place of a path.
    pub fn new<P: AsRef<Path>>(flag: &'static str, paths: impl IntoIterator<Item = P>) -> Read {
        let mut paths: Vec<PathBuf> = paths.into_iter().map(|path| path.as_ref().to_path_buf()).collect();
        paths.retain(|path| !path.to_str().is_some_and(|text| is_word(flag, text)));
        Read { flag, paths, whole_folders: false, optional: false }
    }

    /// Reads a table or, of a folder, the one file of a partition, whatever comes and goes beside it.
    pub fn partition(flag: &'static str, input: &Path, partition: Option<Partition>) -> Read {
        let file = partition.filter(|_| input.is_dir()).and_then(|partition| partition.file_of(input).ok());
        Read::new(flag, [file.unwrap_or(input.to_path_buf())])
    }
}

/// Returns `out.NAME.parquet`, a further output beside `out.parquet`.
pub fn part(out: &Path, name: &str) -> PathBuf {
    out.with_extension(format!("{name}.parquet"))
}

/// Returns the file of a partition in the folder that stands for the whole.
pub fn out_of_partition(out: &Path, partition: Option<Partition>) -> PathBuf {
    match partition {
        Some(partition) => out.with_extension("").join(partition.file_name()),
        None => out.to_path_buf(),
    }
}
