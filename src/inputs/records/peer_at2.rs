//! PEER's AT2: three lines of text, one with NPTS and DT, then accelerations in g. Old files (`ACCELERATION
//! TIME HISTORY IN UNITS OF G`) and NGA files (`ACCELERATION TIME SERIES IN UNITS OF G`).

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::G_M_S2;

use super::ReadOptions;
use super::header::{
    Field, after, azimuth_of, field, header_pga, number, numbers, samples, single_spaced, time_step, unit_of,
};
use crate::inputs::{InputError, Result, plain_number};

/// Largest number of lines before the one with NPTS.
const HEADER: usize = 8;

pub fn recognises(lines: &[&str]) -> bool {
    line_of_counts(lines).is_some()
}

/// Finds the line with NPTS (or NPT) and DT, or with numbers alone below the unit.
fn line_of_counts(lines: &[&str]) -> Option<usize> {
    let header = &lines[..lines.len().min(HEADER)];
    let named = header.iter().position(|line| after(line, "NPT").is_some());
    let unit = header.iter().position(|line| unit_words(line).is_some());
    named.or(unit.map(|at| at + 1).filter(|at| header.get(*at).is_some_and(|line| are_counts(line))))
}

/// Whether a line has a number of samples, a time step, perhaps a third number, and nothing else.
fn are_counts(line: &str) -> bool {
    let numbers: Option<Vec<f64>> = line.split_ascii_whitespace().map(plain_number).collect();
    numbers.is_some_and(|all| matches!(all.len(), 2 | 3) && all[0] > 1.0 && all[0].fract() == 0.0)
}

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let missing = |line, field, expected| InputError::Missing { line, field, expected };
    let at = line_of_counts(lines).ok_or(missing(4, "NPTS", "a line such as 'NPTS= 7818, DT= .0050 SEC'"))?;
    let (header, counts) = (&lines[..at], lines[at]);
    // Below the database and the record.
    let mut others = header.iter().zip(1..).skip(2);
    let is_other = |text: &str| after(text, "VELOCITY").or(after(text, "DISPLACEMENT")).is_some();
    if let Some((text, line)) = others.find(|(text, _)| is_other(text)) {
        return Err(InputError::NotAcceleration { line, found: text.trim().to_string() });
    }
    let unit = header.iter().zip(1..).find_map(|(text, line)| Some(Field { text: unit_words(text)?, line }));
    let unit = unit_of(unit.unwrap_or(Field { line: 3, text: "" }), options)?;
    // By name, or in order in the oldest files (`4000 .0050 NPTS, DT`).
    let mut unnamed = counts.split_ascii_whitespace().map_while(plain_number).fuse();
    let [first, second] = [unnamed.next(), unnamed.next()];
    let named = |key| after(counts, key).and_then(number);
    let announced = named("NPT").or(first).ok_or(missing(at + 1, "NPTS", "the number of samples"))?;
    let dt_s = time_step(named("DT").or(second), options, at + 1)?;
    let values = samples(lines, at + 1, announced, numbers)?;

    // Event, date, station and component, separated by commas; only the date has none inside.
    let title: Vec<&str> = header.get(1).map_or("", |line| line).split(',').map(str::trim).collect();
    let (before, component) = match title.split_last() {
        Some((component, before)) if !before.is_empty() => (before, *component),
        _ => (&title[..], ""),
    };
    let is_date = |part: &&str| part.contains('/') && !part.contains(|c: char| c.is_ascii_alphabetic());
    let date = before.iter().position(is_date);
    let event_parts = date.map_or(1, |date| date + 1).min(before.len());
    let (event, station) = before.split_at(event_parts);
    let origin = Origin {
        azimuth_deg: azimuth_of(component),
        earthquake: single_spaced(&event.join(", ")),
        station: single_spaced(&station.join(", ")),
        component: single_spaced(component),
        ..Origin::default()
    };
    Ok(RecordedMotion {
        header_pga: header_pga(field(header, "PGA").text, G_M_S2),
        ..RecordedMotion::new(dt_s, values, unit, origin)
    })
}

/// The text behind what announces a unit: `IN UNITS OF G`, `Accelerations (g)`.
fn unit_words(line: &str) -> Option<&str> {
    let is_alone = line.trim_start().get(..5).is_some_and(|start| start.eq_ignore_ascii_case("accel"));
    after(line, "UNITS OF").or_else(|| after(line, "(").filter(|_| is_alone)).map(str::trim_start)
}
