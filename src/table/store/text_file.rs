//! Text files whole: read if they are of moderate size, written beside their name and renamed when complete.

use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::Path;

use csv::{Position, Reader, ReaderBuilder, StringRecord, Trim};

use super::writer::temporary_beside;
use crate::table::TableError;
use crate::table::schema::headings::Headings;

/// The bytes of a file that may have `most_mib` MiB, and of anything else that can be read, up to that.
///
/// # Errors
/// If it cannot be read or is larger; the words say what is `expected`.
pub fn bytes(path: &Path, most_mib: u64, expected: &str) -> Result<Vec<u8>> {
    read(path, most_mib).map_err(|error| Error::new(error.kind(), format!("{error}; expected {expected}")))
}

/// The same as text.
///
/// # Errors
/// As [`bytes`], or if it is not UTF-8.
pub fn text(path: &Path, most_mib: u64, expected: &str) -> Result<String> {
    let no_text = |_| Error::new(ErrorKind::InvalidData, format!("not UTF-8; expected {expected}"));
    String::from_utf8(bytes(path, most_mib, expected)?).map_err(no_text)
}

fn read(path: &Path, most_mib: u64) -> Result<Vec<u8>> {
    let most = most_mib << 20;
    let file = File::open(path)?;
    let announced = file.metadata()?.len();
    let mut bytes = Vec::new();
    if announced <= most {
        // A pipe or a device has no size, and a file may grow.
        file.take(most + 1).read_to_end(&mut bytes)?;
    }
    if announced.max(bytes.len() as u64) > most {
        let words = format!("larger than {most_mib} MiB, the most that is read");
        return Err(Error::new(ErrorKind::FileTooLarge, words));
    }
    Ok(bytes)
}

/// Writes a text, or bytes, beside its name and renames it when it is whole.
///
/// # Errors
/// If the folder is not there or cannot be written.
pub fn write(path: &Path, content: impl AsRef<[u8]>) -> std::result::Result<(), TableError> {
    let mut partial = temporary_beside(path)?;
    partial.write_all(content.as_ref()).map_err(|source| TableError::io(path, source))?;
    partial.persist(path).map_err(|refused| TableError::io(path, refused.error))?;
    Ok(())
}

/// The table of a CSV file, as spreadsheets of any country write it: names in any letter case; semicolons between the cells, and then a
/// comma before the decimals. Lines that begin with # are words.
pub struct CsvText<'a> {
    /// The names of the columns, in lower case, with underscores.
    pub names: Vec<String>,
    has_semicolons: bool,
    reader: Reader<&'a [u8]>,
}

impl<'a> CsvText<'a> {
    /// Reads the names.
    ///
    /// # Errors
    /// If the text is no CSV.
    pub fn new(text: &'a str) -> csv::Result<CsvText<'a>> {
        let text = text.trim_start_matches('\u{feff}');
        let header = text.lines().find(|line| !line.starts_with('#')).unwrap_or_default();
        let has_semicolons = header.contains(';') && !header.contains(',');
        let mut builder = ReaderBuilder::new();
        builder.comment(Some(b'#')).trim(Trim::All).delimiter(if has_semicolons { b';' } else { b',' });
        let mut reader = builder.from_reader(text.as_bytes());
        let names = reader.headers()?.iter().map(plain).collect();
        Ok(CsvText { names, has_semicolons, reader })
    }

    /// Takes other headings for columns.
    ///
    /// # Errors
    /// With the first that is not there.
    pub fn rename(&mut self, headings: &Headings) -> std::result::Result<(), String> {
        self.names = headings.renamed(&self.names, |name, heading| name == plain(heading))?;
        Ok(())
    }

    /// The rows with their lines, in order.
    pub fn rows(self) -> impl Iterator<Item = std::result::Result<(u64, StringRecord), String>> + use<'a> {
        let has_semicolons = self.has_semicolons;
        self.reader.into_records().map(move |record| {
            let record = record.map_err(|error| explain(&error))?;
            let line = record.position().map_or(0, Position::line);
            if !has_semicolons {
                return Ok((line, record));
            }
            let with_point = |cell: &str| {
                let point = cell.replace(',', ".");
                if point.trim_end_matches(['%', ' ']).parse::<f64>().is_ok() {
                    point
                } else {
                    cell.to_string()
                }
            };
            Ok((line, record.iter().map(with_point).collect()))
        })
    }
}

/// A heading as the name of a column.
fn plain(heading: &str) -> String {
    heading.to_lowercase().replace([' ', '-'], "_")
}

/// What is wrong with a row.
fn explain(error: &csv::Error) -> String {
    let csv::ErrorKind::UnequalLengths { pos, expected_len, len } = error.kind() else {
        return error.to_string();
    };
    let line = pos.as_ref().map_or(0, Position::line);
    format!(
        "line {line}: {len} cells under {expected_len} headings; if commas are decimal signs, separate the cells by semicolons"
    )
}
