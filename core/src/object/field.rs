//! The numbers that may be known of an object, by the names that options, lists and messages have for them.

use std::f64::consts::FRAC_PI_4;
use std::ops::RangeInclusive;

use crate::plausibility::GIVEN_FREQUENCIES_RAD_S;
use crate::spelling::unknown_word;
use crate::units::Quantity;

/// A number that may be known of an object. Lengths are in m.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case", parse_err_ty = String, parse_err_fn = unknown_word::<Field>)]
pub enum Field {
    /// Width of the base of a block, body or column.
    Width,
    Depth,
    Height,
    /// Height of the centre of mass above the base.
    CentreHeight,
    /// Distance of the centre of mass from the middle of the width.
    CentreOffset,
    /// Moment of inertia about the centre of mass, per unit mass, m2.
    Inertia,
    /// Mass of the beam of a frame over that of all columns.
    BeamMassRatio,
    /// Frequency parameter, rad/s.
    P,
    /// Slenderness, rad.
    Alpha,
    Eta,
    /// First period of the building, s.
    Period,
    /// Height of the floor over that of the roof.
    Level,
    /// Standard deviation of ln(period).
    PeriodSd,
    Friction,
    EtaSd,
    CentreHeightSd,
    CentreOffsetSd,
}

const SIDE: &str = "a side above 0 m, up to 50 m: is it in cm or mm?";
const HEIGHT: &str = "a height above 0 m, up to 100 m: is it in cm or mm?";
const SD: &str = "a standard deviation of 0 m or more, up to 100 m: is it in cm?";

impl Field {
    /// The least and the largest value that an object can have, and what is expected. No rocking
    /// structure is taller than 100 m (the piers of the South Rangitikei viaduct have 78 m), has a
    /// semi-diagonal below 3 mm (p 50 rad/s) or above 184 m (p 0.2 rad/s), or is wider than tall (it slides).
    #[rustfmt::skip]
    pub fn range(self) -> (RangeInclusive<f64>, &'static str) {
        match self {
            Field::Width | Field::Depth => (1e-4..=50.0, SIDE),
            Field::Height => (1e-3..=100.0, HEIGHT),
            Field::CentreHeight => (1e-6..=100.0, HEIGHT),
            Field::CentreOffset => (-100.0..=100.0, "a length up to 100 m: is it in cm or mm?"),
            Field::Inertia => (1e-9..=2e4, "m2, above 0: is it about an edge, or times mass?"),
            Field::BeamMassRatio => (0.0..=20.0, "a mass ratio from 0 to 20: is it in percent?"),
            Field::P => (GIVEN_FREQUENCIES_RAD_S,
                "rad/s, from 0.2 to 50: is it in Hz, or of dimensions in cm or mm?"),
            Field::Alpha => (0.01..=FRAC_PI_4,
                "rad, from 0.01 to 0.7854 (45 degrees): is it in degrees, height over width, or p?"),
            Field::Eta => (f64::MIN_POSITIVE..=1.0, "a number above 0 and up to 1, or housner"),
            Field::Period => (0.02..=10.0, "a period from 0.02 to 10 s: is it in Hz?"),
            Field::Level => (0.0..=1.0, "the height over that of the roof, 0 to 1: 0.6 for storey 3 of 5"),
            Field::PeriodSd => (0.0..=1.0,
                "a standard deviation of ln(period), 0 to 1: is it in s or percent?"),
            Field::Friction => (0.01..=2.0, "a coefficient of friction from 0.01 to 2"),
            Field::EtaSd => (0.0..=0.5, "a standard deviation from 0 to 0.5"),
            Field::CentreHeightSd | Field::CentreOffsetSd => (0.0..=100.0, SD),
        }
    }

    /// None where it has no unit, or none that a list may change.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Field::P => Some(Quantity::AngularFrequency),
            Field::Alpha => Some(Quantity::Angle),
            Field::Period => Some(Quantity::Time),
            Field::Width | Field::Depth | Field::Height | Field::CentreHeight | Field::CentreOffset => {
                Some(Quantity::Length)
            }
            Field::CentreHeightSd | Field::CentreOffsetSd => Some(Quantity::Length),
            _ => None,
        }
    }

    /// # Errors
    /// With what is expected, if no object can have this value.
    pub fn parse_value(self, text: &str) -> Result<f64, String> {
        let (range, expected) = self.range();
        match text.parse::<f64>() {
            Ok(value) if range.contains(&value) => Ok(value),
            _ if text.contains(',') => Err(format!("expected {expected}, with a point before the decimals")),
            _ => Err(format!("expected {expected}")),
        }
    }
}
