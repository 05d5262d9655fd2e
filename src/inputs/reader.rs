//! What reads the files of a call: the user names headings (`--columns pga_g=PGA`) or leaves columns out
//! (`--ignore Remarks`).

use std::path::Path;
use std::str::FromStr;

use rockfrag_core::warning::Warnings;

use super::error::{InputError, Result};
use super::grid::Grid;
use super::hazard::contradict;
use super::heading::Heading;
use super::reading::{Meaning, Reading};

#[derive(Debug, Clone, PartialEq)]
pub struct Rename {
    pub column: String,
    pub heading: String,
}

impl<'de> serde::Deserialize<'de> for Rename {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Rename, D::Error> {
        <String as serde::Deserialize>::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl serde::Serialize for Rename {
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
            Err(InputError::Renamed { heading: heading.clone(), seen: self.seen.join(", ") })
        })
    }
}
