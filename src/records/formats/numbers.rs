//! Numbers as Fortran and people write them, one by one and in blocks of an announced length.

use super::error::RecordFileError;
use super::text::{Line, quoted};

/// The numbers of a line in order: separated by blanks, tabs, commas or semicolons, or run together where a sign or a point
/// shows that the next one begins; with exponents of E, D or Q, or as Fortran writes them when they have three digits
/// (`0.1-101`) or a blank for the plus (`1.0E 02`).
pub struct Numbers<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Numbers<'a> {
    pub fn of(text: &'a str) -> Numbers<'a> {
        Numbers { text, at: 0 }
    }

    fn byte(&self, at: usize) -> u8 {
        self.text.as_bytes().get(at).copied().unwrap_or(b' ')
    }

    fn after_digits(&self, mut at: usize) -> usize {
        while self.byte(at).is_ascii_digit() {
            at += 1;
        }
        at
    }

    /// Finds the end of the mantissa that begins at `start`; none if none begins.
    fn mantissa_end(&self, start: usize) -> Option<usize> {
        let digits = start + usize::from(is_sign(self.byte(start)));
        let whole_end = self.after_digits(digits);
        let has_point = self.byte(whole_end) == b'.';
        let end = if has_point { self.after_digits(whole_end + 1) } else { whole_end };
        (end - digits > usize::from(has_point)).then_some(end)
    }

    /// Finds the exponent that begins at `at`: where its digits start, and where they end.
    fn exponent(&self, at: usize) -> Option<(usize, usize)> {
        let letter = matches!(self.byte(at), b'e' | b'E' | b'd' | b'D' | b'q' | b'Q');
        let signed = at + usize::from(letter);
        let blank_for_plus = letter && self.byte(signed) == b' ';
        let digits = signed + usize::from(is_sign(self.byte(signed)) || blank_for_plus);
        let end = self.after_digits(digits);
        let complete = if letter {
            end > digits
        } else {
            // Without a letter only three digits make an exponent: anything else is the next number.
            digits > signed && end - digits == 3 && self.byte(end) != b'.'
        };
        let start = if blank_for_plus { digits } else { signed };
        complete.then_some((start, end))
    }

    fn value(&self, start: usize, mantissa_end: usize, exponent: Option<(usize, usize)>) -> Option<f64> {
        let mantissa = self.text.get(start..mantissa_end)?;
        let value = match exponent {
            None => mantissa.parse(),
            Some((from, to)) => format!("{mantissa}e{}", self.text.get(from..to)?).parse(),
        };
        value.ok().filter(|value: &f64| value.is_finite())
    }

    /// Returns what stands at `start` up to the next separator, for a message.
    fn word(&self, start: usize) -> &'a str {
        let rest = self.text.get(start..).unwrap_or("");
        rest.split(|c: char| c.is_ascii() && is_separator(c as u8)).next().unwrap_or(rest)
    }
}

impl<'a> Iterator for Numbers<'a> {
    /// A finite number, or the text that is none.
    type Item = Result<f64, &'a str>;

    fn next(&mut self) -> Option<Result<f64, &'a str>> {
        while self.at < self.text.len() && is_separator(self.byte(self.at)) {
            self.at += 1;
        }
        if self.at >= self.text.len() {
            return None;
        }
        let start = self.at;
        let read = self.mantissa_end(start).and_then(|mantissa_end| {
            let exponent = self.exponent(mantissa_end);
            let end = exponent.map_or(mantissa_end, |(_, end)| end);
            let next = self.byte(end);
            let ends_here = is_separator(next) || is_sign(next) || next == b'.';
            let value = if ends_here { self.value(start, mantissa_end, exponent) } else { None };
            value.map(|value| (value, end))
        });
        match read {
            Some((value, end)) => {
                self.at = end;
                Some(Ok(value))
            }
            None => {
                let word = self.word(start);
                self.at = start + word.len().max(1);
                Some(Err(word))
            }
        }
    }
}

/// Reads the first number in a text, whatever stands before it.
pub fn first_number(text: &str) -> Option<f64> {
    let starts = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.');
    text.match_indices(starts).find_map(|(at, _)| leading_number(text.get(at..)?))
}

/// Reads the number with which a text begins, though letters may follow it at once (`100Hz`).
pub fn leading_number(text: &str) -> Option<f64> {
    let numbers = Numbers::of(text.trim_start());
    let mantissa_end = numbers.mantissa_end(0)?;
    numbers.value(0, mantissa_end, numbers.exponent(mantissa_end))
}

fn is_sign(byte: u8) -> bool {
    matches!(byte, b'+' | b'-')
}

fn is_separator(byte: u8) -> bool {
    // Form feeds and the end-of-file mark of old systems stand in real files.
    matches!(byte, b' ' | b'\t' | b',' | b';' | b'\r' | b'\x0c' | b'\x1a' | b'\0')
}

/// How a Fortran program laid out numbers: so many on a line, each so many characters wide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout {
    pub on_line: usize,
    /// Characters of each number.
    pub width: usize,
}

impl Layout {
    /// Reads a Fortran format such as `(8F10.5)`, `(10I8)` or `(1E15.6)`, the last one in a text.
    pub fn in_text(text: &str) -> Option<Layout> {
        let inside = text.get(text.rfind('(')? + 1..)?.split(')').next()?;
        let letter = inside.find(|c: char| matches!(c.to_ascii_uppercase(), 'F' | 'E' | 'D' | 'G' | 'I'))?;
        let (count, width) = inside.split_at(letter);
        let width = width.get(1..)?.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()?;
        let on_line = if count.trim().is_empty() { 1 } else { count.trim().parse().ok()? };
        (on_line > 0 && width > 0).then_some(Layout { on_line, width })
    }

    /// Counts the lines that `count` numbers take.
    pub fn lines(&self, count: u64) -> u64 {
        count.div_ceil(self.on_line as u64)
    }
}

/// Numbers in order, and how many of them stand on the last line.
#[derive(Default)]
struct Block {
    values: Vec<f64>,
    on_last_line: usize,
}

/// Reads the announced number of samples from these lines: by the width of numbers where the file says it, since they may stand
/// without a gap; but files whose blanks were changed later do not keep to it, and are read as numbers that anything
/// parts. Surplus numbers that only fill the last line are padding.
///
/// # Errors
/// If something is no number, or the count is wrong.
pub fn samples<'a>(
    lines: impl Iterator<Item = Line<'a>> + Clone,
    announced: u64,
    layout: Option<Layout>,
) -> Result<Vec<f64>, RecordFileError> {
    let by_width = layout.map(|layout| read(lines.clone(), |text| fields(text, layout.width)));
    let block = match by_width {
        Some(Ok(block)) if fits(&block, announced) => block,
        _ => read(lines, Numbers::of)?,
    };
    let found = block.values.len();
    if !fits(&block, announced) {
        return Err(RecordFileError::Count { announced, found });
    }
    let mut values = block.values;
    values.truncate(usize::try_from(announced).unwrap_or(found));
    if values.len() < 2 { Err(RecordFileError::TooShort { found: values.len() }) } else { Ok(values) }
}

fn fits(block: &Block, announced: u64) -> bool {
    let found = block.values.len() as u64;
    found >= announced && found - announced < block.on_last_line.max(1) as u64
}

/// Splits a line into numbers by their places: fields of one width, of which the last may be shorter.
fn fields(text: &str, width: usize) -> impl Iterator<Item = Result<f64, &str>> {
    let text = text.trim_end();
    let field = move |k: usize| text.get(k * width..((k + 1) * width).min(text.len())).unwrap_or(text);
    (0..text.len().div_ceil(width)).map(field).map(|field| {
        let mut numbers = Numbers::of(field);
        match (numbers.next(), numbers.next()) {
            (Some(Ok(value)), None) => Ok(value),
            _ => Err(field),
        }
    })
}

fn read<'a, N: Iterator<Item = Result<f64, &'a str>>>(
    lines: impl Iterator<Item = Line<'a>>,
    numbers: impl Fn(&'a str) -> N,
) -> Result<Block, RecordFileError> {
    let mut block = Block::default();
    for line in lines {
        let before = block.values.len();
        for number in numbers(line.text) {
            let no_number = |text| RecordFileError::NoNumber { line: line.number, text: quoted(text) };
            block.values.push(number.map_err(no_number)?);
        }
        if block.values.len() > before {
            block.on_last_line = block.values.len() - before;
        }
    }
    Ok(block)
}
