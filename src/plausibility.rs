//! What structures and ground motions can be: ranges within which a number given by a user can be right.

use std::f64::consts::FRAC_PI_4;

use crate::rocking::{Structure, StructureError};

/// PGA, g, beyond which nothing was ever recorded.
pub const STRONGEST_PGA_G: f64 = 4.5;
/// PGV, m/s, beyond which nothing was ever recorded.
pub const STRONGEST_PGV_M_S: f64 = 5.0;

/// Annual rate at which no place on earth has 1 g or 1 m/s, and by which power of the peak it falls.
const MOST_FREQUENT: (f64, f64) = (0.008, 1.7);

/// Strong motion more frequent than anywhere on earth.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{peak} of {value} {unit} once in {years:.2} years; no place on earth has that: {guess}")]
pub struct ImplausibleHazard {
    peak: &'static str,
    value: f64,
    unit: &'static str,
    years: f64,
    guess: &'static str,
}

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
        _ => "another unit, or another column?",
    };
    Err(ImplausibleHazard { peak, value, unit, years: 1.0 / rate, guess })
}

/// Why a peak is none of a ground motion: PGA in m/s2, PGV in m/s.
pub fn judge_peak(is_velocity: bool, value: f64) -> Result<(), &'static str> {
    let strongest = if is_velocity { STRONGEST_PGV_M_S } else { STRONGEST_PGA_G * crate::units::G_M_S2 };
    match (is_velocity, (0.0..=strongest).contains(&value)) {
        (_, true) => Ok(()),
        (false, false) => Err("0 to 4.5 g, the strongest ever recorded: is it in m/s2?"),
        (true, false) => Err("0 to 5 m/s, more than was ever recorded: is it in cm/s?"),
    }
}
/// The range of a parameter that a user may give, and the likely mistake outside it.
struct Bound {
    /// Its name among the options.
    parameter: &'static str,
    /// Least and largest value.
    range: (f64, f64),
    /// The range in words.
    expected: &'static str,
    /// The likely mistake.
    slip: &'static str,
}

const fn bound(
    parameter: &'static str,
    range: (f64, f64),
    expected: &'static str,
    slip: &'static str,
) -> Bound {
    Bound { parameter, range, expected, slip }
}

/// Narrower than what [`Structure::new`] accepts. Other numbers are likely in a wrong unit: no rocking
/// structure is taller than 200 m, has a semi-diagonal below 3 mm (p 50 rad/s) or above 184 m (p 0.2 rad/s),
/// is wider than tall (it slides), or has a beam of 50 times the column mass.
const BOUNDS: [Bound; 6] = [
    bound("width", (1e-4, 200.0), "a length above 0 m, up to 200 m", "is it in cm or mm?"),
    bound("height", (1e-3, 200.0), "a length above 0 m, up to 200 m", "is it in cm or mm?"),
    bound("beam-mass-ratio", (0.0, 50.0), "a mass ratio of 0 or more, up to 50", "is it in percent?"),
    bound(
        "p",
        (0.2, 50.0),
        "a frequency parameter above 0 rad/s, from 0.2 to 50",
        "is it in Hz, or of dimensions in cm or mm?",
    ),
    bound(
        "alpha",
        (0.01, FRAC_PI_4),
        "a slenderness between 0 and pi/2 rad, from 0.01 to 0.7854 (45 degrees)",
        "is it in degrees, or height over width?",
    ),
    bound(
        "eta",
        (f64::MIN_POSITIVE, 1.0),
        "a coefficient of restitution above 0 and up to 1",
        "is it in percent?",
    ),
];

impl Bound {
    /// Finds the range of a parameter.
    fn of(parameter: &str) -> Option<&'static Bound> {
        BOUNDS.iter().find(|bound| bound.parameter == parameter)
    }

    /// Returns the expected range and likely mistake of a number out of range; none of a valid number.
    fn refusal(&self, value: f64) -> Option<String> {
        let Bound { range: (least, most), expected, slip, .. } = *self;
        match value {
            _ if value >= least && value <= most => None,
            _ if value > 0.0 && value.is_finite() => Some(format!("{expected}; {slip}")),
            _ => Some(expected.to_string()),
        }
    }
}

/// Checks the parameters of a structure as a user gives them, by name.
///
/// # Errors
/// If one is out of range, p and alpha are exchanged, or the width exceeds the height.
pub fn check_structure(structure: &str, given: &[(&'static str, f64)]) -> Result<(), StructureError> {
    let value =
        |wanted: &str| given.iter().find(|(parameter, _)| *parameter == wanted).map(|&(_, value)| value);
    let can_be = |parameter: &str, value: f64| {
        Bound::of(parameter).is_some_and(|bound| bound.refusal(value).is_none())
    };
    if let (Some(p), Some(alpha)) = (value("p"), value("alpha"))
        && !can_be("alpha", alpha)
        && can_be("alpha", p)
        && can_be("p", alpha)
    {
        let expected = "a slenderness up to 0.7854 rad; were p and alpha exchanged?";
        return Err(StructureError::new(structure, "alpha", alpha, expected));
    }
    for &(parameter, value) in given {
        if let Some(expected) = Bound::of(parameter).and_then(|bound| bound.refusal(value)) {
            return Err(StructureError::new(structure, parameter, value, expected));
        }
    }
    match (value("width"), value("height")) {
        (Some(width), Some(height)) if width > height => {
            let expected = format!("no more than the height, {height} m; were they exchanged?");
            Err(StructureError::new(structure, "width", width, expected))
        }
        _ => Ok(()),
    }
}

/// Solid blocks of a smaller p (rad/s) are higher than about 90 m.
const LEAST_P_RAD_S: f64 = 0.4;

/// Returns whether a solid block would be implausibly tall: its dimensions are probably in cm.
pub fn is_too_high(structure: &Structure) -> bool {
    structure.p_rad_s < LEAST_P_RAD_S
}
