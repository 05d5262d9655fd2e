//! The files of a command: which arguments name them, and where they are if nobody says so.
//!
//! * In a run all default files are in its folder, and `IN_RUN` adds inputs that have no default.
//! * With `--in` and without `--out` the result goes beside what is read.
//! * Further results of a stage are `NAME.more.parquet` beside `NAME.parquet` ([`part`]).
//! * A partition is written as a file of the folder that stands for the whole ([`out_of_partition`]).

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Command, ValueHint};

use super::UsageError;
use crate::table::file::{Partition, is_table};

/// What an argument is to a stage. Its value hint says so, which completions need as well: an argument without
/// one is a parameter, and enters the key of the results by its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// A file or folder to read: it enters the key by its content.
    Input,
    /// A folder of fits, of which `FITS` are read.
    Fits,
    Output,
    Parameter,
}

impl Role {
    pub fn is_read(self) -> bool {
        matches!(self, Role::Input | Role::Fits)
    }
}

/// The files that are read from a folder of fits.
const FITS: [&str; 4] = ["pro.calibration.parquet", "pex.calibration.parquet", "pro.parquet", "pex.parquet"];

/// Files in a run of arguments without a default: flag, file, and the stage that must be in the run.
const IN_RUN: [(&str, &str, &str); 5] = [
    ("fits", ".", "fit-pro"),
    ("motions", "motions.parquet", "synthesize-motions"),
    ("motions", "motions.parquet", "import-motions"),
    ("responses", "responses.parquet", "simulate"),
    ("out", "evaluated.parquet", "evaluate"),
];

/// The stage in a run whose motions all later ones take, and these.
const FLOOR: (&str, &str) = ("floor-motions", "floor.parquet");

pub fn role(arg: &Arg) -> Role {
    match arg.get_value_hint() {
        ValueHint::FilePath => Role::Input,
        ValueHint::DirPath => Role::Fits,
        _ if arg.get_long() == Some("out") => Role::Output,
        _ => Role::Parameter,
    }
}

pub fn files_of(role: Role, path: PathBuf) -> Vec<PathBuf> {
    // Fits to what stood and what fell have none of demands.
    let is_there = |name: &&str| name.starts_with("pro") || path.join(name).exists();
    match role {
        Role::Fits => FITS.into_iter().filter(is_there).map(|name| path.join(name)).collect(),
        _ => vec![path],
    }
}

/// Returns the file of an argument in a run, if none is given; `has` tells whether a stage is in the run.
pub fn in_run(command: &str, arg: &Arg, has: impl Fn(&str) -> bool) -> Option<PathBuf> {
    let role = role(arg);
    if role == Role::Parameter {
        return None;
    }
    let is_made = |maker: &str| has(maker) && (role != Role::Output || maker == command);
    let known = IN_RUN.iter().find(|(flag, _, maker)| arg.get_long() == Some(flag) && is_made(maker));
    // An input may be a word in place of a file, such as the site `rock`: files have a dot.
    let is_file = |default: &&OsStr| default.to_string_lossy().contains('.');
    let default = arg.get_default_values().first().map(|default| default.as_os_str()).filter(is_file);
    let file = default.map(PathBuf::from).or(known.map(|(_, file, _)| PathBuf::from(file)))?;
    let is_of_floor = has(FLOOR.0) && command != FLOOR.0 && role != Role::Output;
    Some(if is_of_floor && file == Path::new("motions.parquet") { PathBuf::from(FLOOR.1) } else { file })
}

/// Returns `--out` beside a given `--in`, if the user gives no `--out`.
pub fn out_beside_in(matches: &ArgMatches) -> Option<OsString> {
    let is = |id: &str, source: ValueSource| {
        matches.try_contains_id(id).is_ok() && matches.value_source(id) == Some(source)
    };
    if !(is("in", ValueSource::CommandLine) && is("out", ValueSource::DefaultValue)) {
        return None;
    }
    let [input, out] = ["in", "out"].map(|id| matches.get_one::<PathBuf>(id).cloned().unwrap_or_default());
    Some(assigned("out", input.with_file_name(out).as_os_str()))
}

/// Checks that what a stage writes as Parquet has no other ending.
pub fn check_out(command: &Command, matches: &ArgMatches) -> anyhow::Result<()> {
    let Some(arg) = command.get_arguments().find(|arg| role(arg) == Role::Output) else { return Ok(()) };
    let is_written_so = arg.get_default_values().iter().any(|default| is_table(Path::new(default)));
    match matches.try_get_one::<PathBuf>("out").ok().flatten() {
        Some(out) if is_written_so && out.extension().is_some() && !is_table(out) => {
            let out = out.display();
            Err(UsageError::because(format!("out is {out}; expected a name that ends in .parquet")))
        }
        _ => Ok(()),
    }
}

/// Returns `--flag=value`; the value may begin with a minus sign.
pub fn assigned(flag: &str, value: &OsStr) -> OsString {
    let mut argument = OsString::from(format!("--{flag}="));
    argument.push(value);
    argument
}

/// Returns `out.NAME.parquet`, a further output beside `out.parquet`.
pub fn part(out: &Path, name: &str) -> PathBuf {
    out.with_extension(format!("{name}.parquet"))
}

pub fn out_of_partition(out: &Path, partition: Option<Partition>) -> PathBuf {
    match partition {
        Some(partition) => out.with_extension("").join(partition.file_name()),
        None => out.to_path_buf(),
    }
}
