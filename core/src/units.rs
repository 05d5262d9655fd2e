//! Units and physical constants.

pub const G_M_S2: f64 = 9.81;

/// Inverse of [`G_M_S2`]: converts m/s2 to g.
pub const G_PER_M_S2: f64 = 1.0 / G_M_S2;

/// Centimetres per metre: published ground-motion relations are in cm/s and cm/s2.
pub const CM_PER_M: f64 = 100.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    Acceleration,
    Velocity,
    Length,
    Time,
    Angle,
    AngularFrequency,
    Mass,
    /// Counts or volts of an uncalibrated instrument.
    Counts,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub name: &'static str,
    pub quantity: Quantity,
    /// Value in m/s2, m/s, m, s, rad, rad/s or kg.
    pub si: f64,
}

impl serde::Serialize for Unit {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

use Quantity::{Acceleration, Angle, AngularFrequency, Counts, Length, Mass, Time, Velocity};

/// Beginnings of the words for a unit in some languages, and its name: `Zentimetern`, `millimètres`.
const BEGINNINGS: [(&str, &[&str]); 2] = [
    ("cm", &["centimet", "centimèt", "centímet", "zentimet", "センチ"]),
    ("mm", &["millimet", "millimèt", "milímet", "ミリ"]),
];

/// Name, quantity, value, and other spellings as normalised by [`Unit::parse`].
#[rustfmt::skip]
const UNITS: [(&str, Quantity, f64, &[&str]); 39] = [
    ("g", Acceleration, G_M_S2, &["gs"]),
    ("%g", Acceleration, 0.01 * G_M_S2, &["%/g"]),
    ("g/10", Acceleration, 0.1 * G_M_S2, &[]),
    ("mg", Acceleration, 0.001 * G_M_S2, &["millig"]),
    ("m/s2", Acceleration, 1.0, &["m/s/s", "ms2"]),
    ("cm/s2", Acceleration, 0.01, &["cm/s/s", "cms2", "gal", "gals"]),
    ("mm/s2", Acceleration, 0.001, &["mm/s/s", "mms2"]),
    ("um/s2", Acceleration, 1e-6, &["\u{3bc}m/s2", "um/s/s", "\u{3bc}m/s/s", "ums2", "\u{3bc}ms2"]),
    ("nm/s2", Acceleration, 1e-9, &["nm/s/s", "nms2"]),
    ("mGal", Acceleration, 1e-5, &["mgal", "mgals", "milligal", "milligals"]),
    ("uGal", Acceleration, 1e-8, &["ugal", "\u{3bc}gal", "microgal", "microgals"]),
    ("ft/s2", Acceleration, 0.3048, &["ft/s/s"]),
    ("in/s2", Acceleration, 0.0254, &["in/s/s"]),
    ("m/s", Velocity, 1.0, &["m/s1", "ms1"]),
    ("cm/s", Velocity, 0.01, &["cm/s1", "cms1", "kine"]),
    ("mm/s", Velocity, 0.001, &["mm/s1"]),
    ("in/s", Velocity, 0.0254, &[]),
    ("ft/s", Velocity, 0.3048, &[]),
    ("m", Length, 1.0, &["metre", "metres", "meter", "meters"]),
    ("cm", Length, 0.01, &[]),
    ("mm", Length, 0.001, &[]),
    ("km", Length, 1000.0, &[]),
    ("in", Length, 0.0254, &["inch", "inches", "zoll", "\"", "''"]),
    ("ft", Length, 0.3048, &["foot", "feet", "'"]),
    ("s", Time, 1.0, &[]),
    ("ms", Time, 1e-3, &["millis"]),
    ("us", Time, 1e-6, &["\u{3bc}s"]),
    ("min", Time, 60.0, &["mins", "minutes"]),
    ("years", Time, 365.25 * 86400.0, &["year", "yr", "yrs"]),
    ("ka", Time, 1000.0 * 365.25 * 86400.0, &["kyr"]),
    ("rad", Angle, 1.0, &[]),
    ("deg", Angle, std::f64::consts::PI / 180.0, &["degrees", "\u{b0}"]),
    ("rad/s", AngularFrequency, 1.0, &[]),
    ("Hz", AngularFrequency, std::f64::consts::TAU, &["hz"]),
    ("kg", Mass, 1.0, &["kgs", "kilogram", "kilograms"]),
    ("t", Mass, 1000.0, &["ton", "tons", "tonne", "tonnes"]),
    ("lb", Mass, 0.453_592_37, &["lbs", "pounds"]),
    ("counts", Counts, 1.0, &["count"]),
    ("volt", Counts, 1.0, &["volts", "mv"]),
];

impl Unit {
    /// Reads a unit, in any common notation: `cm/s^2`, `cm/sec/sec`, `cm_s2`, `cm s-2`. None of text that is
    /// no unit.
    pub fn parse(text: &str) -> Option<Unit> {
        let per = |c: char| if c.is_whitespace() || "_.\u{b7}\u{22c5}".contains(c) { '/' } else { c };
        let text = text.trim().trim_end_matches('.').to_lowercase().replace('\u{b2}', "2");
        // The Greek letter for the micro sign, and no sign of an exponent.
        let text = text.replace('\u{b5}', "\u{3bc}").replace('\u{b9}', "1").replace('\u{207b}', "");
        let text = text.replace("seconds", "s").replace("second", "s").replace("sec", "s");
        // Alone, quotation marks are units.
        let is_left_out =
            |c: &char| matches!(c, '-' | '^' | '*') || *c == '\'' && text.contains(char::is_alphabetic);
        let plain: String = text.chars().filter(|c| !is_left_out(c)).map(per).collect();
        let begins = |(_, words): &&(_, &[&str])| words.iter().any(|word| plain.starts_with(word));
        let known = BEGINNINGS.iter().find(begins).filter(|_| !plain.contains('/'));
        let plain = known.map_or(&*plain, |(name, _)| name);
        let (name, quantity, si, _) =
            UNITS.iter().find(|(name, .., others)| *name == plain || others.contains(&plain))?;
        Some(Unit { name, quantity: *quantity, si: *si })
    }

    /// # Errors
    /// With the known units of acceleration, if it is not one of them.
    pub fn parse_acceleration(text: &str) -> Result<Unit, String> {
        let known = UNITS.iter().filter(|(_, quantity, ..)| *quantity == Acceleration);
        let known: Vec<&str> = known.map(|(name, ..)| *name).collect();
        let found = Unit::parse(text).filter(|unit| unit.quantity == Acceleration);
        found.ok_or_else(|| format!("expected a unit of acceleration: {}", known.join(", ")))
    }
}
