use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use serde::{Deserialize, Serialize};

use crate::keyword::{self, Keyword};
use crate::motion::records::{AccelerationUnit, ColumnChoice, Format, Given};
use crate::pipeline::options::{Parsed, check, defaults};

/// Which records, and how they are read.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ImportMotionsOptions {
    /// Files and folders of records; folders are walked
    #[arg(value_name = "FILE|DIR")]
    pub files: Vec<PathBuf>,
    /// Format of text files: auto (by content), at2, cosmos, csmip, esm, knet, smc, or columns (plain numbers)
    #[arg(long, default_value = "auto")]
    pub format: Parsed<FormatChoice>,
    /// Time between samples of files that do not say it, s
    #[arg(long)]
    pub dt: Option<f64>,
    /// Unit of files that do not say it: g, mg, m/s2, cm/s2 (gal) or mm/s2
    #[arg(long)]
    pub unit: Option<Parsed<AccelerationUnit>>,
    /// Column of plain files that holds the acceleration: its number, its name, or all where one series wraps over lines
    /// [default: the only one, or the second after times]
    #[arg(long, value_name = "N|NAME|all")]
    pub column: Option<Parsed<ColumnChoice>>,
    /// By which share samples may miss the peak that their header gives, and 0 not at all
    #[arg(long, default_value = "0.05")]
    pub pga_tolerance: f64,
    /// Files that cannot be read are named, and are no failure
    #[arg(long)]
    pub keep_going: bool,
}

impl Default for ImportMotionsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ImportMotionsOptions {
    /// Makes the paths of files relative to `folder`, that of the pipeline file.
    pub fn resolve_paths(&mut self, folder: &Path) {
        for file in &mut self.files {
            *file = folder.join(&*file);
        }
    }

    /// How files are read.
    ///
    /// # Errors
    /// If an option is out of range.
    pub(super) fn reading(&self) -> anyhow::Result<Reading> {
        if let Some(dt) = self.dt {
            check(dt > 0.0 && dt <= 10.0, "dt", dt, "a time step above 0 s and up to 10 s")?;
        }
        check(self.pga_tolerance >= 0.0, "pga-tolerance", self.pga_tolerance, "0 or more")?;
        Ok(Reading {
            format: self.format.0.0,
            given: Given {
                dt_s: self.dt,
                unit: self.unit.as_ref().map(|unit| unit.0),
                column: self.column.as_ref().map(|column| column.0.clone()),
            },
            pga_tolerance: self.pga_tolerance,
        })
    }
}

/// How files are read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Reading {
    /// The format, unless the content shows it.
    pub format: Option<Format>,
    /// What files may not say themselves.
    pub given: Given,
    /// By which share samples may miss the peak of their header.
    pub pga_tolerance: f64,
}

/// A format, or `auto`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormatChoice(Option<Format>);

impl FromStr for FormatChoice {
    type Err = keyword::UnknownKeyword;

    fn from_str(word: &str) -> Result<FormatChoice, keyword::UnknownKeyword> {
        if word == "auto" {
            Ok(FormatChoice(None))
        } else {
            keyword::parse(word).map(|f| FormatChoice(Some(f)))
        }
    }
}

impl fmt::Display for FormatChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0.map_or("auto", Keyword::as_str))
    }
}
