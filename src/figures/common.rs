//! What several figures share: labels, choices of cases and fits, values along an axis, bins.

use rockfrag_core::fragility::{
    Calibration, Case, Cases, CurveFit, DemandFit, DemandModel, Event, Measure, Predictors, p_overturning,
};
use rockfrag_core::motion::Suite;
use rockfrag_core::paper;
use rockfrag_core::rocking::Structure;
use rockfrag_core::statistics::numerics::equal_ratios;
use rockfrag_core::statistics::{Interval, Range};
use rockfrag_core::studies::observed_share;
use rockfrag_core::warning::UNNAMED;

use crate::chart::text::literal;
use crate::chart::{Axis, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Words};
use crate::number;
use crate::table::responses::ScaledMeasure;

/// The fits that figures show.
#[derive(Default)]
pub struct Fits {
    pub demand: Vec<DemandFit>,
    /// Fits of overturning.
    pub curves: Vec<CurveFit>,
    pub calibrations: Vec<Calibration>,
    /// Demand whose exceedance was fitted.
    pub limit_state: f64,
    /// Rotation (rad) to which the fits of the demand raise smaller ones.
    pub rotation_floor: f64,
}

impl Fits {
    pub fn calibration(&self, cases: &Cases) -> Option<&Calibration> {
        self.calibrations.iter().find(|row| row.group() == cases.group())
    }

    pub fn curve(&self, cases: &Cases, predictors: &Predictors) -> Option<&CurveFit> {
        let mut fits = self.curves.iter().filter(|fit| fit.group() == cases.group());
        fits.find(|fit| fit.predictors() == *predictors)
    }

    pub fn demand(&self, cases: &Cases, model: DemandModel) -> impl Iterator<Item = &DemandFit> {
        let its = self.demand.iter().filter(|fit| fit.group() == cases.group());
        its.filter(move |fit| fit.model == model && !fit.coefficients.is_empty())
    }
}

const LONGEST_NAME: usize = 200;

/// The name of a structure; without one, the block that rocks like it. Marked text.
pub fn called(structure: &Structure) -> String {
    if paper::STRUCTURES.iter().any(|(name, ..)| structure.name == *name) {
        return structure.name.replace('-', " ");
    }
    if structure.name != UNNAMED {
        return literal(&number::shown(&structure.name, LONGEST_NAME));
    }
    let (sin, cos) = structure.alpha_rad.sin_cos();
    let [width, height] = [sin, cos].map(|side| number::length(side * structure.block_diagonal_m()));
    format!("block of {width} × {height} m")
}

/// A name in a row, marked; what has none is an object.
pub fn name_of(structure: &str) -> String {
    if structure == UNNAMED { "object".to_string() } else { literal(structure) }
}

/// Names the motions of a suite; marked text.
fn motions_of(suite: &str) -> String {
    match suite.parse() {
        Ok(Suite::Pulse) => "pulses".to_string(),
        Ok(Suite::Csgm) => "combined motions".to_string(),
        Ok(Suite::Hfc) => "high frequencies".to_string(),
        Ok(Suite::Record) => "records".to_string(),
        Err(_) => literal(suite),
    }
}

/// Names the motions of cases; marked text.
pub fn motions(cases: &Cases) -> String {
    motions_of(cases.suite.as_deref().unwrap_or("motions"))
}

/// Joins a structure, marked text, with the suite of synthetic motions.
pub fn title(structure: &str, suite: Option<&str>) -> String {
    let synthetic = suite.filter(|suite| suite.parse() != Ok(Suite::Record));
    synthetic.map_or(structure.to_string(), |suite| format!("{structure}, {}", motions_of(suite)))
}

pub fn order(cases: &Cases) -> usize {
    let suite = cases.suite.as_deref().unwrap_or_default().parse();
    suite.map_or(usize::MAX, |suite: Suite| suite as usize)
}

/// Names the structure and suite of some cases; marked text.
pub fn name(cases: &Cases) -> String {
    title(&called(&cases.structure), cases.suite.as_deref())
}

/// Label of the demand (Eq. 7).
pub const DEMAND: &str = "|*θ*|_{max} / *α*";

/// Label of a measure (Eq. 13), or the column of a further one.
pub fn label(measure: &Measure) -> &str {
    match measure {
        Measure::Im1 => "*ω*_{p} / *p*",
        Measure::Im2 => "*ω*_{m} / *p*",
        Measure::Im3 => "PGA / (*p* PGV)",
        Measure::Im4 => "PGA / (*g* tan *α*)",
        Measure::Im5 => "*p* PGV / (*g* tan *α*)",
        Measure::Im6 => "*ω*_{m} PGV / (*g* tan *α*)",
        Measure::Im3Inverse => "*p* PGV / PGA",
        Measure::Column(name) => name,
    }
}

/// Short name of a measure, marked text.
pub fn short_label(measure: &Measure) -> String {
    match measure {
        Measure::Im3Inverse => "1/IM3".to_string(),
        Measure::Column(name) => literal(name),
        of_paper => of_paper.as_str().to_uppercase(),
    }
}

pub fn short_labels(predictors: &Predictors) -> String {
    predictors.measures().map(short_label).collect::<Vec<_>>().join(", ")
}

pub fn scaled_label(measure: ScaledMeasure) -> &'static str {
    match measure {
        ScaledMeasure::Scale => "factor on the motion",
        ScaledMeasure::Pga => "PGA (g)",
        ScaledMeasure::Pgv => "PGV (m/s)",
        ScaledMeasure::Im4 => label(&Measure::Im4),
        ScaledMeasure::Im5 => label(&Measure::Im5),
        ScaledMeasure::Im6 => label(&Measure::Im6),
    }
}

/// Names the figure of the paper that shows the same, at the end of a caption.
pub fn compare(caption: &str, figure: &str) -> String {
    format!("{caption} Compare {figure} of Dimitrakopoulos & Paraskeva (2015).")
}

/// The cases that rocked, and whether they overturned.
pub fn rocked(cases: &Cases) -> impl Iterator<Item = (&Case, bool)> {
    let overturned = |case: &Case| Event::Overturning.happened(case.outcome, f64::INFINITY);
    cases.all.iter().filter_map(move |case| Some((case, overturned(case)?)))
}

/// A value of y with its limits.
pub fn estimate(x: f64, Interval { value, low, high }: Interval) -> Mark {
    Mark { low, high, ..Mark::new(x, value) }
}

/// Number of points of a curve.
pub const STEPS: usize = 100;

/// A lognormal curve (Eq. 20) over a range.
pub fn lognormal(Range { low, high }: Range, mu: f64, beta: f64) -> impl Iterator<Item = Mark> {
    equal_ratios(low, high, STEPS).map(move |im| Mark::new(im, p_overturning(im, mu, beta)))
}

/// A row of a panel.
pub struct Row {
    pub name: String,
    /// One below the other, each in a colour that the legend names.
    pub values: Vec<(Interval<Option<f64>>, Ink, String)>,
    /// At the right edge.
    pub words: String,
}

pub fn rows_panel(title: &str, x: Axis, rows: Vec<Row>) -> Panel {
    let names = Axis::names(rows.iter().map(|row| row.name.clone()));
    let mut panel = Panel::new(title, x, names, Vec::new());
    for (row, y) in rows.into_iter().zip(0_i32..) {
        let y = f64::from(y);
        for (Interval { value, low, high }, ink, label) in row.values {
            let [x, low, high] = [value, low, high].map(|end| end.unwrap_or(f64::NAN));
            let mark = Mark { low, high, ..Mark::new(x, y) };
            match panel.layers.iter_mut().find(|layer| layer.name == label && layer.ink == ink) {
                Some(layer) => layer.marks.push(mark),
                None => panel.layers.push(Layer::new(&label, ink, MarkStyle::Estimates, [mark])),
            }
        }
        let (text, position) = (row.words, LabelPosition::Margin);
        panel.words.push(Words { x: 0.0, y, text, position, ink: Ink::Text });
    }
    panel
}

/// Gathers cases (value, whether the event happened) into bins: mean value, observed share with its 95 %
/// limits, number of cases. A bin of fewer cases than `least` is joined with the next; the last is left out.
pub fn observed_shares(cases: &[(f64, bool)], least: usize, bin: impl Fn(f64) -> usize) -> Vec<Mark> {
    let mut cases = cases.to_vec();
    cases.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut joined: Vec<Vec<(f64, bool)>> = Vec::new();
    for its in cases.chunk_by(|a, b| bin(a.0) == bin(b.0)) {
        match joined.last_mut().filter(|last| last.len() < least) {
            Some(last) => last.extend(its),
            None => joined.push(its.to_vec()),
        }
    }
    let share = |its: Vec<(f64, bool)>| {
        let (n, events) = (its.len(), its.iter().filter(|(_, event)| *event).count());
        let mean = its.iter().map(|(value, _)| value).sum::<f64>() / n as f64;
        Mark { n: n as f64, ..estimate(mean, observed_share(events, n)) }
    };
    joined.into_iter().filter(|its| its.len() >= least).map(share).collect()
}

/// Bins of equal ratio within a span, for [`observed_shares`].
pub fn ratio_bins(Range { low, high }: Range, count: usize) -> impl Fn(f64) -> usize {
    let ratio = (high / low).ln().max(f64::MIN_POSITIVE);
    move |value| (((value / low).ln() / ratio * count as f64) as usize).min(count - 1)
}
