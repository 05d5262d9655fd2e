//! What a path is to a stage: a type for each kind, which clap parses.
//!
//! Paths are no part of the options that enter a key: what is read enters by name and content ([`Read`]),
//! what is written does not enter.

use std::any::TypeId;
use std::ffi::OsString;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::Arg;
use clap::builder::{OsStringValueParser, TypedValueParser, ValueParser, ValueParserFactory};
use serde::{Serialize, Serializer};

use crate::table::file::Partition;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Input,
    Folder,
    Output,
}

/// A kind of paths: how the names of its files may end (any way if empty), and words in place of a path.
#[derive(Debug, Clone, Copy)]
pub struct PathKind {
    pub role: Role,
    pub formats: &'static [&'static str],
    pub words: &'static [&'static str],
}

impl PathKind {
    /// Checks the ending of a file to write; what others wrote is known by its content.
    fn checked(self, text: OsString) -> Result<PathBuf, String> {
        let path = PathBuf::from(text);
        let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        if self.role != Role::Output || ending.is_empty() || self.formats.contains(&&*ending) {
            return Ok(path);
        }
        Err(format!("expected a name that ends in .{}", self.formats.join(", .")))
    }
}

macro_rules! path_types {
    ($($(#[$meaning:meta])* $type:ident: $role:ident, $formats:expr, $words:expr;)*) => {
        $(
            $(#[$meaning])*
            #[derive(Debug, Clone, PartialEq, Eq)]
            pub struct $type(pub PathBuf);

            impl $type {
                pub const KIND: PathKind = PathKind { role: Role::$role, formats: &$formats, words: &$words };

                /// The word in place of a path, if it is one.
                pub fn word(&self) -> Option<&str> {
                    self.0.to_str().filter(|text| Self::KIND.words.contains(text))
                }
            }

            impl Deref for $type {
                type Target = Path;

                fn deref(&self) -> &Path {
                    &self.0
                }
            }

            impl ValueParserFactory for $type {
                type Parser = ValueParser;

                fn value_parser() -> ValueParser {
                    OsStringValueParser::new().try_map(|text| $type::KIND.checked(text).map($type)).into()
                }
            }

            impl Serialize for $type {
                fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                    self.word().serialize(serializer)
                }
            }
        )*

        /// Returns what kind of path an argument takes, if it takes one.
        pub fn path_kind(arg: &Arg) -> Option<PathKind> {
            let parsed = arg.get_value_parser().type_id();
            let kinds = [$((TypeId::of::<$type>(), $type::KIND)),*];
            kinds.into_iter().find(|(id, _)| parsed == *id).map(|(_, kind)| kind)
        }
    };
}

path_types! {
    /// A table, or a folder with the parts of one.
    Input: Input, ["parquet"], [];
    /// A list, curve or table as people keep it.
    SheetInput: Input, ["csv"], [];
    /// Intensities, as a table or as people keep them.
    RowsInput: Input, ["parquet", "csv"], [];
    /// A list of structures, or the paper's two.
    StructuresInput: Input, ["csv"], ["paper"];
    /// The factors of a site, or a known site.
    SiteInput: Input, ["csv"], ["rock", "soil", "none"];
    /// A file of records, or a folder of such files.
    RecordsInput: Input, [], [];
    /// A table, or a folder of which all tables are read.
    InputFolder: Folder, ["parquet"], [];
    /// A folder of fits.
    FitsFolder: Folder, ["parquet"], [];
    /// A table to write.
    Output: Output, ["parquet"], [];
    /// Answers to write.
    AnswersOutput: Output, ["parquet", "csv", "json", "xlsx", "html", "svg", "png"], [];
    /// Fragility to write for another program.
    FragilityOutput: Output, ["xml", "csv"], [];
    /// A page to write.
    PageOutput: Output, ["html"], [];
}

/// Returns the paths of lists with commas.
pub fn split_lists<P: Deref<Target = Path>>(lists: &[P]) -> Vec<PathBuf> {
    let paths = lists.iter().flat_map(|list| split_list(Path::new(""), &list.to_string_lossy()));
    paths.map(PathBuf::from).collect()
}

/// Returns the paths of a list, of which one may have a comma in its name if it is there.
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
