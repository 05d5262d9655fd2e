//! An object as it is given: as options, as NAME=VALUE, or as a row of a list.

use std::f64::consts::FRAC_PI_4;
use std::str::FromStr;

use clap::{Args, Parser};

use crate::pipeline::options::{in_one_line, number};
use crate::plausibility::GIVEN_FREQUENCIES_RAD_S;
use crate::rocking::{Structure, StructureError};
use crate::warning::UNNAMED;

#[derive(Debug, Clone, Default, PartialEq, Parser)]
#[command(no_binary_name = true, disable_help_flag = true, args_override_self = true)]
pub struct Spec {
    #[arg(long, default_value = UNNAMED)]
    pub name: String,
    /// Number of such objects.
    #[arg(long, value_parser = number(0..=1_000_000_u32, "a whole number of objects"))]
    pub count: Option<u32>,
    #[command(flatten)]
    pub shape: Shape,
    #[command(flatten)]
    pub place: Place,
    /// Why there is no answer for a row of a list.
    #[arg(skip)]
    pub refused: Option<Reason>,
}

const LENGTH: &str = "a length above 0 m, up to 200 m: is it in cm or mm?";
const SD: &str = "a standard deviation of 0 m or more, up to 100 m: is it in cm?";

/// A structure: its dimensions, or p, alpha and eta. No rocking structure is taller than 200 m, has a
/// semi-diagonal below 3 mm (p 50 rad/s) or above 184 m (p 0.2 rad/s), or is wider than tall (it slides).
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[group(id = "one", multiple = true)]
pub struct Shape {
    /// Width of the base of a block, body or column, m; the smaller side unless --depth is given
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"], value_parser = number(1e-4..=200.0, LENGTH))]
    pub width: Option<f64>,
    /// Height of the block, body or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"], value_parser = number(1e-3..=200.0, LENGTH))]
    pub height: Option<f64>,
    /// Depth of the base, m; the object may also fall that way
    #[arg(long, value_name = "M", requires = "width", value_parser = number(1e-4..=200.0, LENGTH))]
    pub depth: Option<f64>,
    /// Height of the centre of mass above the base, m [default: half the height]
    #[arg(long, value_name = "M", requires = "height", value_parser = number(1e-6..=200.0, LENGTH))]
    pub centre_height: Option<f64>,
    /// Distance of the centre of mass from the middle of the width, m [default: 0]
    #[arg(long, value_name = "M", requires = "width", allow_negative_numbers = true,
          value_parser = number(-100.0..=100.0, "a length up to 100 m: is it in cm or mm?"))]
    pub centre_offset: Option<f64>,
    /// Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid block]
    #[arg(long, value_name = "M2", requires = "height",
          value_parser = number(1e-9..=2e4, "m2, above 0: is it about an edge, or times mass?"))]
    pub inertia: Option<f64>,
    /// Frame: mass of the beam over that of all columns
    #[arg(long, value_name = "RATIO", conflicts_with_all = ["p", "alpha", "depth", "centre_height", "centre_offset", "inertia"],
          value_parser = number(0.0..=20.0, "a mass ratio from 0 to 20: is it in percent?"))]
    pub beam_mass_ratio: Option<f64>,
    /// Frequency parameter, rad/s
    #[arg(long, value_name = "RAD/S",
          value_parser = number(GIVEN_FREQUENCIES_RAD_S, "rad/s, from 0.2 to 50: is it in Hz, or of dimensions in cm or mm?"))]
    pub p: Option<f64>,
    /// Slenderness, rad
    #[arg(long, value_name = "RAD",
          value_parser = number(0.01..=FRAC_PI_4, "rad, from 0.01 to 0.7854 (45 degrees): is it in degrees, height over width, or p?"))]
    pub alpha: Option<f64>,
    /// Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    #[arg(long)]
    pub eta: Option<Restitution>,
}

impl Shape {
    /// What it is, in words.
    pub fn kind(&self) -> &'static str {
        let is_solid = self.centre_height.is_none_or(|centre| Some(2.0 * centre) == self.height)
            && self.centre_offset.is_none_or(|offset| offset == 0.0)
            && self.inertia.is_none();
        match (self.width, self.beam_mass_ratio) {
            (None, _) => "Structure",
            (_, Some(_)) => "Frame of columns",
            _ if is_solid => "Block",
            _ => "Body",
        }
    }
}

/// Where an object stands, and how well it is known; of all objects of a list that do not say so themselves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Args)]
#[command(next_help_heading = "Object")]
pub struct Place {
    /// First period of the building, s [default: the object stands on the ground]
    #[arg(long, value_name = "S", value_parser = number(0.02..=10.0, "a period from 0.02 to 10 s: is it in Hz?"))]
    pub period: Option<f64>,
    /// Height of the floor over that of the roof, 0 to 1
    #[arg(long, value_name = "Z", value_parser = number(0.0..=1.0, "the height over that of the roof, 0 to 1: 0.6 for storey 3 of 5"))]
    pub level: Option<f64>,
    /// Standard deviation of ln(period) [default: 0.25]
    #[arg(long, value_name = "SD", value_parser = number(0.0..=1.0, "a standard deviation of ln(period), 0 to 1: is it in s or percent?"))]
    pub period_sd: Option<f64>,
    /// Coefficient of friction; if tan(alpha) exceeds it, the object slides
    #[arg(long, value_name = "MU", value_parser = number(0.01..=2.0, "a coefficient of friction from 0.01 to 2"))]
    pub friction: Option<f64>,
    /// Standard deviation of eta [default: 0 if eta is given; that of tests if it is computed]
    #[arg(long, value_name = "SD", value_parser = number(0.0..=0.5, "a standard deviation from 0 to 0.5"))]
    pub eta_sd: Option<f64>,
    /// Standard deviation of the height of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = number(0.0..=100.0, SD))]
    pub centre_height_sd: Option<f64>,
    /// Standard deviation of the offset of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = number(0.0..=100.0, SD))]
    pub centre_offset_sd: Option<f64>,
}

/// Why there is no answer for an object.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Reason {
    #[error("{0}")]
    Implausible(String),
    #[error("{0}")]
    NotRocking(String),
}

impl From<StructureError> for Reason {
    fn from(StructureError { parameter, value, expected, .. }: StructureError) -> Reason {
        Reason::Implausible(format!("{parameter} is {value}; expected {expected}"))
    }
}

/// A coefficient of restitution as it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Restitution {
    Number(f64),
    Housner,
    /// Of a fitted structure: its fits do not say how it was found.
    Fitted(f64),
}

impl FromStr for Restitution {
    type Err = String;

    fn from_str(text: &str) -> Result<Restitution, String> {
        match text.parse() {
            Ok(eta) if eta > 0.0 && eta <= 1.0 => Ok(Restitution::Number(eta)),
            Err(_) if text == "housner" => Ok(Restitution::Housner),
            _ => Err("expected a number above 0 and up to 1, or housner".to_string()),
        }
    }
}

impl FromStr for Spec {
    type Err = String;

    fn from_str(text: &str) -> Result<Spec, String> {
        let pair = |pair: &str| {
            let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
            (name.trim().replace('_', "-"), value.trim().to_string())
        };
        Spec::of_pairs(text.split(',').map(pair))
    }
}

impl Spec {
    /// Reads names and values as the options that they are.
    pub fn of_pairs(pairs: impl Iterator<Item = (String, String)>) -> Result<Spec, String> {
        let words = pairs.map(|(name, value)| format!("--{name}={value}"));
        Spec::try_parse_from(words).map_err(|refused| in_one_line(&refused))
    }

    /// A structure whose parameters are known.
    pub fn of_structure(structure: Structure, eta: fn(f64) -> Restitution) -> Spec {
        let Structure { name, p_rad_s, alpha_rad, eta: value } = structure;
        let shape =
            Shape { p: Some(p_rad_s), alpha: Some(alpha_rad), eta: Some(eta(value)), ..Shape::default() };
        Spec { name, shape, ..Spec::default() }
    }

    /// Where it does not say itself where it stands, it stands in this place.
    pub fn at(self, other: &Place) -> Spec {
        let own = self.place;
        let place = Place {
            period: own.period.or(other.period),
            level: own.level.or(other.level),
            period_sd: own.period_sd.or(other.period_sd),
            friction: own.friction.or(other.friction),
            eta_sd: own.eta_sd.or(other.eta_sd),
            centre_height_sd: own.centre_height_sd.or(other.centre_height_sd),
            centre_offset_sd: own.centre_offset_sd.or(other.centre_offset_sd),
        };
        Spec { place, ..self }
    }

    /// The same with a base this many times as wide: the offset with it, and the inertia as that of a solid
    /// block.
    pub fn resized(&self, factor: f64) -> Spec {
        let shape = &self.shape;
        let width = shape.width.unwrap_or(0.0);
        let added = width * width * (factor * factor - 1.0) / 12.0;
        let shape = Shape {
            width: Some(factor * width),
            centre_offset: shape.centre_offset.map(|offset| factor * offset),
            inertia: shape.inertia.map(|inertia| inertia + added),
            ..shape.clone()
        };
        Spec { shape, ..self.clone() }
    }
}
