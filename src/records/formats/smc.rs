//! USGS SMC: 11 lines of text, 48 integers on 6 lines, 50 reals on 10, comments that begin with `|`, then accelerations
//! in cm/s2. Version 1 has eight numbers of ten characters on a line, version 2 five of fourteen.

use super::error::RecordFileError;
use super::header::{azimuth_of, time_step};
use super::numbers::{Layout, leading_number, samples};
use super::text::{Line, after, lines, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, HeaderPga, RecordedMotion, SaidUnit};

/// What the first line says of other contents.
const OTHERS: [(&str, &str); 4] = [
    ("VELOCITY", "velocity"),
    ("DISPLACEMENT", "displacement"),
    ("RESPONSE", "response spectra"),
    ("FOURIER", "Fourier amplitude spectra"),
];
const TEXT_LINES: usize = 11;
const INTEGERS: (u64, Layout) = (48, Layout { on_line: 8, width: 10 });
const REALS: (u64, Layout) = (50, Layout { on_line: 5, width: 15 });
const DATA: Layout = Layout { on_line: 8, width: 10 };
/// Share of the peak to which it is given, with five digits.
const PEAK_ROUNDING: f64 = 1e-4;

/// Tells whether it begins with the number and the name of a kind of SMC file.
pub fn recognises(text: &str) -> bool {
    let first = lines(text).next().map_or("", |line| line.text).trim_start();
    let kinds = ["ACCELEROGRAM", "VELOCITY", "DISPLACEMENT", "RESPONSE", "FOURIER"];
    let numbered = first.starts_with(|c: char| c.is_ascii_digit()) && !first.contains("Format");
    numbered
        && kinds.iter().any(|kind| first.contains(kind))
        && lines(text)
            .nth(1)
            .is_some_and(|line| line.text.trim_start().starts_with('*') || line.text.trim().is_empty())
}

/// Reads the motion of an SMC file.
///
/// # Errors
/// If it holds something else than evenly sampled acceleration, or header or samples are not as they must be.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let kind = lines(text).next().map_or("", |line| line.text);
    if let Some((_, quantity)) = OTHERS.iter().find(|(word, _)| kind.contains(word)) {
        return Err(RecordFileError::NotAcceleration { line: 1, quantity });
    }
    let integers = block(text, TEXT_LINES, INTEGERS)?;
    let reals_from = TEXT_LINES + INTEGERS.1.lines(INTEGERS.0) as usize;
    let reals = block(text, reals_from, REALS)?;
    // The first value of each block is the one that stands for unknown ones.
    let known = |values: &[f64], index: usize| {
        let unknown = values.first().copied();
        values.get(index).copied().filter(|value| Some(*value) != unknown)
    };
    let dt_line = reals_from + 1;
    let dt_s = match (known(&reals, 1), given.dt_s) {
        (Some(rate), _) => 1.0 / rate,
        (None, Some(dt_s)) => dt_s,
        (None, None) => return Err(RecordFileError::Uneven { line: dt_line }),
    };
    let announced = known(&integers, 16).filter(|count| *count >= 0.0).ok_or(RecordFileError::Missing {
        line: TEXT_LINES + 3,
        what: "number of samples",
        expected: "it as the first integer of the line",
    })?;
    let comments = known(&integers, 15).unwrap_or(0.0).max(0.0) as usize;
    let data_from = (reals_from + REALS.1.lines(REALS.0) as usize).saturating_add(comments);
    let values = samples(lines(text).skip(data_from), announced as u64, Some(DATA))?;
    let scale = AccelerationUnit::CentimetrePerSecond2.in_m_s2();
    let header = |number: usize| lines(text).nth(number).map_or("", |line| line.text);
    // An angle of 90 degrees from the vertical is horizontal.
    let horizontal = known(&integers, 12).is_none_or(|angle| angle == 90.0);
    let azimuth_deg =
        known(&integers, 13).filter(|_| horizontal).filter(|azimuth| (0.0..=360.0).contains(azimuth));
    let component = after(header(5), "component=").and_then(words);
    let peaks = known(&reals, 29).into_iter().chain(known(&reals, 31)).map(f64::abs);
    Ok(RecordedMotion {
        dt_s: time_step(dt_s, dt_line)?,
        acceleration_m_s2: values.into_iter().map(|value| value * scale).collect(),
        event: after_integers(header(3)).and_then(words),
        station: after(header(5), "station =").and_then(|rest| words(rest.split("component").next()?)),
        azimuth_deg: azimuth_deg.or(component.as_deref().filter(|_| horizontal).and_then(azimuth_of)),
        component,
        header_pga: peaks
            .reduce(f64::max)
            .map(|peak| HeaderPga { m_s2: peak * scale, rounding_m_s2: PEAK_ROUNDING * peak * scale }),
        unit: Some(SaidUnit::by_file(AccelerationUnit::CentimetrePerSecond2)),
        ..RecordedMotion::default()
    })
}

/// The numbers of a part of the header after `skip` lines.
fn block(text: &str, skip: usize, (count, layout): (u64, Layout)) -> Result<Vec<f64>, RecordFileError> {
    let wanted = layout.lines(count) as usize;
    let part: Vec<Line> = lines(text).skip(skip).take(wanted).collect();
    if part.len() < wanted {
        let line = lines(text).count();
        return Err(RecordFileError::EndsEarly { line, expected: "the integers and reals of an SMC header" });
    }
    samples(part.into_iter(), count, Some(layout))
}

/// The name of the earthquake, which follows its date and time.
fn after_integers(text: &str) -> Option<&str> {
    let is_number = |word: &&str| leading_number(word).is_some();
    let first = text.split_whitespace().find(|word| !is_number(word))?;
    text.get(text.find(first)?..)
}
