//! PEER's AT2: three lines of text, one with NPTS and DT, then accelerations in g. Old files
//! (`ACCELERATION TIME HISTORY IN UNITS OF G`) and those of NGA (`ACCELERATION TIME SERIES IN UNITS OF G`).

use super::error::RecordFileError;
use super::header::{azimuth_of, header_pga, time_step};
use super::numbers::{Numbers, first_number, samples};
use super::text::{Line, after, lines, quoted, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, RecordedMotion, SaidUnit};

/// Lines of the header in which the one with NPTS must come.
const HEADER: usize = 8;

/// Tells whether the header has the line of NPTS that all of PEER's files have.
pub fn recognises(text: &str) -> bool {
    counts(text).is_some()
}

/// Reads the motion of an AT2 file.
///
/// # Errors
/// If it is a VT2 or DT2 file, a part of the header is missing, or the samples are not as announced.
pub fn parse(text: &str, given: &Given) -> Result<RecordedMotion, RecordFileError> {
    let counts = counts(text).ok_or(RecordFileError::Missing {
        line: 4,
        what: "NPTS",
        expected: "a header line such as 'NPTS= 7818, DT= .0050 SEC'",
    })?;
    let header: Vec<Line> = lines(text).take_while(|line| line.number < counts.number).collect();
    let unit = unit(&header, given)?;
    let (announced, dt_s) = length(counts, given)?;
    let values = samples(lines(text).skip(counts.number), announced, None)?;
    let scale = unit.unit.in_m_s2();
    let title = Title::of(header.get(1).map_or("", |line| line.text));
    Ok(RecordedMotion {
        dt_s: time_step(dt_s, counts.number)?,
        acceleration_m_s2: values.into_iter().map(|value| value * scale).collect(),
        azimuth_deg: title.component.as_deref().and_then(azimuth_of),
        event: title.event,
        station: title.station,
        component: title.component,
        header_pga: header
            .iter()
            .find_map(|line| after(line.text, "PGA"))
            .and_then(|rest| header_pga(rest.trim_start_matches([' ', '=']), AccelerationUnit::G)),
        unit: Some(unit),
        ..RecordedMotion::default()
    })
}

/// The line that announces how many samples come.
fn counts(text: &str) -> Option<Line<'_>> {
    lines(text).take(HEADER).find(|line| after(line.text, "NPTS").is_some())
}

/// NPTS and DT by their names, or in the order of the oldest files (`4000 .0050 NPTS, DT`).
fn length(line: Line, given: &Given) -> Result<(u64, f64), RecordFileError> {
    let named = |key| {
        let value = after(line.text, key)?.trim_start().strip_prefix('=')?.trim_start();
        value.starts_with(|c: char| c.is_ascii_digit() || c == '.').then(|| first_number(value)).flatten()
    };
    let mut unnamed = Numbers::of(line.text).map_while(Result::ok).fuse();
    let (first, second) = (unnamed.next(), unnamed.next());
    let missing = |what, expected| RecordFileError::Missing { line: line.number, what, expected };
    let npts = named("NPTS")
        .or(first)
        .filter(|npts| *npts >= 0.0)
        .ok_or_else(|| missing("NPTS", "the number of samples, such as 'NPTS= 7818'"))?;
    let dt_s = named("DT")
        .or(second)
        .or(given.dt_s)
        .ok_or_else(|| missing("DT", "the time step, such as 'DT= .0050 SEC': give it with --dt"))?;
    Ok((npts as u64, dt_s))
}

fn unit(header: &[Line], given: &Given) -> Result<SaidUnit, RecordFileError> {
    const OTHERS: [(&str, &str); 2] =
        [("VELOCITY", "velocity, as in a VT2 file"), ("DISPLACEMENT", "displacement, as in a DT2 file")];
    // The first two lines name the database and the record.
    let kinds = || header.iter().filter(|line| line.number > 2);
    let other = |(word, quantity): &(&str, &'static str)| {
        kinds().find(|line| after(line.text, word).is_some()).map(|line| (line, *quantity))
    };
    if let Some((line, quantity)) = OTHERS.iter().find_map(other) {
        return Err(RecordFileError::NotAcceleration { line: line.number, quantity });
    }
    let Some(line) = header.iter().find(|line| after(line.text, "UNITS OF").is_some()) else {
        return given.unit.map(SaidUnit::by_user).ok_or(RecordFileError::Missing {
            line: 3,
            what: "unit",
            expected: "'ACCELERATION TIME SERIES IN UNITS OF G': give it with --unit",
        });
    };
    let unit = after(line.text, "UNITS OF").unwrap_or("");
    AccelerationUnit::leading(unit)
        .map(SaidUnit::by_file)
        .ok_or_else(|| RecordFileError::Unit { line: line.number, unit: quoted(unit) })
}

/// The second line: event, date, station and component, separated by commas, of which only the date is sure to have none.
struct Title {
    event: Option<String>,
    station: Option<String>,
    component: Option<String>,
}

impl Title {
    fn of(text: &str) -> Title {
        let parts: Vec<&str> = text.split(',').map(str::trim).collect();
        let Some((component, before)) = parts.split_last().filter(|(_, before)| !before.is_empty()) else {
            return Title { event: words(text), station: None, component: None };
        };
        let is_date = |part: &&str| part.contains('/') && !part.contains(|c: char| c.is_ascii_alphabetic());
        let event_parts = before.iter().position(is_date).map_or(1, |date| date + 1);
        let (event, station) = before.split_at(event_parts.min(before.len()));
        Title {
            event: words(&event.join(", ")),
            station: words(&station.join(", ")),
            component: words(component),
        }
    }
}
