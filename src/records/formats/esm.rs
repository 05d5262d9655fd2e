//! ASCII of the Engineering Strong Motion database (DYNA 1.2): lines of `KEY: value`, then samples.

use super::error::RecordFileError;
use super::header::{
    after, azimuth_of, given_unit, header_pga, leading_number, numbers, samples, time_step, unit_of, words,
};
use crate::records::{ReadOptions, RecordedMotion};
use crate::units::Unit;

/// Largest number of header lines.
const HEADER: usize = 200;

/// Returns whether the header has the key of the sampling interval.
pub fn recognises(lines: &[&str]) -> bool {
    value(header(lines), "SAMPLING_INTERVAL_S").is_some()
}

/// Reads the motion of an ESM file.
pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion, RecordFileError> {
    let header = header(lines);
    let end = header.len();
    let find = |key| value(header, key);
    if let Some((line, kind)) = find("DATA_TYPE").filter(|(_, kind)| after(kind, "ACCELERATION").is_none()) {
        return Err(RecordFileError::NotAcceleration { line, found: kind.to_string() });
    }
    let unit = find("UNITS").map_or_else(|| given_unit(options, end), |(line, text)| unit_of(text, line))?;
    let number = |key| find(key).and_then(|(line, value)| Some((line, leading_number(value)?)));
    let missing = |field, expected| RecordFileError::missing(end, field, expected);
    let step = number("SAMPLING_INTERVAL_S").or(options.dt_s.map(|dt_s| (end, dt_s)));
    let expected = "SAMPLING_INTERVAL_S";
    let (line, dt_s) = step.ok_or(RecordFileError::NoTimeStep { line: end, expected })?;
    let (_, announced) =
        number("NDATA").ok_or(missing("NDATA", "the number of samples, such as 'NDATA: 18904'"))?;
    let values = samples(lines, end, announced, numbers)?;
    let joined = |keys: [&'static str; 3]| {
        let parts: Vec<&str> = keys.into_iter().filter_map(|key| Some(find(key)?.1)).collect();
        words(&parts.join(" "))
    };
    let stream = find("STREAM").map_or("", |(_, stream)| stream);
    // The last letter of a channel code is the direction; a digit is not.
    let letter = stream.get(stream.len().saturating_sub(1)..).unwrap_or("");
    Ok(RecordedMotion {
        event: joined(["EVENT_NAME", "EVENT_DATE_YYYYMMDD", "EVENT_TIME_HHMMSS"]),
        mw: number("MAGNITUDE_W").map(|(_, mw)| mw),
        station: joined(["NETWORK", "STATION_CODE", "STATION_NAME"]),
        component: words(stream),
        azimuth_deg: azimuth_of(letter).filter(|_| !letter.starts_with(|c: char| c.is_ascii_digit())),
        header_pga: find("PGA_CM/S^2").and_then(|(_, peak)| header_pga(peak, Unit::parse("cm/s2")?)),
        ..RecordedMotion::new(time_step(dt_s, line)?, values, unit)
    })
}

/// Returns the leading lines of `KEY: value`.
fn header<'a, 'b>(lines: &'a [&'b str]) -> &'a [&'b str] {
    let end = lines.iter().take(HEADER).take_while(|line| line.contains(':')).count();
    &lines[..end]
}

fn value<'a>(header: &[&'a str], key: &str) -> Option<(usize, &'a str)> {
    let value = |(line, text): (usize, &&'a str)| {
        let (name, value) = text.split_once(':')?;
        (name.trim() == key && !value.trim().is_empty()).then_some((line + 1, value.trim()))
    };
    header.iter().enumerate().find_map(value)
}
