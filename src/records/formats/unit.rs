use crate::units::G_M_S2;

/// A unit of acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AccelerationUnit {
    G,
    MilliG,
    MetrePerSecond2,
    /// Also called gal.
    CentimetrePerSecond2,
    MillimetrePerSecond2,
}

/// How units are written, without blanks and in lower case.
const NAMES: [(&str, AccelerationUnit); 23] = [
    ("g", AccelerationUnit::G),
    ("mg", AccelerationUnit::MilliG),
    ("milli-g", AccelerationUnit::MilliG),
    ("m/s2", AccelerationUnit::MetrePerSecond2),
    ("m/s/s", AccelerationUnit::MetrePerSecond2),
    ("m/s^2", AccelerationUnit::MetrePerSecond2),
    ("m/s**2", AccelerationUnit::MetrePerSecond2),
    ("m/sec2", AccelerationUnit::MetrePerSecond2),
    ("m/sec/sec", AccelerationUnit::MetrePerSecond2),
    ("m/sec^2", AccelerationUnit::MetrePerSecond2),
    ("cm/s2", AccelerationUnit::CentimetrePerSecond2),
    ("cm/s/s", AccelerationUnit::CentimetrePerSecond2),
    ("cm/s^2", AccelerationUnit::CentimetrePerSecond2),
    ("cm/s**2", AccelerationUnit::CentimetrePerSecond2),
    ("cm/sec2", AccelerationUnit::CentimetrePerSecond2),
    ("cm/sec/sec", AccelerationUnit::CentimetrePerSecond2),
    ("cm/sec^2", AccelerationUnit::CentimetrePerSecond2),
    ("cm/sec**2", AccelerationUnit::CentimetrePerSecond2),
    ("gal", AccelerationUnit::CentimetrePerSecond2),
    ("gals", AccelerationUnit::CentimetrePerSecond2),
    ("mm/s2", AccelerationUnit::MillimetrePerSecond2),
    ("mm/s/s", AccelerationUnit::MillimetrePerSecond2),
    ("mm/s^2", AccelerationUnit::MillimetrePerSecond2),
];

impl AccelerationUnit {
    /// Returns the factor from this unit to m/s2.
    pub fn in_m_s2(self) -> f64 {
        match self {
            AccelerationUnit::G => G_M_S2,
            AccelerationUnit::MilliG => G_M_S2 / 1000.0,
            AccelerationUnit::MetrePerSecond2 => 1.0,
            AccelerationUnit::CentimetrePerSecond2 => 0.01,
            AccelerationUnit::MillimetrePerSecond2 => 0.001,
        }
    }

    /// Reads the unit with which a text begins; words, a full stop or a code in brackets may follow it.
    pub fn leading(text: &str) -> Option<AccelerationUnit> {
        let text = text.trim_start().to_ascii_lowercase();
        let name = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | '(' | ';')).next()?;
        AccelerationUnit::named(name.trim_end_matches('.'))
    }

    fn named(name: &str) -> Option<AccelerationUnit> {
        NAMES.iter().find(|(known, _)| *known == name).map(|(_, unit)| *unit)
    }
}

impl std::str::FromStr for AccelerationUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<AccelerationUnit, String> {
        let expected =
            || format!("'{text}' is no unit of acceleration; expected g, mg, m/s2, cm/s2, gal or mm/s2");
        AccelerationUnit::named(&text.trim().to_ascii_lowercase()).ok_or_else(expected)
    }
}

impl std::fmt::Display for AccelerationUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(match self {
            AccelerationUnit::G => "g",
            AccelerationUnit::MilliG => "mg",
            AccelerationUnit::MetrePerSecond2 => "m/s2",
            AccelerationUnit::CentimetrePerSecond2 => "cm/s2",
            AccelerationUnit::MillimetrePerSecond2 => "mm/s2",
        })
    }
}
