//! What structures and ground motions can be: ranges within which a number given by a user can be right.

use crate::number::{period, significant};

/// PGA, g, beyond which nothing was ever recorded.
pub const STRONGEST_PGA_G: f64 = 4.5;
/// PGV, m/s, beyond which nothing was ever recorded.
pub const STRONGEST_PGV_M_S: f64 = 5.0;

/// Moment magnitudes that were ever recorded, with a margin.
pub const MAGNITUDES: std::ops::RangeInclusive<f64> = 1.0..=9.9;

/// Solid blocks of a smaller p (rad/s) are higher than about 40 m: their dimensions are probably in cm.
pub const LEAST_P_RAD_S: f64 = 0.6;

/// Annual rate at which no place on earth has 1 g or 1 m/s, and by which power of the peak it falls.
const MOST_FREQUENT: (f64, f64) = (0.008, 1.7);

/// Strong motion more frequent than anywhere on earth.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct ImplausibleHazard(String);

/// Judges annual rates at which PGA (g), or PGV (m/s), is exceeded, and guesses what they are instead.
pub fn judge_hazard(is_velocity: bool, points: &[(f64, f64)]) -> Result<(), ImplausibleHazard> {
    let excess = |(value, rate): (f64, f64)| rate / (MOST_FREQUENT.0 * value.powf(-MOST_FREQUENT.1));
    let is_plausible =
        |convert: fn((f64, f64)) -> (f64, f64)| points.iter().all(|&point| excess(convert(point)) < 1.0);
    if is_plausible(|point| point) {
        return Ok(());
    }
    let worst = points.iter().copied().max_by(|a, b| excess(*a).total_cmp(&excess(*b)));
    let (value, rate) = worst.unwrap_or_default();
    let (peak, unit, strongest) =
        if is_velocity { ("PGV", "m/s", STRONGEST_PGV_M_S) } else { ("PGA", "g", STRONGEST_PGA_G) };
    let is_large = points.iter().any(|(value, _)| *value > strongest);
    let are_probabilities = is_plausible(|(value, p)| (value, -(-p.min(1.0 - 1e-9)).ln_1p() / 50.0));
    let guess = match (is_velocity, is_large, are_probabilities) {
        (true, true, _) => "is it in cm/s?",
        (false, true, _) => "is it in m/s2?",
        (.., true) => "are these probabilities in 50 years (heading probability_of_exceedance_in_50_years)?",
        _ => "is the unit or the column wrong?",
    };
    let (value, years) = (significant(value, 3), period(1.0 / rate));
    let hazard = format!("{peak} of {value} {unit} once in {years} years");
    Err(ImplausibleHazard(format!("{hazard} exceeds any known hazard: {guess}")))
}

/// Why a value cannot be a peak of ground motion: PGA in m/s2, PGV in m/s.
pub fn judge_peak(is_velocity: bool, value: f64) -> Result<(), &'static str> {
    let strongest = if is_velocity { STRONGEST_PGV_M_S } else { STRONGEST_PGA_G * crate::units::G_M_S2 };
    match (is_velocity, (0.0..=strongest).contains(&value)) {
        (_, true) => Ok(()),
        (false, false) => Err("0 to 4.5 g (the strongest record): is the value in m/s2?"),
        (true, false) => Err("0 to 5 m/s (above any record): is the value in cm/s?"),
    }
}

/// PGV/PGA of ground motions, s: 0.005 for a sine of 30 Hz; the synthetic pulses of large magnitudes reach 1.7.
const PGV_PGA_S: std::ops::RangeInclusive<f64> = 0.005..=3.0;

/// Why PGA (m/s2) and PGV (m/s) cannot be of one motion.
pub fn judge_peaks(pga_m_s2: f64, pgv_m_s: f64) -> Result<(), String> {
    let ratio_s = pgv_m_s / pga_m_s2;
    match ratio_s.is_nan() || PGV_PGA_S.contains(&ratio_s) {
        true => Ok(()),
        false => Err(format!(
            "PGV/PGA is {} s; expected 0.005 to 3 s, of PGA in g and PGV in m/s: a wrong unit?",
            significant(ratio_s, 3)
        )),
    }
}
