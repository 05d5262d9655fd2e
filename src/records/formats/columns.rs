//! Plain numbers: CSV, a column of time and one of acceleration, or one series that wraps from line to line. Lines that
//! begin with `#` or `%` are comments, those before the first line of numbers a header. What headings and comments say of units,
//! times and contents counts, and may not contradict what the user says.

use super::error::RecordFileError;
use super::header::time_step;
use super::heading::{Content, Note, content};
use super::table::{Table, begins_numbers};
use super::text::lines;
use super::times::Times;
use crate::records::{ColumnChoice, Given, RecordedMotion, SaidUnit};

/// The share by which a time step may differ from the one that the user gives.
const SAME_STEP: f64 = 0.01;

/// Tells whether a line at the beginning holds numbers, or what is meant to be some, and nothing else.
pub fn recognises(text: &str) -> bool {
    lines(text).take(50).any(|line| begins_numbers(line.text))
}

/// Reads the motion in a file of plain numbers.
///
/// # Errors
/// If it is unclear which column counts, or what its unit or time step is; or if the file and the user contradict each other.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let wraps = given.column == Some(ColumnChoice::All);
    let table = Table::read(text, wraps)?;
    let columns = Columns::of(&table);
    if let Some(Content::NoTime(unit)) =
        columns.contents.iter().find(|content| matches!(content, Content::NoTime(_)))
    {
        return Err(RecordFileError::TimeUnit { line: columns.above(), unit: unit.clone() });
    }
    let column = columns.acceleration(given.column.as_ref())?;
    let unit = columns.unit(column, given)?;
    let dt_s = columns.time_step(column, given, wraps)?;
    let scale = unit.unit.in_m_s2();
    let acceleration_m_s2: Vec<f64> = table.column(column).map(|value| value * scale).collect();
    if acceleration_m_s2.len() < 2 {
        return Err(RecordFileError::TooShort { found: acceleration_m_s2.len() });
    }
    Ok(RecordedMotion {
        dt_s: time_step(dt_s, table.first_line)?,
        acceleration_m_s2,
        component: table.names.get(column).filter(|name| !name.is_empty()).cloned(),
        unit: Some(unit),
        ..RecordedMotion::default()
    })
}

/// The columns of a table, and what the lines above them say.
struct Columns<'a> {
    table: &'a Table,
    contents: Vec<Content>,
    note: Note,
}

impl Columns<'_> {
    fn of(table: &Table) -> Columns<'_> {
        let mut contents: Vec<Content> = table.names.iter().map(|name| content(name)).collect();
        contents.resize(table.columns, Content::Unknown);
        for (place, known) in contents.iter_mut().enumerate() {
            let named = table.names.get(place).is_some_and(|name| !name.is_empty());
            match known {
                // The first column of a data frame has no name, and may be its times.
                Content::Index if !named && !counts_rows(table, place) => *known = Content::Unknown,
                Content::Unknown if !named && place == 0 && counts_rows(table, 0) => *known = Content::Index,
                // Further to the right, T is the transverse component.
                Content::Time(_) if place > 0 && table.names[place].eq_ignore_ascii_case("t") => {
                    *known = Content::Unknown;
                }
                _ => {}
            }
        }
        let mut note = Note::default();
        for line in &table.notes {
            let Note { unit, other, dt_s } = Note::of(line);
            note = Note { unit: note.unit.or(unit), other: note.other.or(other), dt_s: note.dt_s.or(dt_s) };
        }
        Columns { table, contents, note }
    }

    /// The last line above the numbers.
    fn above(&self) -> usize {
        self.table.first_line.max(2) - 1
    }

    /// Finds the place of the times, from 0: the column of that name, or else the first one if it rises.
    fn times(&self) -> Option<usize> {
        let named = self.contents.iter().position(|content| matches!(content, Content::Time(_)));
        let rises = || {
            let times = || self.table.column(0);
            let is_open = self.table.columns > 1 && self.contents[0] == Content::Unknown;
            is_open && times().zip(times().skip(1)).all(|(time, next)| next > time)
        };
        named.or_else(|| rises().then_some(0))
    }

    /// Finds the place of the acceleration, from 0.
    fn acceleration(&self, choice: Option<&ColumnChoice>) -> Result<usize, RecordFileError> {
        let Table { first_line: line, columns, ref names, .. } = *self.table;
        let place = match choice {
            Some(ColumnChoice::Number(number)) => number.checked_sub(1),
            Some(ColumnChoice::Name(name)) => self.table.place_of(name),
            Some(ColumnChoice::All) => Some(0),
            None => Some(self.only_acceleration()?),
        };
        let missing = || RecordFileError::NoColumn {
            line,
            column: choice.map(ToString::to_string).unwrap_or_default(),
            columns: listed(names, columns),
        };
        let place = place.filter(|place| *place < columns).ok_or_else(missing)?;
        let quantity = match &self.contents[place] {
            Content::Other(quantity) => Some(*quantity),
            Content::Time(_) => Some("time"),
            Content::Unknown if choice.is_none() => self.note.other,
            _ => None,
        };
        match quantity {
            Some(quantity) => Err(RecordFileError::NotAcceleration { line: self.above(), quantity }),
            None => Ok(place),
        }
    }

    /// The column that must be the acceleration: the one of that name, or the only one that is nothing else.
    fn only_acceleration(&self) -> Result<usize, RecordFileError> {
        let Table { first_line: line, columns, ref names, .. } = *self.table;
        let places = |is: &dyn Fn(usize, &Content) -> bool| -> Vec<usize> {
            let found = self.contents.iter().enumerate().filter(|(place, content)| is(*place, content));
            found.map(|(place, _)| place).collect()
        };
        let named =
            places(&|_, content| matches!(content, Content::Acceleration(_) | Content::NoAcceleration(_)));
        let times = self.times();
        let open = || places(&|place, content| *content == Content::Unknown && Some(place) != times);
        let candidates = if named.is_empty() { open() } else { named };
        match candidates[..] {
            [place] => Ok(place),
            // What is there instead is named by who asks for it.
            [] => {
                Ok(places(&|_, content| matches!(content, Content::Other(_))).first().copied().unwrap_or(0))
            }
            _ => Err(RecordFileError::WhichColumn { line, columns: listed(names, columns) }),
        }
    }

    /// The unit that the heading or a note says, or else the user.
    fn unit(&self, column: usize, given: &Given) -> Result<SaidUnit, RecordFileError> {
        let line = self.table.first_line;
        let said = match &self.contents[column] {
            Content::Acceleration(Some(unit)) => Some(*unit),
            Content::NoAcceleration(unit) => {
                return Err(RecordFileError::NoAccelerationUnit { line: self.above(), unit: unit.clone() });
            }
            _ => self.note.unit,
        };
        match (said, given.unit) {
            (Some(said), Some(given)) if said != given => {
                Err(RecordFileError::OtherUnit { line: self.above(), said, given })
            }
            (Some(unit), _) => Ok(SaidUnit::by_file(unit)),
            (None, Some(unit)) => Ok(SaidUnit::by_user(unit)),
            (None, None) => Err(RecordFileError::Missing {
                line,
                what: "unit",
                expected: "a heading such as 'acc (m/s2)', or --unit, such as --unit g",
            }),
        }
    }

    /// The time step of the times, or of a note, or else what the user says.
    fn time_step(&self, column: usize, given: &Given, wraps: bool) -> Result<f64, RecordFileError> {
        let line = self.table.first_line;
        let times = self.times().filter(|times| !wraps && *times != column);
        let said = match times.map(|times| self.times_of(times)) {
            Some(times) => match (times.step_s(), given.dt_s) {
                // The user says what rounded times are meant to be.
                (Err(_), Some(given_s)) => times.expect_steps(given_s).map(|()| None)?,
                (step_s, _) => Some(step_s?),
            },
            None => self.note.dt_s,
        };
        match (said, given.dt_s) {
            (Some(said), Some(given)) if (said - given).abs() > SAME_STEP * given => {
                Err(RecordFileError::OtherTimeStep { line, said_s: said, given_s: given })
            }
            (Some(step), None) => Ok(step),
            (_, Some(given)) => Ok(given),
            (None, None) => Err(RecordFileError::Missing {
                line,
                what: "time step",
                expected: "--dt, such as --dt 0.005, or a column of times",
            }),
        }
    }

    fn times_of(&self, column: usize) -> Times {
        let in_s = if let Content::Time(in_s) = self.contents[column] { in_s } else { 1.0 };
        Times::new(self.table.column(column).collect(), in_s, self.table.first_line)
    }
}

/// Whether a column counts the rows: 0, 1, 2, or 1, 2, 3.
fn counts_rows(table: &Table, column: usize) -> bool {
    let values = || table.column(column);
    table.columns > 1
        && values().next().is_some_and(|first| first == 0.0 || first == 1.0)
        && values().zip(values().skip(1)).all(|(value, next)| next - value == 1.0)
}

/// How many columns there are, and their names where they have some.
fn listed(names: &[String], columns: usize) -> String {
    if names.is_empty() {
        format!("{columns} columns")
    } else {
        format!("{columns} columns ({})", names.join(", "))
    }
}
