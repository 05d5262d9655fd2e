//! K-NET and KiK-net ASCII: lines of key and value, then integers, times the scale factor in gal. Their zero
//! is arbitrary, so the mean is removed; the peak in the header is about the mean, too.

use super::error::RecordFileError;
use super::header::{
    after, azimuth_of, first_number, header_pga, leading_number, numbers, samples, time_step, unit_of, words,
};
use crate::records::{ReadOptions, RecordedMotion};

/// Largest number of header lines.
const HEADER: usize = 40;

/// Returns whether the first line has the first key.
pub fn recognises(lines: &[&str]) -> bool {
    value(lines.first().unwrap_or(&""), "Origin Time").is_some()
}

/// Reads the motion of a K-NET or KiK-net file.
pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion, RecordFileError> {
    let memo = lines.iter().take(HEADER).position(|line| value(line, "Memo").is_some());
    let missing = RecordFileError::missing;
    let end = memo.ok_or(missing(HEADER, "Memo.", "it at the end of the header"))?;
    let find =
        |key| lines[..end].iter().zip(1..).find_map(|(line, number)| Some((number, value(line, key)?)));
    let hertz =
        find("Sampling Freq(Hz)").map(|(line, text)| (line, 1.0 / leading_number(text).unwrap_or(0.0)));
    let step = hertz.or(options.dt_s.map(|dt_s| (end, dt_s)));
    let expected = "a line with Sampling Freq(Hz)";
    let (line, dt_s) = step.ok_or(RecordFileError::NoTimeStep { line: end, expected })?;
    let dt_s = time_step(dt_s, line)?;
    let (line, text) = find("Scale Factor").ok_or(missing(end, "Scale Factor", "'2000(gal)/8388608'"))?;
    let counts = after(text, "/").and_then(first_number).filter(|counts| *counts != 0.0);
    let scale = leading_number(text).and_then(|gal| Some(gal / counts?));
    let refusal =
        || RecordFileError::value(line, "Scale Factor", text, "gal over counts, '2000(gal)/8388608'");
    let scale = scale.ok_or_else(refusal)?;
    let duration_s = find("Duration Time(s)").and_then(|(_, duration)| leading_number(duration));
    let duration_s = duration_s.ok_or(missing(end, "Duration Time(s)", "a duration in seconds"))?;
    let counts = samples(lines, end + 1, (duration_s / dt_s).round(), numbers)?;
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    let gal = counts.into_iter().map(|count| (count - mean) * scale).collect();
    let unit = unit_of("gal", line)?;
    let direction = find("Dir.").map_or("", |(_, direction)| direction);
    // KiK-net numbers the directions in the borehole 1 to 3, those at the surface 4 to 6.
    let number = direction.parse().ok().filter(|number: &usize| (1..=6).contains(number));
    let component = number.map_or(direction, |number| ["N-S", "E-W", "U-D"][(number - 1) % 3]);
    let is_in_borehole = number.is_some_and(|number| number <= 3);
    let place = number.map_or("", |_| if is_in_borehole { "borehole" } else { "surface" });
    Ok(RecordedMotion {
        event: find("Origin Time").and_then(|(_, time)| words(time)),
        mw: find("Mag.").and_then(|(_, magnitude)| leading_number(magnitude)),
        station: find("Station Code").and_then(|(_, code)| words(&format!("{code} {place}"))),
        component: words(component),
        is_in_borehole,
        azimuth_deg: azimuth_of(component),
        header_pga: find("Max. Acc. (gal)").and_then(|(_, peak)| header_pga(peak, unit)),
        ..RecordedMotion::new(dt_s, gal, unit)
    })
}

fn value<'a>(line: &'a str, key: &str) -> Option<&'a str> {
    line.trim_start().strip_prefix(key).map(str::trim)
}
