//! The Engineering Strong Motion database's ASCII (DYNA 1.2): lines of `KEY: value`, then one acceleration a line.

use super::error::RecordFileError;
use super::header::{azimuth_of, header_pga, time_step};
use super::numbers::{leading_number, samples};
use super::text::{Line, after, lines, quoted, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, RecordedMotion, SaidUnit};

/// Lines in which the header must come to its end.
const HEADER: usize = 200;

/// Tells whether the header has the key of the sampling interval.
pub fn recognises(text: &str) -> bool {
    header(text).iter().any(|line| value(line, "SAMPLING_INTERVAL_S").is_some())
}

/// Reads the motion of an ESM file.
///
/// # Errors
/// If it holds no acceleration, a key is missing, or the samples are not as announced.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let header = header(text);
    let find = |key| header.iter().find_map(|line| value(line, key).map(|value| (line.number, value)));
    let end = header.last().map_or(0, |line| line.number);
    let missing = |what, expected| RecordFileError::Missing { line: end, what, expected };
    if let Some((line, kind)) = find("DATA_TYPE") {
        let other = |(word, _): &&(&str, &'static str)| after(kind, word).is_some();
        if let Some((_, quantity)) =
            [("VELOCITY", "velocity"), ("DISPLACEMENT", "displacement")].iter().find(other)
        {
            return Err(RecordFileError::NotAcceleration { line, quantity });
        }
    }
    let unit = match find("UNITS") {
        Some((line, unit)) => AccelerationUnit::leading(unit)
            .map(SaidUnit::by_file)
            .ok_or_else(|| RecordFileError::Unit { line, unit: quoted(unit) })?,
        None => given
            .unit
            .map(SaidUnit::by_user)
            .ok_or_else(|| missing("UNITS", "'UNITS: cm/s^2': give it with --unit"))?,
    };
    let number = |key| find(key).and_then(|(line, value)| leading_number(value).map(|number| (line, number)));
    let (line, dt_s) = number("SAMPLING_INTERVAL_S")
        .or(given.dt_s.map(|dt_s| (end, dt_s)))
        .ok_or_else(|| missing("SAMPLING_INTERVAL_S", "the time step: give it with --dt"))?;
    let (_, announced) = number("NDATA")
        .filter(|(_, count)| *count >= 0.0)
        .ok_or_else(|| missing("NDATA", "the number of samples, such as 'NDATA: 18904'"))?;
    let values = samples(lines(text).skip(end), announced as u64, None)?;
    let scale = unit.unit.in_m_s2();
    let stream = find("STREAM").map_or("", |(_, stream)| stream);
    Ok(RecordedMotion {
        dt_s: time_step(dt_s, line)?,
        acceleration_m_s2: values.into_iter().map(|value| value * scale).collect(),
        event: joined(&[find("EVENT_NAME"), find("EVENT_DATE_YYYYMMDD"), find("EVENT_TIME_HHMMSS")]),
        station: joined(&[find("NETWORK"), find("STATION_CODE"), find("STATION_NAME")]),
        component: words(stream),
        azimuth_deg: direction(stream),
        header_pga: find("PGA_CM/S^2")
            .and_then(|(_, peak)| header_pga(peak, AccelerationUnit::CentimetrePerSecond2)),
        unit: Some(unit),
        ..RecordedMotion::default()
    })
}

/// The azimuth that the last letter of a channel code names; a digit names none.
fn direction(stream: &str) -> Option<f64> {
    let (at, _) = stream.char_indices().next_back().filter(|(_, letter)| letter.is_alphabetic())?;
    azimuth_of(stream.get(at..)?)
}

/// The lines of `KEY: value` at the beginning.
fn header(text: &str) -> Vec<Line<'_>> {
    lines(text).take(HEADER).take_while(|line| line.text.contains(':')).collect()
}

fn value<'a>(line: &Line<'a>, key: &str) -> Option<&'a str> {
    let (name, value) = line.text.split_once(':')?;
    (name.trim() == key && !value.trim().is_empty()).then_some(value.trim())
}

fn joined(parts: &[Option<(usize, &str)>]) -> Option<String> {
    words(&parts.iter().flatten().map(|(_, value)| *value).collect::<Vec<_>>().join(" "))
}
