//! What a table says about records: magnitude, distance and earthquake, which few files have.

use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::path::Path;

use crate::inputs::{Grid, Heading, InputError, decode};
use crate::pipeline::UsageError;
use crate::plausibility::{DISTANCES_KM, MAGNITUDES};
use crate::records::RecordedMotion;
use crate::source;

/// The line above the table of records in PEER's search results, which have others.
const PEER: &str = "Summary of Metadata of Selected Records";
/// Names of columns, the first of which counts: PEER's flatfile has several distances.
const MAGNITUDE: [&str; 4] = ["magnitude", "mw", "earthquake_magnitude", "m"];
const DISTANCE: [&str; 5] = ["distance", "re", "rrup", "clstd", "closest_distance"];
const EARTHQUAKE: [&str; 4] = ["earthquake", "event", "earthquake_name", "event_name"];
/// PEER's numbers below this stand for values that are not known.
const UNKNOWN: f64 = -99.0;

#[derive(Default)]
pub struct About {
    /// By the name of the file in small letters, with its ending or without, or `rsn` and its number at PEER.
    known: HashMap<String, Known>,
    /// Headings of other columns.
    pub unused: Vec<String>,
}

#[derive(Clone, PartialEq)]
struct Known {
    mw: Option<f64>,
    re_km: Option<f64>,
    earthquake: Option<String>,
}

/// The columns of the table.
struct Columns {
    files: Vec<usize>,
    /// PEER's number of the record.
    number: Option<usize>,
    magnitude: Option<usize>,
    distance: Option<usize>,
    earthquake: Option<usize>,
}

impl About {
    /// Reads a table with a column `name` or `file`, and `magnitude`, `distance` (km) or `earthquake`, or
    /// PEER's search results or flatfile.
    pub fn read(path: &Path) -> anyhow::Result<About> {
        About::parse(path).map_err(|problem| UsageError::because(format!("{}: {problem}", path.display())))
    }

    fn parse(path: &Path) -> Result<About, String> {
        let grid = grid(path).map_err(|error| error.to_string())?;
        let columns = Columns::find(&grid)?;
        let mut about = About::default();
        for row in 0..grid.lines.len() {
            let known = columns.known(&grid, row).map_err(|error| error.to_string())?;
            for file in columns.keys(&grid, row) {
                if about.known.insert(file.clone(), known.clone()).is_some_and(|before| before != known) {
                    return Err(format!("line {}: {file} again, with other values", grid.lines[row]));
                }
            }
        }
        let unused = grid.headings.iter().enumerate().filter(|(at, _)| !columns.uses(*at));
        about.unused = unused.map(|(_, heading)| heading.text.clone()).collect();
        Ok(about)
    }

    /// Returns whether a row is about a file.
    pub fn has(&self, file: &Path) -> bool {
        self.find(file).is_some()
    }

    fn find(&self, file: &Path) -> Option<&Known> {
        let [name, stem] = [file.file_name()?, file.file_stem()?].map(|name| name.to_str().map(key));
        // RSN6_IMPVALL.I_I-ELC180.AT2
        let number = stem.as_ref().and_then(|stem| stem.split('_').next());
        let number = number.filter(|word| word.starts_with("rsn")).map(str::to_string);
        [name, stem, number].into_iter().flatten().find_map(|name| self.known.get(&name))
    }

    /// Adds to a record what the table says of its file.
    pub fn add(&self, file: &Path, motion: &mut RecordedMotion) {
        let Some(Known { mw, re_km, earthquake }) = self.find(file).cloned() else { return };
        motion.mw = mw.or(motion.mw);
        motion.re_km = re_km.or(motion.re_km);
        motion.event = earthquake.or(motion.event.take());
    }
}

/// The table, of which other tables in a file of PEER are no part.
fn grid(path: &Path) -> Result<Grid, InputError> {
    let text = source::read(path).ok().and_then(|bytes| Some(decode(&bytes).ok()?.into_owned()));
    let Some((before, after)) = text.as_deref().and_then(|text| text.split_once(PEER)) else {
        return Grid::read(path);
    };
    let table = after.split_once('\n').map_or("", |(_, table)| table);
    let table = table.split("\n\n").next().unwrap_or_default();
    // Lines keep their numbers.
    Grid::parse(("\n".repeat(before.matches('\n').count() + 1) + table).as_bytes(), None)
}

impl Columns {
    fn find(grid: &Grid) -> Result<Columns, String> {
        let files = grid.headings.iter().enumerate().filter(|(_, heading)| is_file(heading));
        let [magnitude, distance, earthquake] = [&MAGNITUDE[..], &DISTANCE, &EARTHQUAKE]
            .map(|names| names.iter().find_map(|name| grid.column(&[name])));
        let files = files.map(|(at, _)| at).collect();
        let number = grid.column(&["record_sequence_number", "rsn"]);
        let columns = Columns { files, number, magnitude, distance, earthquake };
        if columns.files.is_empty() && columns.number.is_none() {
            return Err("no column 'file' or 'name'".to_string());
        }
        if magnitude.or(distance).or(earthquake).is_none() {
            return Err("expected a column 'magnitude', 'distance' or 'earthquake'".to_string());
        }
        let heading = distance.map(|at| &grid.headings[at]);
        match heading.filter(|heading| heading.unit.is_some_and(|unit| unit.name != "km")) {
            Some(heading) => Err(format!("column '{}'; expected km", heading.text)),
            None => Ok(columns),
        }
    }

    fn uses(&self, column: usize) -> bool {
        let others = [self.number, self.magnitude, self.distance, self.earthquake];
        self.files.contains(&column) || others.contains(&Some(column))
    }

    fn known(&self, grid: &Grid, row: usize) -> Result<Known, InputError> {
        let earthquake = self.earthquake.map(|column| grid.cell(row, column)).filter(|name| !name.is_empty());
        Ok(Known {
            mw: number(grid, row, self.magnitude, MAGNITUDES, "a moment magnitude")?,
            re_km: number(grid, row, self.distance, DISTANCES_KM, "a distance from 0 to 1000 km")?,
            earthquake: earthquake.map(str::to_string),
        })
    }

    /// The names under which a file may be the one of a row.
    fn keys(&self, grid: &Grid, row: usize) -> Vec<String> {
        let files = self.files.iter().map(|&column| grid.cell(row, column));
        let files = files.filter_map(|path| path.rsplit(['/', '\\']).next().map(key));
        let files = files.filter(|name| name.contains(char::is_alphanumeric));
        let number = self.number.map(|column| format!("rsn{}", grid.cell(row, column)));
        files.filter(|name| name != "-999").chain(number).collect()
    }
}

/// The number in a cell, if it has one, which must be in a range.
fn number(
    grid: &Grid,
    row: usize,
    column: Option<usize>,
    range: RangeInclusive<f64>,
    expected: &str,
) -> Result<Option<f64>, InputError> {
    let Some(column) = column.filter(|&column| !grid.cell(row, column).is_empty()) else { return Ok(None) };
    match grid.number(row, column)? {
        number if number <= UNKNOWN => Ok(None),
        number if range.contains(&number) => Ok(Some(number)),
        _ => Err(grid.refusal(row, column, expected)),
    }
}

fn is_file(heading: &Heading) -> bool {
    let name = heading.name.as_str();
    matches!(name, "file" | "name" | "motion_id") || name.contains("filename") || name.contains("file_name")
}

fn key(name: &str) -> String {
    name.trim().to_lowercase()
}
