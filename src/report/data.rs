//! The data of a report: responses, the fits to them, motions, and the files they come from.

use serde_json::Value;

use super::text::{Label, number};
use crate::fragility::overturning::LEAST_EVENTS;
use crate::fragility::{Case, DemandLaw, FragilityModel, Gap, Measure, Peak, Predictor, has_few_events};
use crate::keyword::Keyword;
use crate::rocking::{Outcome, Structure, TracePoint};
use crate::statistics::FitStatus;

/// The data of a report.
#[derive(Debug, Clone, Default)]
pub struct ReportData {
    /// What the user calls the report; a name of its own where none is given.
    pub title: Option<String>,
    pub author: Option<String>,
    /// The date in the user's words: there is no clock, so that the same files give the same bytes.
    pub date: Option<String>,
    /// The responses that the figures show, by suite and structure.
    pub groups: Vec<Group>,
    /// What came out for each suite and structure that is asked for, those with figures first.
    pub summaries: Vec<Summary>,
    /// Number of further pairs of suite and structure in the file, without figures.
    pub left_out: usize,
    /// Limit state of P_ex, |theta|max / alpha, if there are regressions.
    pub limit: Option<f64>,
    /// Joined fits, for the calculator.
    pub models: Vec<Model>,
    /// Some motions, and the responses to them over time.
    pub motions: Vec<Motion>,
    /// A combined motion and its pulse.
    pub parts: Option<Parts>,
    /// Annual rates at a site.
    pub rates: Vec<Rates>,
    pub analyses: Vec<Analysis>,
    pub validations: Vec<Validated>,
    pub rankings: Vec<Ranking>,
    /// How many curves of overturning hold, bend and fail on other structures.
    pub transfers: Option<[usize; 3]>,
    pub tables: Vec<Table>,
    /// The files, in the order of the pipeline.
    pub files: Vec<File>,
}

/// What came of a structure under a suite.
#[derive(Debug, Clone)]
pub struct Summary {
    pub suite: Option<String>,
    pub structure: Structure,
    /// Number of motions.
    pub n: usize,
    pub rocked: usize,
    pub overturned: usize,
    /// Cases above the limit state that did not overturn, if there is one.
    pub exceeded: Option<usize>,
    /// The curve of overturning over p PGV / (g tan alpha), if there is a row of it.
    pub curve: Option<Median>,
}

impl Summary {
    /// Names structure and suite.
    pub fn name(&self) -> String {
        name_of(&self.structure.name, self.suite.as_deref())
    }

    /// How many of those that rock overturn, or do not, whichever are fewer.
    pub fn fewer(&self) -> usize {
        self.overturned.min(self.rocked - self.overturned)
    }

    /// Whether a curve of one measure says little, or its tests do.
    pub fn has_few_events(&self) -> bool {
        has_few_events(self.overturned, self.rocked, 1)
    }
}

/// The middle of a curve of overturning, and what its tests say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Median {
    pub status: FitStatus,
    /// PGV (m/s) at which half of the rocking structures overturn, with limits; none if there is no curve.
    pub pgv_m_s: Option<[f64; 3]>,
    /// Where the curve is off most.
    pub gap: Option<Gap>,
}

/// Annual rates of the limit states of a structure at a site.
#[derive(Debug, Clone, PartialEq)]
pub struct Rates {
    /// The structure and the fits, in words.
    pub name: String,
    pub by: By,
    /// What a reader must know of them, a sentence each.
    pub notes: Vec<String>,
    pub years: f64,
    pub states: Vec<StateRate>,
    /// The hazard that they are over, where the file says.
    pub hazard: Option<Hazard>,
}

/// What annual rates come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    Fits,
    /// The universal surface.
    Surface,
}

/// How often motions of some strength come to a site.
#[derive(Debug, Clone, PartialEq)]
pub struct Hazard {
    /// Name of its file.
    pub file: String,
    /// Number of its rows.
    pub rows: usize,
    /// Of one peak or of both.
    pub curves: Vec<PeakCurve>,
}

/// Values of a peak, m/s2 or m/s, and annual rates at which they are exceeded.
#[derive(Debug, Clone, PartialEq)]
pub struct PeakCurve {
    pub peak: Peak,
    pub points: Vec<(f64, f64)>,
}

/// Value, lower and upper limit of a limit state; NaN where it has none.
#[derive(Debug, Clone, PartialEq)]
pub struct StateRate {
    pub words: String,
    pub annual_rate: [f64; 3],
    /// That it is reached in the years of the rates.
    pub probability: [f64; 3],
}

/// Shares of motions that overturn a structure when they are scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    pub name: String,
    /// What is scaled.
    pub measure: String,
    pub levels: Vec<Level>,
    /// Median of the lowest overturning intensity, with limits.
    pub theta: Option<[f64; 3]>,
    /// Its dispersion, with limits.
    pub beta: Option<[f64; 3]>,
    /// Motions that overturn the structure at no level, and those that do at the lowest one already.
    pub censored: [usize; 2],
}

/// What is scaled in an analysis, with its unit.
pub fn scaled_words(measure: &str) -> String {
    match measure {
        "pga" => "PGA (g)".to_string(),
        "pgv" => "PGV (m/s)".to_string(),
        "scale" => "scale of the motions".to_string(),
        other => other.to_uppercase(),
    }
}

/// One intensity of an analysis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    pub intensity: f64,
    pub n: usize,
    /// Share that overturns, with limits.
    pub share: [f64; 3],
    /// The lognormal curve of the lowest overturning intensities.
    pub lognormal: Option<f64>,
}

/// An event seen, and predicted by curves of other motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Validated {
    pub name: String,
    pub n: usize,
    /// Share seen, with limits.
    pub seen: [f64; 3],
    /// Share predicted, with limits of the fits.
    pub expected: [f64; 3],
    /// Probability of a count as far out.
    pub chance_p: f64,
}

/// Measures by how well they predict held-out cases.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Structure, suite and what is predicted.
    pub name: String,
    /// Measures, gain in log score over the model of the paper, and its standard error.
    pub candidates: Vec<(String, f64, f64)>,
}

/// The responses of one structure to one suite.
#[derive(Debug, Clone)]
pub struct Group {
    pub suite: Option<String>,
    pub structure: Structure,
    /// All of them, or of very many some that are spread over all.
    pub responses: Vec<ReportResponse>,
    /// How many more there are.
    pub not_drawn: usize,
    /// Of all that rock, those that overturn or those that do not, whichever are fewer.
    pub fewer: usize,
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
    pub status: FitStatus,
    /// Where it is off most.
    pub gap: Option<Gap>,
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

impl Motion {
    /// The demand of the first structure, if it rocks safely.
    pub fn demand(&self) -> Option<f64> {
        let trace = self.traces.first().filter(|trace| trace.outcome == Outcome::SafeRocking)?;
        let peak = trace.points.iter().fold(0.0_f64, |peak, point| peak.max(point.theta_rad.abs()));
        Some(peak / trace.alpha_rad)
    }
}

/// The motion that brings the first structure nearest to overturning without doing so, else the one in the middle.
pub fn most_telling(motions: &[Motion]) -> Option<usize> {
    let demands = motions.iter().enumerate().filter_map(|(index, motion)| Some((index, motion.demand()?)));
    let largest = demands.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index);
    largest.or((!motions.is_empty()).then_some(motions.len() / 2))
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
    /// Name of its file.
    pub name: String,
    pub title: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<String>>,
    /// Number of further rows in the file.
    pub left_out: usize,
    /// The same rows in full, as comma-separated values.
    pub csv: String,
}

/// A column of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its head, in words.
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
    /// What its stage warned of.
    pub warnings: Vec<String>,
}

/// Number of letters of a name that fit above a panel.
const LONGEST_NAME: usize = 44;

/// Options that the method names.
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
    /// Whether so few motions overturn a structure, or do not, that what they tell when they are scaled comes first.
    pub fn has_few_events(&self) -> bool {
        self.summaries.iter().any(Summary::has_few_events)
    }

    /// Whether some of the rates come from this.
    pub fn has_rates_by(&self, by: By) -> bool {
        self.rates.iter().any(|rates| rates.by == by)
    }

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

impl Hazard {
    /// Says which file it is and what that holds.
    pub fn words(&self) -> String {
        let of = |PeakCurve { peak, points }: &PeakCurve| {
            let (unit, size) = peak.usual_unit();
            let ends =
                [points.first(), points.last()].map(|end| end.map_or(f64::NAN, |(value, _)| value / size));
            let [from, to] = ends.map(number::short);
            format!("{} from {from} to {to} {unit}", peak.as_str().to_uppercase())
        };
        let peaks: Vec<String> = self.curves.iter().map(of).collect();
        let (file, rows, peaks) = (&self.file, number::count(self.rows), peaks.join(" and "));
        match self.curves.len() {
            1 => format!("{file}: annual rates of exceedance at {rows} values of {peaks}"),
            _ => format!(
                "{file}: annual rates of {rows} pairs of {peaks}, drawn as rates of exceedance of each"
            ),
        }
    }
}

impl Group {
    /// Names the group in titles, cut to their width.
    pub fn name(&self) -> String {
        name_of(&self.structure.name, self.suite.as_deref())
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

    /// Whether enough motions overturn the structure, and enough do not, for a curve to be drawn.
    pub fn has_curve(&self) -> bool {
        self.fewer >= LEAST_EVENTS
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

/// Names a structure and a suite, cut to the width of a title.
pub fn name_of(structure: &str, suite: Option<&str>) -> String {
    let name = suite.map_or(structure.to_string(), |suite| format!("{structure}, {suite}"));
    if name.chars().count() <= LONGEST_NAME {
        return name;
    }
    name.chars().take(LONGEST_NAME - 1).chain(['\u{2026}']).collect()
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

/// Labels a peak in its usual unit on an axis.
pub fn peak_label(peak: Peak) -> Label {
    Label::plain(format!("{} ({})", peak.as_str().to_uppercase(), peak.usual_unit().0))
}

/// Labels the demand on an axis.
pub fn demand_label() -> Label {
    Label::marked("|*θ*|_{max} / *α*")
}
