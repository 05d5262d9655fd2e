//! Structures as a user names them: by p, alpha and eta, as a block, as a frame, or those of the paper.

use std::collections::HashSet;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::Context;
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Value, json};

use crate::keyword::nearest;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{self, comma_slip, explain, from_scalar};
use crate::rocking::{Structure, StructureError, housner_eta, judge};
use crate::table::store::columns::text_or_numbers;
use crate::table::store::contents::footer;
use crate::table::store::reader::read_any;
use crate::table::store::text_file::{self, CsvText};

/// The largest file: hundreds of thousands of structures.
const MOST_MIB: u64 = 16;

/// The columns of a table of structures, and the part of a structure that each is.
const COLUMNS: [(&str, &str); 15] = [
    ("name", "name"),
    ("structure", "name"),
    ("p", "p"),
    ("p_rad_s", "p"),
    ("alpha", "alpha"),
    ("alpha_rad", "alpha"),
    ("eta", "eta"),
    ("restitution", "eta"),
    ("coefficient_of_restitution", "eta"),
    ("restitution_coefficient", "eta"),
    ("width", "width"),
    ("width_m", "width"),
    ("height", "height"),
    ("height_m", "height"),
    ("beam_mass_ratio", "beam_mass_ratio"),
];

/// Units in which lengths may be given elsewhere.
const IN_OTHER_UNITS: [&str; 6] = ["cm", "mm", "ft", "feet", "in", "inches"];

/// What a file must be.
const FILE_OF_STRUCTURES: &str = "a .yaml, .yml, .parquet or .csv file of structures";

/// How like a known column a heading is that is one misspelt, from 0 to 1.
const MISSPELT: f64 = 0.8;

/// The ways to give a structure.
pub const WAYS: &str =
    "p, alpha and eta (a number, or housner); or width and height (m), with beam-mass-ratio for a frame";

/// A coefficient of restitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Restitution {
    /// A number.
    Given(f64),
    /// That of a rectangular block of the same slenderness.
    Housner,
}

impl Restitution {
    fn of(self, alpha_rad: f64) -> f64 {
        match self {
            Restitution::Given(eta) => eta,
            Restitution::Housner => housner_eta(alpha_rad),
        }
    }
}

impl FromStr for Restitution {
    type Err = String;

    fn from_str(text: &str) -> Result<Restitution, String> {
        match (text, text.parse()) {
            ("housner", _) => Ok(Restitution::Housner),
            (_, Ok(eta)) => Ok(Restitution::Given(eta)),
            _ => Err(format!(
                "'{text}': expected a number above 0 and up to 1, or housner{}",
                comma_slip(text)
            )),
        }
    }
}

impl Serialize for Restitution {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Restitution::Given(eta) => serializer.serialize_f64(*eta),
            Restitution::Housner => serializer.serialize_str("housner"),
        }
    }
}

impl<'de> Deserialize<'de> for Restitution {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Restitution, D::Error> {
        from_scalar(deserializer)
    }
}

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
    pub eta: Option<Restitution>,
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
    /// If parameters are missing, mixed, or cannot be right.
    pub fn structure(&self) -> anyhow::Result<Structure> {
        let name = self.name.clone().unwrap_or_else(|| self.generic_name());
        let wrong = |error: StructureError| UsageError::because(error.to_string());
        judge(&name, &self.given()).map_err(wrong)?;
        let of_dimensions = |alpha_rad: f64| self.eta.map(|eta| eta.of(alpha_rad));
        let structure = match (self.p, self.alpha, self.eta, self.width, self.height, self.beam_mass_ratio) {
            (Some(p), Some(alpha), Some(eta), None, None, None) => {
                Structure::new(&name, p, alpha, eta.of(alpha))
            }
            (None, None, _, Some(width), Some(height), None) => {
                Structure::rectangular_block(&name, width, height, of_dimensions(libm::atan(width / height)))
            }
            (None, None, _, Some(width), Some(height), Some(ratio)) => {
                Structure::frame(&name, width, height, ratio, of_dimensions(libm::atan(width / height)))
            }
            (Some(_), Some(_), None, None, None, None) => {
                return Err(UsageError::because(format!(
                    "structure '{name}': eta is missing; expected p, alpha and eta (a number, 0.92 in the paper, or housner: 1 - 1.5 sin^2 alpha)"
                )));
            }
            _ if self.given().is_empty() && self.name.is_none() => {
                return Err(UsageError::because(format!("no structure; expected {WAYS}")));
            }
            _ => {
                let given = self.given().into_iter().map(|(part, _)| part).collect::<Vec<_>>().join(", ");
                let given = if given.is_empty() { "no number".to_string() } else { given };
                return Err(UsageError::because(format!(
                    "structure '{name}': found {given}; expected {WAYS}"
                )));
            }
        };
        let structure = structure.map_err(wrong)?;
        let Structure { p_rad_s, alpha_rad, eta, .. } = structure;
        judge(&name, &[("p", p_rad_s), ("alpha", alpha_rad), ("eta", eta)]).map_err(wrong)?;
        Ok(structure)
    }

    /// The structure; `eta` of the fits holds where neither it nor dimensions are given.
    ///
    /// # Errors
    /// As [`StructureSpec::structure`].
    pub fn structure_with_eta(&self, eta: f64) -> anyhow::Result<Structure> {
        let of_fits = || (self.p.is_some() && self.alpha.is_some()).then_some(Restitution::Given(eta));
        StructureSpec { eta: self.eta.or_else(of_fits), ..self.clone() }.structure()
    }

    /// The numbers that are given.
    fn given(&self) -> Vec<(&'static str, f64)> {
        let eta = match self.eta {
            Some(Restitution::Given(eta)) => Some(eta),
            _ => None,
        };
        let parts = [
            ("p", self.p),
            ("alpha", self.alpha),
            ("width", self.width),
            ("height", self.height),
            ("beam-mass-ratio", self.beam_mass_ratio),
            ("eta", eta),
        ];
        parts.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
    }

    fn generic_name(&self) -> String {
        let short = |name: &'static str| if name == "beam-mass-ratio" { "beam" } else { name };
        let numbers = self.given().into_iter().map(|(name, value)| format!("{}{value}", short(name)));
        let housner = (self.eta == Some(Restitution::Housner)).then(|| "housner".to_string());
        numbers.chain(housner).collect::<Vec<_>>().join("-")
    }

    /// Takes the cell of a table that is this part.
    fn set(&mut self, part: &str, text: &str) -> Result<(), String> {
        let number = || options::number(text).map_err(|expected| format!("'{text}'; {expected}"));
        match part {
            "name" => self.name = Some(text.to_string()),
            "eta" => self.eta = Some(text.parse()?),
            "p" => self.p = Some(number()?),
            "alpha" => self.alpha = Some(number()?),
            "width" => self.width = Some(number()?),
            "height" => self.height = Some(number()?),
            _ => self.beam_mass_ratio = Some(number()?),
        }
        Ok(())
    }
}

impl From<Structure> for StructureSpec {
    fn from(structure: Structure) -> StructureSpec {
        let Structure { name, p_rad_s, alpha_rad, eta } = structure;
        StructureSpec {
            name: Some(name),
            p: Some(p_rad_s),
            alpha: Some(alpha_rad),
            eta: Some(Restitution::Given(eta)),
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

/// When it slides in place of rocking, which nothing here computes.
pub fn words_of_friction(structure: &Structure) -> String {
    format!("which {}", structure.words_of_friction())
}

/// Warns of structures of a size that none has.
pub fn warn_of_size<'s>(structures: impl IntoIterator<Item = &'s Structure>, console: &Console) {
    let doubts =
        structures.into_iter().filter_map(|structure| Some((structure.doubt()?, structure.name.clone())));
    console.warn_each(doubts);
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
    /// Those of the paper.
    #[serde(serialize_with = "paper")]
    Paper,
    /// From a YAML, CSV or Parquet file.
    File(PathBuf),
    /// From the pipeline file itself.
    List(Vec<StructureSpec>),
}

impl fmt::Display for Structures {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Structures::Paper => f.write_str(PAPER),
            Structures::File(path) => path.display().fmt(f),
            Structures::List(_) => f.write_str("structures"),
        }
    }
}

impl FromStr for Structures {
    type Err = std::convert::Infallible;

    fn from_str(path: &str) -> Result<Structures, Self::Err> {
        Ok(if path == PAPER { Structures::Paper } else { Structures::File(PathBuf::from(path)) })
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
        f.write_str(
            "the name of a file, paper, or a list of structures: [{ name: block, width: 0.6, height: 2.4 }]",
        )
    }

    fn visit_str<E: de::Error>(self, path: &str) -> Result<Structures, E> {
        path.parse().map_err(E::custom)
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
            Structures::Paper => PAPERS.map(of_paper).to_vec(),
            Structures::List(specs) => specs.clone(),
            Structures::File(path) => read(path)?,
        };
        if specs.is_empty() {
            return Err(UsageError::because("structures: none given; expected at least one"));
        }
        let structures = specs.iter().map(StructureSpec::structure).collect::<anyhow::Result<Vec<_>>>();
        let structures = match self {
            Structures::File(path) => structures.with_context(|| UsageError(path.display().to_string()))?,
            _ => structures?,
        };
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

/// The word for the structures of the paper: name, p (rad/s) and alpha (rad), of eta 0.92.
const PAPER: &str = "paper";
const PAPERS: [(&str, f64, f64); 2] = [("frame", 1.0, 0.15), ("electrical-equipment", 2.5, 0.20)];

fn of_paper((name, p, alpha): (&str, f64, f64)) -> StructureSpec {
    StructureSpec {
        name: Some(name.to_string()),
        p: Some(p),
        alpha: Some(alpha),
        eta: Some(Restitution::Given(0.92)),
        ..StructureSpec::default()
    }
}

fn paper<S: Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(PAPER)
}

fn read(path: &Path) -> anyhow::Result<Vec<StructureSpec>> {
    let failed = |what: String| UsageError::because(format!("{}: {what}", path.display()));
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let text = || {
        text_file::text(path, MOST_MIB, "structures").with_context(|| UsageError(path.display().to_string()))
    };
    match extension.as_str() {
        "yaml" | "yml" => from_yaml(&text()?).map_err(failed),
        "csv" => from_csv(&text()?).map_err(failed),
        "parquet" => from_parquet(path),
        _ => Err(failed(format!("expected {FILE_OF_STRUCTURES}, or the word paper"))),
    }
}

fn from_yaml(text: &str) -> Result<Vec<StructureSpec>, String> {
    let is_content = |line: &&str| !line.is_empty() && !line.starts_with(['#', '%']) && *line != "---";
    match text.lines().map(str::trim).find(is_content) {
        Some(line) if !line.starts_with(['-', '[']) => Err(format!(
            "'{line}'; expected a list, each structure on a line: - {{ name: block, width: 0.6, height: 2.4 }}"
        )),
        _ => serde_saphyr::from_str(text).map_err(|error| explain(&error, text)),
    }
}

/// The part of a structure that each column of a table is; none of one that is something else.
fn parts(names: &[String], headings: &[String]) -> Result<Vec<Option<&'static str>>, String> {
    let part = |name: &String| COLUMNS.iter().find(|(column, _)| column == name).map(|(_, part)| *part);
    let parts: Vec<Option<&'static str>> = names.iter().map(part).collect();
    for (other, part) in parts.iter().enumerate().filter_map(|(other, part)| Some((other, (*part)?))) {
        if let Some(one) = parts[..other].iter().position(|earlier| *earlier == Some(part)) {
            let (one, other) = (&headings[one], &headings[other]);
            return Err(format!("columns '{one}' and '{other}' are both the {part}; expected one of them"));
        }
    }
    let has = |part| parts.contains(&Some(part));
    // Where a structure is given in one way, the parts of the other are not missed.
    let of_other_way: &[&str] = match (has("p") && has("alpha"), has("width") && has("height")) {
        (true, _) => &["width", "height", "beam_mass_ratio"],
        (false, true) => &["p", "alpha"],
        (false, false) => &[],
    };
    let missing = COLUMNS.iter().filter(|(_, part)| !has(part) && !of_other_way.contains(part));
    let missing: Vec<&str> = missing.map(|(column, _)| *column).collect();
    let is_unknown = |(_, part): &(_, &Option<&str>)| part.is_none();
    for ((name, heading), _) in names.iter().zip(headings).zip(&parts).filter(is_unknown) {
        let in_other_units =
            |length: &&str| IN_OTHER_UNITS.iter().any(|unit| *name == format!("{length}_{unit}"));
        if let Some(length) = ["width", "height"].into_iter().find(in_other_units) {
            return Err(format!("column '{heading}': expected {length}_m, a length in m: convert it"));
        }
        let near = nearest(name, &missing).filter(|near| strsim::jaro_winkler(name, near) > MISSPELT);
        if let Some(near) = near {
            return Err(format!(
                "column '{heading}': did you mean '{near}'? expected name, with {WAYS}, in rad/s, rad and m; take the column out if it is \
                 something else"
            ));
        }
    }
    Ok(parts)
}

fn from_csv(text: &str) -> Result<Vec<StructureSpec>, String> {
    let is_known = |name: &str| COLUMNS.iter().any(|(column, _)| *column == name);
    let table = CsvText::new(text, is_known).map_err(|error| error.to_string())?;
    let headings = table.headings.clone();
    let parts = parts(&table.names, &headings)?;
    let spec = |row: Result<(u64, csv::StringRecord), String>| {
        let (line, record) = row?;
        let cells = headings.iter().zip(&parts).zip(&record);
        spec_of(cells.filter_map(|((heading, part), cell)| Some((heading.as_str(), (*part)?, cell))))
            .map_err(|wrong| format!("line {line}, {wrong}"))
    };
    table.rows().map(spec).collect()
}

/// The structure of a row: the heading of each cell, the part that it is, and its text.
fn spec_of<'c>(
    cells: impl Iterator<Item = (&'c str, &'static str, &'c str)>,
) -> Result<StructureSpec, String> {
    let mut spec = StructureSpec::default();
    for (heading, part, cell) in cells.filter(|(.., cell)| !cell.is_empty()) {
        spec.set(part, cell).map_err(|wrong| format!("column '{heading}': {wrong}"))?;
    }
    Ok(spec)
}

fn from_parquet(path: &Path) -> anyhow::Result<Vec<StructureSpec>> {
    let failed = |what: String| UsageError::because(format!("{}: {what}", path.display()));
    std::fs::metadata(path).with_context(|| UsageError(path.display().to_string()))?;
    let schema = footer(path)?.schema;
    let headings: Vec<String> = schema.fields().iter().map(|field| field.name().clone()).collect();
    let names: Vec<String> = headings.iter().map(|heading| text_file::plain(heading)).collect();
    let parts = parts(&names, &headings).map_err(failed)?;
    let has = |part| parts.contains(&Some(part));
    // Before its rows are read, which may be those of motions.
    if !(has("p") && has("alpha") || has("width") && has("height")) {
        return Err(failed(format!(
            "no columns p and alpha, or width and height; expected {FILE_OF_STRUCTURES}"
        )));
    }
    let (mut specs, mut names) = (Vec::new(), HashSet::new());
    let is_part =
        |name: &str| headings.iter().zip(&parts).any(|(heading, part)| heading == name && part.is_some());
    for batch in read_any(path, is_part)? {
        let mut columns: Vec<(&str, &'static str, Vec<Option<String>>)> = Vec::new();
        for (heading, part) in headings.iter().zip(&parts) {
            let (Some(part), Some(array)) = (part, batch.column_by_name(heading)) else { continue };
            let cells = text_or_numbers(array).map_err(|found| {
                failed(format!("column '{heading}' is {found}; expected text or numbers: convert it"))
            })?;
            columns.push((heading, part, cells));
        }
        for row in 0..batch.num_rows() {
            let cells = columns
                .iter()
                .filter_map(|(heading, part, cells)| Some((*heading, *part, cells[row].as_deref()?)));
            let spec = spec_of(cells).map_err(|wrong| failed(format!("row {}, {wrong}", specs.len() + 1)))?;
            if let Some(name) = spec.name.clone().filter(|name| names.contains(name)) {
                // Responses, for example, or fits.
                return Err(failed(format!(
                    "several rows of '{name}'; expected {FILE_OF_STRUCTURES}, each in one row"
                )));
            }
            names.extend(spec.name.clone());
            specs.push(spec);
        }
    }
    Ok(specs)
}
