//! The data of a report: responses, the fits to them, motions, and the files they come from.

use serde_json::Value;

use super::text::Label;
use crate::fragility::{Case, DemandLaw, FragilityModel, Measure, Predictor};
use crate::rocking::{Outcome, Structure, TracePoint};

/// The data of a report.
#[derive(Debug, Clone, Default)]
pub struct ReportData {
    /// The responses that the figures show, by suite and structure.
    pub groups: Vec<Group>,
    /// Number of further pairs of suite and structure in the file.
    pub left_out: usize,
    /// Limit state of P_ex, |theta|max / alpha, if there are regressions.
    pub limit: Option<f64>,
    /// Joined fits, for the calculator.
    pub models: Vec<Model>,
    /// Some motions, and the responses to them over time.
    pub motions: Vec<Motion>,
    /// A combined motion and its pulse.
    pub parts: Option<Parts>,
    pub tables: Vec<Table>,
    /// The files, in the order of the pipeline.
    pub files: Vec<File>,
}

/// The responses of one structure to one suite.
#[derive(Debug, Clone)]
pub struct Group {
    pub suite: Option<String>,
    pub structure: Structure,
    pub responses: Vec<ReportResponse>,
    /// Regressions of the demand on one measure of Eq. 13 each.
    pub univariate: Vec<Regression>,
    /// The two planes: below the transition and from there on.
    pub planes: Option<Planes>,
    pub curves: Vec<Curve>,
}

/// A response with the peaks of its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportResponse {
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
    pub law: DemandLaw,
    pub r2: f64,
    /// Whether the demand rises with the measure.
    pub rises: bool,
}

/// The two planes of the demand (Eqs. 17 and 18).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planes {
    /// IM4 at which they meet.
    pub transition: f64,
    /// Planes below the transition and above it.
    pub sides: [Regression; 2],
}

/// A fragility curve of overturning, by the probit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    pub index: Predictor,
}

/// Fits joined into the tree of Eq. 12.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    pub suite: Option<String>,
    pub structure: String,
    /// `bivariate`, or the name of the one measure.
    pub form: String,
    pub fits: FragilityModel,
    /// What speaks against it, if anything does.
    pub doubt: Option<String>,
}

/// A motion and the responses of structures to it over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    pub name: String,
    /// Magnitude, distance and period in words, as far as known.
    pub words: String,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Ground acceleration, m/s2.
    pub acceleration_m_s2: Vec<f64>,
    pub traces: Vec<Trace>,
}

/// The response of a structure over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    pub structure: String,
    pub alpha_rad: f64,
    pub outcome: Outcome,
    pub points: Vec<TracePoint>,
}

/// A combined motion and the pulse in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Parts {
    /// Magnitude, distance and period in words, as far as known.
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
    pub title: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<String>>,
    /// Number of further rows in the file.
    pub left_out: usize,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    pub name: String,
    pub description: String,
    pub numeric: bool,
}

/// A file of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct File {
    pub name: String,
    /// Stage that made it; none of another program.
    pub stage: Option<String>,
    /// Version of rockfrag that made it.
    pub version: String,
    /// Options of the stage.
    pub parameters: Value,
    /// Fingerprint of its content.
    pub content: String,
    pub rows: usize,
}

/// Number of letters of a name that fit above a panel.
const LONGEST_NAME: usize = 44;

/// Options that a caption names.
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

impl ReportData {
    /// Says in a sentence what made the files: version, seed and options.
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
    /// Names the group in titles, cut to their width.
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

    /// Iterates over the responses that rocked, and whether they overturned.
    pub fn rocked(&self) -> impl Iterator<Item = (&ReportResponse, bool)> {
        let rocked = self.responses.iter().filter(|response| response.case.outcome != Outcome::NoRocking);
        rocked.map(|response| (response, response.case.outcome == Outcome::Overturning))
    }

    /// Iterates over the responses that rocked and came back, with a demand that has a logarithm.
    pub fn safe(&self) -> impl Iterator<Item = &ReportResponse> {
        self.responses.iter().filter(|response| response.case.has_demand())
    }

    /// Counts the responses of an outcome.
    pub fn count(&self, outcome: Outcome) -> usize {
        self.responses.iter().filter(|response| response.case.outcome == outcome).count()
    }

    /// Finds the regression on one measure.
    pub fn on(&self, measure: Measure) -> Option<&Regression> {
        self.univariate.iter().find(|regression| regression.law.ln_median.im_x == measure)
    }

    /// Finds the curve over these measures.
    pub fn curve(&self, im_x: Measure, im_y: Option<Measure>) -> Option<&Curve> {
        self.curves.iter().find(|curve| (curve.index.im_x, curve.index.im_y) == (im_x, im_y))
    }
}

/// Labels a measure on an axis or in a legend.
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

/// Labels the demand on an axis.
pub fn demand_label() -> Label {
    Label::marked("|*θ*|_{max} / *α*")
}
