//! Plain numbers as rows and columns, with the lines above them.

use std::borrow::Cow;

use super::error::RecordFileError;
use super::heading::content;
use super::numbers::Numbers;
use super::text::{Line, lines, quoted};

/// A table of numbers, row after row.
pub struct Table {
    /// The headings of the columns, if there is one for each; headings on several lines are joined.
    pub names: Vec<String>,
    /// The headings as they stand in single lines.
    headings: Vec<Vec<String>>,
    /// Comments and lines of words above the numbers.
    pub notes: Vec<String>,
    pub first_line: usize,
    pub columns: usize,
    values: Vec<f64>,
}

impl Table {
    /// Reads the lines of numbers after those of words: as one column if they only `wrap`.
    ///
    /// # Errors
    /// If a line holds something else, or more or fewer numbers than the first, or if there are other names than columns.
    pub fn read(text: &str, wraps: bool) -> Result<Table, RecordFileError> {
        let mut notes = Vec::new();
        let mut body = lines(text);
        // Lines that only look like numbers begin them where no better ones come.
        let has_rows = lines(text).take(HEADER).any(|line| is_row(line.text));
        let begins = |line: &Line| if has_rows { is_row(line.text) } else { begins_numbers(line.text) };
        let first = loop {
            match body.next() {
                None => return Err(RecordFileError::TooShort { found: 0 }),
                Some(line) if begins(&line) => break line,
                Some(line) => notes.push(line),
            }
        };
        let separator = Separator::of(first)?;
        let mut table = Table {
            names: Vec::new(),
            headings: Vec::new(),
            notes: Vec::new(),
            first_line: first.number,
            columns: 0,
            values: Vec::new(),
        };
        for line in std::iter::once(first).chain(body).filter(|line| !is_comment(line.text)) {
            let found = table.add(line, separator)?;
            // Spreadsheets end in lines of separators alone.
            if found == 0 {
                continue;
            }
            if table.columns == 0 {
                table.columns = if wraps { 1 } else { found };
            }
            if !wraps && found != table.columns {
                return Err(RecordFileError::Ragged { line: line.number, found, columns: table.columns });
            }
        }
        table.head(notes, separator)?;
        Ok(table)
    }

    /// Adds the numbers of a line, and gives how many there are.
    fn add(&mut self, line: Line, separator: Separator) -> Result<usize, RecordFileError> {
        let before = self.values.len();
        for number in Numbers::of(&separator.plain(line)?) {
            let no_number = |text| RecordFileError::no_number(line.number, quoted(text));
            self.values.push(number.map_err(no_number)?);
        }
        Ok(self.values.len() - before)
    }

    /// Parts the lines above the numbers into headings and notes.
    fn head(&mut self, above: Vec<Line>, separator: Separator) -> Result<(), RecordFileError> {
        let last = above.iter().rev().find(|line| !line.text.trim().is_empty()).map(|line| line.number);
        for line in above {
            let text = line.text.trim_start_matches(['#', '%', ' ', '\t']);
            let names = separator.names(text);
            let is_last = Some(line.number) == last;
            let known = names.iter().filter(|name| content(name).is_known()).count();
            // Words between blanks may as well be a sentence.
            let is_sentence = !text.contains([',', ';', '\t']);
            let are_headings =
                names.len() == self.columns && (is_last || self.columns > 1) && (known > 0 || !is_sentence);
            if is_last && !are_headings && known > 1 && (known == names.len() || !is_sentence) {
                let (names, columns) = (names.len(), self.columns);
                return Err(RecordFileError::Headings { line: line.number, names, columns });
            }
            if is_sentence || !are_headings || is_comment(line.text) {
                self.notes.push(text.to_string());
            }
            if are_headings {
                self.headings.push(names);
            }
        }
        if !self.headings.is_empty() {
            let joined = |column: usize| {
                let mut parts: Vec<&str> = self.headings.iter().map(|row| row[column].as_str()).collect();
                parts.dedup();
                parts.join(" ").trim().to_string()
            };
            self.names = (0..self.columns).map(joined).collect();
        }
        Ok(())
    }

    /// Finds the column of this name, from 0.
    pub fn place_of(&self, name: &str) -> Option<usize> {
        let known = |row: &Vec<String>| row.iter().position(|known| known == name);
        known(&self.names).or_else(|| self.headings.iter().find_map(known))
    }

    pub fn column(&self, place: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(place).step_by(self.columns).copied()
    }
}

/// Lines in which numbers must begin.
const HEADER: usize = 50;

/// What parts the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Comma,
    /// A semicolon or a tab; a comma is then a decimal one.
    Other(char),
    Blank,
}

impl Separator {
    fn of(line: Line) -> Result<Separator, RecordFileError> {
        let text = line.text;
        if let Some(other) = [';', '\t'].into_iter().find(|separator| text.contains(*separator)) {
            return Ok(Separator::Other(other));
        }
        if !text.contains(',') {
            return Ok(Separator::Blank);
        }
        let is_decimal =
            |word: &str| word.split(',').count() == 2 && word.chars().all(|c| !matches!(c, '.' | '"'));
        let mut words = text.split_whitespace();
        if text.split_whitespace().count() > 1 && words.all(|word| is_decimal(word) && !word.ends_with(',')) {
            return Err(RecordFileError::DecimalComma { line: line.number, text: quoted(text) });
        }
        Ok(Separator::Comma)
    }

    fn letter(self) -> Option<char> {
        match self {
            Separator::Comma => Some(','),
            Separator::Other(separator) => Some(separator),
            Separator::Blank => None,
        }
    }

    /// The numbers of a line with decimal points and without quotes.
    fn plain(self, line: Line<'_>) -> Result<Cow<'_, str>, RecordFileError> {
        let Some(separator) = self.letter() else { return Ok(Cow::Borrowed(line.text)) };
        let text = line.text.trim_end_matches([' ', '\t', '\r', '\x1a', separator]);
        let empty = text.split(separator).position(|field| field.trim().is_empty());
        if let Some(column) = empty.filter(|_| separator != '\t' && !text.is_empty()) {
            return Err(RecordFileError::EmptyField { line: line.number, column: column + 1 });
        }
        let is_plain = !text.contains('"') && (separator == ',' || !text.contains(','));
        if is_plain {
            return Ok(Cow::Borrowed(text));
        }
        let plain = |field: String| match (field.matches(',').count(), field.contains('.')) {
            (0, _) => Ok(field),
            (1, false) if separator != ',' => Ok(field.replace(',', ".")),
            _ => Err(RecordFileError::no_number(line.number, quoted(&field))),
        };
        let fields: Result<Vec<String>, _> = split(text, separator).into_iter().map(plain).collect();
        Ok(Cow::Owned(fields?.join(" ")))
    }

    /// Splits a line of names: as the numbers are, or at the separator that it has; brackets belong to the word before them.
    fn names(self, text: &str) -> Vec<String> {
        let mut separators = self.letter().into_iter().chain([';', '\t', ',']);
        let known = separators.find(|separator| text.contains(*separator));
        if let Some(separator) = known {
            let mut names = split(text, separator);
            // As numbers do, names may end with a separator.
            if names.len() > 1 && names.last().is_some_and(String::is_empty) {
                names.pop();
            }
            return names;
        }
        let mut names: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            match names.last_mut() {
                Some(before)
                    if word.starts_with(['(', '['])
                        || before.matches(['(', '[']).count() > before.matches([')', ']']).count() =>
                {
                    before.push(' ');
                    before.push_str(word);
                }
                _ => names.push(word.trim_matches('"').to_string()),
            }
        }
        names
    }
}

/// Splits a line at separators that stand outside of quotes.
fn split(text: &str, separator: char) -> Vec<String> {
    let mut is_quoted = false;
    let fields = text.split(|c: char| {
        is_quoted ^= c == '"';
        c == separator && !is_quoted
    });
    fields.map(|field| field.trim().trim_matches('"').trim().to_string()).collect()
}

fn is_comment(text: &str) -> bool {
    let text = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\x1a');
    text.is_empty() || text.starts_with(['#', '%'])
}

fn is_row(text: &str) -> bool {
    let unquoted = if text.contains('"') { Cow::Owned(text.replace('"', " ")) } else { Cow::Borrowed(text) };
    let mut numbers = Numbers::of(&unquoted).peekable();
    !is_comment(text) && numbers.peek().is_some() && numbers.all(|number| number.is_ok())
}

/// Whether a line holds numbers, or what is meant to be some: dates, times of day, `NaN`.
pub fn begins_numbers(text: &str) -> bool {
    let mut words = text.split([',', ';', '\t', ' ', '"']).filter(|word| !word.is_empty()).peekable();
    let is_meant = |word: &str| {
        let word = word.to_ascii_lowercase();
        word.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'))
            || matches!(word.as_str(), "nan" | "inf" | "na" | "null")
    };
    is_row(text)
        || (!is_comment(text)
            && text.contains(|c: char| c.is_ascii_digit())
            && words.peek().is_some()
            && words.all(is_meant))
}
