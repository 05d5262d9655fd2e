//! What a table says about records: magnitude, distance and earthquake, which few files have.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use crate::inputs::{Grid, InputError};
use crate::pipeline::UsageError;
use crate::plausibility::MAGNITUDES;
use crate::records::RecordedMotion;

#[derive(Default)]
pub struct About {
    /// By the name of the file, with its ending or without.
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

impl About {
    /// Reads a table with a column `name` or `file`, and `magnitude`, `distance` (km) or `earthquake`.
    pub fn read(path: &Path) -> anyhow::Result<About> {
        let problem = |problem: String| UsageError::because(format!("{}: {problem}", path.display()));
        let sheet = Grid::read(path).map_err(|error| problem(error.to_string()))?;
        let Some(name) = sheet.column(&["file", "name", "motion_id"]) else {
            return Err(problem("no column 'file' or 'name'".to_string()));
        };
        let magnitude = sheet.column(&["magnitude", "mw", "m"]);
        let distance = sheet.column(&["distance", "re"]);
        let earthquake = sheet.column(&["earthquake", "event"]);
        if magnitude.or(distance).or(earthquake).is_none() {
            return Err(problem("expected a column 'magnitude', 'distance' or 'earthquake'".to_string()));
        }
        let km = |at: usize| sheet.headings[at].unit.is_none_or(|unit| unit.name == "km");
        if let Some(at) = distance.filter(|&at| !km(at)) {
            return Err(problem(format!("column '{}'; expected km", sheet.headings[at].text)));
        }
        let number =
            |row: usize, column: Option<usize>, is_possible: &dyn Fn(f64) -> bool, expected: &str| {
                let Some(column) = column.filter(|&column| !sheet.cell(row, column).is_empty()) else {
                    return Ok(None);
                };
                let value = sheet.number(row, column)?;
                if is_possible(value) { Ok(Some(value)) } else { Err(sheet.refusal(row, column, expected)) }
            };
        let known = |row: usize| -> Result<(String, Known), InputError> {
            let mw = number(row, magnitude, &|mw| MAGNITUDES.contains(&mw), "a moment magnitude")?;
            let re_km = number(row, distance, &|km| km >= 0.0, "a distance of 0 km or more")?;
            let cell = |column| sheet.cell(row, column).to_string();
            let earthquake = earthquake.map(cell).filter(|name| !name.is_empty());
            Ok((cell(name), Known { mw, re_km, earthquake }))
        };
        let mut all = HashMap::new();
        for row in 0..sheet.lines.len() {
            let (file, known) = known(row).map_err(|error| problem(error.to_string()))?;
            if all.insert(file.clone(), known.clone()).is_some_and(|before| before != known) {
                return Err(problem(format!("line {}: {file} again, with other values", sheet.lines[row])));
            }
        }
        let is_used = |at: usize| [Some(name), magnitude, distance, earthquake].contains(&Some(at));
        let unused = sheet.headings.iter().enumerate().filter(|(at, _)| !is_used(*at));
        Ok(About { known: all, unused: unused.map(|(_, heading)| heading.text.clone()).collect() })
    }

    /// Refuses a table that says nothing of any of these files.
    pub fn expect_any(&self, path: &Path, files: &[PathBuf]) -> anyhow::Result<()> {
        if files.iter().any(|file| self.of(file).is_some()) {
            return Ok(());
        }
        let problem = format!("{}: no row is about any of the {} files", path.display(), files.len());
        Err(UsageError::because(problem))
    }

    fn of(&self, file: &Path) -> Option<&Known> {
        let names = [file.file_name(), file.file_stem()];
        names.into_iter().flatten().find_map(|name| self.known.get(name.to_str()?))
    }

    /// Adds to a record what the table says of its file.
    pub fn add(&self, file: &Path, motion: &mut RecordedMotion) {
        let Some(Known { mw, re_km, earthquake }) = self.of(file).cloned() else { return };
        motion.mw = mw.or(motion.mw);
        motion.re_km = re_km.or(motion.re_km);
        motion.event = earthquake.or(motion.event.take());
    }
}
