//! Plain numbers: CSV, a column of time and one of acceleration, or one series that wraps from line to line. Lines that
//! begin with `#` or `%` are comments, those before the first line of numbers a header.

use super::error::RecordFileError;
use super::header::time_step;
use super::numbers::Numbers;
use super::text::{Line, lines, quoted};
use crate::records::{ColumnChoice, Given, RecordedMotion};

/// The share by which a step of time may differ from the usual one: the times of many files are rounded.
const UNEVEN: f64 = 0.05;

/// Tells whether a line at the beginning holds numbers and nothing else.
pub fn recognises(text: &str) -> bool {
    lines(text).take(50).any(is_row)
}

/// Reads the motion in a file of plain numbers.
///
/// # Errors
/// If it is unclear which column counts, or what its unit or time step is.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let table = Table::read(text, given.column.as_ref() == Some(&ColumnChoice::All))?;
    let unit = given.unit.ok_or(RecordFileError::Missing {
        line: table.first_line,
        what: "unit",
        expected: "--unit, such as --unit g: plain numbers do not say theirs",
    })?;
    let column = table.acceleration_column(given.column.as_ref())?;
    let dt_s = match (given.dt_s, column) {
        (Some(dt_s), _) => dt_s,
        (None, 1..) => table.time_step()?,
        (None, 0) => {
            return Err(RecordFileError::Missing {
                line: table.first_line,
                what: "time step",
                expected: "--dt, such as --dt 0.005, or a first column of times",
            });
        }
    };
    let scale = unit.in_m_s2();
    let acceleration_m_s2: Vec<f64> = table.column(column).map(|value| value * scale).collect();
    if acceleration_m_s2.len() < 2 {
        return Err(RecordFileError::TooShort { found: acceleration_m_s2.len() });
    }
    Ok(RecordedMotion {
        dt_s: time_step(dt_s, table.first_line)?,
        acceleration_m_s2,
        component: table.names.get(column).filter(|name| !name.is_empty()).cloned(),
        ..RecordedMotion::default()
    })
}

/// A table of numbers, row after row.
struct Table {
    names: Vec<String>,
    first_line: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Table {
    fn read(text: &str, wraps: bool) -> Result<Table, RecordFileError> {
        let mut table = Table { names: Vec::new(), first_line: 1, columns: 0, values: Vec::new() };
        for line in lines(text).filter(|line| !is_comment(line)) {
            if table.columns == 0 && !is_row(line) {
                table.names = names(line.text);
                continue;
            }
            let before = table.values.len();
            for number in Numbers::of(line.text) {
                let no_number = |text| RecordFileError::NoNumber { line: line.number, text: quoted(text) };
                table.values.push(number.map_err(no_number)?);
            }
            let found = table.values.len() - before;
            if table.columns == 0 {
                table.first_line = line.number;
                table.columns = if wraps { 1 } else { found };
            }
            if !wraps && found != table.columns {
                return Err(RecordFileError::Ragged { line: line.number, found, columns: table.columns });
            }
        }
        if table.columns == 0 { Err(RecordFileError::TooShort { found: 0 }) } else { Ok(table) }
    }

    /// Finds the place of the acceleration, from 0.
    fn acceleration_column(&self, choice: Option<&ColumnChoice>) -> Result<usize, RecordFileError> {
        let Table { first_line: line, columns, .. } = *self;
        let place = match choice {
            Some(ColumnChoice::Number(number)) => number.checked_sub(1),
            Some(ColumnChoice::Name(name)) => self.names.iter().position(|known| known == name),
            Some(ColumnChoice::All) => Some(0),
            None if columns <= 2 => Some(columns - 1),
            None => return Err(RecordFileError::WhichColumn { line, columns }),
        };
        let missing = || RecordFileError::NoColumn {
            line,
            column: choice.map(ToString::to_string).unwrap_or_default(),
            columns,
        };
        place.filter(|place| *place < columns).ok_or_else(missing)
    }

    fn column(&self, place: usize) -> impl Iterator<Item = f64> {
        self.values.iter().skip(place).step_by(self.columns).copied()
    }

    /// Computes the time step from the first column, which must hold even times.
    fn time_step(&self) -> Result<f64, RecordFileError> {
        let times: Vec<f64> = self.column(0).collect();
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut ordered = steps.clone();
        ordered.sort_by(f64::total_cmp);
        let usual =
            *ordered.get(ordered.len() / 2).ok_or(RecordFileError::TooShort { found: times.len() })?;
        match steps.iter().position(|step| (step - usual).abs() > UNEVEN * usual.abs()) {
            Some(index) => Err(RecordFileError::UnevenTime {
                line: self.first_line + index + 1,
                step_s: steps[index],
                dt_s: usual,
            }),
            None => Ok(steps.iter().sum::<f64>() / steps.len() as f64),
        }
    }
}

fn is_comment(line: &Line) -> bool {
    let text = line.text.trim_start();
    text.is_empty() || text.starts_with(['#', '%'])
}

fn is_row(line: Line) -> bool {
    let mut numbers = Numbers::of(line.text).peekable();
    !is_comment(&line) && numbers.peek().is_some() && numbers.all(|number| number.is_ok())
}

/// Splits a line of names at commas, else semicolons, else tabs, else blanks.
fn names(text: &str) -> Vec<String> {
    let separator = [',', ';', '\t'].into_iter().find(|separator| text.contains(*separator));
    let name = |name: &str| name.trim().trim_matches('"').to_string();
    match separator {
        Some(separator) => text.split(separator).map(name).collect(),
        None => text.split_whitespace().map(name).collect(),
    }
}
