//! One file a figure; each makes of the data the figures that they suffice for.

mod demand;
mod exceedance;
mod histories;
mod motion;
mod outcomes;
mod overturning;
mod planes;
mod radar;
mod regressions;
mod reliability;
mod similarity;
mod tree;

use super::data::{Group, ReportData};
use super::drawing::{Drawing, Stroke};
use super::figure::Figure;
use super::panel::Panel;
use super::text::number;
use crate::fragility::{Measure, Probability};
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;

/// Draws the figures of one kind that the data suffice for.
pub type Draw = fn(&ReportData) -> Vec<Figure>;

/// All kinds of figures, in the order of the page, which is that of the paper.
pub const ALL: [Draw; 12] = [
    motion::figures,
    outcomes::figures,
    demand::figures,
    histories::figures,
    similarity::figures,
    tree::figures,
    regressions::figures,
    radar::figures,
    planes::figures,
    exceedance::figures,
    overturning::figures,
    reliability::figures,
];

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
fn draw_curve(drawing: &mut Drawing, panel: &Panel, curve: &[(f64, Probability)], stroke: Stroke) {
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
    let ratio = (high / low).powf(1.0 / count as f64);
    let middle = |bin: usize| low * ratio.powf(bin as f64 + 0.5);
    let mut bins: Vec<(f64, Vec<f64>)> = (0..count).map(|bin| (middle(bin), Vec::new())).collect();
    for &[x, y] in values {
        let bin = ((x / low).ln() / ratio.ln()).floor();
        if bin >= 0.0
            && let Some((_, inside)) = bins.get_mut(bin as usize)
        {
            inside.push(y);
        }
    }
    bins
}
