//! What the headers of all formats share: time steps, peaks and azimuths.

use super::error::RecordFileError;
use super::numbers::leading_number;
use super::unit::AccelerationUnit;
use crate::records::HeaderPga;

/// The longest time step of a record, s.
const LONGEST_STEP_S: f64 = 10.0;

/// Checks a time step (s) that stands on a line.
///
/// # Errors
/// If it is no step of a record of shaking.
pub fn time_step(dt_s: f64, line: usize) -> Result<f64, RecordFileError> {
    if dt_s > 0.0 && dt_s <= LONGEST_STEP_S {
        Ok(dt_s)
    } else {
        Err(RecordFileError::TimeStep { line, dt_s })
    }
}

/// Reads the peak acceleration at the beginning of a text.
pub fn header_pga(text: &str, unit: AccelerationUnit) -> Option<HeaderPga> {
    let text = text.trim_start();
    let value = leading_number(text)?.abs();
    let digits = text.split(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-'))).next()?;
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len().min(300));
    let rounding = 0.5 * libm::exp10(-(decimals as f64));
    let scale = unit.in_m_s2();
    (value > 0.0).then_some(HeaderPga { m_s2: value * scale, rounding_m_s2: rounding * scale })
}

/// Reads the azimuth of a component (degrees clockwise from north) from its name: a number, or a direction of the compass.
/// None for a vertical or unnamed one.
pub fn azimuth_of(component: &str) -> Option<f64> {
    const COMPASS: [(&str, f64); 10] = [
        ("N", 0.0),
        ("NS", 0.0),
        ("N-S", 0.0),
        ("NORTH", 0.0),
        ("E", 90.0),
        ("EW", 90.0),
        ("E-W", 90.0),
        ("EAST", 90.0),
        ("S", 180.0),
        ("W", 270.0),
    ];
    let component = component.trim();
    let compass = COMPASS.iter().find(|(name, _)| name.eq_ignore_ascii_case(component));
    let number = || component.parse().ok().filter(|degrees| (0.0..=360.0).contains(degrees));
    compass.map(|(_, degrees)| *degrees).or_else(number)
}
