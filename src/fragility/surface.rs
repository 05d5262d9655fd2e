//! The universal surface: P_ro and P_ex of any structure. data/universal.csv holds it; scripts/universal
//! makes it.

use std::sync::LazyLock;

use super::measure::Measure;
use super::peaks::{JointPeaks, RatioGiven};
use crate::keyword::{Keyword, keywords};
use crate::motion::{IntensityMeasures, Suite};
use crate::rocking::Structure;

keywords! {
    /// Kinds of motion that the surface knows.
    pub enum Kind {
        /// Recorded motions.
        Recorded = "recorded",
        /// Combined synthetic motions on rock: pulse and high frequencies.
        Csgm = "csgm",
        /// Coherent pulses alone.
        Pulse = "pulse",
        /// High frequencies alone.
        Hfc = "hfc",
    }
}

impl Kind {
    /// The kind of a suite by its word in tables, on the ground or a floor; that of an unknown word, or of
    /// none, is that of records.
    pub fn of_word(suite: Option<&str>) -> Kind {
        match suite.and_then(|word| word.trim_end_matches(Suite::OF_FLOOR).parse().ok()) {
            Some(Suite::Pulse) => Kind::Pulse,
            Some(Suite::Csgm) => Kind::Csgm,
            Some(Suite::Hfc) => Kind::Hfc,
            Some(Suite::Record) | None => Kind::Recorded,
        }
    }
}

/// The logit of the surface and its terms for one case, to be calibrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predictor {
    /// L, the logit of the surface.
    pub logit: f64,
    /// M - 6.9, M within the magnitudes of the kind of motion; where M is not known, that which PGV / PGA
    /// tells.
    pub magnitude: f64,
    /// The same in the middle of these magnitudes.
    pub middle: f64,
    /// Standard deviation of M where it is not known, else 0.
    pub magnitude_sd: f64,
    /// What the calibrated logit gains: -(d / ((IM4 - 1) IM5^k))^n, minus infinity at uplift.
    pub added: f64,
}

/// Computes the predictor of P_ro, or of P_ex at a limit state |theta|max / alpha, under a motion of
/// magnitude `mw`, where it is known; none where a measure is missing.
pub fn predictor(
    kind: Kind,
    structure: &Structure,
    measures: &IntensityMeasures,
    mw: Option<f64>,
    limit_state: Option<f64>,
) -> Option<Predictor> {
    let im5 = Measure::Im5.value_of(measures)?;
    let curve = SURFACE.curve(kind, limit_state);
    let expected = &SURFACE.kinds[kind as usize].magnitude;
    let [low, high] = expected.range;
    let seconds = im5 / (measures.im4 * structure.p_rad_s);
    let mean = || expected.intercept + expected.slope * seconds.ln();
    Some(Predictor {
        logit: curve.logit(&features(structure, measures, im5, limit_state)),
        magnitude: mw.unwrap_or_else(mean).clamp(low, high) - REFERENCE_MAGNITUDE,
        middle: 0.5 * (low + high) - REFERENCE_MAGNITUDE,
        magnitude_sd: if mw.is_some() { 0.0 } else { expected.sd },
        added: curve.uplift.gain(measures.im4, im5),
    })
}

/// Returns whether a structure is within those that the surface was fitted to.
pub fn covers_structure(structure: &Structure) -> bool {
    let Structure { p_rad_s, alpha_rad, eta, .. } = *structure;
    [("p", p_rad_s), ("alpha", alpha_rad), ("eta", eta)].iter().all(|(name, value)| is_inside(name, *value))
}

/// Returns whether the measures of a motion, and a limit state, are within those that the surface was fitted
/// to.
pub fn covers_motion(structure: &Structure, measures: &IntensityMeasures, limit_state: f64) -> bool {
    let ratio = structure.p_rad_s * measures.im4 / measures.im5;
    [("im4", measures.im4), ("im5", measures.im5), ("ratio", ratio), ("limit", limit_state)]
        .iter()
        .all(|(name, value)| is_inside(name, *value))
}

/// The relative amount by which a value may pass a bound, as rounding in print does.
const UNSEEN: f64 = 1e-5;

fn is_inside(name: &str, value: f64) -> bool {
    let [low, high] = SURFACE.range(name);
    (low * (1.0 - UNSEEN)..=high * (1.0 + UNSEEN)).contains(&value)
}

/// How the calibrations of structures under a kind of motion are distributed: c, ln s and m are normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prior {
    pub mean: [f64; 3],
    pub sd: [f64; 3],
    /// Standard deviation of the logit between cells or earthquakes.
    pub tau: f64,
    /// By how much c rises with [`limits`]' second.
    by_limit: f64,
}

/// The prior of a kind of motion, of P_ex at a limit state.
pub(super) fn prior(kind: Kind, limit_state: Option<f64>) -> Prior {
    let mut prior = SURFACE.curve(kind, limit_state).prior;
    prior.mean[0] += prior.by_limit * limits(limit_state)[1];
    prior
}

/// How PGA and PGV go together in the motions of a kind.
pub(super) fn peaks(kind: Kind) -> JointPeaks {
    SURFACE.kinds[kind as usize].peaks
}

/// At this magnitude m does not count.
const REFERENCE_MAGNITUDE: f64 = 6.9;

const FEATURES: [&str; 7] = ["x", "w", "r", "eta", "p", "limit", "end"];

/// Of a limit state c, held within the domain, ln(c/0.2), and ln(1.1 - c), which falls steeply where nothing
/// is left below overturning; 0 of P_ro.
fn limits(limit_state: Option<f64>) -> [f64; 2] {
    limit_state.map_or([0.0; 2], |limit_state| {
        let held = held("limit", limit_state);
        [(held / 0.2).ln(), (1.1 - held).ln()]
    })
}

fn held(name: &str, value: f64) -> f64 {
    let [low, high] = SURFACE.range(name);
    value.clamp(low, high)
}

/// Computes x = ln(ln IM4 + 0.2), w = ln IM4 - r - 0.4 l, r = ln(PGA / (p PGV)), (eta - 0.85)/0.1, ln(p/2)
/// and l = ln(c/0.2) of a limit state c, 0 of P_ro. PGA/PGV, p, eta and c are held within the domain, IM4
/// below its end: beyond, a polynomial means nothing.
fn features(
    structure: &Structure,
    measures: &IntensityMeasures,
    im5: f64,
    limit_state: Option<f64>,
) -> [f64; FEATURES.len()] {
    let [limit, end] = limits(limit_state);
    let (p, ln_im4) = (held("p", structure.p_rad_s), held("im4", measures.im4).ln());
    let r = (held("ratio", structure.p_rad_s * measures.im4 / im5) / p).ln();
    let eta = (held("eta", structure.eta) - 0.85) / 0.1;
    [(ln_im4 + 0.2).ln(), ln_im4 - r - 0.4 * limit, r, eta, (p / 2.0).ln(), limit, end]
}

/// The file, read.
struct Surface {
    domain: Vec<(&'static str, [f64; 2])>,
    /// Of each kind of motion.
    kinds: [OfKind; 4],
}

/// What the file says of a kind of motion.
struct OfKind {
    magnitude: ExpectedMagnitude,
    /// P_ro and P_ex.
    curves: [Curve; 2],
    peaks: JointPeaks,
}

/// A probability under a kind of motion.
struct Curve {
    terms: Vec<Term>,
    uplift: Uplift,
    prior: Prior,
}

/// The magnitude of motions, normal about intercept + slope ln(PGV / PGA), s, and the range of the data.
struct ExpectedMagnitude {
    intercept: f64,
    slope: f64,
    sd: f64,
    range: [f64; 2],
}

/// How fast a probability rises from uplift on.
struct Uplift {
    n: f64,
    d: f64,
    k: f64,
}

impl Uplift {
    /// Computes -(d / ((IM4 - 1) IM5^k))^n.
    fn gain(&self, im4: f64, im5: f64) -> f64 {
        -(self.d / ((im4 - 1.0).max(0.0) * im5.powf(self.k))).powf(self.n)
    }
}

/// A product of powers of features.
struct Term {
    coefficient: f64,
    /// Feature and power of each.
    factors: Vec<(usize, i32)>,
}

impl Curve {
    fn logit(&self, features: &[f64; FEATURES.len()]) -> f64 {
        let product = |term: &Term| {
            term.factors.iter().map(|&(feature, power)| features[feature].powi(power)).product::<f64>()
        };
        self.terms.iter().map(|term| term.coefficient * product(term)).sum()
    }
}

static SURFACE: LazyLock<Surface> =
    LazyLock::new(|| Surface::parse(include_str!("../../data/universal.csv")));

impl Surface {
    /// P_ex has a limit state, P_ro has none.
    fn curve(&self, kind: Kind, limit_state: Option<f64>) -> &Curve {
        &self.kinds[kind as usize].curves[usize::from(limit_state.is_some())]
    }

    fn range(&self, name: &str) -> [f64; 2] {
        self.domain.iter().find(|(other, _)| *other == name).expect("the domain has it").1
    }

    /// Reads the file that is compiled in: a line that is none of its kind is a fault of the build, which
    /// tests find.
    fn parse(text: &'static str) -> Surface {
        let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
        let of_domain = rows.iter().filter(|row| row[0] == "domain");
        Surface {
            domain: of_domain.map(|row| (row[1], numbers(&rows, &row[..2]))).collect(),
            kinds: [Kind::Recorded, Kind::Csgm, Kind::Pulse, Kind::Hfc]
                .map(|kind| OfKind::parse(&rows, kind)),
        }
    }
}

impl OfKind {
    fn parse(rows: &[Vec<&str>], kind: Kind) -> OfKind {
        let word = kind.as_str();
        let [intercept, slope, sd, low, high] = numbers(rows, &["magnitude", word]);
        let term = |row: &Vec<&str>| Term {
            coefficient: row[3 + kind as usize].parse().expect("a number"),
            factors: factors(row[2]),
        };
        let curve = |name: &str| {
            let [n, d, k] = numbers(rows, &["uplift", word, name]);
            let [c, ln_s, m, sd_c, sd_ln_s, sd_m, tau, by_limit] =
                numbers(rows, &["calibration", word, name]);
            Curve {
                terms: rows.iter().filter(|row| row.starts_with(&["term", name])).map(term).collect(),
                uplift: Uplift { n, d, k },
                prior: Prior { mean: [c, ln_s, m], sd: [sd_c, sd_ln_s, sd_m], tau, by_limit },
            }
        };
        let ratio_given = |peak: &str| {
            RatioGiven::of_numbers(&numbers::<6>(rows, &["peaks", word, peak])).expect("six numbers")
        };
        OfKind {
            magnitude: ExpectedMagnitude { intercept, slope, sd, range: [low, high] },
            curves: ["pro", "pex"].map(curve),
            peaks: JointPeaks { given_pga: ratio_given("pga"), given_pgv: ratio_given("pgv") },
        }
    }
}

/// The numbers of the row that begins with these words.
fn numbers<const N: usize>(rows: &[Vec<&str>], words: &[&str]) -> [f64; N] {
    let row = rows.iter().find(|row| row.starts_with(words)).expect("the file has it");
    std::array::from_fn(|k| row[words.len() + k].parse().expect("a number"))
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
