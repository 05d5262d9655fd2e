//! The options by which every stage takes structures: parameters, dimensions, or a list.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::Context;
use clap::{Args, ValueHint};

use crate::hazard::{Part, Unknown};
use crate::keyword::nearest;
use crate::paper;
use crate::pipeline::UsageError;
use crate::rocking::{Structure, housner_eta, judge};
use crate::sheet::Sheet;
use crate::units::Quantity;
use crate::warning::{Warning, Warnings};

/// The structures of a call.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Structure")]
pub struct StructureArgs {
    /// Width of the block or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub width: Option<f64>,
    /// Height of the block or column, m
    #[arg(long, value_name = "M", conflicts_with_all = ["p", "alpha"])]
    pub height: Option<f64>,
    /// Frequency parameter, rad/s
    #[arg(long, value_name = "RAD/S")]
    pub p: Option<f64>,
    /// Slenderness, rad
    #[arg(long, value_name = "RAD")]
    pub alpha: Option<f64>,
    /// Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    #[arg(long)]
    pub eta: Option<Restitution>,
    /// Standard deviation of eta [default: 0 of a number; that of tests if it is computed]
    #[arg(long, value_name = "SD", requires = "eta")]
    pub eta_sd: Option<f64>,
    /// Of a frame: mass of the beam over that of all columns
    #[arg(long, value_name = "RATIO", conflicts_with_all = ["p", "alpha"])]
    pub beam_mass_ratio: Option<f64>,
    /// One of several: name=frame,p=1.0,alpha=0.15,eta=0.92 or name=cabinet,width=0.8,height=2.2
    #[arg(long, value_name = "NAME=VALUE,...", conflicts_with_all = ["p", "alpha", "eta", "width", "height", "beam_mass_ratio"])]
    pub structure: Vec<Spec>,
    /// CSV list: name; width, depth, height (m, cm or mm by the heading) or p, alpha, eta; the word
    /// paper for the two of the paper
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath,
          conflicts_with_all = ["p", "alpha", "eta", "width", "height", "beam_mass_ratio", "structure"])]
    pub structures: Option<PathBuf>,
}

/// A structure as it is given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spec {
    name: Option<String>,
    p: Option<f64>,
    alpha: Option<f64>,
    eta: Option<Restitution>,
    eta_sd: Option<f64>,
    width: Option<f64>,
    height: Option<f64>,
    beam_mass_ratio: Option<f64>,
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

const KEYS: [&str; 8] = ["name", "p", "alpha", "eta", "eta-sd", "width", "height", "beam-mass-ratio"];

impl FromStr for Spec {
    type Err = String;

    fn from_str(text: &str) -> Result<Spec, String> {
        let mut spec = Spec::default();
        for pair in text.split(',') {
            let (key, value) = pair
                .split_once('=')
                .ok_or_else(|| format!("'{pair}': expected {}=VALUE", KEYS.join("=, ")))?;
            spec.set(&key.trim().replace('_', "-"), value.trim())?;
        }
        Ok(spec)
    }
}

impl Spec {
    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        let number = || value.parse().map(Some).map_err(|_| format!("{key} is '{value}'; expected a number"));
        match key {
            "name" => self.name = Some(value.to_string()),
            "p" => self.p = number()?,
            "alpha" => self.alpha = number()?,
            "eta" => self.eta = Some(value.parse()?),
            "eta-sd" => self.eta_sd = number()?,
            "width" => self.width = number()?,
            "height" => self.height = number()?,
            "beam-mass-ratio" => self.beam_mass_ratio = number()?,
            _ => {
                let hint =
                    nearest(key, &KEYS).map_or(String::new(), |near| format!("; did you mean '{near}'?"));
                return Err(format!("unknown parameter '{key}'{hint}"));
            }
        }
        Ok(())
    }

    /// The structure, if its parameters can be right.
    pub fn structure(&self) -> Result<Structure, String> {
        let Spec { ref name, p, alpha, eta, width, height, beam_mass_ratio, .. } = *self;
        let name = name.as_deref().unwrap_or("structure");
        let eta_number = eta.and_then(|eta| match eta {
            Restitution::Number(eta) => Some(eta),
            Restitution::Housner => None,
        });
        let given = [
            ("p", p),
            ("alpha", alpha),
            ("eta", eta_number),
            ("width", width),
            ("height", height),
            ("beam-mass-ratio", beam_mass_ratio),
        ];
        let given: Vec<(&str, f64)> =
            given.into_iter().filter_map(|(key, value)| Some((key, value?))).collect();
        judge(name, &given).map_err(|error| error.to_string())?;
        let structure = match (p, alpha, eta, width, height) {
            (Some(p), Some(alpha), Some(Restitution::Number(eta)), None, None) => {
                Structure::new(name, p, alpha, eta)
            }
            (Some(p), Some(alpha), Some(Restitution::Housner), None, None) => {
                Structure::new(name, p, alpha, housner_eta(alpha))
            }
            (None, None, _, Some(width), Some(height)) => match beam_mass_ratio {
                Some(ratio) => Structure::frame(name, width, height, ratio, eta_number),
                None => Structure::rectangular_block(name, width, height, eta_number),
            },
            _ => return Err(format!("structure '{name}': expected p, alpha and eta, or width and height")),
        };
        structure.map_err(|error| error.to_string())
    }
}

impl StructureArgs {
    /// Whether any is given.
    pub fn is_given(&self) -> bool {
        let StructureArgs { p, alpha, eta, width, height, structure, structures, .. } = self;
        let numbers = [p, alpha, width, height].iter().any(|number| number.is_some());
        numbers || eta.is_some() || structures.is_some() || !structure.is_empty()
    }

    /// All structures.
    pub fn resolve(&self) -> anyhow::Result<Vec<Structure>> {
        let objects = self.objects()?;
        let structures: Result<Vec<Structure>, String> =
            objects.into_iter().map(|object| object.structure).collect();
        structures.map_err(UsageError::because)
    }

    /// All structures, each with what is wrong with it.
    pub fn objects(&self) -> anyhow::Result<Vec<Object>> {
        let StructureArgs { p, alpha, eta, eta_sd, width, height, beam_mass_ratio, .. } = *self;
        let objects = match &self.structures {
            Some(path) if path.as_os_str() == "paper" => {
                paper::structures().into_iter().map(Object::from).collect()
            }
            Some(path) => read_list(path)?,
            None if !self.structure.is_empty() => {
                self.structure.iter().map(|spec| Object::of_spec(spec, None)).collect()
            }
            None if self.is_given() => {
                vec![Object::of_spec(
                    &Spec { name: None, p, alpha, eta, eta_sd, width, height, beam_mass_ratio },
                    None,
                )]
            }
            None => {
                return Err(UsageError::because(
                    "no structure; expected --width and --height of a block, or --p, --alpha and --eta, or --structures FILE",
                ));
            }
        };
        let mut names: Vec<&str> = objects.iter().map(|object| object.name.as_str()).collect();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(UsageError::because(format!(
                "two structures are called '{}'; expected distinct names",
                pair[0]
            ))),
            None => Ok(objects),
        }
    }
}

/// Below this a coefficient of restitution is more likely a typing error.
const LOW_ETA: f64 = 0.5;

/// What speaks against the parameters of a structure.
pub fn warnings_of(structure: &Structure) -> Vec<Warning> {
    let size = structure.warning().map(|_| Warning::ImplausibleSize);
    size.into_iter().chain((structure.eta < LOW_ETA).then_some(Warning::LowRestitution)).collect()
}

/// The same of several structures.
pub fn warnings_of_all(structures: &[Structure]) -> Warnings {
    let of = |structure: &Structure| {
        warnings_of(structure)
            .into_iter()
            .map(|warning| (warning, structure.name.clone()))
            .collect::<Vec<_>>()
    };
    structures.iter().flat_map(of).collect()
}

/// An object of a list: a structure, or what is wrong with its row.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub name: String,
    /// Width of the base and height, m, if it is given by its dimensions.
    pub size_m: Option<[f64; 2]>,
    pub structure: Result<Structure, String>,
    /// What is not known of it: the structure at the 16 and 84 % quantiles.
    pub unknowns: Vec<Unknown<Structure>>,
}

impl From<Structure> for Object {
    fn from(structure: Structure) -> Object {
        Object {
            name: structure.name.clone(),
            size_m: None,
            unknowns: unknown_eta(&structure, None).into_iter().collect(),
            structure: Ok(structure),
        }
    }
}

impl Object {
    fn of_spec(spec: &Spec, row: Option<&str>) -> Object {
        let place = row.map_or(String::new(), |row| format!("{row}: "));
        let structure = spec.structure();
        Object {
            name: spec.name.clone().unwrap_or_else(|| "structure".to_string()),
            size_m: spec.width.zip(spec.height).map(|(width, height)| [width, height]),
            unknowns: structure.iter().filter_map(|structure| unknown_eta(structure, spec.eta_sd)).collect(),
            structure: structure.map_err(|error| format!("{place}{error}")),
        }
    }
}

/// Standard deviation of ln(1 - eta) about Housner's, by free rocking tests: blocks on concrete lost 1.2 to 1.8 times
/// as much (ElGawady et al. 2006), concrete and stone members less, down to 0.6 (Kalliontzis et al. 2016, Ther &
/// Kollar 2017).
const SD_OF_LOSS: f64 = 0.4;

/// What is not known of eta: by its standard deviation if it was measured, of Housner's by tests.
fn unknown_eta(structure: &Structure, sd: Option<f64>) -> Option<Unknown<Structure>> {
    let is_computed = (structure.eta - housner_eta(structure.alpha_rad)).abs() < 1e-6;
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

/// Reads a list of objects: the smaller of width and depth is the base.
fn read_list(path: &Path) -> anyhow::Result<Vec<Object>> {
    let place = || path.display().to_string();
    let sheet = Sheet::parse(&std::fs::read(path).with_context(place)?).with_context(place)?;
    let known = sheet.headings.iter().any(|heading| ["height", "p"].contains(&heading.name.as_str()));
    if !known {
        let headings: Vec<&str> = sheet.headings.iter().map(|heading| heading.text.as_str()).collect();
        anyhow::bail!(
            "{}: headings {}; expected name, width, depth and height, or p, alpha and eta",
            place(),
            headings.join(", ")
        );
    }
    let place = |row| format!("{}, line {}", path.display(), sheet.lines[row]);
    Ok((0..sheet.lines.len()).map(|row| object(&sheet, row, &place(row))).collect())
}

/// The object of a row; `place` is its line in the file.
fn object(sheet: &Sheet, row: usize, place: &str) -> Object {
    let name = sheet.column(&["name"]).map_or("", |column| sheet.cell(row, column));
    let name = if name.is_empty() { format!("line {}", sheet.lines[row]) } else { name.to_string() };
    match spec(sheet, row) {
        Ok(spec) => Object::of_spec(&Spec { name: Some(name), ..spec }, Some(place)),
        Err(problem) => Object {
            name,
            size_m: None,
            structure: Err(format!("{place}: {problem}")),
            unknowns: Vec::new(),
        },
    }
}

fn spec(sheet: &Sheet, row: usize) -> Result<Spec, String> {
    let cell = |name: &str| sheet.column(&[name]).filter(|column| !sheet.cell(row, *column).is_empty());
    let number = |name: &str| {
        let number = cell(name).map(|column| sheet.number(row, column));
        number.transpose().map_err(|error| error.to_string())
    };
    let length = |name: &str| -> Result<Option<f64>, String> {
        let metres = match cell(name).and_then(|column| sheet.headings[column].unit) {
            None => 1.0,
            Some(unit) if unit.quantity == Quantity::Length => unit.si,
            Some(unit) => return Err(format!("{name} is in {}; expected m, cm or mm", unit.name)),
        };
        Ok(number(name)?.map(|length| length * metres))
    };
    let (width, depth) = (length("width")?, length("depth")?);
    Ok(Spec {
        name: None,
        p: number("p")?,
        alpha: number("alpha")?,
        eta_sd: number("eta_sd")?,
        eta: cell("eta").map(|column| sheet.cell(row, column).parse()).transpose()?,
        width: width.zip(depth).map(|(width, depth)| width.min(depth)).or(width).or(depth),
        height: length("height")?,
        beam_mass_ratio: number("beam_mass_ratio")?,
    })
}
