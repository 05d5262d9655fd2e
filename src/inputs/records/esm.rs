//! ASCII of the Engineering Strong Motion database (DYNA 1.2): lines of `KEY: value`, then samples.

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::CM_PER_M;

use super::ReadOptions;
use super::header::{
    Field, after, azimuth_of, field, header_pga, label, number, numbers, samples, time_step, unit_of,
};
use crate::inputs::{InputError, Result};

/// Largest number of header lines.
const HEADER: usize = 200;

pub fn recognises(lines: &[&str]) -> bool {
    !field(header(lines), "SAMPLING_INTERVAL_S:").text.is_empty()
}

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let header = header(lines);
    let Field { line, text } = field(header, "DATA_TYPE:");
    if !text.is_empty() && after(text, "ACCELERATION").is_none() {
        return Err(InputError::NotAcceleration { line, found: text.to_string() });
    }
    let unit = unit_of(field(header, "UNITS:"), options)?;
    let step = field(header, "SAMPLING_INTERVAL_S:");
    let dt_s = time_step(number(step.text), options, step.line)?;
    let Field { line, text } = field(header, "NDATA:");
    let expected = "the number of samples, such as 'NDATA: 18904'";
    let announced = number(text).ok_or(InputError::Missing { line, field: "NDATA", expected })?;
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

/// Returns the leading lines of `KEY: value`.
fn header<'a, 'b>(lines: &'a [&'b str]) -> &'a [&'b str] {
    let end = lines.iter().take(HEADER).take_while(|line| line.contains(':')).count();
    &lines[..end]
}
