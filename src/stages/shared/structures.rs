//! The options by which every stage takes structures: parameters, dimensions, or a list.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::object_list;
use super::objects::Object;
use super::spec::{Place, Restitution, Shape, Spec};
use crate::paper;
use crate::pipeline::UsageError;
use crate::plausibility::LEAST_P_RAD_S;
use crate::rocking::Structure;
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
    /// Whether any is given.
    pub fn is_given(&self) -> bool {
        self.structures.is_some() || !self.structure.is_empty() || self.one != Shape::default()
    }

    /// All structures, each of the weaker direction of an object, and warnings about them and their list.
    pub fn resolve(&self) -> anyhow::Result<(Vec<Structure>, Warnings)> {
        let (objects, mut warnings) = self.objects(&Place::default())?;
        let structure = |object: &Object| match object.floor() {
            Some(_) => {
                let name = &object.spec.name;
                Err(format!(
                    "{name} stands on a floor: leave out level and period; floor-motions makes its motions"
                ))
            }
            None => object.structure().cloned(),
        };
        let structures: Result<Vec<Structure>, String> = objects.iter().map(structure).collect();
        let structures = structures.map_err(UsageError::because)?;
        for structure in &structures {
            let about = warnings_of(structure).into_iter().map(|warning| (warning, structure.name.clone()));
            warnings.extend(about.collect());
        }
        Ok((structures, warnings))
    }

    /// All objects, each with what is wrong with it, and warnings about columns of a list that say nothing of
    /// them.
    pub fn objects(&self, place: &Place) -> anyhow::Result<(Vec<Object>, Warnings)> {
        let of_paper = |structure| Spec::of_structure(structure, Restitution::Number);
        let (specs, unused) = match &self.structures {
            Some(path) if path.as_os_str() == "paper" => {
                (paper::structures().into_iter().map(of_paper).collect(), Vec::new())
            }
            Some(path) => object_list::read(path)?,
            None if !self.structure.is_empty() => (self.structure.clone(), Vec::new()),
            None if self.is_given() => (
                vec![Spec { name: UNNAMED.to_string(), shape: self.one.clone(), ..Spec::default() }],
                Vec::new(),
            ),
            None => {
                return Err(UsageError::because(
                    "no structure; expected --width and --height of a block, or --p, --alpha and --eta, or --structures FILE",
                ));
            }
        };
        let objects: Vec<Object> = specs.into_iter().map(|spec| Object::new(spec.at(place))).collect();
        let mut names: Vec<&str> = objects.iter().map(|object| object.spec.name.as_str()).collect();
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            let problem = format!("two structures are called '{}'; expected distinct names", pair[0]);
            return Err(UsageError::because(problem));
        }
        Ok((objects, unused.into_iter().map(|heading| (Warning::UnusedColumns, heading)).collect()))
    }
}

/// Below this a coefficient of restitution is more likely a typing error.
const LOW_ETA: f64 = 0.5;

/// Warnings about the parameters of a structure.
pub fn warnings_of(structure: &Structure) -> Vec<Warning> {
    let size = (structure.p_rad_s < LEAST_P_RAD_S).then_some(Warning::ImplausibleSize);
    size.into_iter().chain((structure.eta < LOW_ETA).then_some(Warning::LowRestitution)).collect()
}
