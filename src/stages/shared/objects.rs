//! The objects of a call: options of one object, NAME=VALUE of several, or a list.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::ensure;
use clap::builder::BoolishValueParser;
use clap::{Arg, Args, Command, ValueHint, value_parser};
use rockfrag_core::object::{
    Base, Entry, Field, Object, Place, Restitution, Shape, Wall, structure_warnings,
};
use rockfrag_core::paper;
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::{UNNAMED, Warning};
use serde::{Deserialize, Serialize};
use strum::VariantArray;

use crate::inputs::Reader;
use crate::inputs::objects::{self, ListDefaults};
use crate::pipeline::UsageError;
use crate::pipeline::paths::Read;
use crate::stages::shared::reading_args::ListArgs;

/// Adds the fields of an object to the options of a stage.
pub fn with_fields(stage: Command) -> Command {
    let has = |option: &str| stage.get_arguments().any(|arg| arg.get_id() == option);
    // Only what has limits takes standard deviations.
    let (shape, place, has_limits) = (has("structures"), has("over"), has("years"));
    let is_of_shape = |word: &&str| *word == "eta" || Field::SIZES.contains(word);
    let of_shape = Field::SIZES.into_iter().chain(["eta"]).filter(|_| shape).map(|word| (word, "Structure"));
    let others = Field::VARIANTS.iter().map(<&str>::from).filter(|word| !is_of_shape(word));
    let of_place =
        others.filter(|word| place && (has_limits || !word.ends_with("-sd"))).map(|word| (word, "Object"));
    stage.args(of_shape.chain(of_place).filter_map(|(word, heading)| {
        let of = word.parse::<Field>().ok()?;
        let Entry { symbol, help, .. } = of.entry();
        let arg = Arg::new(word).long(word).value_name(symbol).help(help).help_heading(heading);
        Some(match of {
            Field::Eta => arg.value_parser(value_parser!(Restitution)),
            Field::Base => arg.value_parser(value_parser!(Base)),
            Field::FixedToPedestal => arg.value_parser(BoolishValueParser::new()),
            Field::Wall => arg.num_args(0..=1).default_missing_value("yes").value_parser(value_parser!(Wall)),
            _ => arg.value_parser(move |text: &str| of.parse_value(text)),
        })
    }))
}

const PAPER: &str = "paper";

#[derive(Debug, Clone, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(next_help_heading = "Structure")]
pub struct StructureArgs {
    #[arg(skip)]
    #[serde(flatten)]
    one: Shape,
    /// A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
    /// name=cabinet,width=0.8,height=2.2
    #[arg(long, value_name = "NAME=VALUE,...")]
    structure: Vec<Object>,
    /// List with a name and these options as columns (m, cm or mm by the heading): CSV or a workbook
    /// (list.xlsx#SHEET), or the word paper for the paper's two
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub structures: Option<PathBuf>,
    #[command(flatten)]
    #[serde(flatten)]
    pub list: ListArgs,
}

impl StructureArgs {
    pub fn input(&self) -> Read {
        Read::new("structures", &self.structures)
    }

    pub fn is_given(&self) -> bool {
        self.structures.is_some() || !self.structure.is_empty() || self.one != Shape::default()
    }

    /// Takes the paper's two structures where none is given.
    pub fn or_paper(&self) -> StructureArgs {
        let paper = (!self.is_given()).then(|| PathBuf::from(PAPER));
        StructureArgs { structures: self.structures.clone().or(paper), ..self.clone() }
    }

    /// Finds the structures of all objects, one for each of its directions, the weaker first: of a list
    /// without its rows that do not rock on the ground.
    pub fn resolve(&self, reader: &mut Reader) -> anyhow::Result<Vec<Vec<Structure>>> {
        let objects = self.objects(&Place::default(), reader)?;
        reader.expect_used()?;
        let mut resolved = Vec::new();
        for object in &objects {
            let name = &object.name;
            match on_ground(object) {
                Ok(directions) => {
                    let one_direction = object.shape.depth.map(|_| Warning::OneDirection);
                    for warning in structure_warnings(&directions[0]).into_iter().chain(one_direction) {
                        reader.warnings.add(warning, name.clone());
                    }
                    resolved.push(directions);
                }
                Err(_) if self.structures.is_some() && !object.is_implausible() => {
                    reader.warnings.add(Warning::LeftOut, name.clone());
                }
                Err(problem) => return Err(problem),
            }
        }
        if resolved.is_empty() {
            on_ground(&objects[0])?;
        }
        Ok(resolved)
    }

    /// Finds all objects, each with what is wrong with it.
    pub fn objects(&self, place: &Place, reader: &mut Reader) -> anyhow::Result<Vec<Object>> {
        let is_paper = self.structures.as_deref() == Some(Path::new(PAPER));
        let mut all = match &self.structures {
            Some(list) if !is_paper => {
                objects::read(list, reader, &ListDefaults { place: *place, ..self.list.defaults() })?
            }
            _ => self.structure.clone(),
        };
        if is_paper {
            let paper = paper::structures().into_iter();
            all.extend(paper.map(|known| Object::with_parameters(&known, Restitution::Number(known.eta))));
        }
        let is_open = |object: &&mut Object| object.shape.eta.is_none() && object.place.base.is_none();
        all.iter_mut().filter(is_open).for_each(|object| object.shape.eta = self.one.eta);
        if all.is_empty() && self.one != Shape::default() {
            all.push(Object { name: UNNAMED.to_string(), shape: self.one, ..Object::default() });
        }
        let expected = "--width and --height of a block, or --p, --alpha and --eta, or --structures FILE";
        ensure!(!all.is_empty(), UsageError::because(format!("no structure; expected {expected}")));
        let mut names = HashSet::new();
        if let Some(Object { name, .. }) = all.iter().find(|object| !names.insert(&object.name)) {
            let problem = format!("two structures are called '{name}'; expected distinct names");
            return Err(UsageError::because(problem));
        }
        Ok(all.into_iter().map(|object| object.at(place).on_pedestal()).collect())
    }
}

/// Finds the structures of the directions of an object, which must stand on the ground.
fn on_ground(object: &Object) -> anyhow::Result<Vec<Structure>> {
    let sides = object.sides().map_err(|reason| named(object, &reason))?;
    let problem = "on a floor: leave out level and period; floor-motions makes its motions";
    ensure!(!matches!(object.place.floor(), Ok(Some(_))), named(object, &problem));
    let problem = "at a wall: evaluate answers; solvers rock it to both sides";
    ensure!(object.place.wall.is_none(), named(object, &problem));
    let mut structures: Vec<Structure> = sides.into_iter().map(|side| side.structure).collect();
    structures.iter_mut().skip(1).for_each(|other| other.name += ", other direction");
    Ok(structures)
}

pub fn named(object: &Object, reason: &impl std::fmt::Display) -> anyhow::Error {
    UsageError::because(match object.name.as_str() {
        UNNAMED => reason.to_string(),
        name => format!("structure '{name}': {reason}"),
    })
}
