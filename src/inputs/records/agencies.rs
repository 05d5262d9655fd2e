//! Formats of the agencies: a header, of keys and values in most, then samples.

use std::ops::RangeInclusive;

use rockfrag_core::records::{HeaderPga, Origin, RecordedMotion};
use rockfrag_core::units::{CM_PER_M, G_M_S2, Unit};

use super::header::*;
use super::{HEADER, ReadOptions};
use crate::inputs::words::is_vertical;
use crate::inputs::{InputError, Result, plain_number};

/// Lines among which are the counts of AT2.
const AT2_HEADER: usize = 8;
/// Places of the azimuth among the integers, and of the time step (ms) and the peak among the reals.
const AZIMUTH: usize = 53;
const TIME_STEP_MS: usize = 61;
const PEAK: usize = 63;
/// Codes in place of an azimuth of a component that points up or down, or is vertical.
const VERTICAL: RangeInclusive<f64> = 400.0..=402.0;
const MS_PER_S: f64 = 1000.0;

pub fn is_esm(lines: &[&str]) -> bool {
    !field(esm_header(lines), "SAMPLING_INTERVAL_S:").text.is_empty()
}

/// K-NET and KiK-net ASCII: integers, times the scale factor in gal. Their zero is arbitrary, so the mean is
/// removed; the peak in the header is about the mean, too.
pub fn knet(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let memo = lines.iter().take(HEADER).position(|line| line.trim_start().starts_with("Memo"));
    let end = memo.ok_or(InputError::missing(HEADER, "Memo.", "it at the end of the header"))?;
    let header = &lines[..end];
    let rate = field(header, "Sampling Freq(Hz)");
    let dt_s = time_step(number(rate.text).map(f64::recip), options, rate.line)?;
    let Field { line, text } = field(header, "Scale Factor");
    let counts = after(text, "/").and_then(number).filter(|counts| *counts != 0.0);
    let scale = number(text).zip(counts).map(|(gal, counts)| gal / counts);
    let expected = "gal over counts, '2000(gal)/8388608'";
    let scale = scale.ok_or_else(|| InputError::value(line, "Scale Factor", text, expected))?;
    let duration_s = number(field(header, "Duration Time(s)").text);
    let duration_s =
        duration_s.ok_or(InputError::missing(end, "Duration Time(s)", "a duration in seconds"))?;
    let counts = samples(lines, end + 1, (duration_s / dt_s).round(), numbers)?;
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    let gal = counts.into_iter().map(|count| (count - mean) * scale).collect();
    let unit = unit_of(Field { line, text: "gal" }, options)?;
    let direction = field(header, "Dir.").text;
    // KiK-net numbers the directions in the borehole 1 to 3, those at the surface 4 to 6.
    let (component, place) = match direction.parse() {
        Ok(number @ 1..=6) => {
            (["N-S", "E-W", "U-D"][(number - 1) % 3], if number <= 3 { " borehole" } else { " surface" })
        }
        _ => (direction, ""),
    };
    let origin = Origin {
        earthquake: label(header, &["Origin Time"]),
        mw: number(field(header, "Mag.").text),
        station: label(header, &["Station Code"]).map(|code| code + place),
        component: single_spaced(component),
        azimuth_deg: azimuth_of(component),
        re_km: None,
    };
    Ok(RecordedMotion {
        is_in_borehole: place == " borehole",
        header_pga: header_pga(field(header, "Max. Acc. (gal)").text, unit.si),
        ..RecordedMotion::new(dt_s, gal, unit, origin)
    })
}

/// The Engineering Strong Motion database (DYNA 1.2).
pub fn esm(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let header = esm_header(lines);
    let Field { line, text } = field(header, "DATA_TYPE:");
    if !text.is_empty() && after(text, "ACCELERATION").is_none() || after(text, "SPECTR").is_some() {
        return Err(InputError::NotAcceleration { line, found: text.to_string() });
    }
    let unit = unit_of(field(header, "UNITS:"), options)?;
    let step = field(header, "SAMPLING_INTERVAL_S:");
    let dt_s = time_step(number(step.text), options, step.line)?;
    let Field { line, text } = field(header, "NDATA:");
    let expected = "the number of samples, such as 'NDATA: 18904'";
    let announced = number(text).ok_or(InputError::missing(line, "NDATA", expected))?;
    let values = samples(lines, header.len(), announced, numbers)?;
    let component = label(header, &["STREAM:"]);
    // The last letter of a channel code is the direction; a digit is not.
    let letter = component.as_ref().and_then(|code| code.get(code.len() - 1..));
    let letter = letter.filter(|letter| letter.parse::<u8>().is_err());
    let origin = Origin {
        earthquake: label(header, &["EVENT_NAME:", "EVENT_DATE_YYYYMMDD:", "EVENT_TIME_HHMMSS:"]),
        mw: number(field(header, "MAGNITUDE_W:").text),
        station: label(header, &["NETWORK:", "STATION_CODE:", "STATION_NAME:"]),
        azimuth_deg: letter.and_then(azimuth_of),
        component,
        re_km: None,
    };
    Ok(RecordedMotion {
        header_pga: header_pga(field(header, "PGA_CM/S^2:").text, 1.0 / CM_PER_M),
        ..RecordedMotion::new(dt_s, values, unit, origin)
    })
}

fn esm_header<'a, 'b>(lines: &'a [&'b str]) -> &'a [&'b str] {
    let end = lines.iter().take(HEADER).take_while(|line| line.contains(':')).count();
    &lines[..end]
}

/// Finds the line with NPTS (or NPT) and DT, or with numbers alone below the unit.
pub fn line_of_counts(lines: &[&str]) -> Option<usize> {
    let header = &lines[..lines.len().min(AT2_HEADER)];
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

/// PEER's AT2: three lines of text, one with NPTS and DT, then accelerations in g. Old files (`ACCELERATION
/// TIME HISTORY IN UNITS OF G`) and NGA files (`ACCELERATION TIME SERIES IN UNITS OF G`).
pub fn at2(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let at = line_of_counts(lines).ok_or(InputError::missing(
        4,
        "NPTS",
        "a line such as 'NPTS= 7818, DT= .0050 SEC'",
    ))?;
    let header = &lines[..at];
    // Below the database and the record.
    let mut others = header.iter().zip(1..).skip(2);
    let is_other = |text: &str| after(text, "VELOCITY").or(after(text, "DISPLACEMENT")).is_some();
    if let Some((text, line)) = others.find(|(text, _)| is_other(text)) {
        return Err(InputError::NotAcceleration { line, found: text.trim().to_string() });
    }
    let unit = unit_of(unit_field(header).unwrap_or(Field { line: 3, text: "" }), options)?;
    let [announced, step] = counts(&lines[at]);
    let announced = announced.ok_or(InputError::missing(at + 1, "NPTS", "the number of samples"))?;
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

/// COSMOS format 1.20, volumes V1 and V2: for each channel 13 lines of text, 100 integers, 100 reals and
/// comments, each block after a line with its length and Fortran format, then the samples. A file may have
/// several channels, and velocity and displacement besides acceleration.
pub fn cosmos(lines: &[&str], options: &ReadOptions) -> Result<Vec<RecordedMotion>> {
    let mut motions = Vec::new();
    let mut channel = Channel::default();
    let expected = "'... acceleration pts, ...'";
    let mut refusal = InputError::missing(lines.len(), "acceleration", expected);
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
    let missing = InputError::missing(*at, "format", expected);
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
