//! What structures and ground motions can be: the range of each quantity with its source, for options, tables
//! and records alike.

use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;

use crate::number::{period, significant};
use crate::statistics::scores::sample_quantile;
use crate::units::Unit;

/// Moment magnitudes: the largest was 9.5 (Valdivia 1960), and weaker earthquakes rock nothing.
pub const MAGNITUDES: RangeInclusive<f64> = 1.0..=9.9;
/// Distances from a rupture, km, within which the ground shakes strongly, with a wide margin.
pub const DISTANCES_KM: RangeInclusive<f64> = 0.0..=1000.0;

/// PGA, g, beyond which nothing was recorded, with a margin: the largest is 4278 cm/s2, the vector of three
/// components at IWTH25 (Iwate-Miyagi 2008; Yamada, Mori & Heaton 2009, The slapdown phase in
/// high-acceleration records of large earthquakes, Seismological Research Letters 80).
pub const STRONGEST_PGA_G: f64 = 4.5;
/// PGV, m/s, beyond which nothing was recorded, with a margin over the 3.18 m/s of TCU068 (Chi-Chi 1999).
pub const STRONGEST_PGV_M_S: f64 = 5.0;
/// Above these, a motion is rare: m/s2 read as g is ten times too strong, without effect on PGV/PGA.
pub const RARE_PGA_G: f64 = 2.0;
/// Likewise of PGV, m/s.
pub const RARE_PGV_M_S: f64 = 2.5;
/// Least PGA, g: accelerographs resolve some 1e-4 g, and 1e-3 g rocks no stable structure.
pub const WEAKEST_PGA_G: f64 = 1e-3;
/// PGA (g) and PGV (m/s) up to which motions are scaled.
pub const MOST_SCALED: f64 = 20.0;
/// Largest acceleration that the solver takes, m/s2, about 1000 g: larger samples have a wrong unit.
pub const LARGEST_M_S2: f64 = 1e4;

/// PGV/PGA, s, of any motion: 0.005 for a sine of 30 Hz; the pulses of large magnitudes reach 1.7.
pub const PGV_PGA_S: RangeInclusive<f64> = 0.005..=3.0;
/// PGV/PGA, s, of a record: FEMA P695 has 0.06 to 0.47; twice that is velocity, or another time step.
pub const PGV_PGA_RECORDED_S: RangeInclusive<f64> = 0.005..=1.0;
/// PGV/PGA, s, of the motions of a site: that of records, without its rare ends.
pub const PGV_PGA_OF_SITE_S: RangeInclusive<f64> = 0.01..=0.5;

/// What a person gives of motions and of a site: its range, and what is expected.
pub type Expected = (RangeInclusive<f64>, &'static str);
pub const GIVEN_PGA_G: Expected =
    (0.0..=STRONGEST_PGA_G, "g, up to 4.5 (no record has more): is it in m/s2?");
pub const GIVEN_PGV_M_S: Expected =
    (0.0..=STRONGEST_PGV_M_S, "m/s, up to 5 (no record has more): is it in cm/s?");
pub const GIVEN_MAGNITUDE: Expected = (MAGNITUDES, "a moment magnitude");
pub const GIVEN_VS30_M_S: Expected = (100.0..=2500.0, "Vs30 in m/s, from 100 to 2500");
pub const GIVEN_RATIO_S: Expected = (PGV_PGA_OF_SITE_S, "PGV/PGA in s, from 0.01 to 0.5 (m/s over m/s2)");
pub const GIVEN_YEARS: Expected = (1e-3..=1e6, "years above 0");
pub const GIVEN_LIMIT_STATE: Expected = (1e-6..=1.0, "a demand |theta|max / alpha above 0 and up to 1");

/// Time steps that the solver takes, s.
pub const TIME_STEPS_S: RangeInclusive<f64> = 1e-6..=10.0;
/// Time steps of records, s: 200 to 500 samples a second to film digitised by hand, with a margin.
pub const RECORDED_STEPS_S: RangeInclusive<f64> = 1e-4..=0.1;

/// Frequency parameters p that the solver takes, rad/s: blocks from 0.7 mm to 7000 km. With the bounds of a
/// record they limit the Taylor steps between two samples to some million.
pub const FREQUENCIES_RAD_S: RangeInclusive<f64> = 1e-3..=100.0;
/// Frequency parameters that a person gives, rad/s: blocks from 3 mm to 180 m.
pub const GIVEN_FREQUENCIES_RAD_S: RangeInclusive<f64> = 0.2..=50.0;
/// Solid blocks of a smaller p (rad/s) are higher than about 18 m, as few monuments are.
pub const LEAST_P_RAD_S: f64 = 0.9;
/// Slenderness, rad, of a base of a 25th of the height: few monuments stand on less.
pub const LEAST_ALPHA_RAD: f64 = 0.04;

/// Columns with a range of their own, and what is expected; of motions by what solver and scaling allow.
const COLUMNS: [(&[&str], RangeInclusive<f64>, &str); 16] = [
    (&["p_rad_s"], FREQUENCIES_RAD_S, "a frequency parameter above 0 rad/s, from 0.001 to 100"),
    (&["alpha_rad"], 1e-6..=FRAC_PI_2.next_down(), "a slenderness between 0 and pi/2 rad, of 1e-6 or more"),
    (&["eta"], f64::MIN_POSITIVE..=1.0, "a coefficient of restitution above 0 and up to 1"),
    (&["mw"], MAGNITUDES, "a moment magnitude, from 1 to 9.9"),
    (&["re_km"], DISTANCES_KM, "a distance from the rupture in km, from 0 to 1000"),
    (&["vp_m_s"], 0.0..=20.0, "the amplitude of a velocity pulse in m/s, from 0 to 20"),
    (&["tp_s"], 1e-3..=1000.0, "the period of a velocity pulse in s, from 0.001 to 1000"),
    (&["gamma"], 1.0..=20.0, "the number of half cycles of a pulse, from 1 to 20"),
    (&["nu_rad"], -100.0..=100.0, "a phase in rad, from -100 to 100"),
    (&["dt_s"], TIME_STEPS_S, "a time step above 0 s, from 1e-6 to 10"),
    (&["pga_m_s2"], 0.0..=LARGEST_M_S2, "a peak acceleration in m/s2, from 0 to 10000"),
    (&["pgv_m_s"], 0.0..=1e3, "a peak velocity in m/s, from 0 to 1000"),
    (&["tm_s"], 1e-4..=1e4, "a mean period in s, from 0.0001 to 10000"),
    (&["edp"], 0.0..=1e3, "a rotation over the slenderness, of 0 or more"),
    (&["im1", "im2", "im3", "im4", "im5", "im6"], 0.0..=1e9, "a measure of 0 or more"),
    (&["beta"], 0.0..=1e3, "a dispersion of 0 or more"),
];

/// The range of the numbers in a column, and what is expected.
pub fn range_of_column(name: &str) -> (RangeInclusive<f64>, &'static str) {
    let own = COLUMNS.into_iter().find(|(names, ..)| names.contains(&name));
    own.map_or((f64::MIN..=f64::MAX, "a finite number"), |(_, range, expected)| (range, expected))
}

/// Annual rate at which no place on earth has 1 g or 1 m/s, and by which power of the peak it falls.
const MOST_FREQUENT: (f64, f64) = (0.008, 1.7);

/// PGA, g, that the hazard of any site reaches; PGV, m/s, and SA(1.0 s), g, reach a third of it.
const REACHED_PGA_G: f64 = 0.03;

/// Checks annual rates of exceedance of PGV (m/s), or of PGA or a spectral acceleration (g), and guesses what
/// implausible ones are instead.
pub fn validate_hazard(measure: &str, points: &[(f64, f64)]) -> Result<(), String> {
    let is_velocity = measure == "PGV";
    let excess = |(value, rate): (f64, f64)| rate / (MOST_FREQUENT.0 * value.powf(-MOST_FREQUENT.1));
    let (unit, strongest) = if is_velocity { ("m/s", STRONGEST_PGV_M_S) } else { ("g", STRONGEST_PGA_G) };
    let most = points.iter().map(|(value, _)| *value).fold(0.0, f64::max);
    let reached = if measure == "PGA" { REACHED_PGA_G } else { REACHED_PGA_G / 3.0 };
    if most < reached && !points.is_empty() {
        let (most, expected) = (significant(most, 3), format!("expected {reached} {unit} or more"));
        return Err(format!("{measure} of {most} {unit} at most; {expected}: a wrong unit?"));
    }
    let is_plausible =
        |convert: fn((f64, f64)) -> (f64, f64)| points.iter().all(|&point| excess(convert(point)) < 1.0);
    if is_plausible(|point| point) {
        return Ok(());
    }
    let worst = points.iter().copied().max_by(|a, b| excess(*a).total_cmp(&excess(*b)));
    let (value, rate) = worst.unwrap_or_default();
    let is_large = most > strongest;
    let are_probabilities = is_plausible(|(value, p)| (value, -(-p.min(1.0 - 1e-9)).ln_1p() / 50.0));
    let guess = match (is_velocity, is_large, are_probabilities) {
        (true, true, _) => "is it in cm/s?",
        (false, true, _) => "is it in m/s2?",
        (.., true) => "are these probabilities in 50 years (heading probability_of_exceedance_in_50_years)?",
        _ => "is the unit or the column wrong?",
    };
    let (value, years) = (significant(value, 3), period(1.0 / rate));
    let hazard = format!("{measure} of {value} {unit} once in {years} years");
    Err(format!("{hazard} exceeds any known hazard: {guess}"))
}

/// Spectral acceleration at 1 s over PGA, each exceeded as often, of any site.
const SPECTRAL_OVER_PGA: RangeInclusive<f64> = 0.1..=3.0;

/// Checks spectral accelerations at 1 s over PGA, each exceeded as often, by their median.
pub fn validate_spectrum(ratios: impl Iterator<Item = f64>) -> Result<(), String> {
    let unit = match median(ratios) {
        Some(ratio) if ratio > *SPECTRAL_OVER_PGA.end() => "is it in m/s2 or cm/s2, beside PGA in g?",
        Some(ratio) if ratio < *SPECTRAL_OVER_PGA.start() => "is it in g, beside PGA in m/s2 or cm/s2?",
        _ => return Ok(()),
    };
    Err(format!("SA(1.0 s) is not 0.1 to 3 times PGA at the same rates: {unit}"))
}

/// Least m of the longest of the sides, and of the heights, of a list of objects.
const LEAST_SIDE_M: f64 = 0.01;
const LEAST_HEIGHT_M: f64 = 0.03;

/// Checks the lengths in a column of a list, which are in a unit: what is expected if none can be right.
pub fn validate_lengths(
    is_height: bool,
    unit: Unit,
    lengths: impl Iterator<Item = f64>,
) -> Result<(), &'static str> {
    let longest_m = unit.si * lengths.fold(0.0, f64::max);
    let least = if is_height { LEAST_HEIGHT_M } else { LEAST_SIDE_M };
    match unit.name {
        _ if longest_m == 0.0 || longest_m >= least => Ok(()),
        "mm" => Err("longer ones: are they in m, or do points part thousands (1.100 of 1100)?"),
        _ => Err("longer ones: are they in m?"),
    }
}

/// The median of values that are above 0 and finite.
pub fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    sample_quantile(values.filter(|value| *value > 0.0 && value.is_finite()).collect(), 0.5)
}
