//! One file a figure; each a function of the material to the figures that can be made of it.

mod exceedance;
mod motion;
mod outcomes;
mod overturning;
mod planes;
mod radar;
mod regressions;
mod reliability;
mod similarity;
mod tree;

use super::drawing::{Drawing, Stroke};
use super::figure::Figure;
use super::material::{Group, Material};
use super::number;
use super::panel::Panel;
use crate::fragility::{Measure, Probability};
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;

/// What draws figures.
pub type Draw = fn(&Material) -> Vec<Figure>;

/// All of them, in the order of the page, which is that of the paper.
pub const ALL: [Draw; 10] = [
    motion::figures,
    outcomes::figures,
    similarity::figures,
    tree::figures,
    regressions::figures,
    radar::figures,
    planes::figures,
    exceedance::figures,
    overturning::figures,
    reliability::figures,
];

/// No measure known.
const NOTHING: IntensityMeasures =
    IntensityMeasures { im1: None, im2: None, im3: None, im4: f64::NAN, im5: f64::NAN, im6: None };

/// With one more measure known.
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

/// Probabilities over a measure, with their limits as a band.
fn draw_curve(drawing: &mut Drawing, panel: &Panel, curve: &[(f64, Probability)], stroke: Stroke) {
    let band: Vec<[f64; 3]> = curve.iter().map(|(x, p)| [*x, p.low, p.high]).collect();
    panel.band(drawing, &band, stroke.paint.ink.thin(0.2));
    let line: Vec<[f64; 2]> = curve.iter().map(|(x, p)| [*x, p.value]).collect();
    panel.line(drawing, &line, stroke);
}

/// p, alpha and eta in words.
fn structure_words(structure: &Structure) -> String {
    format!(
        "p = {} rad/s, α = {} rad, η = {}",
        number::plain(structure.p_rad_s),
        number::plain(structure.alpha_rad),
        number::plain(structure.eta)
    )
}

/// A name that a file may have.
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
