//! Text files whole: read if they are of moderate size, written beside their name and renamed when complete.

use std::fs::File;
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};

use csv::{Position, Reader, ReaderBuilder, StringRecord, Trim};
use tempfile::NamedTempFile;

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

/// The same as text, in which each line ends in `\n`, however the lines of the file end.
///
/// # Errors
/// As [`bytes`], or if it is not UTF-8.
pub fn text(path: &Path, most_mib: u64, expected: &str) -> Result<String> {
    let bytes = bytes(path, most_mib, expected)?;
    let other = OTHERS.iter().find(|(begins, _)| bytes.starts_with(begins));
    let what = other.map_or("not UTF-8", |(_, what)| what);
    let no_text = || {
        let words =
            format!("{what}; expected {expected} in UTF-8: save it as such, from a spreadsheet as CSV UTF-8");
        Error::new(ErrorKind::InvalidData, words)
    };
    match (String::from_utf8(bytes), other) {
        (Ok(text), None) if text.contains('\r') => Ok(text.replace("\r\n", "\n").replace('\r', "\n")),
        (Ok(text), None) => Ok(text),
        _ => Err(no_text()),
    }
}

/// How files begin that are no text in UTF-8, and what they are.
const OTHERS: [(&[u8], &str); 4] = [
    (b"\xff\xfe", "UTF-16, a spreadsheet's \"Unicode text\""),
    (b"\xfe\xff", "UTF-16, a spreadsheet's \"Unicode text\""),
    (b"PK\x03\x04", "an Excel workbook or another zip archive"),
    (b"\xd0\xcf\x11\xe0", "an old Excel workbook"),
];

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
    let mut writer = TextWriter::create(path)?;
    writer.write(content)?;
    writer.finish()
}

/// The same part by part.
pub struct TextWriter {
    path: PathBuf,
    partial: NamedTempFile,
}

impl TextWriter {
    /// Starts a file that will stand at `path` once it is finished.
    ///
    /// # Errors
    /// If the folder is not there or cannot be written.
    pub fn create(path: &Path) -> std::result::Result<TextWriter, TableError> {
        Ok(TextWriter { path: path.to_path_buf(), partial: temporary_beside(path)? })
    }

    /// Appends a part.
    ///
    /// # Errors
    /// If the disk is full.
    pub fn write(&mut self, content: impl AsRef<[u8]>) -> std::result::Result<(), TableError> {
        self.partial.write_all(content.as_ref()).map_err(|source| TableError::io(&self.path, source))
    }

    /// Gives the file its name.
    ///
    /// # Errors
    /// If it cannot be renamed.
    pub fn finish(self) -> std::result::Result<(), TableError> {
        let TextWriter { path, partial } = self;
        partial.persist(&path).map_err(|refused| TableError::io(&path, refused.error))?;
        Ok(())
    }
}

/// The table of a CSV file, as spreadsheets of any country write it: headings in any letter case; commas between the cells, or semicolons
/// or tabs and then perhaps a comma before the decimals; titles above the headings; rows of empty cells. Lines that begin with # are
/// words.
pub struct CsvText<'a> {
    /// The headings as they stand in the file.
    pub headings: Vec<String>,
    /// The columns that they name: `pga_g` is that of `PGA (g)`.
    pub names: Vec<String>,
    has_decimal_commas: bool,
    reader: Reader<&'a [u8]>,
    lines: Lines<'a>,
}

/// The lines of a text, counted as far as rows have been read.
struct Lines<'a> {
    text: &'a str,
    /// The byte up to which they are counted.
    byte: usize,
    count: u64,
}

impl Lines<'_> {
    /// The line of a row for which the reader begins at `byte`: empty lines and words come before it.
    fn of(&mut self, byte: usize) -> u64 {
        let between = self.text.get(self.byte..byte).unwrap_or_default();
        self.count += between.matches('\n').count() as u64;
        self.byte = byte;
        while let Some((line, _)) = self.text.get(self.byte..).and_then(|rest| rest.split_once('\n'))
            && (line.is_empty() || line.starts_with('#'))
        {
            self.byte += line.len() + 1;
            self.count += 1;
        }
        self.count
    }
}

/// Rows in which the headings must stand.
const HEADER: usize = 50;

impl<'a> CsvText<'a> {
    /// Reads the headings: the first row in which one names a column that `is_known`, else the first of several cells.
    ///
    /// # Errors
    /// If the text is no CSV.
    pub fn new(text: &'a str, is_known: impl Fn(&str) -> bool) -> csv::Result<CsvText<'a>> {
        let text = text.trim_start_matches('\u{feff}');
        let has_known = |row: &StringRecord| row.iter().any(|cell| is_known(&plain(cell)));
        let has_several = |row: &StringRecord| row.iter().filter(|cell| !cell.is_empty()).count() > 1;
        let is_row = |_: &StringRecord| true;
        let kinds: [&dyn Fn(&StringRecord) -> bool; 3] = [&has_known, &has_several, &is_row];
        let found = kinds.iter().find_map(|is_header| {
            let by = |separator: &u8| {
                let mut rows = reader(text, *separator).into_records().take(HEADER);
                let at = rows.position(|row| row.as_ref().is_ok_and(is_header))?;
                Some((at, *separator))
            };
            b",;\t".iter().filter_map(by).min_by_key(|(at, _)| *at)
        });
        let (above, separator) = found.unwrap_or((0, b','));
        let (mut reader, mut row) = (reader(text, separator), StringRecord::new());
        for _ in 0..=above {
            reader.read_record(&mut row)?;
        }
        let headings: Vec<String> = row.iter().map(str::to_string).collect();
        let names = headings.iter().map(|heading| plain(heading)).collect();
        let lines = Lines { text, byte: 0, count: 1 };
        Ok(CsvText { headings, names, has_decimal_commas: separator != b',', reader, lines })
    }

    /// Takes other headings for columns.
    ///
    /// # Errors
    /// With the first that is not there.
    pub fn rename(&mut self, headings: &Headings) -> std::result::Result<(), String> {
        self.names = headings.renamed(&self.headings, plain)?;
        Ok(())
    }

    /// The rows that are not empty with their lines, in order.
    pub fn rows(self) -> impl Iterator<Item = std::result::Result<(u64, StringRecord), String>> + use<'a> {
        let (has_decimal_commas, columns) = (self.has_decimal_commas, self.headings.len());
        let is_empty = |row: &StringRecord| row.iter().all(str::is_empty);
        let rows = self.reader.into_records().filter(move |row| !row.as_ref().is_ok_and(is_empty));
        let mut lines = self.lines;
        rows.map(move |row| {
            let row = row.map_err(|error| error.to_string())?;
            let byte = row.position().map_or(0, Position::byte);
            let line = lines.of(usize::try_from(byte).unwrap_or(usize::MAX));
            if row.len() != columns {
                return Err(format!(
                    "line {line}: {} cells under {columns} headings; if commas are decimal signs, separate the cells by semicolons",
                    row.len()
                ));
            }
            let with_point = |cell: &str| {
                let point = cell.replace(',', ".");
                if point.trim_end_matches(['%', ' ']).parse::<f64>().is_ok() {
                    point
                } else {
                    cell.to_string()
                }
            };
            let row = if has_decimal_commas { row.iter().map(with_point).collect() } else { row };
            Ok((line, row))
        })
    }
}

/// Reads the rows of a text, the headings too.
fn reader(text: &str, separator: u8) -> Reader<&[u8]> {
    let mut builder = ReaderBuilder::new();
    builder.has_headers(false).flexible(true).comment(Some(b'#')).trim(Trim::All).delimiter(separator);
    builder.from_reader(text.as_bytes())
}

/// A heading as the name of a column: in lower case, with underscores for what is no letter or digit.
pub fn plain(heading: &str) -> String {
    let lower = heading.to_lowercase();
    let words = lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("_")
}
