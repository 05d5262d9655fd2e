//! COSMOS format 1.20, volumes V1 and V2: for each channel 13 lines of text, 100 integers, 100 reals and
//! comments, each block after a line with its length and Fortran format, then the samples. A file may have
//! several channels, and velocity and displacement besides acceleration.

use std::ops::RangeInclusive;

use rockfrag_core::records::{HeaderPga, Origin, RecordedMotion};
use rockfrag_core::units::Unit;

use super::ReadOptions;
use super::header::{Field, after, field, label, number, samples, single_spaced, time_step, unit_of};
use crate::inputs::words::is_vertical;
use crate::inputs::{InputError, Result};

/// Places of the azimuth among the integers, and of the time step (ms) and the peak among the reals.
const AZIMUTH: usize = 53;
const TIME_STEP_MS: usize = 61;
const PEAK: usize = 63;
/// Codes in place of an azimuth of a component that points up or down, or is vertical.
const VERTICAL: RangeInclusive<f64> = 400.0..=402.0;
const MS_PER_S: f64 = 1000.0;

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<Vec<RecordedMotion>> {
    let mut motions = Vec::new();
    let mut channel = Channel::default();
    let expected = "'... acceleration pts, ...'";
    let mut refusal = InputError::Missing { line: lines.len(), field: "acceleration", expected };
    let mut at = 0;
    while at < lines.len() {
        let text = lines[at];
        let announces = |words| after(text, words).is_some() && number(text).is_some();
        at += 1;
        if announces("integer-header values") {
            channel.integers = block(lines, &mut at)?;
        } else if announces("real-header values") {
            channel.reals = block(lines, &mut at)?;
        } else if announces("acceleration pts") {
            let unit = unit_of(Field { line: at, ..field(&[text], "units=") }, options)?;
            let step_ms = channel.reals.get(TIME_STEP_MS).filter(|step| **step > 0.0);
            let dt_s = time_step(step_ms.map(|step| step / MS_PER_S), options, at)?;
            motions.push(std::mem::take(&mut channel).motion(dt_s, block(lines, &mut at)?, unit));
        } else if announces("velocity pts") || announces("displacement pts") {
            refusal = InputError::NotAcceleration { line: at, found: text.trim().to_string() };
            block(lines, &mut at).ok();
            channel = Channel::default();
        } else {
            channel.header.push(text);
        }
    }
    if motions.is_empty() { Err(refusal) } else { Ok(motions) }
}

/// Reads the block of numbers announced on the line before `at` (`100 Real-header values follow on 20 lines,
/// Format= (5F15.6)`), by field width, since blanks may be missing.
fn block(lines: &[&str], at: &mut usize) -> Result<Vec<f64>> {
    let text = lines[*at - 1];
    let expected = "a count and 'Format=(8F10.5)'";
    let missing = InputError::Missing { line: *at, field: "format", expected };
    let count = number(text).filter(|count| *count >= 0.0);
    let (count, (on_line, width)) = count.zip(layout(text)).ok_or(missing)?;
    let extent = (count / on_line as f64).ceil() as usize;
    let start = std::mem::replace(at, lines.len().min(at.saturating_add(extent)));
    samples(&lines[..*at], start, count, |line| {
        // A letter beyond ASCII is in no number.
        let fields = line.trim_end().as_bytes().chunks(width);
        fields.map(move |field| std::str::from_utf8(field).unwrap_or(line).trim())
    })
}

/// Reads how many numbers are on a line, and their width, in `Format= (5F15.6)`.
fn layout(text: &str) -> Option<(usize, usize)> {
    let format = text[text.rfind('(')? + 1..].split(')').next()?;
    let (on_line, width) = format.split_once(|c: char| "FEDGI".contains(c.to_ascii_uppercase()))?;
    let width = width.split(|c: char| !c.is_ascii_digit()).next()?.parse().ok()?;
    let on_line: usize = if on_line.trim().is_empty() { 1 } else { on_line.trim().parse().ok()? };
    (on_line > 0 && width > 0).then_some((on_line, width))
}

#[derive(Default)]
struct Channel<'a> {
    header: Vec<&'a str>,
    integers: Vec<f64>,
    reals: Vec<f64>,
}

impl Channel<'_> {
    fn motion(self, dt_s: f64, values: Vec<f64>, unit: Unit) -> RecordedMotion {
        let text = |key| field(&self.header, key).text;
        let name = after(text("Sta Chan"), ":").and_then(|name| single_spaced(name.split('(').next()?));
        let code = self.integers.get(AZIMUTH).copied().unwrap_or_default();
        // Of HNZ.XX in `<SCNL>12345.HNZ.XX.10`, which some programs write with an azimuth of 360.
        let channel = text("<SCNL>").split('.').nth(1);
        let is_vertical = VERTICAL.contains(&code)
            || name.as_deref().is_some_and(is_vertical)
            || channel.is_some_and(|channel| channel.ends_with('Z'));
        let degrees = name.as_deref().filter(|text| after(text, "deg").is_some()).and_then(number);
        // Other codes above 360 are not azimuths; nor is 0, since north is 360.
        let azimuth = [Some(code).filter(|code| *code >= 1.0), degrees];
        let azimuth = azimuth.into_iter().flatten().find(|azimuth| (0.0..=360.0).contains(azimuth));
        let origin = Origin {
            earthquake: label(&self.header, &["Record of "]),
            station: label(&self.header, &["Code:"]),
            azimuth_deg: azimuth.filter(|_| !is_vertical),
            component: if is_vertical { Some("vertical".to_string()) } else { name },
            ..Origin::default()
        };
        let peak = self.reals.get(PEAK).filter(|peak| peak.abs() != 999.0 && **peak != 0.0);
        let header_pga = peak.map(|peak| HeaderPga { m_s2: peak.abs() * unit.si, rounding_m_s2: 0.0 });
        RecordedMotion { header_pga, ..RecordedMotion::new(dt_s, values, unit, origin) }
    }
}
