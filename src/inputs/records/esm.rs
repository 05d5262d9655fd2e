//! ASCII of the Engineering Strong Motion database (DYNA 1.2): lines of `KEY: value`, then samples.

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::CM_PER_M;

use super::ReadOptions;
use super::header::{
    after, azimuth_of, field, header_pga, number_field, numbers, samples, single_spaced, time_step, unit_of,
};
use crate::inputs::{InputError, Result};

/// Largest number of header lines.
const HEADER: usize = 200;

pub fn recognises(lines: &[&str]) -> bool {
    field(header(lines), "SAMPLING_INTERVAL_S:").is_some()
}

pub fn parse(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let header = header(lines);
    let end = header.len();
    if let Some((line, kind)) = field(header, "DATA_TYPE:")
        && after(kind, "ACCELERATION").is_none()
    {
        return Err(InputError::NotAcceleration { line, found: kind.to_string() });
    }
    let (line, unit) = field(header, "UNITS:").unzip();
    let unit = unit_of(unit, options, line.unwrap_or(end))?;
    let (line, step) = number_field(header, "SAMPLING_INTERVAL_S:").unzip();
    let dt_s = time_step(step, options, line.unwrap_or(end))?;
    let expected = "the number of samples, such as 'NDATA: 18904'";
    let missing = InputError::Missing { line: end, field: "NDATA", expected };
    let (_, announced) = number_field(header, "NDATA:").ok_or(missing)?;
    let values = samples(lines, end, announced, numbers)?;
    let stream = field(header, "STREAM:").map_or("", |(_, stream)| stream);
    // The last letter of a channel code is the direction; a digit is not.
    let letter = stream.get(stream.len().saturating_sub(1)..).unwrap_or("");
    let origin = Origin {
        earthquake: joined(header, ["EVENT_NAME:", "EVENT_DATE_YYYYMMDD:", "EVENT_TIME_HHMMSS:"]),
        mw: number_field(header, "MAGNITUDE_W:").map(|(_, mw)| mw),
        station: joined(header, ["NETWORK:", "STATION_CODE:", "STATION_NAME:"]),
        component: single_spaced(stream),
        azimuth_deg: azimuth_of(letter).filter(|_| !letter.starts_with(|c: char| c.is_ascii_digit())),
        re_km: None,
    };
    Ok(RecordedMotion {
        header_pga: field(header, "PGA_CM/S^2:").and_then(|(_, peak)| header_pga(peak, 1.0 / CM_PER_M)),
        ..RecordedMotion::new(dt_s, values, unit, origin)
    })
}

/// Returns the leading lines of `KEY: value`.
fn header<'a, 'b>(lines: &'a [&'b str]) -> &'a [&'b str] {
    let end = lines.iter().take(HEADER).take_while(|line| line.contains(':')).count();
    &lines[..end]
}

fn joined(header: &[&str], keys: [&str; 3]) -> Option<String> {
    let parts: Vec<&str> = keys.into_iter().filter_map(|key| Some(field(header, key)?.1)).collect();
    single_spaced(&parts.join(" "))
}
