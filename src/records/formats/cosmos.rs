//! COSMOS format 1.20, volumes V1 and V2: for each channel 13 lines of text, 100 integers, 100 reals and comments, each
//! part announced by a line that says how many follow and in which Fortran format, then the samples. A file may hold
//! several channels, and velocity and displacement besides acceleration.

use super::error::RecordFileError;
use super::header::time_step;
use super::numbers::{Layout, first_number, leading_number, samples};
use super::text::{Line, after, lines, quoted, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, HeaderPga, RecordedMotion, SaidUnit};

/// The integer that gives the azimuth, from 0.
const AZIMUTH: usize = 53;
/// The real that gives the time step, ms.
const TIME_STEP_MS: usize = 61;
/// The real that gives the peak, in the unit of the samples.
const PEAK: usize = 63;
/// Share of the peak to which it is given.
const PEAK_ROUNDING: f64 = 1e-4;
const MS_PER_S: f64 = 1000.0;

/// Tells whether the first line names the format.
pub fn recognises(text: &str) -> bool {
    lines(text).next().is_some_and(|line| after(line.text, "(format v").is_some())
}

/// Reads the accelerations of a COSMOS file, in its order.
///
/// # Errors
/// If it holds none, or header or samples are not as they must be.
pub fn parse(text: &str, given: &Given) -> Result<Vec<RecordedMotion>, RecordFileError> {
    let mut motions = Vec::new();
    let mut channel = Channel::default();
    let mut other = None;
    let mut rest = lines(text);
    while let Some(line) = rest.next() {
        match Part::announced_by(line) {
            Part::Integers => channel.integers = part(&mut rest, line)?,
            Part::Reals => channel.reals = part(&mut rest, line)?,
            Part::Acceleration => {
                let values = part(&mut rest, line)?;
                motions.push(std::mem::take(&mut channel).motion(values, line, given)?);
            }
            Part::Other(quantity) => {
                rest.by_ref().take(Extent::of(line).map_or(0, |extent| extent.lines)).for_each(drop);
                other = Some(RecordFileError::NotAcceleration { line: line.number, quantity });
                channel = Channel::default();
            }
            Part::Text => channel.header.push(line.text),
        }
    }
    if !motions.is_empty() {
        return Ok(motions);
    }
    let line = lines(text).count();
    Err(other
        .unwrap_or(RecordFileError::EndsEarly { line, expected: "'... acceleration pts, ...' and samples" }))
}

/// What a line is, or what it says will follow.
enum Part {
    Integers,
    Reals,
    Acceleration,
    Other(&'static str),
    Text,
}

impl Part {
    fn announced_by(line: Line) -> Part {
        const PARTS: [(&str, Part); 5] = [
            ("integer-header values", Part::Integers),
            ("real-header values", Part::Reals),
            ("acceleration pts", Part::Acceleration),
            ("velocity pts", Part::Other("velocity")),
            ("displacement pts", Part::Other("displacement")),
        ];
        let announces = leading_number(line.text).is_some();
        let part = PARTS.into_iter().find(|(words, _)| announces && after(line.text, words).is_some());
        part.map_or(Part::Text, |(_, part)| part)
    }
}

/// What a line announces: how many numbers follow, how, and on how many lines.
struct Extent {
    count: u64,
    layout: Layout,
    lines: usize,
}

impl Extent {
    fn of(line: Line) -> Result<Extent, RecordFileError> {
        let missing = |what, expected| RecordFileError::Missing { line: line.number, what, expected };
        let count = leading_number(line.text).filter(|count| *count >= 0.0);
        let count = count.ok_or_else(|| missing("count", "how many numbers follow"))? as u64;
        let layout =
            Layout::in_text(line.text).ok_or_else(|| missing("format", "one such as 'Format=(8F10.5)'"))?;
        let lines = usize::try_from(layout.lines(count)).unwrap_or(usize::MAX);
        Ok(Extent { count, layout, lines })
    }
}

/// The numbers that a line announces.
fn part<'a>(
    rest: &mut (impl Iterator<Item = Line<'a>> + Clone),
    line: Line<'a>,
) -> Result<Vec<f64>, RecordFileError> {
    let Extent { count, layout, lines } = Extent::of(line)?;
    let to_end = |line: &Line| after(line.text, "end-of-data").is_none();
    let numbers = samples(rest.clone().take(lines).take_while(to_end), count, Some(layout))?;
    rest.by_ref().take(lines).for_each(drop);
    Ok(numbers)
}

/// The header of one channel.
#[derive(Default)]
struct Channel<'a> {
    header: Vec<&'a str>,
    integers: Vec<f64>,
    reals: Vec<f64>,
}

impl Channel<'_> {
    fn motion(self, values: Vec<f64>, line: Line, given: &Given) -> Result<RecordedMotion, RecordFileError> {
        let unit_text = after(line.text, "units=").unwrap_or("");
        let unit = AccelerationUnit::leading(unit_text)
            .ok_or_else(|| RecordFileError::Unit { line: line.number, unit: quoted(unit_text) })?;
        let step = self.reals.get(TIME_STEP_MS).filter(|step| **step > 0.0).map(|step| step / MS_PER_S);
        let dt_s = step.or(given.dt_s).ok_or(RecordFileError::Missing {
            line: line.number,
            what: "time step in the header above",
            expected: "milliseconds as its 62nd real: give it with --dt",
        })?;
        let scale = unit.in_m_s2();
        let find = |key| self.header.iter().find_map(|text| after(text, key));
        let peak = self.reals.get(PEAK).filter(|peak| peak.abs() != 999.0 && **peak != 0.0);
        let component = find("Sta Chan").and_then(|rest| words(after(rest, ":")?.split('(').next()?));
        Ok(RecordedMotion {
            dt_s: time_step(dt_s, line.number)?,
            acceleration_m_s2: values.into_iter().map(|value| value * scale).collect(),
            event: find("Record of ").and_then(words),
            station: find("Code:").and_then(words),
            // Codes above 360 are no azimuths, and 0 is none either: north is 360.
            azimuth_deg: self
                .integers
                .get(AZIMUTH)
                .copied()
                .filter(|azimuth| (1.0..=360.0).contains(azimuth))
                .or(component.as_deref().and_then(degrees)),
            component,
            header_pga: peak.map(|peak| HeaderPga {
                m_s2: peak.abs() * scale,
                rounding_m_s2: PEAK_ROUNDING * peak.abs() * scale,
            }),
            unit: Some(SaidUnit::by_file(unit)),
            ..RecordedMotion::default()
        })
    }
}

/// The azimuth in `90 deg`.
fn degrees(component: &str) -> Option<f64> {
    after(component, "deg")?;
    first_number(component).filter(|degrees| (0.0..=360.0).contains(degrees))
}
