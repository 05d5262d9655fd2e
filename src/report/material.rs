//! What a report is made of: responses, the fits to them, motions and where they all come from.

use serde_json::Value;

use super::label::Label;
use crate::fragility::{Case, DemandLaw, FragilityModel, Measure, Predictor};
use crate::rocking::{Outcome, Structure, TracePoint};

/// All of it.
#[derive(Debug, Clone, Default)]
pub struct Material {
    /// The responses that the figures show, by suite and structure.
    pub groups: Vec<Group>,
    /// How many further suites and structures the file holds.
    pub left_out: usize,
    /// The demand |theta|max / alpha that P_ex is about, if there are regressions.
    pub limit: Option<f64>,
    /// Joined fits, for the calculator.
    pub models: Vec<Model>,
    /// Some motions, and what structures do in them.
    pub motions: Vec<Motion>,
    /// A motion with its parts.
    pub parts: Option<Parts>,
    /// Tables as they stand in files.
    pub tables: Vec<Table>,
    /// The files, in the order of the pipeline.
    pub files: Vec<File>,
}

/// The responses of one structure to one suite.
#[derive(Debug, Clone)]
pub struct Group {
    /// The suite, if it has a name.
    pub suite: Option<String>,
    /// The structure.
    pub structure: Structure,
    /// Its responses.
    pub responses: Vec<Seen>,
    /// Regressions of the demand on one measure, of those of Eq. 13 that have one.
    pub univariate: Vec<Regression>,
    /// The two planes: below the transition and from there on.
    pub planes: Option<Planes>,
    /// Curves of overturning.
    pub curves: Vec<Curve>,
}

/// A response and the peaks of its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Seen {
    /// Outcome, demand and measures.
    pub case: Case,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Period of the pulse, s, if known.
    pub tp_s: Option<f64>,
}

/// A regression of the demand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Regression {
    /// ln EDP on ln IM.
    pub law: DemandLaw,
    /// Coefficient of determination.
    pub r2: f64,
    /// Whether the demand rises with the measure.
    pub rises: bool,
}

/// Two regressions that meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planes {
    /// The IM4 at which they meet.
    pub transition: f64,
    /// Below and from there on.
    pub sides: [Regression; 2],
}

/// A fragility curve of overturning, by the probit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// Its index.
    pub index: Predictor,
}

/// Fits joined into the tree of Eq. 12.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// Suite, if it has a name.
    pub suite: Option<String>,
    /// Structure that was simulated.
    pub structure: String,
    /// `bivariate`, or the one measure.
    pub form: String,
    /// The fits.
    pub fits: FragilityModel,
}

/// A motion and what structures do in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// What it is called.
    pub name: String,
    /// Magnitude, distance and period in words, as far as known.
    pub words: String,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Ground acceleration, m/s2.
    pub acceleration_m_s2: Vec<f64>,
    /// What the structures do.
    pub traces: Vec<Trace>,
}

/// The response of a structure over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    /// Which structure.
    pub structure: String,
    /// Its slenderness, rad.
    pub alpha_rad: f64,
    /// How it ends.
    pub outcome: Outcome,
    /// Samples and events.
    pub points: Vec<TracePoint>,
}

/// A combined motion and the pulse in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Parts {
    /// What is known of the earthquake.
    pub words: String,
    /// Time between samples, s.
    pub dt_s: f64,
    /// The pulse, m/s2; none if the motion has no known parts.
    pub pulse_m_s2: Option<Vec<f64>>,
    /// The whole motion, m/s2.
    pub whole_m_s2: Vec<f64>,
}

/// A table out of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// What it is about.
    pub title: String,
    /// Name and description of each column, and whether it holds numbers.
    pub columns: Vec<Column>,
    /// The cells of each row.
    pub rows: Vec<Vec<String>>,
    /// How many further rows the file has.
    pub left_out: usize,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name in the file.
    pub name: String,
    /// What it holds.
    pub description: String,
    /// Whether it holds numbers.
    pub numeric: bool,
}

/// A file of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct File {
    /// Its name.
    pub name: String,
    /// The stage that made it; another program's have none.
    pub stage: Option<String>,
    /// Version of rockfrag that made it.
    pub version: String,
    /// Options of the stage.
    pub parameters: Value,
    /// Fingerprint of what it holds.
    pub content: String,
    /// Its rows.
    pub rows: usize,
}

/// Letters of a name that fit above a panel.
const LONGEST_NAME: usize = 44;

/// Options that a caption names where a file has them.
const NAMED: [&str; 12] = [
    "seed",
    "design",
    "samples",
    "mw",
    "re",
    "suite",
    "dt",
    "difference",
    "limit-state",
    "transition",
    "link",
    "estimator",
];

impl Material {
    /// What was run, in a sentence: version, seed and options.
    pub fn made(&self) -> String {
        let mut versions: Vec<&str> = self.files.iter().map(|file| file.version.as_str()).collect();
        versions.retain(|version| !version.is_empty());
        versions.sort_unstable();
        versions.dedup();
        let mut options: Vec<String> = Vec::new();
        for name in NAMED {
            for value in self
                .files
                .iter()
                .filter_map(|file| file.parameters.get(name))
                .filter(|value| !value.is_null())
            {
                let words =
                    format!("{name} {}", value.to_string().replace(['"', '[', ']'], "").replace(',', ", "));
                if !options.contains(&words) {
                    options.push(words);
                }
            }
        }
        match versions[..] {
            [] => "The files were not made by rockfrag.".to_string(),
            _ => format!("Made by rockfrag {}: {}.", versions.join(", "), options.join("; ")),
        }
    }
}

impl Group {
    /// Its name in titles, cut where it is too long for them.
    pub fn name(&self) -> String {
        let name = match &self.suite {
            Some(suite) => format!("{}, {suite}", self.structure.name),
            None => self.structure.name.clone(),
        };
        if name.chars().count() <= LONGEST_NAME {
            return name;
        }
        name.chars().take(LONGEST_NAME - 1).chain(['\u{2026}']).collect()
    }

    /// Responses that rocked, and whether they overturned.
    pub fn rocked(&self) -> impl Iterator<Item = (&Seen, bool)> {
        let rocked = self.responses.iter().filter(|seen| seen.case.outcome != Outcome::NoRocking);
        rocked.map(|seen| (seen, seen.case.outcome == Outcome::Overturning))
    }

    /// Responses that rocked and came back, with a demand that has a logarithm.
    pub fn safe(&self) -> impl Iterator<Item = &Seen> {
        self.responses.iter().filter(|seen| seen.case.has_demand())
    }

    /// How many responses have this outcome.
    pub fn count(&self, outcome: Outcome) -> usize {
        self.responses.iter().filter(|seen| seen.case.outcome == outcome).count()
    }

    /// The regression on one measure.
    pub fn on(&self, measure: Measure) -> Option<&Regression> {
        self.univariate.iter().find(|regression| regression.law.ln_median.im_x == measure)
    }

    /// The curve over these measures.
    pub fn curve(&self, im_x: Measure, im_y: Option<Measure>) -> Option<&Curve> {
        self.curves.iter().find(|curve| (curve.index.im_x, curve.index.im_y) == (im_x, im_y))
    }
}

/// A measure on an axis or in a legend.
pub fn measure_label(measure: Measure) -> Label {
    Label::marked(match measure {
        Measure::Im1 => "*ω*_{p} / *p*",
        Measure::Im2 => "*ω*_{m} / *p*",
        Measure::Im3 => "PGA / (*p* PGV)",
        Measure::Im4 => "PGA / (*g* tan *α*)",
        Measure::Im5 => "*p* PGV / (*g* tan *α*)",
        Measure::Im6 => "*ω*_{m} PGV / (*g* tan *α*)",
        Measure::Im3Inverse => "*p* PGV / PGA",
    })
}

/// The demand on an axis.
pub fn demand_label() -> Label {
    Label::marked("|*θ*|_{max} / *α*")
}
