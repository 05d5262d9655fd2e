//! Lines of key and value, then samples: K-NET and KiK-net ASCII, and the Engineering Strong Motion database
//! (DYNA 1.2).

use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::CM_PER_M;

use super::header::{
    Field, after, azimuth_of, field, header_pga, label, number, numbers, samples, single_spaced, time_step,
    unit_of,
};
use super::{HEADER, ReadOptions};
use crate::inputs::{InputError, Result};

pub fn is_esm(lines: &[&str]) -> bool {
    !field(esm_header(lines), "SAMPLING_INTERVAL_S:").text.is_empty()
}

/// Reads integers, times the scale factor in gal. Their zero is arbitrary, so the mean is removed; the peak in
/// the header is about the mean, too.
pub fn knet(lines: &[&str], options: &ReadOptions) -> Result<RecordedMotion> {
    let missing = |line, field, expected| InputError::Missing { line, field, expected };
    let memo = lines.iter().take(HEADER).position(|line| line.trim_start().starts_with("Memo"));
    let end = memo.ok_or(missing(HEADER, "Memo.", "it at the end of the header"))?;
    let header = &lines[..end];
    let rate = field(header, "Sampling Freq(Hz)");
    let dt_s = time_step(number(rate.text).map(f64::recip), options, rate.line)?;
    let Field { line, text } = field(header, "Scale Factor");
    let counts = after(text, "/").and_then(number).filter(|counts| *counts != 0.0);
    let scale = number(text).zip(counts).map(|(gal, counts)| gal / counts);
    let expected = "gal over counts, '2000(gal)/8388608'";
    let scale = scale.ok_or_else(|| InputError::value(line, "Scale Factor", text, expected))?;
    let duration_s = number(field(header, "Duration Time(s)").text);
    let duration_s = duration_s.ok_or(missing(end, "Duration Time(s)", "a duration in seconds"))?;
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

fn esm_header<'a, 'b>(lines: &'a [&'b str]) -> &'a [&'b str] {
    let end = lines.iter().take(HEADER).take_while(|line| line.contains(':')).count();
    &lines[..end]
}
