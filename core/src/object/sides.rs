//! The rocking structures of an object: by its parameters, as a frame, or for the sides of a body.

use std::f64::consts::FRAC_PI_4;

use super::contacts::{Base, Wall};
use super::given::{Object, ObjectError, Place, Restitution, Shape};
use super::rocking::{LowHigh, UncertaintySource};
use crate::rocking::{Body, Structure, StructureError, housner_eta};
use crate::statistics::normal::Z_95;
use crate::statistics::{Interval, normal, numerics};

/// A direction in which an object rocks.
#[derive(Debug, Clone, PartialEq)]
pub struct Side {
    pub structure: Structure,
    /// Structures at the quantiles of each property that is not known.
    pub at_quantiles: Vec<LowHigh<Structure>>,
}

/// Standard deviation of ln(1 - eta) about Housner's, by free rocking tests: blocks on concrete lost 1.2 to
/// 1.8 times as much (ElGawady et al. 2006), concrete and stone members less, down to 0.6 (Kalliontzis et al.
/// 2016, Ther & Kollar 2017).
const SD_OF_LOSS: f64 = 0.4;
/// Least coefficient of restitution at the ends of its uncertainty.
const LEAST_ETA: f64 = 0.01;
/// Least slenderness there, rad.
const LEAST_ALPHA: f64 = 0.01;
/// Largest share of the half width, or of the height, that a centre of mass is away from the middle or the
/// base.
const FARTHEST: f64 = 0.98;
/// No object is deeper than this times its height.
const LONGEST: f64 = 20.0;
/// No object has its centre of mass below this share of its height.
const LOWEST: f64 = 0.05;

impl Object {
    /// The directions in which the object rocks, the weaker first, without those in which it would slide.
    ///
    /// # Errors
    /// Why there is none.
    pub fn sides(&self) -> Result<Vec<Side>, ObjectError> {
        if let Some(reason) = &self.refused {
            return Err(reason.clone());
        }
        self.place.floor()?;
        let mut sides = self.all_sides()?;
        sides.sort_by(|a, b| a.friction().total_cmp(&b.friction()));
        let (least, friction) = (sides[0].friction(), self.place.friction.unwrap_or(f64::INFINITY));
        sides.retain(|side| side.friction() <= friction);
        if sides.is_empty() {
            let problem = format!("slides first: it rocks from a friction of {least:.2} on");
            return Err(ObjectError::NotRocking(problem));
        }
        self.place.wall.into_iter().for_each(|wall| put_before(wall, &mut sides));
        Ok(sides)
    }

    pub fn is_implausible(&self) -> bool {
        matches!(self.sides(), Err(ObjectError::Implausible(_)))
    }

    fn all_sides(&self) -> Result<Vec<Side>, ObjectError> {
        let Shape { p, alpha, eta, width, height, depth, centre_height, centre_offset, inertia, .. } =
            self.shape;
        let is_body = [depth, centre_height, centre_offset, inertia].iter().any(Option::is_some);
        match (p, alpha, width, height, self.shape.beam_mass_ratio) {
            (Some(p), Some(alpha), None, None, None) if !is_body => {
                let eta = match eta {
                    Some(Restitution::Number(eta) | Restitution::Fitted(eta)) => eta,
                    Some(Restitution::Housner) => housner_eta(alpha),
                    None => return Err(ObjectError::Implausible("p and alpha need eta".to_string())),
                };
                Ok(vec![self.side_like(Structure::new(&self.name, p, alpha, eta)?)])
            }
            (None, None, Some(width), Some(height), Some(ratio)) if !is_body => {
                self.check_dimensions(width, height)?;
                let eta = self.shape.given_eta();
                Ok(vec![self.side_like(Structure::frame(&self.name, width, height, ratio, eta)?)])
            }
            (None, None, Some(width), Some(height), None) => {
                self.check_dimensions(width, height)?;
                self.sides_of_body(height)
            }
            (None, None, Some(_), Some(_), Some(_)) => Err(ObjectError::Implausible(
                "beam-mass-ratio: expected width and height of a column alone".to_string(),
            )),
            _ => Err(ObjectError::Implausible("expected p, alpha and eta, or width and height".to_string())),
        }
    }

    pub(super) fn check_dimensions(&self, width: f64, height: f64) -> Result<(), ObjectError> {
        let (shape, place) = (&self.shape, &self.place);
        let side = shape.depth.map_or(width, |depth| depth.min(width));
        let (offset, inertia) =
            (shape.centre_offset.map(f64::abs), 3.0 * Body::solid_inertia_m2(width, height));
        let most = [
            ("width", Some(side), height, "m, the height: exchanged, or another unit?"),
            ("depth", shape.depth, LONGEST * height, "m, 20 times the height: is it in cm or mm?"),
            ("centre-height", shape.centre_height, height, "m, the height: exchanged, or another unit?"),
            (
                "centre-offset",
                offset,
                FARTHEST * 0.5 * width,
                "m, or it does not stand: from an edge, or in cm?",
            ),
            ("inertia", shape.inertia, inertia, "m2: is it about an edge, or times mass?"),
            ("centre-height-sd", place.centre_height_sd, height, "m, the height: is it in cm?"),
            ("centre-offset-sd", place.centre_offset_sd, width, "m, the width: is it in cm?"),
        ];
        if let Some(centre) = shape.centre_height.filter(|centre| *centre < LOWEST * height) {
            let least = LOWEST * height;
            let problem = format!("centre-height is {centre}; expected {least} m or more: another unit?");
            return Err(ObjectError::Implausible(problem));
        }
        for (name, value, most, expected) in most {
            if let Some(value) = value.filter(|value| *value > most) {
                let problem = format!("{name} is {value}; expected up to {most} {expected}");
                return Err(ObjectError::Implausible(problem));
            }
        }
        Ok(())
    }

    /// Only eta is uncertain: by its standard deviation if that is given, by tests if eta is computed.
    fn side_like(&self, mut structure: Structure) -> Side {
        let mut eta_sd = self.place.eta_sd;
        let is_computed = matches!(self.shape.eta, None | Some(Restitution::Housner));
        if let Some([ratio, sd]) = self.place.base.filter(|_| is_computed).map(Base::over_housner) {
            eta_sd = eta_sd.or(Some(sd * structure.eta));
            structure.eta = (ratio * structure.eta).min(1.0);
        }
        let off = LowHigh { source: UncertaintySource::Eta, low: -Z_95, high: Z_95 };
        let etas = match (eta_sd, self.shape.given_eta()) {
            (Some(sd), _) => Some(off.map(|off| structure.eta + off * sd)),
            (None, Some(_)) => None,
            (None, None) => Some(off.map(|off| 1.0 - (1.0 - structure.eta) * (-off * SD_OF_LOSS).exp())),
        };
        let structures = etas
            .map(|etas| etas.map(|eta| Structure { eta: eta.clamp(LEAST_ETA, 1.0), ..structure.clone() }));
        // A restitution that is computed follows alpha.
        let tilts = self.place.alpha_sd.map(|sd| LowHigh::normal(UncertaintySource::Object, sd)).map(|off| {
            off.map(|off| {
                let alpha_rad = (structure.alpha_rad + off).clamp(LEAST_ALPHA, FRAC_PI_4);
                let ratio = housner_eta(alpha_rad) / housner_eta(structure.alpha_rad);
                let eta = structure.eta * if is_computed { ratio } else { 1.0 };
                Structure { alpha_rad, eta: eta.clamp(LEAST_ETA, 1.0), ..structure.clone() }
            })
        });
        Side { structure, at_quantiles: structures.into_iter().chain(tilts).collect() }
    }

    /// Both directions of a body, or that of its width.
    fn sides_of_body(&self, height: f64) -> Result<Vec<Side>, ObjectError> {
        let bodies = self.shape.bodies().into_iter();
        let mut sides: Vec<_> = bodies.map(|body| self.side_of_body(body, height)).collect();
        if sides.iter().any(Result::is_ok) {
            // A squat direction slides, and so is no danger beside one that rocks.
            sides.retain(Result::is_ok);
        }
        sides.into_iter().collect()
    }

    fn side_of_body(&self, body: Body, height: f64) -> Result<Side, ObjectError> {
        let Place { centre_height_sd, centre_offset_sd, .. } = self.place;
        let centre = body.centre_height_m;
        let offset = folded_quantiles(body.centre_offset_m, centre_offset_sd.unwrap_or(0.0));
        let at = |centre_height_m: f64, centre_offset_m: f64| Body {
            centre_height_m: centre_height_m.clamp((1.0 - FARTHEST) * height, FARTHEST * height),
            centre_offset_m: centre_offset_m.min(FARTHEST * 0.5 * body.width_m),
            ..body
        };
        let mut found = self.side_like(self.structure_of_body(at(centre, offset.value), height)?);
        let alpha_rad = found.structure.alpha_rad;
        if alpha_rad > FRAC_PI_4 {
            let tan = alpha_rad.tan();
            let text = format!("squat: it slides unless its friction is above {tan:.2}");
            return Err(ObjectError::NotRocking(text));
        }
        let by_height =
            centre_height_sd.map(|sd| [-Z_95, Z_95].map(|off| at(centre + off * sd, offset.value)));
        let by_offset = centre_offset_sd.map(|_| [offset.low, offset.high].map(|offset| at(centre, offset)));
        for bodies in [by_height, by_offset].into_iter().flatten() {
            // A squat body slides, and so is no danger.
            let [low, high] = bodies
                .map(|body| self.structure_of_body(body, height).unwrap_or_else(|_| found.structure.clone()));
            found.at_quantiles.push(LowHigh { source: UncertaintySource::Object, low, high });
        }
        Ok(found)
    }

    /// A solid body by the formulas of a block.
    fn structure_of_body(&self, body: Body, height: f64) -> Result<Structure, StructureError> {
        let eta = self.shape.given_eta();
        match body == Body::solid(body.width_m, height) {
            true => Structure::rectangular_block(&self.name, body.width_m, height, eta),
            false => body.structure(&self.name, eta),
        }
    }
}

impl Shape {
    /// In the plane of the width and, with a depth, of that; none without width and height. The inertia about
    /// the other axis differs by that of a solid block unless it is known.
    pub(super) fn bodies(&self) -> Vec<Body> {
        let Some((width, height)) = self.width.zip(self.height) else { return Vec::new() };
        let solid = |side| Body::solid_inertia_m2(side, height);
        let body = |width_m, centre_offset_m, inertia: Option<f64>| Body {
            width_m,
            centre_height_m: self.centre_height.unwrap_or(0.5 * height),
            centre_offset_m,
            inertia_m2: inertia.unwrap_or_else(|| solid(width_m)),
        };
        let by_width = body(width, self.centre_offset.unwrap_or(0.0), self.inertia);
        let by_depth = self.depth.map(|depth| {
            let across = self.inertia.map(|inertia| inertia + solid(depth) - solid(width));
            body(depth, 0.0, self.inertia_across.or(across))
        });
        [by_width].into_iter().chain(by_depth).collect()
    }
}

impl Side {
    /// The structure slides below this friction.
    fn friction(&self) -> f64 {
        self.structure.alpha_rad.tan()
    }
}

/// Puts a wall behind the weaker side: an object has its shorter side towards the wall.
fn put_before(wall: Wall, sides: &mut [Side]) {
    let rebound = wall.rebound();
    let Side { structure, at_quantiles } = &mut sides[0];
    structure.rebound = Some(rebound.value);
    for bounds in at_quantiles {
        (bounds.low.rebound, bounds.high.rebound) = (Some(rebound.value), Some(rebound.value));
    }
    for Side { structure, at_quantiles } in sides.iter_mut().filter(|_| rebound.low < rebound.high) {
        let at = |end| Structure { rebound: structure.rebound.map(|_| end), ..structure.clone() };
        let source = UncertaintySource::Wall;
        at_quantiles.push(LowHigh { source, low: at(rebound.low), high: at(rebound.high) });
    }
}

/// Median and 2.5 and 97.5 % quantiles of |x| of a normal x: an offset to either side is as bad.
fn folded_quantiles(mean: f64, sd: f64) -> Interval {
    if sd == 0.0 {
        return Interval::exact(mean.abs());
    }
    let [low, value, high] = [0.025, 0.5, 0.975].map(|share| {
        numerics::bisect_first_true(0.0, mean.abs() + 5.0 * sd, |x| {
            normal::cdf((x - mean) / sd) - normal::cdf((-x - mean) / sd) > share
        })
    });
    Interval { value, low, high }
}
