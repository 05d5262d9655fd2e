//! One file a figure; each makes of the data the figures that they suffice for.

mod analysis;
mod demand;
mod dots;
mod exceedance;
mod histories;
mod medians;
mod motion;
mod outcomes;
mod overturning;
mod planes;
mod quality;
mod ranking;
mod rates;
mod regressions;
mod reliability;
mod similarity;
mod tree;
mod validation;

use super::data::{Group, ReportData, ReportResponse};
use super::drawing::{Drawing, Stroke};
use super::figure::Figure;
use super::panel::Panel;
use super::text::number;
use crate::fragility::{Measure, Probability};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, Structure};

/// Draws the figures of one kind that the data suffice for.
pub type Draw = fn(&ReportData) -> Vec<Figure>;

/// The parts of the page that hold figures, in its order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// What most readers come for.
    Curves,
    /// Annual rates, where there are some.
    Site,
    /// How far the curves can be trusted.
    Checks,
    /// Motions and what the structures did, for the screen.
    Responses,
    /// What stands behind the rest, folded.
    Background,
}

/// All kinds of figures, in the order of the page.
pub const ALL: [(Part, Draw); 20] = [
    (Part::Curves, analysis::first),
    (Part::Curves, overturning::figures),
    (Part::Curves, exceedance::figures),
    (Part::Curves, medians::figures),
    (Part::Curves, analysis::after),
    (Part::Site, rates::figures),
    (Part::Checks, reliability::figures),
    (Part::Checks, validation::figures),
    (Part::Checks, ranking::figures),
    (Part::Responses, tree::figures),
    (Part::Responses, outcomes::figures),
    (Part::Responses, demand::figures),
    (Part::Responses, motion::figures),
    (Part::Responses, histories::figures),
    (Part::Responses, similarity::figures),
    (Part::Background, overturning::further),
    (Part::Background, planes::over_measures),
    (Part::Background, planes::over_pulse),
    (Part::Background, quality::figures),
    (Part::Background, regressions::figures),
];

/// Names the figure of the paper that shows the same.
fn of_paper(figure: &str) -> String {
    format!("Compare {figure} of Dimitrakopoulos & Paraskeva (2015).")
}

/// Says how many of these have no pulse period and how they ended, in a sentence; nothing where all have one.
fn without_period<'r>(responses: impl Iterator<Item = &'r ReportResponse>) -> String {
    let mut counts = [0; Outcome::ALL.len()];
    for response in responses.filter(|response| response.tp_s.is_none()) {
        counts[Outcome::ALL.iter().position(|other| *other == response.case.outcome).unwrap_or(0)] += 1;
    }
    let all: usize = counts.iter().sum();
    if all == 0 {
        return String::new();
    }
    let counts = Outcome::ALL.iter().zip(counts).filter(|(_, count)| *count > 0);
    let words: Vec<String> = counts
        .map(|(outcome, count)| format!("{} {}", number::count(count), outcome.as_str().replace('_', " ")))
        .collect();
    format!(" {} without a pulse period Tp are left out ({}).", number::count(all), words.join(", "))
}

/// Measures of which none is known.
const NOTHING: IntensityMeasures =
    IntensityMeasures { im1: None, im2: None, im3: None, im4: f64::NAN, im5: f64::NAN, im6: None };

/// Sets one more measure.
fn with(measures: IntensityMeasures, measure: Measure, value: f64) -> IntensityMeasures {
    match measure {
        Measure::Im1 => IntensityMeasures { im1: Some(value), ..measures },
        Measure::Im2 => IntensityMeasures { im2: Some(value), ..measures },
        Measure::Im3 => IntensityMeasures { im3: Some(value), ..measures },
        Measure::Im4 => IntensityMeasures { im4: value, ..measures },
        Measure::Im5 => IntensityMeasures { im5: value, ..measures },
        Measure::Im6 => IntensityMeasures { im6: Some(value), ..measures },
        Measure::Im3Inverse => IntensityMeasures { im3: Some(1.0 / value), ..measures },
    }
}

/// Draws probabilities over a measure, with their limits as a band.
fn draw_curve(
    drawing: &mut Drawing,
    panel: &Panel,
    name: &str,
    curve: &[(f64, Probability)],
    stroke: Stroke,
) {
    let row = |(x, p): &(f64, Probability)| [*x, p.value, p.low, p.high];
    drawing.record(name, &["low", "high"], curve.iter().flat_map(row).collect());
    let band: Vec<[f64; 3]> = curve.iter().map(|(x, p)| [*x, p.low, p.high]).collect();
    panel.band(drawing, &band, stroke.paint.ink.thin(0.2));
    let line: Vec<[f64; 2]> = curve.iter().map(|(x, p)| [*x, p.value]).collect();
    panel.line(drawing, &line, stroke);
}

/// Names p, alpha and eta.
fn structure_words(structure: &Structure) -> String {
    format!(
        "p = {} rad/s, α = {} rad, η = {}",
        number::plain(structure.p_rad_s),
        number::plain(structure.alpha_rad),
        number::plain(structure.eta)
    )
}

/// Makes a name safe for a file.
fn file_words(name: &str) -> String {
    let letter =
        |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '-' };
    name.chars().map(letter).collect()
}

fn group_file_words(group: &Group) -> String {
    match &group.suite {
        Some(suite) => format!("{}-{}", file_words(&group.structure.name), file_words(suite)),
        None => file_words(&group.structure.name),
    }
}

/// Sorts the finite values.
fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    values
}

/// Puts values of x and y into bins of equal ratio of x: for each its middle, and the y in it.
fn by_ratio(values: &[[f64; 2]], [low, high]: [f64; 2], count: usize) -> Vec<(f64, Vec<f64>)> {
    let ratio = libm::pow(high / low, 1.0 / count as f64);
    let middle = |bin: usize| low * libm::pow(ratio, bin as f64 + 0.5);
    let mut bins: Vec<(f64, Vec<f64>)> = (0..count).map(|bin| (middle(bin), Vec::new())).collect();
    for &[x, y] in values {
        let bin = (libm::log(x / low) / libm::log(ratio)).floor();
        if bin >= 0.0
            && let Some((_, inside)) = bins.get_mut(bin as usize)
        {
            inside.push(y);
        }
    }
    bins
}
