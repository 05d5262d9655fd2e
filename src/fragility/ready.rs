//! An object ready for many motions: what does not depend on the motion is computed once, what depends on PGA
//! alone once for all motions of that PGA.

use super::calibration::{Branch, Level, Scenarios, logistic};
use super::demand::DemandFit;
use super::measure::Measure;
use super::model::{CONFIDENCE, Direction, Model, paper_probabilities};
use super::on_floor::{FloorMotions, OnFloor};
use super::overturning::CurveFit;
use super::surface::Cut;
use super::tree::{GivenRocking, LimitStates, Probabilities, UNKNOWN, p_failure_given_rocking, p_no_rocking};
use crate::motion::{Floor, IntensityMeasures, Peaks};
use crate::rocking::Structure;
use crate::statistics::Estimate;

impl Model {
    /// The probabilities of the tree at an intensity (Eq. 12). A magnitude that is not known is estimated by
    /// PGV / PGA.
    pub fn probabilities(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
        mw: Option<f64>,
        scenarios: Scenarios,
    ) -> Probabilities {
        let direction = ReadyDirection::new(structure, self, mw);
        let (ready, im5) = (direction.at(measures.im4), Measure::Im5.value_of(measures));
        let ln_seconds = im5.map(|im5| (im5 / (measures.im4 * structure.p_rad_s)).ln());
        match &direction.by {
            By::Ground(branches) => Probabilities::new(measures.im4, || {
                let p = |k: usize| {
                    let (cuts, ln_seconds) = (ready.cuts?, ln_seconds?);
                    let at = |level| given_rocking(branches, &cuts, ln_seconds, level)[k];
                    Some(Level::all(scenarios, at))
                };
                let (p_ro, p_ex) = (p(0)?, p(1)?);
                // What is not known of a structure moves both branches the same way.
                Some(GivenRocking { p_ex, p_ro, p_failure: p_ro.zip(p_ex, p_failure_given_rocking) })
            }),
            By::Floor(..) => {
                let ln_seconds = ln_seconds.unwrap_or(f64::NEG_INFINITY);
                let at = |level| ready.limit_states(ln_seconds, &mut None, level);
                let states = Level::limit_states(scenarios, at);
                let rocking = states.rocking.value;
                let [p_failure, p_ro] =
                    [states.failure, states.overturning].map(|state| state.map(|p| p / rocking));
                let p_ex = p_failure.zip(p_ro, |failure, overturning| {
                    ((failure - overturning) / (1.0 - overturning)).max(0.0)
                });
                let is_known = rocking > 0.0 && ln_seconds.is_finite();
                let given_rocking = is_known.then_some(GivenRocking { p_ex, p_ro, p_failure });
                Probabilities { p_nr: 1.0 - rocking, given_rocking }
            }
            By::Paper { demand, overturning, limit_state } => {
                paper_probabilities(demand, overturning, measures, *limit_state, CONFIDENCE)
            }
        }
    }
}

/// P_ro and P_ex of motions of the ground with this ln(PGV / PGA), s.
fn given_rocking(branches: &[Branch; 2], cuts: &[Cut; 2], ln_seconds: f64, level: Level) -> [f64; 2] {
    [0, 1].map(|k| {
        let magnitude = branches[k].magnitude(ln_seconds);
        logistic(branches[k].logit(&cuts[k], ln_seconds, magnitude, level))
    })
}

/// A structure and the model that predicts for it, ready for motions of one magnitude.
pub(super) struct ReadyDirection<'a> {
    structure: &'a Structure,
    uplift_m_s2: f64,
    by: By<'a>,
}

/// What predicts: P_ro and P_ex of the calibrated surface, or the paper's fits.
#[expect(clippy::large_enum_variant, reason = "one is made for each direction of an object")]
enum By<'a> {
    Ground([Branch<'a>; 2]),
    Floor([Branch<'a>; 2], OnFloor),
    Paper { demand: &'a [DemandFit], overturning: &'a CurveFit, limit_state: f64 },
}

impl<'a> ReadyDirection<'a> {
    pub fn new(structure: &'a Structure, model: &'a Model, mw: Option<f64>) -> ReadyDirection<'a> {
        let by = match model {
            Model::Calibrated { overturning, exceeding, floor } => {
                let branches = [overturning, exceeding].map(|of| of.branch(structure, mw));
                let limit_state = exceeding.limit_state.unwrap_or(f64::NAN);
                match floor {
                    Some(floor) => By::Floor(branches, OnFloor::new(*floor, structure, limit_state)),
                    None => By::Ground(branches),
                }
            }
            Model::Paper { demand, overturning, limit_state, .. } => {
                By::Paper { demand, overturning, limit_state: *limit_state }
            }
        };
        ReadyDirection { structure, uplift_m_s2: structure.uplift_acceleration_m_s2(), by }
    }

    /// Returns it under motions of the ground with this IM4.
    fn at(&self, im4: f64) -> DirectionAtPga<'_> {
        let ln_im4 = im4.ln();
        let cuts = match &self.by {
            By::Ground(branches) if p_no_rocking(im4) == 0.0 => {
                Some([0, 1].map(|k| branches[k].at(im4, ln_im4)))
            }
            _ => None,
        };
        DirectionAtPga { direction: self, im4, ln_im4, cuts }
    }
}

/// A direction under motions of one PGA of the ground.
struct DirectionAtPga<'a> {
    direction: &'a ReadyDirection<'a>,
    im4: f64,
    ln_im4: f64,
    /// P_ro and P_ex on the ground, if it is uplifted.
    cuts: Option<[Cut; 2]>,
}

impl DirectionAtPga<'_> {
    /// The probabilities under motions with this ln(PGV / PGA), s; those of a floor are computed once for all
    /// directions.
    fn limit_states(
        &self,
        ln_seconds: f64,
        of_floor: &mut Option<(Floor, FloorMotions)>,
        level: Level,
    ) -> LimitStates<f64> {
        match &self.direction.by {
            By::Ground(branches) => match &self.cuts {
                None => LimitStates::all(0.0),
                Some(cuts) => {
                    let [p_ro, p_ex] = given_rocking(branches, cuts, ln_seconds, level);
                    let failure = p_failure_given_rocking(p_ro, p_ex);
                    LimitStates { rocking: 1.0, failure, overturning: p_ro }
                }
            },
            By::Floor(branches, on) => {
                let same = of_floor.filter(|(floor, _)| *floor == on.floor);
                let (_, motions) = same.unwrap_or_else(|| (on.floor, on.motions(ln_seconds)));
                *of_floor = Some((on.floor, motions));
                let magnitudes = [0, 1].map(|k| branches[k].magnitude(ln_seconds));
                let added = on.added(&motions);
                let (mut failure, mut overturning) = (0.0, 0.0);
                for node in &motions.nodes {
                    let im4 = self.im4 * node.pfa;
                    if im4 < 1.0 {
                        continue;
                    }
                    let [p_ro, p_ex] = [0, 1].map(|k| {
                        let cut = branches[k].at(im4, self.ln_im4 + node.ln_pfa);
                        let logit = branches[k].logit(&cut, node.ln_seconds, magnitudes[k], level);
                        logistic(logit + added[k])
                    });
                    failure += node.weight * p_failure_given_rocking(p_ro, p_ex);
                    overturning += node.weight * p_ro;
                }
                let rocking = motions.p_rocking(self.ln_im4);
                LimitStates { rocking, failure: failure.min(rocking), overturning: overturning.min(rocking) }
            }
            By::Paper { demand, overturning, limit_state } => {
                let pga_m_s2 = self.im4 * self.direction.uplift_m_s2;
                let peaks = Peaks { pga_m_s2, pgv_m_s: pga_m_s2 * ln_seconds.exp() };
                let measures = IntensityMeasures::new(self.direction.structure, peaks, None, None);
                let of = paper_probabilities(demand, overturning, &measures, *limit_state, CONFIDENCE);
                let rocking = Estimate::exact(1.0 - of.p_nr);
                let unknown = LimitStates { rocking, failure: UNKNOWN, overturning: UNKNOWN };
                of.limit_states().unwrap_or(unknown).map(|state| level.of(state))
            }
        }
    }
}

/// An object in its directions, ready for motions of one magnitude.
pub(crate) struct ReadyObject<'a> {
    directions: Vec<ReadyDirection<'a>>,
    pub mw: Option<f64>,
}

impl<'a> ReadyObject<'a> {
    pub fn new(directions: &'a [Direction], mw: Option<f64>) -> ReadyObject<'a> {
        let ready = |Direction { structure, model }: &'a Direction| ReadyDirection::new(structure, model, mw);
        ReadyObject { directions: directions.iter().map(ready).collect(), mw }
    }

    /// Returns it under motions of a PGA, m/s2.
    pub fn at(&self, pga_m_s2: f64) -> ObjectAtPga<'_> {
        ObjectAtPga(self.directions.iter().map(|of| of.at(pga_m_s2 / of.uplift_m_s2)).collect())
    }

    /// Returns the probabilities of the limit states under motions with these peaks.
    pub fn limit_states(&self, peaks: Peaks, level: Level) -> LimitStates<f64> {
        self.at(peaks.pga_m_s2).limit_states((peaks.pgv_m_s / peaks.pga_m_s2).ln(), level)
    }
}

/// An object under motions of one PGA.
pub(crate) struct ObjectAtPga<'a>(Vec<DirectionAtPga<'a>>);

impl ObjectAtPga<'_> {
    /// Probabilities of the limit states under motions with this ln(PGV / PGA), s: in either of its
    /// directions, which fall independently under one motion. NaN where a model has none.
    pub fn limit_states(&self, ln_seconds: f64, level: Level) -> LimitStates<f64> {
        let mut of_floor = None;
        let mut all = LimitStates::all(0.0);
        for direction in &self.0 {
            let one = direction.limit_states(ln_seconds, &mut of_floor, level);
            all = all.zip(one, |a, b| a + b - a * b);
        }
        match ln_seconds.is_finite() || all.rocking == 0.0 {
            true => all,
            false => LimitStates { rocking: all.rocking, ..LimitStates::all(f64::NAN) },
        }
    }
}
