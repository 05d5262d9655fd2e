//! The numbers that may be known of an object, by the names that options, lists and messages have for them.

use std::f64::consts::FRAC_PI_4;
use std::ops::RangeInclusive;

use super::contacts::Wall;
use super::given::{Object, Restitution};
use crate::plausibility::GIVEN_FREQUENCIES_RAD_S;
use crate::spelling::unknown_word;
use crate::units::{Quantity, Unit};

/// What may be known of an object: [`Field::entry`] says of each what it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case", parse_err_ty = String, parse_err_fn = unknown_word::<Field>)]
pub enum Field {
    Width,
    Depth,
    Height,
    CentreHeight,
    CentreOffset,
    Inertia,
    BeamMassRatio,
    P,
    Alpha,
    Eta,
    Period,
    Level,
    PeriodSd,
    Friction,
    Base,
    Wall,
    EtaSd,
    AlphaSd,
    CentreHeightSd,
    CentreOffsetSd,
    Mass,
    FixedToPedestal,
    PedestalWidth,
    PedestalDepth,
    PedestalHeight,
    PedestalMass,
}

const SIDE: &str = "a side above 0 m, up to 50 m: is it in cm or mm?";
const HEIGHT: &str = "a height above 0 m, up to 100 m: is it in cm or mm?";
const MASS: &str = "a mass above 0 kg, up to 10 million: another unit?";
const MASSES: RangeInclusive<f64> = 1e-3..=1e7;
const SD: &str = "a standard deviation of 0 m or more, up to 100 m: is it in cm?";

/// What the command, lists and messages say of a field.
pub struct Entry {
    /// Unit or symbol of the number, as `--help` names it.
    pub symbol: &'static str,
    /// What a unit must measure; none where the number has no unit, or none that a list may change.
    pub quantity: Option<Quantity>,
    /// The least and the largest value that an object can have.
    pub range: RangeInclusive<f64>,
    pub expected: &'static str,
    pub help: &'static str,
    pub set: fn(&mut Object, f64),
}

impl Field {
    /// The words of the fields of [`Shape`](super::Shape) but `eta`; the others are of [`Place`](super::Place).
    pub const SIZES: [&str; 9] = [
        "width",
        "height",
        "depth",
        "centre-height",
        "centre-offset",
        "inertia",
        "beam-mass-ratio",
        "p",
        "alpha",
    ];

    /// No rocking structure is taller than 100 m (the piers of the South Rangitikei viaduct have 78 m), has a
    /// semi-diagonal below 3 mm (p 50 rad/s) or above 184 m (p 0.2 rad/s), or is wider than tall (it slides).
    #[rustfmt::skip]
    pub fn entry(self) -> Entry {
        use Quantity::{Angle, AngularFrequency, Length, Mass, Time};
        let (symbol, quantity, range, expected, help, set): (_, _, _, _, _, fn(&mut Object, f64)) = match self {
            Field::Width => ("M", Some(Length), 1e-4..=50.0, SIDE,
                "Width of the base of a block, body or column, m; the smaller side unless --depth is given",
                |of, m| of.shape.width = Some(m)),
            Field::Depth => ("M", Some(Length), 1e-4..=50.0, SIDE,
                "Depth of the base, m: the object may also fall that way; simulate and ida take the weaker direction",
                |of, m| of.shape.depth = Some(m)),
            Field::Height => ("M", Some(Length), 1e-3..=100.0, HEIGHT,
                "Height of the block, body or column, m", |of, m| of.shape.height = Some(m)),
            Field::CentreHeight => ("M", Some(Length), 1e-6..=100.0, HEIGHT,
                "Height of the centre of mass above the base, m [default: half the height]",
                |of, m| of.shape.centre_height = Some(m)),
            Field::CentreOffset => ("M", Some(Length), -100.0..=100.0, "a length up to 100 m: is it in cm or mm?",
                "Distance of the centre of mass from the middle of the width, m [default: 0]",
                |of, m| of.shape.centre_offset = Some(m)),
            Field::Inertia => ("M2", None, 1e-9..=2e4, "m2, above 0: is it about an edge, or times mass?",
                "Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid block]",
                |of, m2| of.shape.inertia = Some(m2)),
            Field::BeamMassRatio => ("RATIO", None, 0.0..=20.0, "a mass ratio from 0 to 20: is it in percent?",
                "Frame: mass of the beam over that of all columns", |of, y| of.shape.beam_mass_ratio = Some(y)),
            Field::P => ("RAD/S", Some(AngularFrequency), GIVEN_FREQUENCIES_RAD_S,
                "rad/s, from 0.2 to 50: is it in Hz, or of dimensions in cm or mm?",
                "Frequency parameter, rad/s", |of, p| of.shape.p = Some(p)),
            Field::Alpha => ("RAD", Some(Angle), 0.01..=FRAC_PI_4,
                "rad, from 0.01 to 0.7854 (45 degrees): is it in degrees (8.5deg), height over width, or p?",
                "Slenderness, rad, or in degrees as 8.5deg", |of, alpha| of.shape.alpha = Some(alpha)),
            Field::Eta => ("ETA", None, f64::MIN_POSITIVE..=1.0, "a number above 0 and up to 1, or housner",
                "Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]",
                |of, eta| of.shape.eta = Some(Restitution::Number(eta))),
            Field::Period => ("S", Some(Time), 0.02..=10.0, "a period from 0.02 to 10 s: is it in Hz?",
                "First period of the building, s [default: the object stands on the ground]",
                |of, s| of.place.period = Some(s)),
            Field::Level => ("Z", None, 0.0..=1.0,
                "the height over that of the roof, 0 to 1: 0.6 for storey 3 of 5",
                "Height of the floor over that of the roof, 0 to 1", |of, z| of.place.level = Some(z)),
            Field::PeriodSd => ("SD", None, 0.0..=1.0,
                "a standard deviation of ln(period), 0 to 1: is it in s or percent?",
                "Standard deviation of ln(period) [default: 0.25]", |of, sd| of.place.period_sd = Some(sd)),
            Field::Friction => ("MU", None, 0.01..=2.0, "a coefficient of friction from 0.01 to 2",
                "Coefficient of friction; if tan(alpha) exceeds it, the object slides",
                |of, mu| of.place.friction = Some(mu)),
            Field::Base => ("BASE", None, 1.0..=0.0, "concrete, stone, timber, steel, felt or rubber",
                "Base or feet: concrete, stone, timber, steel, felt or rubber; sets eta by tests",
                |_, _| {}),
            Field::Wall => ("REBOUND", None, 0.0..=0.9, "yes, or a rebound from 0 to 0.9",
                "Wall behind it, with its rebound if known: the velocity after an impact over that before",
                |of, rebound| of.place.wall = Some(Wall::Rebound(rebound))),
            Field::EtaSd => ("SD", None, 0.0..=0.5, "a standard deviation from 0 to 0.5",
                "Standard deviation of eta [default: 0 if eta is given; that of tests if it is computed]",
                |of, sd| of.place.eta_sd = Some(sd)),
            Field::AlphaSd => ("RAD", Some(Angle), 0.0..=0.2, "a standard deviation from 0 to 0.2 rad, or as 2deg",
                "Standard deviation of alpha, as by tilt tests, rad, or in degrees as 2deg [default: 0]",
                |of, sd| of.place.alpha_sd = Some(sd)),
            Field::CentreHeightSd => ("M", Some(Length), 0.0..=100.0, SD,
                "Standard deviation of the height of the centre of mass, m",
                |of, sd| of.place.centre_height_sd = Some(sd)),
            Field::CentreOffsetSd => ("M", Some(Length), 0.0..=100.0, SD,
                "Standard deviation of the offset of the centre of mass, m",
                |of, sd| of.place.centre_offset_sd = Some(sd)),
            Field::Mass => ("KG", Some(Mass), MASSES, MASS, "Mass of the object, beside that of its pedestal, kg",
                |of, kg| of.place.mass = Some(kg)),
            Field::FixedToPedestal => ("YES|NO", None, 1.0..=0.0, "yes or no",
                "Whether it is fixed to its pedestal, as one body, or loose on it", |_, _| {}),
            Field::PedestalWidth => ("M", Some(Length), 1e-4..=50.0, SIDE, "Width of the pedestal, m",
                |of, m| of.place.pedestal_width = Some(m)),
            Field::PedestalDepth => ("M", Some(Length), 1e-4..=50.0, SIDE, "Depth of the pedestal, m",
                |of, m| of.place.pedestal_depth = Some(m)),
            Field::PedestalHeight => ("M", Some(Length), 1e-3..=100.0, HEIGHT, "Height of the pedestal, m",
                |of, m| of.place.pedestal_height = Some(m)),
            Field::PedestalMass => ("KG", Some(Mass), MASSES, MASS, "Mass of the pedestal, kg",
                |of, kg| of.place.pedestal_mass = Some(kg)),
        };
        Entry { symbol, quantity, range, expected, help, set }
    }

    /// Reads a number that an object can have; with a unit, it is converted.
    ///
    /// # Errors
    /// With what is expected, if no object can have this value.
    pub fn parse_value(self, text: &str) -> Result<f64, String> {
        let Entry { quantity, range, expected, .. } = self.entry();
        let number = text.trim_end_matches(|sign: char| sign.is_alphabetic() || sign == '\u{b0}');
        let unit = Unit::parse(&text[number.len()..]).filter(|unit| Some(unit.quantity) == quantity);
        let value = text.parse().ok().or_else(|| Some(number.trim_end().parse::<f64>().ok()? * unit?.si));
        match value.filter(|value| range.contains(value)) {
            Some(value) => Ok(value),
            _ if text.contains(',') => Err(format!("expected {expected}, with a point before the decimals")),
            _ => Err(format!("expected {expected}")),
        }
    }
}
