//! What the heading of a column, or a line above the numbers, says of them: `time_ms`, `Acc. [cm/s^2]`, `# velocity in cm/s`.

use super::numbers::leading_number;
use super::unit::{AccelerationUnit, Unit};

/// What a column holds, as far as its heading says.
#[derive(Debug, Clone, PartialEq)]
pub enum Content {
    Acceleration(Option<AccelerationUnit>),
    /// Times in units of so many seconds.
    Time(f64),
    /// The number of the row.
    Index,
    /// Something else, by name.
    Other(&'static str),
    /// An acceleration in a unit that is of something else.
    NoAcceleration(String),
    /// Times in a unit that is of something else.
    NoTime(String),
    Unknown,
}

impl Content {
    /// Whether the heading says that this is a column of a record.
    pub fn is_known(&self) -> bool {
        !matches!(self, Content::Unknown | Content::Index)
    }
}

/// Words for what a column holds: all of a word, or its beginning.
const WORDS: [(Quantity, &[&str], &[&str]); 4] = [
    (Quantity::Acceleration, &["a", "ag"], &["acc"]),
    (Quantity::Time, &["t", "zeit", "temps"], &["time"]),
    (Quantity::Velocity, &["vg"], &["vel"]),
    (Quantity::Displacement, &["dis", "dg"], &["disp"]),
];
/// Headings of columns that count the rows.
const INDEX: [&str; 8] = ["", "#", "index", "no.", "sample", "samples", "point", "unnamed: 0"];

#[derive(Debug, Clone, Copy, PartialEq)]
enum Quantity {
    Acceleration,
    Time,
    Velocity,
    Displacement,
}

/// Reads the heading of a column.
pub fn content(heading: &str) -> Content {
    let heading = heading.trim().to_lowercase();
    if INDEX.contains(&heading.as_str()) {
        return Content::Index;
    }
    let bracket = bracketed(&heading);
    let unit = bracket.map_or_else(|| at_end(&heading), Unit::named);
    let unit_text = || bracket.unwrap_or(&heading).to_string();
    match (quantity(&heading), unit) {
        (Some(Quantity::Velocity), _) | (None, Some(Unit::Velocity)) => Content::Other("velocity"),
        (Some(Quantity::Displacement), _) => Content::Other("displacement"),
        (None, Some(Unit::Displacement)) if bracket.is_some() => Content::Other("displacement"),
        (None, Some(Unit::Counts)) => Content::Other("counts of an instrument"),
        (Some(Quantity::Acceleration) | None, Some(Unit::Acceleration(unit))) => {
            Content::Acceleration(Some(unit))
        }
        // Brackets may also hold the name of a component.
        (Some(Quantity::Acceleration), None) => Content::Acceleration(None),
        (Some(Quantity::Acceleration), Some(_)) => Content::NoAcceleration(unit_text()),
        (Some(Quantity::Time) | None, Some(Unit::Time(in_s))) => Content::Time(in_s),
        (Some(Quantity::Time), None) if bracket.is_none() => Content::Time(1.0),
        (Some(Quantity::Time), _) => Content::NoTime(unit_text()),
        (None, _) => Content::Unknown,
    }
}

/// What a line above the numbers says of all of them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Note {
    pub unit: Option<AccelerationUnit>,
    /// What they are, if no acceleration.
    pub other: Option<&'static str>,
    pub dt_s: Option<f64>,
}

impl Note {
    /// Reads a line without its comment sign.
    pub fn of(line: &str) -> Note {
        let line = line.trim().to_lowercase();
        let first = line.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("");
        let announced = || ["in", "of", "unit", "units"].iter().find_map(|word| after_word(&line, word));
        let unit = bracketed(&line).and_then(Unit::named).or_else(announced);
        // That of shear waves is one of the site.
        let is_velocity = || line.contains("veloc") && !line.contains("wave");
        let other = match (quantity(first), unit) {
            (Some(Quantity::Velocity), _) => Some("velocity"),
            (Some(Quantity::Displacement), _) => Some("displacement"),
            (_, Some(Unit::Velocity)) if is_velocity() => Some("velocity"),
            _ => None,
        };
        let says_unit = line.contains("unit") || line.contains("acc");
        let unit = match unit {
            Some(Unit::Acceleration(unit)) if says_unit && other.is_none() => Some(unit),
            _ => None,
        };
        Note { unit, other, dt_s: time_step(&line) }
    }
}

/// The time step that a line gives as `dt = 0.01`, in s unless it says ms.
fn time_step(line: &str) -> Option<f64> {
    const KEYS: [&str; 4] = ["dt", "time step", "sampling interval", "delta t"];
    let rest = KEYS.iter().find_map(|key| {
        let (before, rest) = line.split_once(key)?;
        let is_word = !before.ends_with(|c: char| c.is_alphanumeric());
        is_word.then_some(rest)
    })?;
    let is_ms = rest.contains("ms") || rest.contains("millisec");
    let value = leading_number(rest.trim_start_matches(|c: char| !c.is_ascii_digit() && c != '.'))?;
    Some(if is_ms { 1e-3 * value } else { value }).filter(|dt_s| *dt_s > 0.0)
}

fn quantity(text: &str) -> Option<Quantity> {
    let words = || text.split(|c: char| !c.is_alphanumeric());
    let says = |whole: &[&str], beginnings: &[&str]| {
        words().any(|word| whole.contains(&word) || beginnings.iter().any(|start| word.starts_with(start)))
    };
    WORDS.iter().find(|(_, whole, beginnings)| says(whole, beginnings)).map(|(quantity, ..)| *quantity)
}

/// The text in brackets that names a unit, else in the last brackets.
fn bracketed(text: &str) -> Option<&str> {
    let inside = || text.split(['(', '[', '{']).skip(1).filter_map(|rest| rest.split([')', ']', '}']).next());
    inside().find(|inside| Unit::named(inside).is_some()).or_else(|| inside().last())
}

/// The unit with which a text ends after this word, or this word and a sign.
fn after_word(text: &str, word: &str) -> Option<Unit> {
    let (before, rest) = text.rsplit_once(word)?;
    let is_word = !before.ends_with(char::is_alphanumeric) && !rest.starts_with(char::is_alphanumeric);
    is_word.then(|| Unit::named(rest.trim_start_matches([' ', ':', '=']))).flatten()
}

/// The unit with which a text ends, the longest that is one.
fn at_end(text: &str) -> Option<Unit> {
    let starts = text.char_indices().filter(|(_, c)| !c.is_alphanumeric() && *c != '%');
    let starts = std::iter::once(0).chain(starts.map(|(at, c)| at + c.len_utf8()));
    starts.filter_map(|start| text.get(start..)).find_map(Unit::named)
}
