//! Units as headers, headings and people write them.

use crate::units::G_M_S2;

/// A unit of acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AccelerationUnit {
    G,
    PercentG,
    MilliG,
    MetrePerSecond2,
    /// Also called gal.
    CentimetrePerSecond2,
    MillimetrePerSecond2,
    FootPerSecond2,
    InchPerSecond2,
}

use AccelerationUnit::{
    CentimetrePerSecond2, FootPerSecond2, G, InchPerSecond2, MetrePerSecond2, MilliG, MillimetrePerSecond2,
    PercentG,
};

/// Each unit with its name, in m/s2, and how it is written otherwise, of letters, digits and `%` alone.
const UNITS: [(AccelerationUnit, &str, f64, &[&str]); 8] = [
    (G, "g", G_M_S2, &["g", "gs"]),
    (PercentG, "%g", 0.01 * G_M_S2, &["%g", "percentg", "pctg"]),
    (MilliG, "mg", 0.001 * G_M_S2, &["mg", "millig"]),
    (MetrePerSecond2, "m/s2", 1.0, &["ms2", "mss"]),
    (CentimetrePerSecond2, "cm/s2", 0.01, &["cms2", "cmss", "gal", "gals"]),
    (MillimetrePerSecond2, "mm/s2", 0.001, &["mms2", "mmss"]),
    (FootPerSecond2, "ft/s2", 0.3048, &["fts2", "ftss"]),
    (InchPerSecond2, "in/s2", 0.0254, &["ins2", "inss"]),
];
/// How times are written, in s.
const TIMES: [(&[&str], f64); 4] = [
    (&["s", "sec", "secs", "second", "seconds"], 1.0),
    (&["ms", "msec", "millisecond", "milliseconds"], 1e-3),
    (&["us", "\u{b5}s", "\u{3bc}s", "usec"], 1e-6),
    (&["min", "mins", "minutes"], 60.0),
];
const LENGTHS: [&str; 5] = ["m", "cm", "mm", "in", "ft"];
const COUNTS: [&str; 5] = ["count", "counts", "volt", "volts", "mv"];

/// What the numbers of a column are in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unit {
    Acceleration(AccelerationUnit),
    /// So many seconds.
    Time(f64),
    Velocity,
    Displacement,
    /// Of an instrument that was not calibrated.
    Counts,
}

impl Unit {
    /// Finds the unit that a text names, and nothing else.
    pub fn named(text: &str) -> Option<Unit> {
        let lower = text.trim().to_lowercase().replace('\u{b2}', "2");
        if let Some(unit) = AccelerationUnit::named(&lower) {
            return Some(Unit::Acceleration(unit));
        }
        if let Some((_, in_s)) = TIMES.iter().find(|(names, _)| names.contains(&lower.as_str())) {
            return Some(Unit::Time(*in_s));
        }
        let is_velocity = |length: &str| {
            let per = lower.strip_prefix(length).map(|rest| rest.trim_matches([' ', '_', '/', '.', '*']));
            per.is_some_and(|per| {
                matches!(per, "s" | "sec" | "s-1" | "s^-1") && lower.len() > length.len() + per.len()
            })
        };
        if LENGTHS.iter().any(|length| is_velocity(length)) || lower == "kine" {
            return Some(Unit::Velocity);
        }
        if LENGTHS.contains(&lower.as_str()) {
            return Some(Unit::Displacement);
        }
        COUNTS.contains(&lower.as_str()).then_some(Unit::Counts)
    }
}

impl AccelerationUnit {
    /// Returns the factor from this unit to m/s2.
    pub fn in_m_s2(self) -> f64 {
        UNITS.iter().find(|(unit, ..)| *unit == self).map_or(1.0, |(_, _, in_m_s2, _)| *in_m_s2)
    }

    /// Reads the unit with which a text begins; words, a full stop or a code in brackets may follow it.
    pub fn leading(text: &str) -> Option<AccelerationUnit> {
        let text = text.trim_start();
        AccelerationUnit::named(
            text.split(|c: char| c.is_whitespace() || matches!(c, ',' | '(' | ';')).next()?,
        )
    }

    /// Finds a unit however its parts are joined: `cm/s^2`, `cm/sec/sec`, `cm_s2`, `cm s-2`.
    fn named(text: &str) -> Option<AccelerationUnit> {
        let is_joint = |c: char| c.is_whitespace() || matches!(c, '/' | '_' | '-' | '^' | '*' | '.' | '\'');
        let joined: String = text.to_lowercase().chars().filter(|c| !is_joint(*c)).collect();
        let name = joined.replace('\u{b2}', "2").replace("sec", "s");
        UNITS.iter().find(|(.., names)| names.contains(&name.as_str())).map(|(unit, ..)| *unit)
    }
}

impl std::str::FromStr for AccelerationUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<AccelerationUnit, String> {
        AccelerationUnit::named(text).ok_or_else(|| {
            format!(
                "'{text}' is not a unit of acceleration; expected g, mg, m/s2, cm/s2, gal, mm/s2, %g, ft/s2 or in/s2"
            )
        })
    }
}

impl std::fmt::Display for AccelerationUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(UNITS.iter().find(|(unit, ..)| unit == self).map_or("", |(_, name, ..)| name))
    }
}
