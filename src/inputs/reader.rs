//! What reads the files of a call: the user names headings (`--columns pga_g=PGA`) or leaves columns out
//! (`--ignore Remarks`); and how each file was read: one role for each of its columns, rows and remarks.

use std::borrow::Cow;
use std::path::Path;
use std::str::FromStr;

use rockfrag_core::warning::Warnings;
use serde::{Deserialize, Serialize};

use super::error::{InputError, Result};
use super::grid::Grid;
use super::hazard::contradict;
use super::heading::Heading;
use super::words::means;
use crate::number::listed;

/// Columns that a sentence names.
const NAMED: usize = 12;

#[derive(Debug, Clone, PartialEq)]
pub struct Rename {
    pub column: String,
    pub heading: String,
}

impl<'de> Deserialize<'de> for Rename {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Rename, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl Serialize for Rename {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{}={}", self.column, self.heading))
    }
}

impl FromStr for Rename {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Rename, &'static str> {
        let (column, heading) = text.split_once('=').ok_or("expected COLUMN=HEADING, such as pga_g=PGA")?;
        Ok(Rename { column: column.trim().to_string(), heading: heading.trim().to_string() })
    }
}

/// Reads the files of a call, with the headings that the user names or leaves out.
#[derive(Debug, Default)]
pub struct Reader<'a> {
    renames: &'a [Rename],
    ignored: &'a [String],
    /// Headings of files that were seen.
    seen: Vec<String>,
    /// Doubts about what the files say.
    pub warnings: Warnings,
    /// How each file was read.
    pub readings: Vec<Reading>,
}

impl<'a> Reader<'a> {
    pub fn new(renames: &'a [Rename], ignored: &'a [String]) -> Reader<'a> {
        Reader { renames, ignored, ..Reader::default() }
    }

    /// Reads a table and renames its columns; those that are ignored go. A unit or a percent sign of the
    /// heading stays.
    pub fn read(&mut self, path: &Path) -> Result<Grid> {
        let mut grid = Grid::read(path)?;
        self.seen.extend(grid.headings.iter().map(|heading| heading.text.clone()));
        grid.ignore(self.ignored);
        for heading in &mut grid.headings {
            let Some(column) = self.renamed(&heading.text) else { continue };
            let wanted = Heading::new(column);
            let is_other = heading.unit.zip(wanted.unit).is_some_and(|(old, new)| old != new);
            if is_other || contradict(heading, &wanted) {
                return Err(InputError::Units { heading: heading.text.clone(), unit: column.to_string() });
            }
            let unit = wanted.unit.or(heading.unit);
            *heading = Heading { unit, is_percent: heading.is_percent, ..wanted };
        }
        Ok(grid)
    }

    /// Keeps how a table was read: the meaning of each of its columns.
    pub fn tell(&mut self, path: &Path, grid: &Grid, meanings: Vec<Meaning>) {
        self.readings.push(grid.reading(path, meanings));
    }

    /// The name of a column of a table of others, as it is to be called.
    pub fn name(&mut self, name: &str) -> String {
        self.seen.push(name.to_string());
        self.renamed(name).unwrap_or(name).to_string()
    }

    fn renamed(&self, heading: &str) -> Option<&'a str> {
        self.renames.iter().find(|rename| rename.heading == heading).map(|rename| rename.column.as_str())
    }

    pub fn expect_used(&self) -> Result<()> {
        let headings = self.renames.iter().map(|rename| &rename.heading).chain(self.ignored);
        let mut unused = headings.filter(|heading| !self.seen.contains(heading));
        unused.next().map_or(Ok(()), |heading| {
            let seen = if self.seen.is_empty() { "none".to_string() } else { self.seen.join(", ") };
            Err(InputError::Renamed { heading: heading.clone(), seen })
        })
    }
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    pub file: String,
    pub rows: usize,
    pub columns: Vec<ColumnReading>,
    /// Remarks on what decides, which are not used.
    #[serde(default)]
    pub unread: Vec<String>,
    /// Lines that are no data, and what they were taken for: `line 4: section 'Level 2'`.
    pub others: Vec<String>,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ColumnReading {
    pub heading: String,
    pub meaning: Meaning,
    /// Of the numbers below, as the heading has it.
    pub unit: Option<String>,
    /// Number of cells that say something.
    pub filled: usize,
    /// The first and the last of them; numbers of a known meaning in m, s, rad, m/s or m/s2.
    pub first: String,
    pub last: String,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "lowercase")]
pub enum Meaning {
    /// A text of the file's own: tags, rooms, notes.
    Kept,
    #[default]
    #[strum(to_string = "not understood")]
    NotUnderstood,
    /// Left out by the user.
    Ignored,
    /// By the name of its column or option: width.
    #[serde(untagged)]
    #[strum(to_string = "{0}")]
    Known(String),
}

impl Reading {
    pub fn name(&self) -> Cow<'_, str> {
        Path::new(&self.file).file_name().unwrap_or(self.file.as_ref()).to_string_lossy()
    }

    /// Names the columns and remarks that are not understood, if there are any.
    pub fn gaps(&self) -> Option<String> {
        let kind = |of: &ColumnReading| match of.meaning {
            Meaning::NotUnderstood => Some("column"),
            Meaning::Kept if of.filled > 0 && means(&of.heading, "remark") => Some("the texts of column"),
            _ => None,
        };
        let columns = self.columns.iter().filter_map(|of| Some((kind(of)?, &of.heading)));
        let all: Vec<_> = columns.chain(self.unread.iter().map(|remark| ("remark", remark))).collect();
        let told = ["column", "the texts of column", "remark"].map(|kind| {
            let names = all.iter().filter(|(of, _)| *of == kind).map(|(_, name)| format!("'{name}'"));
            let names: Vec<String> = names.collect();
            let plural = if names.len() == 1 { "" } else { "s" };
            (!names.is_empty()).then(|| format!("{kind}{plural} {}", listed(&names, NAMED)))
        });
        let told: Vec<String> = told.into_iter().flatten().collect();
        (!told.is_empty()).then(|| format!("Not understood in {}: {}.", self.name(), told.join("; ")))
    }
}
