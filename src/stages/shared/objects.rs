//! The objects of a call, as the structures that they rock like, and what is not known of them.

use std::f64::consts::FRAC_PI_4;
use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::object_list;
use super::spec::{Place, Reason, Restitution, Shape, Spec};
use crate::fragility::Z_95;
use crate::hazard::{Part, Unknown};
use crate::inputs::Renames;
use crate::motion::Floor;
use crate::paper;
use crate::pipeline::UsageError;
use crate::plausibility::LEAST_P_RAD_S;
use crate::rocking::{Body, Structure, housner_eta};
use crate::statistics::{normal, numerics};
use crate::warning::{UNNAMED, Warning, Warnings};

/// The structures of a call.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Structure")]
pub struct StructureArgs {
    #[command(flatten)]
    pub one: Shape,
    /// A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
    /// name=cabinet,width=0.8,height=2.2
    #[arg(long, value_name = "NAME=VALUE,...", conflicts_with = "one")]
    pub structure: Vec<Spec>,
    /// CSV list with a name and these options as columns (m, cm or mm by the heading), or the word paper for
    /// the paper's two
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with_all = ["one", "structure"])]
    pub structures: Option<PathBuf>,
}

impl StructureArgs {
    pub fn is_given(&self) -> bool {
        self.structures.is_some() || !self.structure.is_empty() || self.one != Shape::default()
    }

    /// Takes the paper's two structures where none is given.
    pub fn or_paper(&self) -> StructureArgs {
        let paper = (!self.is_given()).then(|| PathBuf::from("paper"));
        StructureArgs { structures: self.structures.clone().or(paper), ..self.clone() }
    }

    /// All structures, each of the weaker direction of an object, and warnings about them and their list: of
    /// a list without its rows that do not rock on the ground.
    pub fn resolve(&self) -> anyhow::Result<(Vec<Structure>, Warnings)> {
        let (objects, mut warnings) = self.objects(&Place::default(), &mut Renames::new(&[]))?;
        let (mut structures, mut first) = (Vec::new(), None);
        for object in &objects {
            let name = &object.spec.name;
            let structure = match on_ground(object) {
                Ok(structure) => structure,
                Err(problem) if self.structures.is_some() && !object.is_implausible() => {
                    warnings.extend([(Warning::LeftOut, name.clone())].into_iter().collect());
                    first.get_or_insert(problem);
                    continue;
                }
                Err(problem) => return Err(UsageError::because(problem)),
            };
            let one_direction = object.spec.shape.depth.map(|_| Warning::OneDirection);
            let about = warnings_of(&structure).into_iter().chain(one_direction);
            warnings.extend(about.map(|warning| (warning, name.clone())).collect());
            structures.push(structure);
        }
        match first.filter(|_| structures.is_empty()) {
            Some(problem) => Err(UsageError::because(problem)),
            None => Ok((structures, warnings)),
        }
    }

    /// All objects, each with what is wrong with it, and warnings about columns of a list that say nothing of
    /// them.
    pub fn objects(&self, place: &Place, renames: &mut Renames) -> anyhow::Result<(Vec<Object>, Warnings)> {
        let of_paper = |structure| Spec::of_structure(structure, Restitution::Number);
        let (mut specs, mut unused) = (self.structure.clone(), Warnings::default());
        match &self.structures {
            Some(path) if path.as_os_str() == "paper" => {
                specs = paper::structures().into_iter().map(of_paper).collect();
            }
            Some(path) => (specs, unused) = object_list::read(path, renames)?,
            None if self.one != Shape::default() => {
                specs = vec![Spec { name: UNNAMED.to_string(), shape: self.one.clone(), ..Spec::default() }];
            }
            None if specs.is_empty() => {
                return Err(UsageError::because(
                    "no structure; expected --width and --height of a block, or --p, --alpha and --eta, or --structures FILE",
                ));
            }
            None => {}
        }
        let objects: Vec<Object> = specs.into_iter().map(|spec| Object::new(spec.at(place))).collect();
        let mut names: Vec<&str> = objects.iter().map(|object| object.spec.name.as_str()).collect();
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let problem = format!("two structures are called '{}'; expected distinct names", pair[0]);
            return Err(UsageError::because(problem));
        }
        Ok((objects, unused))
    }
}

/// The structure of the weaker direction of an object, which must stand on the ground.
fn on_ground(object: &Object) -> Result<Structure, String> {
    let name = &object.spec.name;
    match object.floor() {
        Some(_) => Err(format!(
            "{name} stands on a floor: leave out level and period; floor-motions makes its motions"
        )),
        None => Ok(object.expect_directions()?[0].structure.clone()),
    }
}

/// Below this a coefficient of restitution is more likely a typing error.
const LOW_ETA: f64 = 0.5;

pub fn warnings_of(structure: &Structure) -> Vec<Warning> {
    let size = (structure.p_rad_s < LEAST_P_RAD_S).then_some(Warning::ImplausibleSize);
    size.into_iter().chain((structure.eta < LOW_ETA).then_some(Warning::LowRestitution)).collect()
}

/// An object: the structures that it rocks like, or why there is no answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub spec: Spec,
    /// The weaker direction first.
    pub directions: Result<Vec<Direction>, Reason>,
}

/// A direction in which an object rocks.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    pub structure: Structure,
    /// What is not known of it.
    pub unknowns: Vec<Unknown<Structure>>,
}

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

impl Object {
    pub fn new(spec: Spec) -> Object {
        Object { directions: spec.directions(), spec }
    }

    /// Its directions, the weaker first, or why there is none, with its name.
    pub fn expect_directions(&self) -> Result<&[Direction], String> {
        let named = |reason: &Reason| format!("structure '{}': {}", self.spec.name, reason);
        self.directions.as_deref().map_err(named)
    }

    /// Whether it cannot be right as it is given.
    pub fn is_implausible(&self) -> bool {
        matches!(self.directions, Err(Reason::Implausible(_)))
    }

    /// The floor that it stands on; none on the ground.
    pub fn floor(&self) -> Option<Floor> {
        let (period_s, level) = self.spec.place.period.zip(self.spec.place.level)?;
        (level > 0.0).then_some(Floor { period_s, level })
    }

    /// The floor with the period of the building at its 2.5 and 97.5 % quantiles.
    pub fn unknown_floor(&self) -> Option<[Floor; 2]> {
        let (floor, sd) = (self.floor()?, self.spec.place.period_sd.unwrap_or(SD_OF_PERIOD));
        let with = |off: f64| Floor { period_s: floor.period_s * (off * sd).exp(), ..floor };
        Some([-Z_95, Z_95].map(with))
    }
}

/// The 2.5, 50 and 97.5 % quantiles of |x| of a normal x: an offset to either side is as bad.
fn folded(mean: f64, sd: f64) -> [f64; 3] {
    let within = |x: f64| normal::cdf((x - mean) / sd) - normal::cdf((-x - mean) / sd);
    [0.025, 0.5, 0.975].map(|share| match sd > 0.0 {
        true => numerics::first(0.0, mean.abs() + 5.0 * sd, |x| within(x) > share),
        false => mean.abs(),
    })
}

impl Spec {
    fn directions(&self) -> Result<Vec<Direction>, Reason> {
        if let Some(reason) = &self.refused {
            return Err(reason.clone());
        }
        let missing = match (self.place.level, self.place.period) {
            (Some(level), None) if level > 0.0 => Some("level needs period, the first of the building (s)"),
            (None, Some(_)) => Some("period needs level, the height of the floor over that of the roof"),
            _ => None,
        };
        let implausible = |text: &str| Err(Reason::Implausible(text.to_string()));
        if let Some(missing) = missing {
            return implausible(missing);
        }
        let Shape { p, alpha, eta, width, height, beam_mass_ratio, .. } = self.shape;
        let mut directions = match (p, alpha, eta, width, height) {
            (Some(p), Some(alpha), Some(eta), None, None) => {
                let eta = match eta {
                    Restitution::Number(eta) | Restitution::Fitted(eta) => eta,
                    Restitution::Housner => housner_eta(alpha),
                };
                vec![self.direction(Structure::new(&self.name, p, alpha, eta)?)]
            }
            (None, None, _, Some(width), Some(height)) => {
                self.check(width, height)?;
                match beam_mass_ratio {
                    Some(ratio) => {
                        vec![self.direction(Structure::frame(&self.name, width, height, ratio, self.eta())?)]
                    }
                    None => self.sides(width, height)?,
                }
            }
            _ => return implausible("expected p, alpha and eta, or width and height"),
        };
        let tan = |direction: &Direction| direction.structure.alpha_rad.tan();
        directions.sort_by(|a, b| tan(a).total_cmp(&tan(b)));
        let (least, friction) = (tan(&directions[0]), self.place.friction.unwrap_or(f64::INFINITY));
        directions.retain(|direction| tan(direction) <= friction);
        match directions.is_empty() {
            true => {
                Err(Reason::NotRocking(format!("slides first: it rocks from a friction of {least:.2} on")))
            }
            false => Ok(directions),
        }
    }

    /// Checks that dimensions can be right beside each other.
    fn check(&self, width: f64, height: f64) -> Result<(), Reason> {
        let (shape, place) = (&self.shape, &self.place);
        let side = shape.depth.map_or(width, |depth| depth.min(width));
        let (offset, inertia) =
            (shape.centre_offset.map(f64::abs), 3.0 * Body::solid_inertia_m2(width, height));
        let most = [
            ("width", Some(side), height, "m, the height: were they exchanged?"),
            ("depth", shape.depth, LONGEST * height, "m, 20 times the height: is it in cm or mm?"),
            ("centre-height", shape.centre_height, height, "m, the height: were they exchanged?"),
            ("centre-offset", offset, 0.5 * width, "m, half of the width: is it from an edge, or in cm?"),
            ("inertia", shape.inertia, inertia, "m2: is it about an edge, or times mass?"),
            ("centre-height-sd", place.centre_height_sd, height, "m, the height: is it in cm?"),
            ("centre-offset-sd", place.centre_offset_sd, width, "m, the width: is it in cm?"),
        ];
        for (name, value, most, expected) in most {
            if let Some(value) = value.filter(|value| *value > most) {
                let problem = format!("{name} is {value}; expected up to {most} {expected}");
                return Err(Reason::Implausible(problem));
            }
        }
        Ok(())
    }

    /// The coefficient of restitution if it is given as a number.
    fn eta(&self) -> Option<f64> {
        match self.shape.eta {
            Some(Restitution::Number(eta)) => Some(eta),
            _ => None,
        }
    }

    /// A structure of which nothing but eta is unknown: by its standard deviation if that is given, of a
    /// computed one by tests.
    fn direction(&self, structure: Structure) -> Direction {
        let with = |eta: f64| Structure { eta: eta.clamp(0.01, 1.0), ..structure.clone() };
        let limits = match (self.place.eta_sd, self.eta()) {
            (Some(sd), _) => Some([-Z_95, Z_95].map(|off| with(structure.eta + off * sd))),
            (None, Some(_)) => None,
            (None, None) => {
                let loss = |off: f64| (1.0 - structure.eta) * (off * SD_OF_LOSS).exp();
                Some([Z_95, -Z_95].map(|off| with(1.0 - loss(off))))
            }
        };
        let unknown = limits.map(|quantiles| Unknown { part: Part::Eta, quantiles });
        Direction { structure, unknowns: unknown.into_iter().collect() }
    }

    /// Both directions of a body, or that of its width.
    fn sides(&self, width: f64, height: f64) -> Result<Vec<Direction>, Reason> {
        let mut sides = vec![self.side([width, width, height], self.shape.centre_offset.unwrap_or(0.0))];
        sides.extend(self.shape.depth.map(|depth| self.side([width, depth, height], 0.0)));
        if sides.iter().any(Result::is_ok) {
            // A direction that is squat is no danger beside one that is not.
            sides.retain(Result::is_ok);
        }
        sides.into_iter().collect()
    }

    /// The direction of a side of the base; the inertia about the other axis differs by that of a solid
    /// block.
    fn side(&self, [width, side, height]: [f64; 3], offset: f64) -> Result<Direction, Reason> {
        let Place { centre_height_sd, centre_offset_sd, .. } = self.place;
        let solid = Body::solid(side, height);
        let of_width = Body::solid(width, height).inertia_m2;
        let inertia_m2 =
            self.shape.inertia.map_or(solid.inertia_m2, |inertia| inertia + solid.inertia_m2 - of_width);
        let centre = self.shape.centre_height.unwrap_or(0.5 * height);
        let [left, middle, right] = folded(offset, centre_offset_sd.unwrap_or(0.0));
        let at = |centre_height_m: f64, centre_offset_m: f64| Body {
            width_m: side,
            centre_height_m: centre_height_m.clamp((1.0 - FARTHEST) * height, FARTHEST * height),
            centre_offset_m: centre_offset_m.min(FARTHEST * 0.5 * side),
            inertia_m2,
        };
        let structure = |body: Body| match body == solid {
            true => Structure::rectangular_block(&self.name, side, height, self.eta()),
            false => body.structure(&self.name, self.eta()),
        };
        let mut direction = self.direction(structure(at(centre, middle))?);
        let alpha_rad = direction.structure.alpha_rad;
        if alpha_rad > FRAC_PI_4 {
            let tan = alpha_rad.tan();
            let text = format!("squat: it slides unless its friction is above {tan:.2}");
            return Err(Reason::NotRocking(text));
        }
        let of_height = centre_height_sd.map(|sd| [-Z_95, Z_95].map(|off| at(centre + off * sd, middle)));
        let of_offset = centre_offset_sd.map(|_| [at(centre, left), at(centre, right)]);
        for bodies in [of_height, of_offset].into_iter().flatten() {
            // A body that is squat is no danger.
            let quantiles = bodies.map(|body| structure(body).unwrap_or(direction.structure.clone()));
            direction.unknowns.push(Unknown { part: Part::Object, quantiles });
        }
        Ok(direction)
    }
}
