//! CSMIP (CDMG) volumes V1 and V2, the format before COSMOS: for each channel lines of text and numbers, then a line such
//! as `7500 points of accel data equally spaced at .010 sec, in cm/sec2. (8f10.6)` and the samples; V2 then has velocity
//! and displacement, which are left out.

use super::error::RecordFileError;
use super::header::{azimuth_of, header_pga, time_step};
use super::numbers::{Layout, Numbers, first_number, leading_number, samples};
use super::text::{Line, after, lines, quoted, words};
use super::unit::AccelerationUnit;
use crate::records::{Given, HeaderPga, RecordedMotion, SaidUnit};

/// The layout of samples where the line does not say it.
const USUAL: Layout = Layout { on_line: 8, width: 10 };
/// The reals of a V2 header fill this many lines before the samples; the time step is the fifth on their eighth.
const REAL_LINES: usize = 13;
const TIME_STEP_LINE: usize = 7;
const TIME_STEP_FIELD: usize = 4;
/// The time step of the line before the samples has three decimals.
const TIME_STEP_ROUNDING_S: f64 = 0.0005;

/// Tells whether the first line names the volume.
pub fn recognises(text: &str) -> bool {
    lines(text).next().is_some_and(|line| after(line.text, "corrected accelerogram").is_some())
}

/// Reads the accelerations of a CSMIP file, in its order.
///
/// # Errors
/// If it holds none, its samples are uneven in time, or header or samples are not as they must be.
pub fn parse(text: &str, given: &Given) -> Result<Vec<RecordedMotion>, RecordFileError> {
    let mut motions = Vec::new();
    let mut header: Vec<Line> = Vec::new();
    let mut rest = lines(text);
    while let Some(line) = rest.next() {
        let Some(data) = Data::announced_by(line, &header, given)? else {
            if after(line.text, "corrected accelerogram").is_some() && !header_just_began(&header) {
                header.clear();
            }
            header.push(line);
            continue;
        };
        let wanted = usize::try_from(data.layout.lines(data.count)).unwrap_or(usize::MAX);
        let to_next =
            |line: &Line| after(line.text, "points of").or(after(line.text, "end of data")).is_none();
        let values = samples(rest.clone().take(wanted).take_while(to_next), data.count, Some(data.layout))?;
        rest.by_ref().take(wanted).for_each(drop);
        motions.push(motion(&header, &data, values));
        header.clear();
    }
    let line = lines(text).count();
    let velocity = lines(text).find(|line| after(line.text, "points of veloc").is_some());
    let nothing = velocity.map_or(
        RecordFileError::EndsEarly { line, expected: "'... points of accel data equally spaced ...'" },
        |line| RecordFileError::NotAcceleration { line: line.number, quantity: "velocity" },
    );
    if motions.is_empty() { Err(nothing) } else { Ok(motions) }
}

/// V2 headers name V1 on their second line.
fn header_just_began(header: &[Line]) -> bool {
    header.len() == 1
}

/// What the line before the samples says.
struct Data {
    count: u64,
    dt_s: f64,
    unit: AccelerationUnit,
    layout: Layout,
}

impl Data {
    /// From a line, if it announces accelerations.
    fn announced_by(line: Line, header: &[Line], given: &Given) -> Result<Option<Data>, RecordFileError> {
        let corrected = after(line.text, "points of accel");
        let uncorrected = after(line.text, "accelerogram points");
        let (Some(rest), Some(count)) = (corrected.or(uncorrected), leading_number(line.text)) else {
            return Ok(None);
        };
        let uneven = RecordFileError::Uneven { line: line.number };
        let spacing = after(rest, "spaced at").and_then(first_number).map(|dt_s| exact(dt_s, header));
        let rate = || after(rest, " at ").filter(|rest| after(rest, "/sec").is_some()).and_then(first_number);
        let dt_s = spacing.or_else(|| rate().map(|rate| 1.0 / rate)).or(given.dt_s).ok_or(uneven)?;
        let unit_text = after(rest, "units of").or(after(rest, " in ")).unwrap_or("");
        let unit = AccelerationUnit::leading(unit_text)
            .ok_or_else(|| RecordFileError::Unit { line: line.number, unit: quoted(unit_text) })?;
        Ok(Some(Data {
            count: count.max(0.0) as u64,
            dt_s: time_step(dt_s, line.number)?,
            unit,
            layout: Layout::in_text(rest).unwrap_or(USUAL),
        }))
    }
}

/// The time step with more digits from the reals of the header, where it is the same.
fn exact(rounded_s: f64, header: &[Line]) -> f64 {
    let line = header.len().checked_sub(REAL_LINES).and_then(|first| header.get(first + TIME_STEP_LINE));
    let field = line.and_then(|line| line.text.get(10 * TIME_STEP_FIELD..10 * (TIME_STEP_FIELD + 1)));
    let exact = field.and_then(|field| Numbers::of(field).next()?.ok());
    exact.filter(|dt_s| (dt_s - rounded_s).abs() <= TIME_STEP_ROUNDING_S).unwrap_or(rounded_s)
}

fn motion(header: &[Line], data: &Data, values: Vec<f64>) -> RecordedMotion {
    let scale = data.unit.in_m_s2();
    let find = |key| header.iter().position(|line| after(line.text, key).is_some());
    let text_at = |index: usize| header.get(index).map_or("", |line| line.text);
    // The line after the number of the station names it, and that after gives the channel.
    let station = find("Station No.");
    let component = station.and_then(|at| {
        let channel = text_at(at + 2);
        words(after(channel, ":").unwrap_or(channel))
    });
    RecordedMotion {
        dt_s: data.dt_s,
        acceleration_m_s2: values.into_iter().map(|value| value * scale).collect(),
        event: find("Rcrd of ").or(find("Record of ")).and_then(|at| before_gap(after(text_at(at), " of ")?)),
        station: station.and_then(|at| before_gap(text_at(at + 1))),
        azimuth_deg: component.as_deref().and_then(|name| {
            let number = after(name, "deg").and_then(|_| first_number(name));
            number.filter(|degrees| (0.0..=360.0).contains(degrees)).or_else(|| azimuth_of(name))
        }),
        component,
        header_pga: peak(header),
        unit: Some(SaidUnit::by_file(data.unit)),
        ..RecordedMotion::default()
    }
}

/// What stands before the first gap of a line of several fields.
fn before_gap(text: &str) -> Option<String> {
    words(text.trim_start().split("  ").next()?)
}

fn peak(header: &[Line]) -> Option<HeaderPga> {
    let find = |key| header.iter().find_map(|line| after(line.text, key));
    let corrected = find("Peak acceleration =");
    let uncorrected = || find("Max  =").or(find("Max ="));
    let text = corrected.or_else(uncorrected)?.trim_start();
    let unit = text.split_whitespace().nth(1).and_then(AccelerationUnit::leading)?;
    header_pga(text, unit)
}
