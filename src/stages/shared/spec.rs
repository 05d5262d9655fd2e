//! A structure as it is given, and where it stands: as options, as NAME=VALUE, or as a row of a list.

use std::str::FromStr;

use clap::Args;

use crate::keyword::nearest;
use crate::pipeline::options::number;

/// A structure as it is given: its dimensions, or p, alpha and eta.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[group(id = "one", multiple = true)]
pub struct Spec {
    #[arg(skip)]
    pub name: Option<String>,
    /// Width of the base of a block, body or column, m; without --depth the smaller side
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub width: Option<f64>,
    /// Height of the block, body or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub height: Option<f64>,
    /// Depth of the base, m: it may fall that way too
    #[arg(long, value_name = "M", requires = "width")]
    pub depth: Option<f64>,
    /// Height of the centre of mass above the base, m [default: half of the height]
    #[arg(long, value_name = "M", requires = "height")]
    pub centre_height: Option<f64>,
    /// Distance of the centre of mass from the middle of the width, m [default: 0]
    #[arg(long, value_name = "M", requires = "width", allow_negative_numbers = true)]
    pub centre_offset: Option<f64>,
    /// Moment of inertia about the centre of mass over mass, m2 [default: of a solid block]
    #[arg(long, value_name = "M2", requires = "height")]
    pub inertia: Option<f64>,
    /// Of a frame: mass of the beam over that of all columns
    #[arg(long, value_name = "RATIO", conflicts_with_all = ["p", "alpha", "depth", "centre_height", "centre_offset", "inertia"])]
    pub beam_mass_ratio: Option<f64>,
    /// Frequency parameter, rad/s
    #[arg(long, value_name = "RAD/S")]
    pub p: Option<f64>,
    /// Slenderness, rad
    #[arg(long, value_name = "RAD")]
    pub alpha: Option<f64>,
    /// Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    #[arg(long)]
    pub eta: Option<Restitution>,
    #[arg(skip)]
    pub place: Place,
    /// Why it is not free to rock.
    #[arg(skip)]
    pub held: Option<String>,
}

/// Where an object stands, and how well it is known; of all objects of a list that do not say so themselves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Args)]
#[command(next_help_heading = "Object")]
pub struct Place {
    /// First period of the building, s [default: it stands on the ground]
    #[arg(long, value_name = "S", value_parser = number(0.02..=10.0, "a period from 0.02 to 10 s: is it in Hz?"))]
    pub period: Option<f64>,
    /// Height of the floor over that of the roof, 0 to 1
    #[arg(long, value_name = "Z", value_parser = number(0.0..=1.0, "the height over that of the roof, 0 to 1: 0.6 for storey 3 of 5"))]
    pub level: Option<f64>,
    /// Standard deviation of ln(period) [default: 0.25]
    #[arg(long, value_name = "SD", value_parser = number(0.0..=1.0, "a standard deviation of ln(period), 0 to 1: is it in s or percent?"))]
    pub period_sd: Option<f64>,
    /// Coefficient of friction: where tan(alpha) is above it, the object slides
    #[arg(long, value_name = "MU", value_parser = number(0.01..=2.0, "a coefficient of friction from 0.01 to 2"))]
    pub friction: Option<f64>,
    /// Standard deviation of eta [default: 0 of a number; that of tests if it is computed]
    #[arg(long, value_name = "SD", value_parser = number(0.0..=0.5, "a standard deviation from 0 to 0.5"))]
    pub eta_sd: Option<f64>,
    /// Standard deviation of the height of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = number(0.0..=100.0, "a length of 0 m or more"))]
    pub centre_height_sd: Option<f64>,
    /// Standard deviation of the offset of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = number(0.0..=100.0, "a length of 0 m or more"))]
    pub centre_offset_sd: Option<f64>,
    /// Number of such objects.
    #[arg(skip)]
    pub count: Option<f64>,
}

impl Place {
    /// What is given of it, else what `other` says.
    pub fn or(self, other: &Place) -> Place {
        Place {
            period: self.period.or(other.period),
            level: self.level.or(other.level),
            period_sd: self.period_sd.or(other.period_sd),
            friction: self.friction.or(other.friction),
            eta_sd: self.eta_sd.or(other.eta_sd),
            centre_height_sd: self.centre_height_sd.or(other.centre_height_sd),
            centre_offset_sd: self.centre_offset_sd.or(other.centre_offset_sd),
            count: self.count.or(other.count),
        }
    }
}

/// A coefficient of restitution as it is given.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Restitution {
    Number(f64),
    Housner,
}

impl FromStr for Restitution {
    type Err = String;

    fn from_str(text: &str) -> Result<Restitution, String> {
        match text.parse() {
            Ok(eta) => Ok(Restitution::Number(eta)),
            Err(_) if text == "housner" => Ok(Restitution::Housner),
            Err(_) => Err("expected a number above 0 and up to 1, or housner".to_string()),
        }
    }
}

/// The parameters of a structure that are numbers.
pub const NUMBERS: [&str; 17] = [
    "p",
    "alpha",
    "width",
    "height",
    "depth",
    "centre-height",
    "centre-offset",
    "inertia",
    "beam-mass-ratio",
    "period",
    "level",
    "period-sd",
    "friction",
    "eta-sd",
    "centre-height-sd",
    "centre-offset-sd",
    "count",
];

impl FromStr for Spec {
    type Err = String;

    fn from_str(text: &str) -> Result<Spec, String> {
        let mut spec = Spec::default();
        for pair in text.split(',') {
            let (key, value) = pair
                .split_once('=')
                .ok_or_else(|| format!("'{pair}': expected name=, eta=, {}=VALUE", NUMBERS.join("=, ")))?;
            spec.set(&key.trim().replace('_', "-"), value.trim())?;
        }
        Ok(spec)
    }
}

impl Spec {
    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match (key, self.number_mut(key)) {
            (_, Some(number)) => {
                *number = Some(value.parse().map_err(|_| format!("{key} is '{value}'; expected a number"))?);
            }
            ("name", _) => self.name = Some(value.to_string()),
            ("eta", _) => self.eta = Some(value.parse()?),
            _ => {
                let known = [&["name", "eta"], &NUMBERS[..]].concat();
                let hint =
                    nearest(key, &known).map_or(String::new(), |near| format!("; did you mean '{near}'?"));
                return Err(format!("unknown parameter '{key}'{hint}"));
            }
        }
        Ok(())
    }

    /// The number of this name.
    pub fn number_mut(&mut self, key: &str) -> Option<&mut Option<f64>> {
        Some(match key {
            "p" => &mut self.p,
            "alpha" => &mut self.alpha,
            "width" => &mut self.width,
            "height" => &mut self.height,
            "depth" => &mut self.depth,
            "centre-height" => &mut self.centre_height,
            "centre-offset" => &mut self.centre_offset,
            "inertia" => &mut self.inertia,
            "beam-mass-ratio" => &mut self.beam_mass_ratio,
            "period" => &mut self.place.period,
            "level" => &mut self.place.level,
            "period-sd" => &mut self.place.period_sd,
            "friction" => &mut self.place.friction,
            "eta-sd" => &mut self.place.eta_sd,
            "centre-height-sd" => &mut self.place.centre_height_sd,
            "centre-offset-sd" => &mut self.place.centre_offset_sd,
            "count" => &mut self.place.count,
            _ => return None,
        })
    }

    /// The numbers that are given, by name.
    pub fn given(&self) -> Vec<(&'static str, f64)> {
        let mut spec = self.clone();
        let eta = match self.eta {
            Some(Restitution::Number(eta)) => Some(("eta", eta)),
            _ => None,
        };
        let numbers = NUMBERS.iter().filter_map(|key| Some((*key, (*spec.number_mut(key)?)?)));
        numbers.chain(eta).collect()
    }

    /// The same with a base so many times as wide: the offset with it, and the inertia as that of a solid
    /// block.
    pub fn resized(&self, factor: f64) -> Spec {
        let width = self.width.unwrap_or(0.0);
        let added = width * width * (factor * factor - 1.0) / 12.0;
        Spec {
            width: Some(factor * width),
            centre_offset: self.centre_offset.map(|offset| factor * offset),
            inertia: self.inertia.map(|inertia| inertia + added),
            ..self.clone()
        }
    }
}
