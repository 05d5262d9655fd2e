//! K-NET and KiK-net ASCII: lines of key and value, then integers, times the scale factor in gal. Their zero
//! is arbitrary, so the mean is removed; the peak in the header is about the mean, too.

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::Unit;

use super::ReadOptions;
use super::header::{
    after, azimuth_of, field, first_number, header_pga, leading_number, number_field, numbers, samples,
    single_spaced, time_step, unit,
};
use crate::inputs::{InputError, Result};

/// Largest number of header lines.
const HEADER: usize = 40;

pub fn recognises(lines: &[&str]) -> bool {
    lines.first().is_some_and(|line| line.trim_start().starts_with("Origin Time"))
}

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let missing = |line, field, expected| InputError::Missing { line, field, expected };
    let memo = lines.iter().take(HEADER).position(|line| line.trim_start().starts_with("Memo"));
    let end = memo.ok_or(missing(HEADER, "Memo.", "it at the end of the header"))?;
    let header = &lines[..end];
    let (line, hertz) = number_field(header, "Sampling Freq(Hz)").unzip();
    let dt_s = time_step(hertz.map(f64::recip), options, line.unwrap_or(end))?;
    let (line, text) = field(header, "Scale Factor").unwrap_or((end, ""));
    let counts = after(text, "/").and_then(first_number).filter(|counts| *counts != 0.0);
    let Some((gal, counts)) = leading_number(text).zip(counts) else {
        let expected = "gal over counts, '2000(gal)/8388608'";
        return Err(InputError::value(line, "Scale Factor", text, expected));
    };
    let scale = gal / counts;
    let duration = number_field(header, "Duration Time(s)");
    let (_, duration_s) = duration.ok_or(missing(end, "Duration Time(s)", "a duration in seconds"))?;
    let counts = samples(lines, end + 1, (duration_s / dt_s).round(), numbers)?;
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    let gal = counts.into_iter().map(|count| (count - mean) * scale).collect();
    let unit = unit(Unit::parse("gal"), options, line)?;
    let direction = field(header, "Dir.").map_or("", |(_, direction)| direction);
    // KiK-net numbers the directions in the borehole 1 to 3, those at the surface 4 to 6.
    let number = direction.parse().ok().filter(|number: &usize| (1..=6).contains(number));
    let component = number.map_or(direction, |number| ["N-S", "E-W", "U-D"][(number - 1) % 3]);
    let is_in_borehole = number.is_some_and(|number| number <= 3);
    let place = number.map_or("", |_| if is_in_borehole { "borehole" } else { "surface" });
    let origin = Origin {
        earthquake: field(header, "Origin Time").and_then(|(_, time)| single_spaced(time)),
        mw: number_field(header, "Mag.").map(|(_, magnitude)| magnitude),
        station: field(header, "Station Code")
            .and_then(|(_, code)| single_spaced(&format!("{code} {place}"))),
        component: single_spaced(component),
        azimuth_deg: azimuth_of(component),
        re_km: None,
    };
    Ok(RecordedMotion {
        is_in_borehole,
        header_pga: field(header, "Max. Acc. (gal)").and_then(|(_, peak)| header_pga(peak, unit.si)),
        ..RecordedMotion::new(dt_s, gal, unit, origin)
    })
}
