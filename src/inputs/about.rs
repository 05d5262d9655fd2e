//! What a table says about records: magnitude, distance and earthquake, which few files have.

use std::collections::HashMap;
use std::path::Path;

use rockfrag_core::records::Origin;

use super::words::means;
use super::{Grid, Heading, InputError, Meaning, Reading, Result, decode};
use crate::source;

/// The line above the table of records in PEER's search results, which have others.
const PEER: &str = "Summary of Metadata of Selected Records";

#[derive(Debug, Default)]
pub struct About {
    /// By the name of the file in small letters, with its ending or without, or `rsn` and its number at PEER.
    known: HashMap<String, Origin>,
    /// How the table was read.
    pub reading: Reading,
}

impl About {
    /// Reads a table with a column `name` or `file`, and `magnitude`, `distance` (km) or `earthquake`, or
    /// PEER's search results or flatfile.
    pub fn read(path: &Path) -> Result<About> {
        grid(path).and_then(|grid| About::from_grid(path, &grid)).map_err(|error| error.in_file(path))
    }

    fn from_grid(path: &Path, grid: &Grid) -> Result<About> {
        let named = ["magnitude", "distance", "earthquake", "record-number"];
        let columns = named.map(|meaning| grid.about(meaning));
        let [magnitude, distance, earthquake, number] = columns;
        let is_file = |Heading { name, .. }: &Heading| {
            name.replace('-', "").contains("filename") || means(name, "record")
        };
        let files: Vec<usize> = (0..grid.headings.len()).filter(|at| is_file(&grid.headings[*at])).collect();
        if files.is_empty() && number.is_none() || columns[..3] == [None; 3] {
            let expected = "a column 'file' or 'name', and 'magnitude', 'distance' or 'earthquake'";
            return Err(InputError::unexpected(grid.found(), expected));
        }
        if let Some(Heading { text, unit: Some(unit), .. }) = distance.map(|at| &grid.headings[at])
            && unit.name != "km"
        {
            return Err(InputError::unexpected(format!("column '{text}'"), "km"));
        }
        let (mw, re_km) = (grid.known(magnitude, "mw")?, grid.known(distance, "re_km")?);
        let mut known = HashMap::new();
        for (row, line) in grid.lines.iter().enumerate() {
            let earthquake = earthquake.and_then(|at| grid.value(row, at)).map(str::to_string);
            let origin = Origin { mw: mw[row], re_km: re_km[row], earthquake, ..Origin::default() };
            let names = files.iter().filter_map(|at| grid.cell(row, *at).rsplit(['/', '\\']).next());
            let names = names.map(str::to_lowercase);
            let names = names.filter(|name| name.contains(char::is_alphanumeric) && name != "-999");
            // Some programs write 6.0 for 6.
            let number = number.map(|at| format!("rsn{}", grid.cell(row, at).trim_end_matches(".0")));
            for name in names.chain(number) {
                if known.insert(name.clone(), origin.clone()).is_some_and(|before| before != origin) {
                    let found = format!("line {line}: {name} again, with other values");
                    return Err(InputError::unexpected(found, "one row of each record"));
                }
            }
        }
        let meaning = |at| match columns.iter().position(|column| *column == Some(at)) {
            Some(of) => Meaning::Known(named[of].replace('-', " ")),
            None if files.contains(&at) => Meaning::Known("file".to_string()),
            None if grid.is_text(at) => Meaning::Kept,
            None => Meaning::NotUnderstood,
        };
        let meanings = (0..grid.headings.len()).map(meaning).collect();
        Ok(About { known, reading: grid.reading(path, meanings) })
    }

    pub fn get(&self, file: &Path) -> Option<&Origin> {
        let [name, stem] =
            [file.file_name()?, file.file_stem()?].map(|name| name.to_string_lossy().to_lowercase());
        // RSN6_IMPVALL.I_I-ELC180.AT2
        let number = stem.split('_').next().filter(|word| word.starts_with("rsn"));
        [&*name, &stem].into_iter().chain(number).find_map(|name| self.known.get(name))
    }
}

/// The table, of which other tables in a file of PEER are no part.
fn grid(path: &Path) -> Result<Grid> {
    let text = source::read(path).ok().and_then(|bytes| Some(decode(&bytes).ok()?.into_owned()));
    let Some((before, after)) = text.as_deref().and_then(|text| text.split_once(PEER)) else {
        return Grid::read(path);
    };
    let table = after.split_once('\n').map_or("", |(_, table)| table);
    let table = table.split("\n\n").next().unwrap_or_default();
    // Lines keep their numbers.
    Grid::parse(("\n".repeat(before.matches('\n').count() + 1) + table).as_bytes(), None)
}
