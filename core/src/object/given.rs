//! An object as given: its shape, its place, and the uncertainty of both.

use std::collections::HashSet;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::contacts::{Base, Wall};
use super::field::Field;
use super::rocking::SD_OF_PERIOD;
use crate::motion::Floor;
use crate::rocking::{Structure, StructureError};
use crate::warning::UNNAMED;

/// Dimensions of a block, body or frame, or p, alpha and eta: see [`Field`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Shape {
    pub width: Option<f64>,
    pub depth: Option<f64>,
    pub height: Option<f64>,
    pub centre_height: Option<f64>,
    #[serde(skip_serializing_if = "is_zero")]
    pub centre_offset: Option<f64>,
    pub inertia: Option<f64>,
    /// That in the plane of the depth, where it differs from `inertia` by more than a solid block's.
    #[serde(skip)]
    pub inertia_across: Option<f64>,
    pub beam_mass_ratio: Option<f64>,
    pub p: Option<f64>,
    pub alpha: Option<f64>,
    pub eta: Option<Restitution>,
}

/// Where an object stands, and the uncertainty of its properties: see [`Field`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Place {
    pub period: Option<f64>,
    pub level: Option<f64>,
    #[serde(skip_serializing_if = "is_sd_of_period")]
    pub period_sd: Option<f64>,
    pub friction: Option<f64>,
    pub base: Option<Base>,
    pub wall: Option<Wall>,
    pub eta_sd: Option<f64>,
    #[serde(skip_serializing_if = "is_zero")]
    pub alpha_sd: Option<f64>,
    #[serde(skip_serializing_if = "is_zero")]
    pub centre_height_sd: Option<f64>,
    #[serde(skip_serializing_if = "is_zero")]
    pub centre_offset_sd: Option<f64>,
    pub mass: Option<f64>,
    pub fixed_to_pedestal: Option<bool>,
    pub pedestal_width: Option<f64>,
    pub pedestal_depth: Option<f64>,
    pub pedestal_height: Option<f64>,
    pub pedestal_mass: Option<f64>,
}

/// Whether a number says what its absence says.
fn is_zero(number: &Option<f64>) -> bool {
    number.is_none_or(|number| number == 0.0)
}

fn is_sd_of_period(number: &Option<f64>) -> bool {
    number.is_none_or(|number| number == SD_OF_PERIOD)
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Restitution {
    /// Housner's, 1 - 1.5 sin^2(alpha).
    Housner,
    #[serde(untagged)]
    Number(f64),
    /// Of a fitted structure, whose fits do not say how it was found.
    #[serde(untagged)]
    Fitted(f64),
}

impl FromStr for Restitution {
    type Err = String;

    fn from_str(text: &str) -> Result<Restitution, String> {
        match text {
            "housner" => Ok(Restitution::Housner),
            _ => Field::Eta.parse_value(text).map(Restitution::Number),
        }
    }
}

/// Why there is no answer for an object.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ObjectError {
    /// Values that cannot be right.
    #[error("{0}")]
    Implausible(String),
    /// An object that slides, rolls or is held.
    #[error("{0}")]
    NotRocking(String),
}

impl From<StructureError> for ObjectError {
    fn from(StructureError { parameter, value, expected, .. }: StructureError) -> ObjectError {
        ObjectError::Implausible(format!("{parameter} is {value}; expected {expected}"))
    }
}

/// An object: what is known of it, or why there is no answer.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Object {
    pub name: String,
    /// Number of such objects.
    pub count: Option<u32>,
    /// Its own time of exposure, years.
    #[serde(skip)]
    pub years: Option<f64>,
    #[serde(flatten)]
    pub shape: Shape,
    #[serde(flatten)]
    pub place: Place,
    /// As the list of the object has it: `floor 3 of 5`.
    #[serde(skip)]
    pub floor: Option<String>,
    /// Of a round base, in place of which there is the square around it.
    #[serde(skip)]
    pub is_round: bool,
    /// What else the list of the object says of it, as it is written there: headings and cells.
    #[serde(skip)]
    pub labels: Vec<(String, String)>,
    /// Why there is no answer, whatever its shape.
    #[serde(skip)]
    pub refused: Option<ObjectError>,
}

impl FromStr for Object {
    type Err = String;

    /// Reads an object as `name=cabinet,width=0.5,height=2`.
    fn from_str(text: &str) -> Result<Object, String> {
        Object::of_fields(text.split(',').map(|pair| pair.split_once('=').unwrap_or((pair, ""))))
    }
}

pub const MOST_OBJECTS: u32 = 1_000_000;

impl Object {
    /// Reads an object of its fields, each by its word and as text.
    ///
    /// # Errors
    /// If there is no such field, one is given twice, or an object cannot have this value.
    pub fn of_fields<'a>(fields: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Object, String> {
        let mut object = Object { name: UNNAMED.to_string(), ..Object::default() };
        let mut given = HashSet::new();
        for (name, text) in fields {
            let name = name.trim().replace('_', "-");
            object.set(&name, text.trim())?;
            if let Some(name) = given.replace(name) {
                return Err(format!("{name} is given twice; expected one value"));
            }
        }
        Ok(object)
    }

    /// A solid block on the ground.
    pub fn block(name: &str, width_m: f64, height_m: f64) -> Object {
        let shape = Shape { width: Some(width_m), height: Some(height_m), ..Shape::default() };
        Object { name: name.to_string(), shape, ..Object::default() }
    }

    pub fn with_parameters(structure: &Structure, eta: Restitution) -> Object {
        let (p, alpha) = (Some(structure.p_rad_s), Some(structure.alpha_rad));
        let shape = Shape { p, alpha, eta: Some(eta), ..Shape::default() };
        Object { name: structure.name.clone(), shape, ..Object::default() }
    }

    /// Sets a [`Field`], the `count` of such objects or their `name`.
    ///
    /// # Errors
    /// If there is no such field, or an object cannot have this value.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), String> {
        let refuse = |expected: String| format!("{name} is {text}; {expected}");
        match name {
            "name" => self.name = text.to_string(),
            "count" => {
                let count = text.parse().ok().filter(|count| *count <= MOST_OBJECTS);
                let expected = || refuse("expected a whole number of objects".to_string());
                self.count = Some(count.ok_or_else(expected)?);
            }
            "eta" => self.shape.eta = Some(text.parse().map_err(refuse)?),
            "base" => self.place.base = Some(text.to_lowercase().parse().map_err(refuse)?),
            "wall" => self.place.wall = Some(text.parse().map_err(refuse)?),
            "fixed-to-pedestal" if matches!(text, "yes" | "no" | "true" | "false") => {
                self.place.fixed_to_pedestal = Some(matches!(text, "yes" | "true"));
            }
            _ => {
                let field: Field = name.parse()?;
                (field.entry().set)(self, field.parse_value(text).map_err(refuse)?);
            }
        }
        Ok(())
    }

    /// Fills in what the object does not say of where it stands.
    pub fn at(self, place: &Place) -> Object {
        Object { place: self.place.or(place), ..self }
    }

    /// On another base (m): the offset scales with the width, the inertia changes as that of a solid block.
    pub fn resized(&self, width_m: f64, depth_m: Option<f64>) -> Object {
        let shape = &self.shape;
        let width = shape.width.unwrap_or(width_m);
        let added = |to: f64, from: f64| (to * to - from * from) / 12.0;
        let across = shape.inertia_across.zip(shape.depth.zip(depth_m));
        let shape = Shape {
            width: Some(width_m),
            depth: depth_m,
            centre_offset: shape.centre_offset.map(|offset| width_m / width * offset),
            inertia: shape.inertia.map(|inertia| inertia + added(width_m, width)),
            inertia_across: across.map(|(inertia, (from, to))| inertia + added(to, from)),
            ..*shape
        };
        Object { shape, ..self.clone() }
    }
}

impl Shape {
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

    /// None of Housner's, and of that of a fitted structure.
    pub(super) fn given_eta(&self) -> Option<f64> {
        match self.eta {
            Some(Restitution::Number(eta)) => Some(eta),
            _ => None,
        }
    }
}

impl Place {
    fn or(self, other: &Place) -> Place {
        Place {
            period: self.period.or(other.period),
            level: self.level.or(other.level),
            period_sd: self.period_sd.or(other.period_sd),
            friction: self.friction.or(other.friction),
            base: self.base.or(other.base),
            wall: self.wall.or(other.wall),
            eta_sd: self.eta_sd.or(other.eta_sd),
            alpha_sd: self.alpha_sd.or(other.alpha_sd),
            centre_height_sd: self.centre_height_sd.or(other.centre_height_sd),
            centre_offset_sd: self.centre_offset_sd.or(other.centre_offset_sd),
            mass: self.mass.or(other.mass),
            fixed_to_pedestal: self.fixed_to_pedestal.or(other.fixed_to_pedestal),
            pedestal_width: self.pedestal_width.or(other.pedestal_width),
            pedestal_depth: self.pedestal_depth.or(other.pedestal_depth),
            pedestal_height: self.pedestal_height.or(other.pedestal_height),
            pedestal_mass: self.pedestal_mass.or(other.pedestal_mass),
        }
    }

    /// None on the ground.
    ///
    /// # Errors
    /// If only one of level and period is given.
    pub fn floor(&self) -> Result<Option<Floor>, ObjectError> {
        let missing = match (self.period, self.level) {
            (Some(period_s), Some(level)) => return Ok((level > 0.0).then_some(Floor { period_s, level })),
            (None, Some(level)) if level > 0.0 => "level needs period, the first of the building (s)",
            (Some(_), None) => "period needs level, the height of the floor over that of the roof",
            _ => return Ok(None),
        };
        Err(ObjectError::Implausible(missing.to_string()))
    }
}
