//! The fragility of any rocking structure, from one surface that is shipped: `docs/universal.md` tells what it was made from
//! and how well it does, `scripts/universal/surface.py` is the same in Python.

use std::sync::LazyLock;

use super::measure::Measure;
use super::peaks::{JointPeaks, RatioGiven, restricted_splines};
use super::tree::{GivenRocking, Probabilities, Probability, Z_95, p_failure_given_rocking, p_no_rocking};
use crate::keyword::Keyword;
use crate::motion::{IntensityMeasures, Suite};
use crate::rocking::Structure;

/// The surface as it is shipped: knots, domain and coefficients.
pub const SURFACE: &str = include_str!("../../data/universal.csv");

static PARSED: LazyLock<Surface> = LazyLock::new(|| Surface::parse(SURFACE));

/// Functions of one coordinate: 1, itself, and the cubic splines of five knots.
const FUNCTIONS: usize = 5;
const COORDINATES: usize = 8;
type Functions = [[f64; FUNCTIONS]; COORDINATES];

/// The surface at a limit state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UniversalModel {
    /// The demand |theta|max / alpha that P_ex is about.
    pub limit: f64,
    /// The kind of motion, one of [`Suite::SYNTHETIC`]; all others count as combined ones.
    pub motions: Suite,
    /// What the limits are about.
    pub scenarios: Scenarios,
}

/// Over which magnitudes and distances a probability is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenarios {
    /// A single pair of them.
    One,
    /// Many, among which their differences average out, as over a hazard.
    Many,
}

/// A measure outside of the range of the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    pub measure: Measure,
    pub value: f64,
    /// Least and largest value in the data.
    pub range: [f64; 2],
}

/// A parameter of a structure that no structure of the surface had.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OtherStructure {
    pub parameter: &'static str,
    pub value: f64,
    /// Least and largest value among the structures of the surface.
    pub range: [f64; 2],
}

/// The logit of a probability.
#[derive(Debug, Clone, PartialEq)]
pub struct LogitIndex {
    pub value: f64,
    /// What it would be less this, from resampled structures and cells.
    deviations: Vec<f64>,
    /// Standard deviation of what the surface does not know of structures and scenarios.
    spread: f64,
}

impl LogitIndex {
    /// Its standard error: of the surface, and of the structure and scenario about it.
    pub fn standard_error(&self) -> f64 {
        let squares: f64 = self.deviations.iter().map(|deviation| deviation * deviation).sum();
        (squares / self.deviations.len() as f64 + self.spread * self.spread).sqrt()
    }

    fn probability(&self) -> Probability {
        let half_width = Z_95 * self.standard_error();
        let [value, low, high] = [self.value, self.value - half_width, self.value + half_width].map(logistic);
        Probability { value, low, high }
    }
}

impl UniversalModel {
    /// The probabilities of a structure at an intensity.
    pub fn probabilities(&self, structure: &Structure, measures: &IntensityMeasures) -> Probabilities {
        let p_nr = p_no_rocking(measures.im4);
        let given_rocking = if p_nr == 0.0 { self.given_rocking(structure, measures) } else { None };
        Probabilities { p_nr, given_rocking }
    }

    /// The logits of overturning and of exceeding the limit, given rocking; none where the ground has no velocity.
    pub fn indices(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<[LogitIndex; 2]> {
        let functions = PARSED.functions(self, structure, measures)?;
        Some(PARSED.curves.each_ref().map(|curve| curve.at(&functions, self.scenarios)))
    }

    /// The probability of overturning given rocking, without limits; none where the ground has no velocity.
    pub fn p_ro(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<f64> {
        let functions = PARSED.functions(self, structure, measures)?;
        Some(logistic(PARSED.curves[0].value(&functions)))
    }

    fn given_rocking(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<GivenRocking> {
        let [overturning, exceeding] = self.indices(structure, measures)?;
        let (p_ro, p_ex) = (overturning.probability(), exceeding.probability());
        let failure = |of: fn(&Probability) -> f64| p_failure_given_rocking(of(&p_ro), of(&p_ex));
        // What the surface does not know of a structure is taken to move both the same way.
        let p_failure =
            Probability { value: failure(|p| p.value), low: failure(|p| p.low), high: failure(|p| p.high) };
        Some(GivenRocking { p_ex, p_ro, p_failure })
    }

    /// The measures that lie outside of the motions of the surface; none without rocking.
    pub fn out_of_range(&self, measures: &IntensityMeasures) -> impl Iterator<Item = OutOfRange> {
        let rocks = p_no_rocking(measures.im4) == 0.0;
        MEASURES.into_iter().filter_map(move |measure| {
            let (value, range) = (measure.among(measures)?, PARSED.range(measure.as_str()));
            (rocks && is_outside(value, range)).then_some(OutOfRange { measure, value, range })
        })
    }

    /// What bounds the domain: the measures and the parameters of a structure, each with its least and largest value.
    pub fn coordinates(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
    ) -> Vec<(&'static str, f64, [f64; 2])> {
        let measured =
            MEASURES.into_iter().filter_map(|measure| Some((measure.as_str(), measure.among(measures)?)));
        let all =
            measured.chain(parameters(structure)).map(|(name, value)| (name, value, PARSED.range(name)));
        all.collect()
    }

    /// How PGA and PGV go together in the motions of the surface.
    pub fn peaks(&self) -> Option<JointPeaks> {
        let of = |peak: &str| {
            let name = format!("{}_{peak}", self.motions.as_str());
            let known = PARSED.peaks.iter().find(|(other, _)| *other == name)?;
            Some(RatioGiven::of_numbers(known.1))
        };
        Some(JointPeaks { given_pga: of("pga")?, given_pgv: of("pgv")? })
    }
}

/// The measures that bound the domain.
const MEASURES: [Measure; 3] = [Measure::Im4, Measure::Im3, Measure::Im5];

fn parameters(structure: &Structure) -> [(&'static str, f64); 3] {
    [("p", structure.p_rad_s), ("alpha", structure.alpha_rad), ("eta", structure.eta)]
}

/// The parameters of a structure that lie outside of those of the surface.
pub fn other_structure(structure: &Structure) -> impl Iterator<Item = OtherStructure> {
    parameters(structure).into_iter().filter_map(|(parameter, value)| {
        let range = PARSED.range(parameter);
        is_outside(value, range).then_some(OtherStructure { parameter, value, range })
    })
}

/// The least and largest limit state that the surface knows, as |theta|max / alpha.
pub fn limits() -> [f64; 2] {
    PARSED.range("limit")
}

/// By how much, relative to it, a value may pass a bound: what a print of it does not show.
const UNSEEN: f64 = 1e-5;

fn is_outside(value: f64, [least, largest]: [f64; 2]) -> bool {
    value < least * (1.0 - UNSEEN) || value > largest * (1.0 + UNSEEN)
}

fn logistic(index: f64) -> f64 {
    1.0 / (1.0 + libm::exp(-index))
}

/// The file, read.
struct Surface {
    knots: [Vec<f64>; COORDINATES],
    domain: Vec<(&'static str, [f64; 2])>,
    /// What each peak of each kind of motion says of PGV / PGA.
    peaks: Vec<(&'static str, [f64; 7])>,
    /// Of overturning and of exceeding.
    curves: [Curve; 2],
}

#[derive(Default)]
struct Curve {
    /// For one scenario, and for many.
    spread: [f64; 2],
    terms: Vec<Term>,
}

/// A product of one function of each coordinate.
struct Term {
    functions: [usize; COORDINATES],
    coefficient: f64,
    deviations: Vec<f64>,
}

impl Surface {
    /// Reads the file that is compiled in: a line that is none of its kind is a fault of the build, which tests find.
    fn parse(text: &'static str) -> Surface {
        let mut surface = Surface {
            knots: Default::default(),
            domain: Vec::new(),
            peaks: Vec::new(),
            curves: Default::default(),
        };
        let mut coordinate = 0;
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let cells: Vec<&str> = line.split(',').collect();
            let numbers: Vec<f64> = cells[2..].iter().map(|cell| cell.parse().expect(line)).collect();
            let curve = &mut surface.curves[usize::from(cells[1] == "pex")];
            match cells[0] {
                "domain" => surface.domain.push((cells[1], [numbers[0], numbers[1]])),
                "knots" => {
                    surface.knots[coordinate] = numbers;
                    coordinate += 1;
                }
                "peaks" => surface.peaks.push((cells[1], std::array::from_fn(|k| numbers[k]))),
                "spread" => curve.spread = [numbers[0], numbers[1]],
                _ => curve.terms.push(Term {
                    functions: std::array::from_fn(|k| numbers[k] as usize),
                    coefficient: numbers[COORDINATES],
                    deviations: numbers[COORDINATES + 1..].to_vec(),
                }),
            }
        }
        surface
    }

    fn range(&self, name: &str) -> [f64; 2] {
        let known = self.domain.iter().find(|(other, _)| *other == name);
        known.map_or([f64::NEG_INFINITY, f64::INFINITY], |(_, range)| *range)
    }

    fn functions(
        &self,
        model: &UniversalModel,
        structure: &Structure,
        measures: &IntensityMeasures,
    ) -> Option<Functions> {
        let is = |suite: Suite| f64::from(u8::from(model.motions == suite));
        let coordinates = [
            libm::log(libm::log(measures.im4) + 0.05),
            libm::log(Measure::Im3.among(measures)?),
            (structure.eta - 0.85) / 0.1,
            libm::log(structure.alpha_rad / 0.15),
            libm::log(structure.p_rad_s / 2.0),
            libm::log(model.limit / 0.2),
            is(Suite::Pulse),
            is(Suite::Hfc),
        ];
        Some(std::array::from_fn(|k| splines(coordinates[k], &self.knots[k])))
    }
}

impl Curve {
    /// Its terms, with the product of functions of each.
    fn products<'s>(&'s self, functions: &'s Functions) -> impl Iterator<Item = (&'s Term, f64)> {
        let product = move |term: &Term| term.functions.iter().zip(functions).map(|(&k, of)| of[k]).product();
        self.terms.iter().map(move |term| (term, product(term))).filter(|(_, product)| *product != 0.0)
    }

    fn value(&self, functions: &Functions) -> f64 {
        self.products(functions).map(|(term, product)| term.coefficient * product).sum()
    }

    fn at(&self, functions: &Functions, scenarios: Scenarios) -> LogitIndex {
        let replicates = self.terms.first().map_or(0, |term| term.deviations.len());
        let spread = self.spread[scenarios as usize];
        let mut index = LogitIndex { value: 0.0, deviations: vec![0.0; replicates], spread };
        for (term, product) in self.products(functions) {
            index.value += term.coefficient * product;
            let pairs = index.deviations.iter_mut().zip(&term.deviations);
            pairs.for_each(|(sum, deviation)| *sum += deviation * product);
        }
        index
    }
}

/// 1, the coordinate, and restricted cubic splines.
fn splines(u: f64, knots: &[f64]) -> [f64; FUNCTIONS] {
    let mut functions = [0.0; FUNCTIONS];
    (functions[0], functions[1]) = (1.0, u);
    functions[2..]
        .iter_mut()
        .zip(restricted_splines(u, knots))
        .for_each(|(function, value)| *function = value);
    functions
}
