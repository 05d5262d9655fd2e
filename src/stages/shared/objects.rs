//! An object as it is given, as the structures that it rocks like, and what is not known of it.

use std::f64::consts::FRAC_PI_4;

use super::spec::{Place, Restitution, Spec};
use crate::hazard::{Part, Unknown};
use crate::motion::Floor;
use crate::plausibility::check_structure;
use crate::rocking::{Body, Structure, housner_eta};
use crate::statistics::{normal, numerics};

/// An object of a list: the structures that it rocks like, or why there is no answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub spec: Spec,
    /// The weaker direction first.
    pub directions: Result<Vec<Direction>, Reason>,
}

/// Why there is no answer for an object.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// What is given cannot be right.
    Implausible(String),
    /// It does not rock.
    Held(String),
}

impl std::fmt::Display for Reason {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Reason::Implausible(reason) | Reason::Held(reason) => f.write_str(reason),
        }
    }
}

/// A direction in which an object rocks.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    pub structure: Structure,
    /// What is not known of it: the structure at the 16 and 84 % quantiles.
    pub unknowns: Vec<Unknown<Structure>>,
}

/// The name of an object that has none.
const UNNAMED: &str = "structure";
/// Standard deviation of the logarithm of a building's period that is not given.
const SD_OF_PERIOD: f64 = 0.25;
/// Standard deviation of ln(1 - eta) about Housner's, by free rocking tests: blocks on concrete lost 1.2 to
/// 1.8 times as much (ElGawady et al. 2006), concrete and stone members less, down to 0.6 (Kalliontzis et al.
/// 2016, Ther & Kollar 2017).
const SD_OF_LOSS: f64 = 0.4;
/// Largest share of the half width, or of the height, that a centre of mass is away from the middle or the
/// base.
const FARTHEST: f64 = 0.98;

/// Depth of an object over its height that no object has.
const LONGEST: f64 = 20.0;

impl Spec {
    /// The structure of its weaker direction, if its parameters can be right.
    pub fn structure(&self) -> Result<Structure, String> {
        Object::new(self.clone()).structure().cloned()
    }
}

impl From<Structure> for Object {
    fn from(structure: Structure) -> Object {
        let spec = Spec { name: Some(structure.name.clone()), ..Spec::default() };
        let is_computed = (structure.eta - housner_eta(structure.alpha_rad)).abs() < 1e-6;
        let unknowns = unknown_eta(&structure, None, is_computed).into_iter().collect();
        Object { spec, directions: Ok(vec![Direction { structure, unknowns }]) }
    }
}

impl Object {
    pub fn new(spec: Spec) -> Object {
        let directions = match &spec.held {
            Some(reason) => Err(Reason::Held(reason.clone())),
            None => spec.directions(),
        };
        Object { spec, directions }
    }

    /// The same in this place.
    pub fn at(self, place: Place) -> Object {
        let directions = self.directions.and_then(|directions| place.rocking(directions));
        Object { spec: Spec { place, ..self.spec }, directions }
    }

    /// One that cannot be read.
    pub fn refused(spec: Spec, reason: String) -> Object {
        Object { spec, directions: Err(Reason::Implausible(reason)) }
    }

    pub fn name(&self) -> &str {
        self.spec.name.as_deref().unwrap_or(UNNAMED)
    }

    /// The structure of its weaker direction.
    pub fn structure(&self) -> Result<&Structure, String> {
        self.directions.as_ref().map(|directions| &directions[0].structure).map_err(Reason::to_string)
    }

    /// The floor that it stands on; none on the ground.
    pub fn floor(&self) -> Option<Floor> {
        let Place { period, level, .. } = self.spec.place;
        let (period_s, level) = period.zip(level)?;
        (level > 0.0).then_some(Floor { period_s, level })
    }

    /// The floor with the period of the building at its 16 and 84 % quantiles.
    pub fn unknown_floor(&self) -> Option<Unknown<Floor>> {
        let (floor, sd) = (self.floor()?, self.spec.place.period_sd.unwrap_or(SD_OF_PERIOD));
        let with = |ln: f64| Floor { period_s: floor.period_s * ln.exp(), ..floor };
        Some(Unknown { part: Part::Floor, low: with(-sd), high: with(sd) })
    }

    /// Number of such objects.
    pub fn count(&self) -> f64 {
        self.spec.place.count.unwrap_or(1.0)
    }
}

impl Place {
    /// The directions in which friction lets an object rock.
    fn rocking(&self, directions: Vec<Direction>) -> Result<Vec<Direction>, Reason> {
        let Some(friction) = self.friction else { return Ok(directions) };
        let tan = |direction: &Direction| direction.structure.alpha_rad.tan();
        let least = tan(&directions[0]);
        let rocking: Vec<Direction> = directions.into_iter().filter(|of| tan(of) <= friction).collect();
        match rocking.is_empty() {
            true => Err(Reason::Held(format!("slides first: it rocks from a friction of {least:.2} on"))),
            false => Ok(rocking),
        }
    }
}

/// What is not known of eta: by its standard deviation if it was measured, of a computed one by tests.
fn unknown_eta(structure: &Structure, sd: Option<f64>, is_computed: bool) -> Option<Unknown<Structure>> {
    let with = |eta: f64| Structure { eta: eta.clamp(0.01, 1.0), ..structure.clone() };
    let [low, high] = match sd {
        Some(sd) => [-sd, sd].map(|off| with(structure.eta + off)),
        None if is_computed => {
            [SD_OF_LOSS, -SD_OF_LOSS].map(|ln| with(1.0 - (1.0 - structure.eta) * ln.exp()))
        }
        None => return None,
    };
    Some(Unknown { part: Part::Eta, low, high })
}

/// The 16, 50 and 84 % quantiles of |x| of a normal x: an offset to either side is as bad.
fn folded(mean: f64, sd: f64) -> [f64; 3] {
    let within = |x: f64| normal::cdf((x - mean) / sd) - normal::cdf((-x - mean) / sd);
    [normal::cdf(-1.0), 0.5, normal::cdf(1.0)].map(|share| match sd > 0.0 {
        true => numerics::first(0.0, mean.abs() + 5.0 * sd, |x| within(x) > share),
        false => mean.abs(),
    })
}

impl Spec {
    /// Checks that what is given can be right.
    fn check(&self) -> Result<(), String> {
        let name = self.name.as_deref().unwrap_or(UNNAMED);
        let side = self.width.zip(self.depth).map(|(width, depth)| width.min(depth)).or(self.width);
        let given: Vec<(&str, f64)> = self.given();
        let of_structure = ["p", "alpha", "eta", "height", "beam-mass-ratio"];
        let plain = given.iter().copied().filter(|(key, _)| of_structure.contains(key));
        let plain: Vec<(&str, f64)> = plain.chain(side.map(|side| ("width", side))).collect();
        check_structure(name, &plain).map_err(|error| error.to_string())?;
        let (width, height) = (self.width.unwrap_or(f64::INFINITY), self.height.unwrap_or(f64::INFINITY));
        let centre = format!("above 0 and below the height, {height} m: were they exchanged?");
        let offset = format!("less than half of the width, {} m: is it from an edge, or in cm?", 0.5 * width);
        let radius = Body::solid_inertia_m2(width, height) * 3.0;
        let inertia = format!("m2, above 0 and up to {radius:.2}: is it about an edge, or times mass?");
        let longer = |side: &str| format!("a length above 0 m, up to 200 m{side}: is it in cm or mm?");
        let bounds: [(&str, f64, f64, String); 12] = [
            ("width", 1e-4, 200.0, longer("")),
            (
                "depth",
                1e-4,
                (LONGEST * height).min(200.0),
                longer(&format!(" and {LONGEST} times the height")),
            ),
            ("centre-height", 1e-6, height * (1.0 - 1e-9), centre),
            ("centre-offset", -0.4999 * width, 0.4999 * width, offset),
            ("inertia", 1e-9, radius, inertia),
            ("period", 0.02, 10.0, "s, from 0.02 to 10: is it in Hz?".to_string()),
            ("level", 0.0, 1.0, "height over that of the roof, 0 to 1: 0.6 for storey 3 of 5".to_string()),
            ("period-sd", 0.0, 1.0, "sd of ln(period), 0 to 1: is it in s or percent?".to_string()),
            ("friction", 0.01, 2.0, "a coefficient of friction from 0.01 to 2".to_string()),
            ("eta-sd", 0.0, 0.5, "a standard deviation from 0 to 0.5".to_string()),
            ("centre-height-sd", 0.0, height, "0 m or more, up to the height: is it in cm?".to_string()),
            ("centre-offset-sd", 0.0, width, "0 m or more, up to the width: is it in cm?".to_string()),
        ];
        for (key, least, most, expected) in bounds {
            if let Some((_, value)) =
                given.iter().find(|(other, value)| *other == key && !(least..=most).contains(value))
            {
                return Err(format!("structure '{name}': {key} is {value}; expected {expected}"));
            }
        }
        match self.place {
            Place { count: Some(count), .. } if !(0.0..=1e6).contains(&count) || count.fract() != 0.0 => {
                Err(format!("structure '{name}': count is {count}; expected a whole number of objects"))
            }
            Place { level: Some(level), period: None, .. } if level > 0.0 => {
                Err(format!("structure '{name}': level needs period, the first of the building (s)"))
            }
            Place { level: None, period: Some(_), .. } => Err(format!(
                "structure '{name}': period needs level, the height of the floor over that of the roof"
            )),
            _ => Ok(()),
        }
    }

    fn directions(&self) -> Result<Vec<Direction>, Reason> {
        let named = |problem: String| {
            let name = self.name.as_deref().unwrap_or(UNNAMED);
            Reason::Implausible(format!("structure '{name}': {problem}"))
        };
        let name = self.name.as_deref().unwrap_or(UNNAMED);
        self.check().map_err(Reason::Implausible)?;
        let eta = match self.eta {
            Some(Restitution::Number(eta)) => Some(eta),
            _ => None,
        };
        let refused = |error: crate::rocking::StructureError| Reason::Implausible(error.to_string());
        let mut directions = match (self.p, self.alpha, self.eta, self.width, self.height) {
            (Some(p), Some(alpha), Some(restitution), None, None) => {
                let eta = match restitution {
                    Restitution::Number(eta) => eta,
                    Restitution::Housner => housner_eta(alpha),
                };
                vec![self.known(Structure::new(name, p, alpha, eta).map_err(refused)?)]
            }
            (None, None, _, Some(width), Some(height)) => match self.beam_mass_ratio {
                Some(ratio) => {
                    vec![self.known(Structure::frame(name, width, height, ratio, eta).map_err(refused)?)]
                }
                None => self.sides(name, width, height, eta)?,
            },
            _ => return Err(named("expected p, alpha and eta, or width and height".to_string())),
        };
        directions.sort_by(|a, b| a.structure.alpha_rad.total_cmp(&b.structure.alpha_rad));
        self.place.rocking(directions)
    }

    /// A structure of which nothing but eta is unknown.
    fn known(&self, structure: Structure) -> Direction {
        let is_computed = !matches!(self.eta, Some(Restitution::Number(_)));
        let unknowns = unknown_eta(&structure, self.place.eta_sd, is_computed).into_iter().collect();
        Direction { structure, unknowns }
    }

    /// Both directions of a body, or that of its width.
    fn sides(&self, name: &str, width: f64, height: f64, eta: Option<f64>) -> Result<Vec<Direction>, Reason> {
        let sides = std::iter::once((width, self.centre_offset.unwrap_or(0.0)));
        let sides: Vec<(f64, f64)> = sides.chain(self.depth.map(|depth| (depth, 0.0))).collect();
        let of_side = |&(side, offset): &(f64, f64)| self.side(name, [width, side, height], offset, eta);
        let (rocking, squat): (Vec<_>, Vec<_>) = sides.iter().map(of_side).partition(Result::is_ok);
        match rocking.is_empty() {
            // A direction that is squat is no danger beside one that is not.
            false => rocking.into_iter().collect(),
            true => squat.into_iter().take(1).collect(),
        }
    }

    /// The direction of a side of the base; the inertia about the other axis differs by that of a solid
    /// block.
    fn side(
        &self,
        name: &str,
        [width, side, height]: [f64; 3],
        offset: f64,
        eta: Option<f64>,
    ) -> Result<Direction, Reason> {
        let Place { centre_height_sd, centre_offset_sd, .. } = self.place;
        let solid = Body::solid(side, height);
        let of_width = Body::solid(width, height).inertia_m2;
        let inertia_m2 =
            self.inertia.map_or(solid.inertia_m2, |inertia| inertia + solid.inertia_m2 - of_width);
        let centre = self.centre_height.unwrap_or(0.5 * height);
        let offsets = folded(offset, centre_offset_sd.unwrap_or(0.0));
        let at = |centre_height_m: f64, centre_offset_m: f64| Body {
            width_m: side,
            centre_height_m: centre_height_m.clamp((1.0 - FARTHEST) * height, FARTHEST * height),
            centre_offset_m: centre_offset_m.min(FARTHEST * 0.5 * side),
            inertia_m2,
        };
        let body = at(centre, offsets[1]);
        let structure = match body == solid {
            true => Structure::rectangular_block(name, side, height, eta),
            false => body.structure(name, eta),
        };
        let structure = structure.map_err(|error| Reason::Implausible(error.to_string()))?;
        if structure.alpha_rad > FRAC_PI_4 {
            let tan = structure.alpha_rad.tan();
            return Err(Reason::Held(format!("squat: it slides unless its friction is above {tan:.2}")));
        }
        let mut direction = self.known(structure);
        let part = Part::Object;
        let mut vary = |low: Body, high: Body| {
            let varied = |body: Body| body.structure(name, eta);
            if let (Ok(low), Ok(high)) = (varied(low), varied(high)) {
                direction.unknowns.push(Unknown { part, low, high });
            }
        };
        if let Some(sd) = centre_height_sd {
            vary(at(centre - sd, offsets[1]), at(centre + sd, offsets[1]));
        }
        if centre_offset_sd.is_some() {
            vary(at(centre, offsets[0]), at(centre, offsets[2]));
        }
        Ok(direction)
    }
}
