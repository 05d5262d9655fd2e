//! PEER's AT2: three lines of text, one with NPTS and DT, then accelerations in g. Old files (`ACCELERATION
//! TIME HISTORY IN UNITS OF G`) and NGA files (`ACCELERATION TIME SERIES IN UNITS OF G`).

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::G_M_S2;

use super::ReadOptions;
use super::header::{
    Field, after, azimuth_of, field, header_pga, number, numbers, samples, single_spaced, time_step, unit_of,
};
use crate::inputs::{InputError, Result, plain_number};

const HEADER: usize = 8;

/// Finds the line with NPTS (or NPT) and DT, or with numbers alone below the unit.
pub fn line_of_counts(lines: &[&str]) -> Option<usize> {
    let header = &lines[..lines.len().min(HEADER)];
    let named = header.iter().position(|line| after(line, "NPT").is_some());
    let are_counts =
        |line| matches!(counts(line), [Some(count), Some(_)] if count > 1.0 && count.fract() == 0.0);
    named.or(unit_field(header).map(|unit| unit.line).filter(|at| header.get(*at).is_some_and(are_counts)))
}

/// Reads the number of samples and the time step: by name, or in order in the oldest files (`4000 .0050 NPTS,
/// DT`).
fn counts(line: &&str) -> [Option<f64>; 2] {
    let mut unnamed = line.split_ascii_whitespace().map_while(plain_number).fuse();
    let named = |key| after(line, key).and_then(number);
    [("NPT", unnamed.next()), ("DT", unnamed.next())].map(|(key, unnamed)| named(key).or(unnamed))
}

/// Finds the text behind what announces a unit: `IN UNITS OF G`, `Accelerations (g)`.
fn unit_field<'a>(header: &[&'a str]) -> Option<Field<'a>> {
    let is_alone = |line: &str| line.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("accel"));
    header.iter().zip(1..).find_map(|(text, line)| {
        let text = after(text, "UNITS OF").or(after(text, "(").filter(|_| is_alone(text.trim_start())))?;
        Some(Field { text: text.trim(), line })
    })
}

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let missing = |line, field, expected| InputError::Missing { line, field, expected };
    let at = line_of_counts(lines).ok_or(missing(4, "NPTS", "a line such as 'NPTS= 7818, DT= .0050 SEC'"))?;
    let header = &lines[..at];
    // Below the database and the record.
    let mut others = header.iter().zip(1..).skip(2);
    let is_other = |text: &str| after(text, "VELOCITY").or(after(text, "DISPLACEMENT")).is_some();
    if let Some((text, line)) = others.find(|(text, _)| is_other(text)) {
        return Err(InputError::NotAcceleration { line, found: text.trim().to_string() });
    }
    let unit = unit_of(unit_field(header).unwrap_or(Field { line: 3, text: "" }), options)?;
    let [announced, step] = counts(&lines[at]);
    let announced = announced.ok_or(missing(at + 1, "NPTS", "the number of samples"))?;
    let dt_s = time_step(step, options, at + 1)?;
    let values = samples(lines, at + 1, announced, numbers)?;

    // Event, date, station and component, separated by commas; only the date has none inside.
    let title = header.get(1).copied().unwrap_or_default();
    let (before, component) = title.rsplit_once(',').unwrap_or((title, ""));
    let before: Vec<&str> = before.split(',').map(str::trim).collect();
    let is_date = |part: &&str| part.contains('/') && !part.contains(|c: char| c.is_ascii_alphabetic());
    let date = before.iter().position(is_date).unwrap_or(0);
    let (event, station) = before.split_at(date + 1);
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
