//! The objects of a call: options of one object, NAME=VALUE of several, or a list.

use clap::{ArgGroup, Args};
use rockfrag_core::object::{Field, Object, Place, Restitution, SD_OF_PERIOD, structure_warnings};
use rockfrag_core::paper;
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::{Warning, Warnings};
use serde::Serialize;

use crate::inputs::Renames;
use crate::inputs::objects::{self, ListDefaults};
use crate::pipeline::UsageError;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Read, StructuresInput};

/// Returns a parser of a number that may be known of an object.
pub fn field(field: Field) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| field.parse_value(text)
}

/// Whether an option says what its absence says.
fn is_zero(value: &Option<f64>) -> bool {
    value.is_none_or(|value| value == 0.0)
}

fn is_sd_of_period(value: &Option<f64>) -> bool {
    value.is_none_or(|value| value == SD_OF_PERIOD)
}

/// A structure: its dimensions, or p, alpha and eta.
#[derive(Debug, Clone, Default, PartialEq, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[group(id = "one", multiple = true)]
pub struct ShapeArgs {
    /// Width of the base of a block, body or column, m; the smaller side unless --depth is given
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"], value_parser = field(Field::Width))]
    width: Option<f64>,
    /// Height of the block, body or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"], value_parser = field(Field::Height))]
    height: Option<f64>,
    /// Depth of the base, m: the object may also fall that way; simulate and ida take the weaker direction
    #[arg(long, value_name = "M", requires = "width", value_parser = field(Field::Depth))]
    depth: Option<f64>,
    /// Height of the centre of mass above the base, m [default: half the height]
    #[arg(long, value_name = "M", requires = "height", value_parser = field(Field::CentreHeight))]
    centre_height: Option<f64>,
    /// Distance of the centre of mass from the middle of the width, m [default: 0]
    #[arg(long, value_name = "M", requires = "width", allow_negative_numbers = true,
          value_parser = field(Field::CentreOffset))]
    #[serde(skip_serializing_if = "is_zero")]
    centre_offset: Option<f64>,
    /// Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid block]
    #[arg(long, value_name = "M2", requires = "height", value_parser = field(Field::Inertia))]
    inertia: Option<f64>,
    /// Frame: mass of the beam over that of all columns
    #[arg(long, value_name = "RATIO", value_parser = field(Field::BeamMassRatio),
          conflicts_with_all = ["p", "alpha", "depth", "centre_height", "centre_offset", "inertia"])]
    beam_mass_ratio: Option<f64>,
    /// Frequency parameter, rad/s
    #[arg(long, value_name = "RAD/S", value_parser = field(Field::P))]
    p: Option<f64>,
    /// Slenderness, rad
    #[arg(long, value_name = "RAD", value_parser = field(Field::Alpha))]
    alpha: Option<f64>,
    /// Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    #[arg(long)]
    eta: Option<Restitution>,
}

/// Where an object stands, and how well it is known; of all objects of a list that do not say so themselves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(next_help_heading = "Object")]
#[command(group(ArgGroup::new("on_floor").args(["period", "structure", "structures"]).multiple(true)))]
pub struct PlaceArgs {
    /// First period of the building, s [default: the object stands on the ground]
    #[arg(long, value_name = "S", value_parser = field(Field::Period))]
    period: Option<f64>,
    /// Height of the floor over that of the roof, 0 to 1
    #[arg(long, value_name = "Z", value_parser = field(Field::Level))]
    level: Option<f64>,
    /// Standard deviation of ln(period) [default: 0.25]
    #[arg(long, value_name = "SD", requires = "on_floor", value_parser = field(Field::PeriodSd))]
    #[serde(skip_serializing_if = "is_sd_of_period")]
    period_sd: Option<f64>,
    /// Coefficient of friction; if tan(alpha) exceeds it, the object slides
    #[arg(long, value_name = "MU", value_parser = field(Field::Friction))]
    friction: Option<f64>,
    /// Standard deviation of eta [default: 0 if eta is given; that of tests if it is computed]
    #[arg(long, value_name = "SD", value_parser = field(Field::EtaSd))]
    eta_sd: Option<f64>,
    /// Standard deviation of the height of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = field(Field::CentreHeightSd))]
    #[serde(skip_serializing_if = "is_zero")]
    centre_height_sd: Option<f64>,
    /// Standard deviation of the offset of the centre of mass, m
    #[arg(long, value_name = "M", value_parser = field(Field::CentreOffsetSd))]
    #[serde(skip_serializing_if = "is_zero")]
    centre_offset_sd: Option<f64>,
}

impl PlaceArgs {
    pub fn place(&self) -> Place {
        object(self).place
    }
}

/// Makes an object of options, which have the names of its fields.
fn object(options: &impl Serialize) -> Object {
    serde_json::json!(options).to_string().parse().expect("clap has checked the options")
}

/// The structures of a call.
#[derive(Debug, Clone, Default, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(next_help_heading = "Structure")]
pub struct StructureArgs {
    #[command(flatten)]
    #[serde(flatten)]
    one: ShapeArgs,
    /// A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
    /// name=cabinet,width=0.8,height=2.2
    #[arg(long, value_name = "NAME=VALUE,...", conflicts_with = "one")]
    structure: Vec<Object>,
    /// List with a name and these options as columns (m, cm or mm by the heading): CSV or a workbook
    /// (list.xlsx#SHEET), or the word paper for the paper's two
    #[arg(long, value_name = "FILE", conflicts_with_all = ["one", "structure"])]
    pub structures: Option<StructuresInput>,
    /// Number that the floors of --structures give the ground floor: 0 or 1
    #[arg(long, value_name = "N", requires = "structures", conflicts_with_all = ["one", "structure"],
          value_parser = number(0..=1_u32, "0 or 1"))]
    ground_floor: Option<u32>,
}

impl StructureArgs {
    pub fn input(&self) -> Read {
        let list = self.structures.as_ref().filter(|list| list.word().is_none());
        Read::new("structures", list.map(|path| &**path))
    }

    pub fn is_given(&self) -> bool {
        self.structures.is_some() || !self.structure.is_empty() || self.one != ShapeArgs::default()
    }

    /// Takes the paper's two structures where none is given.
    pub fn or_paper(&self) -> StructureArgs {
        let paper = (!self.is_given()).then(|| StructuresInput("paper".into()));
        StructureArgs { structures: self.structures.clone().or(paper), ..self.clone() }
    }

    /// Finds the structures of all objects, one for each of its directions, the weaker first, and warnings
    /// about them and their list: of a list without its rows that do not rock on the ground.
    pub fn resolve(&self) -> anyhow::Result<(Vec<Vec<Structure>>, Warnings)> {
        let (objects, mut warnings) = self.objects(&Place::default(), &mut Renames::new(&[]))?;
        let (mut resolved, mut first) = (Vec::new(), None);
        for object in &objects {
            let name = &object.name;
            match on_ground(object) {
                Ok(directions) => {
                    let one_direction = object.shape.depth.map(|_| Warning::OneDirection);
                    for warning in structure_warnings(&directions[0]).into_iter().chain(one_direction) {
                        warnings.add(warning, name.clone());
                    }
                    resolved.push(directions);
                }
                Err(problem) if self.structures.is_some() && !object.is_implausible() => {
                    warnings.add(Warning::LeftOut, name.clone());
                    first.get_or_insert(problem);
                }
                Err(problem) => return Err(problem),
            }
        }
        match first.filter(|_| resolved.is_empty()) {
            Some(problem) => Err(problem),
            None => Ok((resolved, warnings)),
        }
    }

    /// Finds all objects, each with what is wrong with it, and warnings about columns of a list that say
    /// nothing of them.
    pub fn objects(&self, place: &Place, renames: &mut Renames) -> anyhow::Result<(Vec<Object>, Warnings)> {
        let (mut all, mut unused): (Vec<Object>, _) = Default::default();
        match &self.structures {
            Some(list) if list.word().is_some() => {
                let paper = paper::structures().into_iter();
                all.extend(
                    paper.map(|known| Object::with_parameters(&known, Restitution::Number(known.eta))),
                );
            }
            Some(path) => {
                let defaults = ListDefaults { ground_floor: self.ground_floor, place: *place };
                (all, unused) = objects::read(path, renames, &defaults)?;
            }
            None if self.one != ShapeArgs::default() => {
                all.push(object(&self.one));
            }
            None => all.extend(self.structure.iter().cloned()),
        }
        if all.is_empty() {
            return Err(UsageError::because(
                "no structure; expected --width and --height of a block, or --p, --alpha and --eta, \
                 or --structures FILE",
            ));
        }
        let all: Vec<Object> = all.into_iter().map(|object| object.at(place)).collect();
        let mut names: Vec<&str> = all.iter().map(|object| object.name.as_str()).collect();
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let problem = format!("two structures are called '{}'; expected distinct names", pair[0]);
            return Err(UsageError::because(problem));
        }
        Ok((all, unused))
    }
}

/// Finds the structures of the directions of an object, which must stand on the ground.
pub fn on_ground(object: &Object) -> anyhow::Result<Vec<Structure>> {
    let sides = object.sides().map_err(|reason| named(object, &reason))?;
    if object.place.floor().is_ok_and(|floor| floor.is_some()) {
        let problem = "on a floor: leave out level and period; floor-motions makes its motions";
        return Err(named(object, &problem));
    }
    let mut structures: Vec<Structure> = sides.into_iter().map(|side| side.structure).collect();
    structures.iter_mut().skip(1).for_each(|other| other.name += ", other direction");
    Ok(structures)
}

/// Makes an error of why there is no answer for an object.
pub fn named(object: &Object, reason: &impl std::fmt::Display) -> anyhow::Error {
    UsageError::because(format!("structure '{}': {reason}", object.name))
}
