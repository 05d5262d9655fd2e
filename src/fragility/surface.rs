//! The universal surface: P_ro and P_ex of any structure. data/universal.csv holds it; scripts/universal
//! makes it.

use std::sync::LazyLock;

use super::measure::Measure;
use super::peaks::{JointPeaks, RatioGiven};
use crate::keyword::{Keyword, keywords};
use crate::motion::{IntensityMeasures, Suite};
use crate::rocking::Structure;

/// Kinds of motion that the surface knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Recorded motions.
    Recorded,
    /// Combined synthetic motions on rock: pulse and high frequencies.
    Csgm,
    /// Coherent pulses alone.
    Pulse,
    /// High frequencies alone.
    Hfc,
}

keywords!(Kind { Recorded = "recorded", Csgm = "csgm", Pulse = "pulse", Hfc = "hfc" });

impl Kind {
    /// The kind of a suite of motions; those without a suite are taken for recorded ones.
    pub fn of(suite: Option<Suite>) -> Kind {
        match suite {
            Some(Suite::Pulse) => Kind::Pulse,
            Some(Suite::Csgm) => Kind::Csgm,
            Some(Suite::Hfc) => Kind::Hfc,
            Some(Suite::Record | Suite::Residual) | None => Kind::Recorded,
        }
    }

    /// The kind of a suite by its word in tables; that of an unknown word, or of none, is that of records.
    pub fn of_word(suite: Option<&str>) -> Kind {
        Kind::of(suite.and_then(|word| word.parse().ok()))
    }

    /// The column of its coefficients: recorded motions have those of high frequencies.
    fn column(self) -> usize {
        match self {
            Kind::Csgm => 0,
            Kind::Pulse => 1,
            Kind::Recorded | Kind::Hfc => 2,
        }
    }
}

/// The logit of P_ro by the surface; none where a measure is missing.
pub fn logit_overturning(kind: Kind, structure: &Structure, measures: &IntensityMeasures) -> Option<f64> {
    let features = features(structure, measures, None)?;
    Some(SURFACE.logit(Curve::Pro, kind, &features))
}

/// The logit of P_ex by the surface at a limit state |theta|max / alpha; none where a measure is missing.
pub fn logit_exceeding(
    kind: Kind,
    structure: &Structure,
    measures: &IntensityMeasures,
    limit_state: f64,
) -> Option<f64> {
    let features = features(structure, measures, Some(limit_state))?;
    Some(SURFACE.logit(Curve::Pex, kind, &features))
}

/// Returns whether a structure is within those that the surface was fitted to.
pub fn covers_structure(structure: &Structure) -> bool {
    let Structure { p_rad_s, alpha_rad, eta, .. } = *structure;
    [("p", p_rad_s), ("alpha", alpha_rad), ("eta", eta)].iter().all(|(name, value)| is_inside(name, *value))
}

/// Returns whether the measures of a motion, and a limit state, are within those that the surface was fitted
/// to.
pub fn covers_motion(measures: &IntensityMeasures, limit_state: f64) -> bool {
    let is_known =
        |measure: &Measure| measure.value_of(measures).is_none_or(|value| is_inside(measure.as_str(), value));
    [Measure::Im4, Measure::Im3, Measure::Im5].iter().all(is_known) && is_inside("limit", limit_state)
}

/// The relative amount by which a value may pass a bound, as rounding in print does.
const UNSEEN: f64 = 1e-5;

fn is_inside(name: &str, value: f64) -> bool {
    let bounds = SURFACE.domain.iter().find(|(other, _)| *other == name);
    bounds.is_none_or(|(_, [low, high])| (low * (1.0 - UNSEEN)..=high * (1.0 + UNSEEN)).contains(&value))
}

/// The probabilities of the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Curve {
    Pro,
    Pex,
}

/// How the calibrations of structures under a kind of motion are distributed: c and ln s are normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prior {
    pub c: f64,
    pub ln_s: f64,
    pub sd_c: f64,
    pub sd_ln_s: f64,
    /// Standard deviation of the logit between cells or earthquakes.
    pub tau: f64,
}

/// The prior of a kind of motion.
pub(super) fn prior(kind: Kind, curve: Curve) -> Prior {
    let is_same = |(of, other, _): &&(Kind, Curve, Prior)| *of == kind && *other == curve;
    SURFACE.priors.iter().find(is_same).expect("each kind has a calibration").2
}

/// How PGA and PGV go together in the motions of a kind.
pub(super) fn peaks(kind: Kind) -> JointPeaks {
    let of = |peak: &str| {
        let is_same = |(of, other, _): &&(Kind, &str, RatioGiven)| *of == kind && *other == peak;
        SURFACE.peaks.iter().find(is_same).expect("each kind has peaks").2
    };
    JointPeaks { given_pga: of("pga"), given_pgv: of("pgv") }
}

/// No motion is stronger; from some 2000 on the cubes would let the probability fall.
const MOST_IM5: f64 = 100.0;

const FEATURES: [&str; 6] = ["x", "w", "r", "eta", "p", "limit"];

/// Computes x = ln(ln IM4 + 0.2), w = ln IM5 - 0.4 l, r = ln IM3, (eta - 0.85)/0.1, ln(p/2) and l = ln(c/0.2)
/// of a limit state c, 0 of P_ro. None where the ground has no velocity.
fn features(
    structure: &Structure,
    measures: &IntensityMeasures,
    limit_state: Option<f64>,
) -> Option<[f64; FEATURES.len()]> {
    let limit = limit_state.map_or(0.0, |limit_state| (limit_state / 0.2).ln());
    Some([
        (measures.im4.max(1.0).ln() + 0.2).ln(),
        Measure::Im5.value_of(measures)?.min(MOST_IM5).ln() - 0.4 * limit,
        Measure::Im3.value_of(measures)?.ln(),
        (structure.eta - 0.85) / 0.1,
        (structure.p_rad_s / 2.0).ln(),
        limit,
    ])
}

/// The file, read.
struct Surface {
    domain: Vec<(&'static str, [f64; 2])>,
    terms: Vec<Term>,
    priors: Vec<(Kind, Curve, Prior)>,
    peaks: Vec<(Kind, &'static str, RatioGiven)>,
}

/// A product of powers of features.
struct Term {
    curve: Curve,
    /// Feature and power of each.
    factors: Vec<(usize, i32)>,
    /// For combined motions, pulses and high frequencies.
    coefficients: [f64; 3],
}

static SURFACE: LazyLock<Surface> =
    LazyLock::new(|| Surface::parse(include_str!("../../data/universal.csv")));

impl Surface {
    /// Reads the file that is compiled in: a line that is none of its kind is a fault of the build, which
    /// tests find.
    fn parse(text: &'static str) -> Surface {
        let mut surface = Surface { domain: vec![], terms: vec![], priors: vec![], peaks: vec![] };
        for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |place: usize| cells[place].parse::<f64>().expect(line);
            let kind = || cells[1].parse::<Kind>().expect(line);
            let curve = |place: usize| if cells[place] == "pro" { Curve::Pro } else { Curve::Pex };
            match cells[0] {
                "domain" => surface.domain.push((cells[1], [number(2), number(3)])),
                "calibration" => {
                    let [c, ln_s, sd_c, sd_ln_s, tau] = [3, 4, 5, 6, 7].map(number);
                    surface.priors.push((kind(), curve(2), Prior { c, ln_s, sd_c, sd_ln_s, tau }));
                }
                "peaks" => {
                    let numbers = [3, 4, 5, 6, 7, 8].map(number);
                    surface.peaks.push((kind(), cells[2], RatioGiven::of_numbers(&numbers).expect(line)));
                }
                _ => surface.terms.push(Term {
                    curve: curve(1),
                    factors: factors(cells[2]),
                    coefficients: [3, 4, 5].map(number),
                }),
            }
        }
        surface
    }

    fn logit(&self, curve: Curve, kind: Kind, features: &[f64; FEATURES.len()]) -> f64 {
        let product = |term: &Term| {
            term.factors.iter().map(|&(feature, power)| features[feature].powi(power)).product::<f64>()
        };
        let terms = self.terms.iter().filter(|term| term.curve == curve);
        terms.map(|term| term.coefficients[kind.column()] * product(term)).sum()
    }
}

/// Reads a product such as `x*w^2`; 1 is the empty one.
fn factors(product: &str) -> Vec<(usize, i32)> {
    let factor = |factor: &str| {
        let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
        let place = FEATURES.iter().position(|feature| *feature == name).expect(product);
        (place, power.parse().expect(product))
    };
    product.split('*').filter(|name| *name != "1").map(factor).collect()
}
