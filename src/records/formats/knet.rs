//! K-NET and KiK-net ASCII: lines of a key and a value, then integers which the scale factor makes gal. Their zero means
//! nothing, so the mean is removed; the header's peak is about the mean as well.

use super::error::RecordFileError;
use super::header::{header_pga, time_step};
use super::numbers::{first_number, leading_number, samples};
use super::text::{Line, after, lines, quoted, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, RecordedMotion, SaidUnit};

/// Lines in which the header must come to its end.
const HEADER: usize = 40;
/// The directions of K-NET by name and of KiK-net by number, in the borehole and at the surface: component, azimuth, and
/// where at the station.
const DIRECTIONS: [(&str, &str, Option<f64>, &str); 9] = [
    ("N-S", "N-S", Some(0.0), ""),
    ("E-W", "E-W", Some(90.0), ""),
    ("U-D", "U-D", None, ""),
    ("1", "N-S", Some(0.0), "borehole"),
    ("2", "E-W", Some(90.0), "borehole"),
    ("3", "U-D", None, "borehole"),
    ("4", "N-S", Some(0.0), "surface"),
    ("5", "E-W", Some(90.0), "surface"),
    ("6", "U-D", None, "surface"),
];

/// Tells whether it begins as all of them do.
pub fn recognises(text: &str) -> bool {
    lines(text).next().is_some_and(|line| value(line, "Origin Time").is_some())
}

/// Reads the motion of a K-NET or KiK-net file.
///
/// # Errors
/// If a key is missing or the samples are not as announced.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let memo = lines(text).take(HEADER).find(|line| value(*line, "Memo").is_some());
    let end = memo.ok_or(RecordFileError::Missing {
        line: HEADER,
        what: "line 'Memo.'",
        expected: "it at the end of the header: get the file again",
    })?;
    let find = |key| lines(text).take(end.number).find_map(|line| Some((line.number, value(line, key)?)));
    let missing = |what, expected| RecordFileError::Missing { line: end.number, what, expected };
    let (line, dt_s) = match (find("Sampling Freq(Hz)"), given.dt_s) {
        (Some((line, frequency)), _) => (line, 1.0 / leading_number(frequency).unwrap_or(0.0)),
        (None, Some(dt_s)) => (end.number, dt_s),
        (None, None) => {
            return Err(missing("Sampling Freq(Hz)", "such a line: give the time step with --dt"));
        }
    };
    let dt_s = time_step(dt_s, line)?;
    let gal = scale(find("Scale Factor").ok_or_else(|| missing("Scale Factor", "'2000(gal)/8388608'"))?)?;
    let duration_s = find("Duration Time(s)").and_then(|(_, duration)| leading_number(duration));
    let announced = duration_s.ok_or_else(|| missing("Duration Time(s)", "a duration in seconds"))? / dt_s;
    let counts = samples(lines(text).skip(end.number), announced.round() as u64, None)?;
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    let scale = gal * AccelerationUnit::CentimetrePerSecond2.in_m_s2();
    let direction = find("Dir.").map_or("", |(_, direction)| direction);
    let known = DIRECTIONS.iter().find(|(code, ..)| *code == direction);
    let place = known.map_or("", |(.., place)| place);
    Ok(RecordedMotion {
        dt_s,
        acceleration_m_s2: counts.into_iter().map(|count| (count - mean) * scale).collect(),
        event: find("Origin Time").and_then(|(_, time)| words(time)),
        station: find("Station Code").and_then(|(_, code)| words(&format!("{code} {place}"))),
        component: known.map_or(words(direction), |(_, name, ..)| words(name)),
        azimuth_deg: known.and_then(|(_, _, azimuth, _)| *azimuth),
        header_pga: find("Max. Acc. (gal)")
            .and_then(|(_, peak)| header_pga(peak, AccelerationUnit::CentimetrePerSecond2)),
        unit: Some(SaidUnit::by_file(AccelerationUnit::CentimetrePerSecond2)),
        ..RecordedMotion::default()
    })
}

fn value<'a>(line: Line<'a>, key: &str) -> Option<&'a str> {
    line.text.trim_start().strip_prefix(key).map(str::trim)
}

/// Gal in a count, from `7845(gal)/6182761`.
fn scale((line, text): (usize, &str)) -> Result<f64, RecordFileError> {
    let gal = leading_number(text);
    let counts = after(text, "/").and_then(first_number);
    match (gal, counts) {
        (Some(gal), Some(counts)) if counts != 0.0 => Ok(gal / counts),
        _ => Err(RecordFileError::NoNumber { line, text: quoted(text) }),
    }
}
