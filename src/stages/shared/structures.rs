//! Structures as a user names them: by p, alpha and eta, as a block, or as a frame.

use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Value, json};

use crate::pipeline::UsageError;
use crate::pipeline::options::explain;
use crate::rocking::Structure;
use crate::table::store::text_file;

/// The largest file: hundreds of thousands of structures.
const MOST_MIB: u64 = 16;

/// One structure: p, alpha and eta; or the width and height (m) of a block or of a frame's columns, with beam-mass-ratio for a
/// frame. Of the latter two, eta may be left out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct StructureSpec {
    /// What it is called.
    pub name: Option<String>,
    /// Frequency parameter, rad/s.
    pub p: Option<f64>,
    /// Slenderness, rad.
    pub alpha: Option<f64>,
    /// Coefficient of restitution.
    pub eta: Option<f64>,
    /// Width 2b of the block or column, m.
    pub width: Option<f64>,
    /// Height 2h of the block or column, m.
    pub height: Option<f64>,
    /// Mass of the beam over that of all columns.
    pub beam_mass_ratio: Option<f64>,
}

impl StructureSpec {
    /// The structure.
    ///
    /// # Errors
    /// If parameters are missing, mixed, or out of range.
    pub fn structure(&self) -> anyhow::Result<Structure> {
        let name = self.name.clone().unwrap_or_else(|| self.generic_name());
        let structure = match (self.p, self.alpha, self.eta, self.width, self.height, self.beam_mass_ratio) {
            (Some(p), Some(alpha), Some(eta), None, None, None) => Structure::new(&name, p, alpha, eta),
            (None, None, eta, Some(width), Some(height), None) => {
                Structure::rectangular_block(&name, width, height, eta)
            }
            (None, None, eta, Some(width), Some(height), Some(ratio)) => {
                Structure::frame(&name, width, height, ratio, eta)
            }
            _ => {
                return Err(UsageError::because(format!(
                    "structure '{name}': expected p, alpha and eta; or width and height (m), with beam-mass-ratio for a frame"
                )));
            }
        };
        structure.map_err(|error| UsageError::because(error.to_string()))
    }

    /// The structure; `eta` of the fits holds where neither it nor dimensions are given.
    ///
    /// # Errors
    /// As [`StructureSpec::structure`].
    pub fn structure_with_eta(&self, eta: f64) -> anyhow::Result<Structure> {
        let eta = self.eta.or_else(|| self.width.is_none().then_some(eta));
        StructureSpec { eta, ..self.clone() }.structure()
    }

    fn generic_name(&self) -> String {
        let parts = [
            ("p", self.p),
            ("alpha", self.alpha),
            ("width", self.width),
            ("height", self.height),
            ("beam", self.beam_mass_ratio),
            ("eta", self.eta),
        ];
        let given = parts.iter().filter_map(|(name, value)| value.map(|value| format!("{name}{value}")));
        given.collect::<Vec<_>>().join("-")
    }
}

impl From<Structure> for StructureSpec {
    fn from(structure: Structure) -> StructureSpec {
        let Structure { name, p_rad_s, alpha_rad, eta } = structure;
        StructureSpec {
            name: Some(name),
            p: Some(p_rad_s),
            alpha: Some(alpha_rad),
            eta: Some(eta),
            ..StructureSpec::default()
        }
    }
}

/// The parameters of a structure, in words.
pub fn words(structure: &Structure) -> String {
    let four_decimals = |value: f64| (value * 1e4).round() / 1e4;
    let [p, alpha, eta] = [structure.p_rad_s, structure.alpha_rad, structure.eta].map(four_decimals);
    format!("p {p} rad/s, alpha {alpha} rad, eta {eta}")
}

/// The parameters of structures, as a file records them.
pub fn parameters(structures: &[Structure]) -> Value {
    let of = |s: &Structure| json!({ "name": s.name, "p": s.p_rad_s, "alpha": s.alpha_rad, "eta": s.eta });
    structures.iter().map(of).collect()
}

/// Where structures come from.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Structures {
    /// From a YAML or CSV file.
    File(PathBuf),
    /// From the pipeline file itself.
    List(Vec<StructureSpec>),
}

impl FromStr for Structures {
    type Err = std::convert::Infallible;

    fn from_str(path: &str) -> Result<Structures, Self::Err> {
        Ok(Structures::File(PathBuf::from(path)))
    }
}

impl<'de> Deserialize<'de> for Structures {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Structures, D::Error> {
        deserializer.deserialize_any(FileOrList)
    }
}

/// Tells a file from a list, so that what is wrong with a structure of the list is said of it.
struct FileOrList;

impl<'de> Visitor<'de> for FileOrList {
    type Value = Structures;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a file, or a list of structures")
    }

    fn visit_str<E: de::Error>(self, path: &str) -> Result<Structures, E> {
        Ok(Structures::File(PathBuf::from(path)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Structures, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Structures::List)
    }
}

impl Structures {
    /// Makes the path of a file relative to `folder`, that of the pipeline file.
    pub fn resolve_path(&mut self, folder: &Path) {
        if let Structures::File(path) = self {
            *path = folder.join(&*path);
        }
    }

    /// All structures, checked.
    ///
    /// # Errors
    /// If the file cannot be read, there is no structure, one is impossible, or two have the same name.
    pub fn resolve(&self) -> anyhow::Result<Vec<Structure>> {
        let specs = match self {
            Structures::List(specs) => specs.clone(),
            Structures::File(path) => read(path)?,
        };
        if specs.is_empty() {
            return Err(UsageError::because("structures: none given; expected at least one"));
        }
        let structures = specs.iter().map(StructureSpec::structure).collect::<anyhow::Result<Vec<_>>>()?;
        let mut names: Vec<&str> = structures.iter().map(|structure| structure.name.as_str()).collect();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(UsageError::because(format!(
                "structures: two are called '{}'; expected distinct names",
                pair[0]
            ))),
            None => Ok(structures),
        }
    }
}

fn read(path: &Path) -> anyhow::Result<Vec<StructureSpec>> {
    let failed = |what: String| UsageError::because(format!("{}: {what}", path.display()));
    let text = text_file::text(path, MOST_MIB, "structures").map_err(|error| failed(error.to_string()))?;
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "yaml" | "yml" => serde_saphyr::from_str(&text).map_err(|error| failed(explain(&error))),
        "csv" => {
            let rows = csv::ReaderBuilder::new()
                .trim(csv::Trim::All)
                .from_reader(text.as_bytes())
                .into_deserialize();
            rows.collect::<Result<_, _>>().map_err(|error| failed(error.to_string()))
        }
        _ => Err(failed("expected a .yaml, .yml or .csv file of structures".to_string())),
    }
}
