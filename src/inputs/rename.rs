//! Headings that the user names: `--columns pga_g=PGA`.

use std::path::Path;
use std::str::FromStr;

use super::error::{InputError, Result};
use super::grid::Grid;
use super::heading::Heading;

/// A column, and its heading in a file.
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

/// Columns that the user names; each must be in one of the files of a call.
#[derive(Debug)]
pub struct Renames<'a> {
    all: &'a [Rename],
    /// Headings of files that were seen.
    seen: Vec<String>,
}

impl<'a> Renames<'a> {
    pub fn new(all: &'a [Rename]) -> Renames<'a> {
        Renames { all, seen: Vec::new() }
    }

    /// Reads a table and renames its columns. A unit or a percent sign of the heading stays.
    pub fn read(&mut self, path: &Path) -> Result<Grid> {
        let mut grid = Grid::read(path)?;
        for heading in &mut grid.headings {
            let Some(column) = self.renamed(&heading.text) else { continue };
            let wanted = Heading::new(column);
            if heading.unit.zip(wanted.unit).is_some_and(|(old, new)| old != new) {
                return Err(InputError::Units { heading: heading.text.clone(), unit: column.to_string() });
            }
            let unit = wanted.unit.or(heading.unit);
            *heading = Heading { unit, is_percent: heading.is_percent, ..wanted };
        }
        Ok(grid)
    }

    /// The name of a column of a table of others, as it is to be called.
    pub fn name(&mut self, name: &str) -> String {
        self.renamed(name).unwrap_or(name).to_string()
    }

    fn renamed(&mut self, heading: &str) -> Option<&'a str> {
        self.seen.push(heading.to_string());
        self.all.iter().find(|rename| rename.heading == heading).map(|rename| rename.column.as_str())
    }

    /// Refuses a heading that no file has.
    pub fn expect_used(self) -> Result<()> {
        let mut unused = self.all.iter().filter(|rename| !self.seen.contains(&rename.heading));
        unused.next().map_or(Ok(()), |Rename { heading, .. }| {
            Err(InputError::Renamed { heading: heading.clone(), seen: self.seen.join(", ") })
        })
    }
}
