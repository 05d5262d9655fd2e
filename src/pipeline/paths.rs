//! What a path is to a stage: a type for each kind.
//!
//! Paths are no part of the options that enter a key: what is read enters by name and content ([`Read`]),
//! what is written does not enter.

use std::ffi::OsString;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::table::file::Partition;

/// A path below a folder, and as it is written.
#[derive(Deserialize)]
struct Located {
    folder: PathBuf,
    path: PathBuf,
    written: String,
}

impl Located {
    /// Returns the path; words in place of one, and `-`, are in no folder.
    fn resolved(self, words: &[&str]) -> PathBuf {
        let Located { folder, path, written } = self;
        match written == "-" || words.contains(&written.as_str()) {
            true => written.into(),
            false if path == Path::new("") => folder,
            false => folder.join(path),
        }
    }
}

/// Declares types of paths, with words in place of one.
macro_rules! path_types {
    ($($(#[$meaning:meta])* $type:ident: $words:expr;)*) => {$(
        $(#[$meaning])*
        #[derive(Debug, Clone, PartialEq, Eq)]
        pub struct $type(pub PathBuf);

        impl $type {
            /// The word in place of a path, if it is one.
            pub fn word(&self) -> Option<&str> {
                let words: &[&str] = &$words;
                self.0.to_str().filter(|text| words.contains(text))
            }
        }

        impl Deref for $type {
            type Target = Path;

            fn deref(&self) -> &Path {
                &self.0
            }
        }

        impl AsRef<Path> for $type {
            fn as_ref(&self) -> &Path {
                &self.0
            }
        }

        impl From<OsString> for $type {
            fn from(path: OsString) -> $type {
                $type(path.into())
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<$type, D::Error> {
                Ok($type(Located::deserialize(deserializer)?.resolved(&$words)))
            }
        }

        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                self.word().serialize(serializer)
            }
        }
    )*};
}

path_types! {
    /// A file to read, or a folder with the parts of a table.
    Input: [];
    /// A list of structures, or the paper's two.
    StructuresInput: ["paper"];
    /// The factors of a site, or a known site.
    SiteInput: ["rock", "soil", "none"];
    /// A file to write.
    Output: [];
}

/// Returns the paths of a list with commas, of which one may have a comma in its name if it is there.
pub fn split_list(folder: &Path, text: &str) -> Vec<String> {
    match folder.join(text).exists() {
        true => vec![text.to_string()],
        false => text.split(',').map(str::to_string).collect(),
    }
}

/// What a stage reads under a flag.
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
    pub fn new<P: AsRef<Path>>(flag: &'static str, paths: impl IntoIterator<Item = P>) -> Read {
        let paths = paths.into_iter().map(|path| path.as_ref().to_path_buf()).collect();
        Read { flag, paths, whole_folders: false, optional: false }
    }

    /// Reads a table or, of a folder, the one file of a partition, whatever comes and goes beside it.
    pub fn partition(flag: &'static str, input: &Input, partition: Option<Partition>) -> Read {
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
