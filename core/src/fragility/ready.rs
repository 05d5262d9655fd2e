//! The probabilities of an object in three stages, since a rate needs them for thousands of pairs of peaks:
//!
//! 1. [`ReadyObject`], once: the surface at this structure, limit state and magnitude, a polynomial in x, w
//!    and r, and the errors of its calibration.
//! 2. [`ObjectAtPga`], for each PGA: the surface at this IM4, which leaves a cubic in ln(PGA / PGV).
//! 3. For each PGV / PGA: the cubic and g, and one logistic function for each level. On a floor the second
//!    stage is repeated here, for each of the seven nodes of its peaks.

use super::calibration::{Branch, Predictor};
use super::level::{QuantileLevel, Scenarios};
use super::model::{CONFIDENCE, Model, RockingDirection, paper_probabilities};
use super::on_floor::{FloorMotionDistribution, OnFloor};
use super::surface::{Im4Terms, SurfaceAtIm4};
use super::tree::{GivenRocking, LimitStates, Probabilities, p_failure_given_rocking};
use crate::motion::{IntensityMeasures, Peaks};
use crate::rocking::Structure;
use crate::statistics::Interval;

impl Model {
    /// The tree (Eq. 12). A magnitude that is not known is inferred from PGV / PGA.
    pub fn probabilities(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
        mw: Option<f64>,
        scenarios: Scenarios,
    ) -> Probabilities {
        match self {
            Model::Calibrated { overturning, exceeding, floor: None } => {
                Probabilities::new(measures.im4, || {
                    let p_ro = overturning.probability(structure, measures, mw, scenarios)?;
                    let p_ex = exceeding.probability(structure, measures, mw, scenarios)?;
                    // Errors of both have the same causes, so that their limits are joined in pairs.
                    let p_failure = p_ro.zip(p_ex, p_failure_given_rocking);
                    Some(GivenRocking { p_ex: Some(p_ex), p_ro, p_failure: Some(p_failure) })
                })
            }
            Model::Calibrated { floor: Some(_), .. } => {
                let Peaks { pga_m_s2, pgv_m_s } = measures.peaks(structure);
                let ln_seconds = if pgv_m_s > 0.0 { (pgv_m_s / pga_m_s2).ln() } else { f64::NEG_INFINITY };
                let mut states = [LimitStates::all(Some(0.0)); 3];
                let direction = ReadyDirection::new(structure, self, mw);
                direction.at(pga_m_s2).combine_into(
                    ln_seconds,
                    &mut None,
                    &QuantileLevel::with_limits(scenarios),
                    &mut states,
                );
                Probabilities::on_floor(LimitStates::from_levels(&states))
            }
            Model::Paper { demand, overturning, limit_state, .. } => {
                paper_probabilities(demand, overturning, measures, *limit_state, CONFIDENCE)
            }
        }
    }
}

impl Probabilities {
    /// From the whole tree to given rocking, which a floor may or may not cause.
    fn on_floor(states: LimitStates<Option<Interval>>) -> Probabilities {
        let rocking = states.rocking.map_or(0.0, |p| p.value);
        let known = states.failure.zip(states.overturning).filter(|_| rocking > 0.0);
        let given_rocking = known.map(|(failure, overturning)| {
            let [p_failure, p_ro] = [failure, overturning].map(|state| state.map(|p| p / rocking));
            let p_ex = p_failure
                .zip(p_ro, |failure, overturning| ((failure - overturning) / (1.0 - overturning)).max(0.0));
            GivenRocking { p_ex: Some(p_ex), p_ro, p_failure: Some(p_failure) }
        });
        Probabilities { p_nr: 1.0 - rocking, given_rocking }
    }
}

/// First stage: a structure under motions of one magnitude.
struct ReadyDirection<'a> {
    structure: &'a Structure,
    uplift_m_s2: f64,
    by: ReadyModel<'a>,
}

/// P_ro and P_ex of the calibrated surface, or the paper's fits with each of their errors at its quantiles.
#[expect(clippy::large_enum_variant, reason = "one is made for each direction of an object")]
enum ReadyModel<'a> {
    Ground([Branch<'a>; 2]),
    Floor([Branch<'a>; 2], OnFloor),
    Paper(&'a Model, Vec<[Model; 2]>),
}

impl<'a> ReadyDirection<'a> {
    fn new(structure: &'a Structure, model: &'a Model, mw: Option<f64>) -> ReadyDirection<'a> {
        let by = match model {
            Model::Calibrated { overturning, exceeding, floor } => {
                let branches = [overturning, exceeding].map(|calibration| calibration.branch(structure, mw));
                match floor {
                    Some(floor) => {
                        ReadyModel::Floor(branches, OnFloor::new(*floor, structure, exceeding.limit_state))
                    }
                    None => ReadyModel::Ground(branches),
                }
            }
            Model::Paper { .. } => ReadyModel::Paper(model, model.ends()),
        };
        ReadyDirection { structure, uplift_m_s2: structure.uplift_acceleration_m_s2(), by }
    }

    fn at(&self, pga_m_s2: f64) -> DirectionAtPga<'_> {
        let im4 = pga_m_s2 / self.uplift_m_s2;
        let ln_im4 = im4.ln();
        match &self.by {
            ReadyModel::Ground(branches) if im4 >= 1.0 => {
                let at = Im4Terms::new(im4, ln_im4);
                let at_im4 = branches.each_ref().map(|branch| branch.surface.at(&at));
                DirectionAtPga::Ground(branches, at_im4)
            }
            ReadyModel::Ground(_) => DirectionAtPga::Still,
            ReadyModel::Floor(branches, on_floor) => {
                DirectionAtPga::Floor { branches, on_floor, im4, ln_im4 }
            }
            ReadyModel::Paper(model, ends) => {
                DirectionAtPga::Paper { model, ends, structure: self.structure, pga_m_s2 }
            }
        }
    }
}

/// Second stage: a direction under motions of one PGA of the ground.
enum DirectionAtPga<'a> {
    Still,
    Ground(&'a [Branch<'a>; 2], [SurfaceAtIm4; 2]),
    Floor { branches: &'a [Branch<'a>; 2], on_floor: &'a OnFloor, im4: f64, ln_im4: f64 },
    Paper { model: &'a Model, ends: &'a [[Model; 2]], structure: &'a Structure, pga_m_s2: f64 },
}

impl DirectionAtPga<'_> {
    /// Third stage: joins the probabilities at each level under motions with this ln(PGV / PGA), s, to those
    /// of other directions: an object falls in either, independently under one motion. `motions` are those of
    /// the floor, the same for all directions: the first that needs them computes them.
    fn combine_into(
        &self,
        ln_seconds: f64,
        motions: &mut Option<FloorMotionDistribution>,
        levels: &[QuantileLevel],
        joined: &mut [LimitStates<Option<f64>>],
    ) {
        let levels = joined.iter_mut().zip(levels);
        match self {
            DirectionAtPga::Still => {}
            DirectionAtPga::Ground(branches, at_im4) => {
                let predictors = [0, 1].map(|k| {
                    let (branch, at_im4) = (&branches[k], &at_im4[k]);
                    branch.predictor(at_im4, ln_seconds, branch.surface.magnitude(ln_seconds + at_im4.excess))
                });
                for (joined, level) in levels {
                    let [p_ro, p_ex] = [0, 1].map(|k| branches[k].probability(&predictors[k], *level));
                    let failure = p_failure_given_rocking(p_ro, p_ex);
                    let states = LimitStates { rocking: 1.0, failure, overturning: p_ro };
                    *joined = joined.or(states.known(ln_seconds));
                }
            }
            DirectionAtPga::Floor { branches, on_floor, im4, ln_im4 } => {
                let motions = motions.get_or_insert_with(|| on_floor.motions(ln_seconds));
                let (added, rocking) = (on_floor.added(motions), motions.p_rocking(*ln_im4));
                let magnitudes = branches.each_ref().map(|branch| branch.surface.magnitude(ln_seconds));
                let rocks = motions.nodes.iter().filter(|node| im4 * node.pfa >= 1.0).map(|node| {
                    let at = Im4Terms::new(im4 * node.pfa, ln_im4 + node.ln_pfa);
                    let predictors = [0, 1].map(|k| {
                        let at_im4 = branches[k].surface.at(&at);
                        let predictor = branches[k].predictor(&at_im4, node.ln_seconds, magnitudes[k]);
                        Predictor { added: predictor.added + added[k], ..predictor }
                    });
                    (node.weight, predictors)
                });
                let rocks: Vec<(f64, [Predictor; 2])> = rocks.collect();
                for (joined, level) in levels {
                    let (mut failure, mut overturning) = (0.0, 0.0);
                    for (weight, predictors) in &rocks {
                        let [p_ro, p_ex] = [0, 1].map(|k| branches[k].probability(&predictors[k], *level));
                        failure += weight * p_failure_given_rocking(p_ro, p_ex);
                        overturning += weight * p_ro;
                    }
                    let [failure, overturning] = [failure, overturning].map(|p: f64| p.min(rocking));
                    *joined = joined.or(LimitStates { rocking, failure, overturning }.known(ln_seconds));
                }
            }
            DirectionAtPga::Paper { model, ends, structure, pga_m_s2 } => {
                let peaks = Peaks { pga_m_s2: *pga_m_s2, pgv_m_s: pga_m_s2 * ln_seconds.exp() };
                let measures = IntensityMeasures::new(structure, peaks, None, None);
                for (joined, level) in levels {
                    let model = match *level {
                        QuantileLevel::Error { number, is_high } => &ends[number][usize::from(is_high)],
                        _ => *model,
                    };
                    let tree = model.probabilities(structure, &measures, None, Scenarios::Many);
                    *joined = joined.or(tree.limit_states().map(|p| {
                        p.map(|p| match level {
                            QuantileLevel::Low(_) => p.low,
                            QuantileLevel::High(_) => p.high,
                            QuantileLevel::Estimate | QuantileLevel::Error { .. } => p.value,
                        })
                    }));
                }
            }
        }
    }
}

impl QuantileLevel {
    /// The estimate, then each error of the models at both quantiles: the same error moves all directions.
    pub fn with_errors(directions: &[RockingDirection]) -> Vec<QuantileLevel> {
        let fewest = directions.iter().map(|direction| direction.model.ends().len()).min().unwrap_or(0);
        let errors = (0..fewest)
            .flat_map(|number| [false, true].map(|is_high| QuantileLevel::Error { number, is_high }));
        [QuantileLevel::Estimate].into_iter().chain(errors).collect()
    }
}

/// The first two stages for all directions of an object.
pub(crate) struct ReadyObject<'a> {
    directions: Vec<ReadyDirection<'a>>,
    pub mw: Option<f64>,
}

impl<'a> ReadyObject<'a> {
    pub fn new(directions: &'a [RockingDirection], mw: Option<f64>) -> ReadyObject<'a> {
        let ready =
            |direction: &'a RockingDirection| ReadyDirection::new(&direction.structure, &direction.model, mw);
        ReadyObject { directions: directions.iter().map(ready).collect(), mw }
    }

    pub fn at(&self, pga_m_s2: f64) -> ObjectAtPga<'_> {
        ObjectAtPga(self.directions.iter().map(|direction| direction.at(pga_m_s2)).collect())
    }

    pub fn limit_states(&self, peaks: Peaks, levels: &[QuantileLevel]) -> Vec<LimitStates<Option<f64>>> {
        let mut states = vec![LimitStates::all(Some(0.0)); levels.len()];
        let ln_seconds = (peaks.pgv_m_s / peaks.pga_m_s2).ln();
        self.at(peaks.pga_m_s2).limit_states(ln_seconds, levels, &mut states);
        states
    }

    pub fn estimates(&self, peaks: Peaks, scenarios: Scenarios) -> LimitStates<Option<Interval>> {
        LimitStates::from_levels(&self.limit_states(peaks, &QuantileLevel::with_limits(scenarios)))
    }
}

pub(crate) struct ObjectAtPga<'a>(Vec<DirectionAtPga<'a>>);

impl ObjectAtPga<'_> {
    /// The limit states at this ln(PGV / PGA), s, and each level; none where a model has none.
    pub fn limit_states(
        &self,
        ln_seconds: f64,
        levels: &[QuantileLevel],
        states: &mut [LimitStates<Option<f64>>],
    ) {
        let mut motions = None;
        states.fill(LimitStates::all(Some(0.0)));
        for direction in &self.0 {
            direction.combine_into(ln_seconds, &mut motions, levels, states);
        }
    }
}

impl LimitStates<f64> {
    /// Without a PGV, only rocking is known.
    fn known(self, ln_seconds: f64) -> LimitStates<Option<f64>> {
        let states = self.map(Some);
        if ln_seconds.is_finite() {
            states
        } else {
            LimitStates { rocking: states.rocking, ..LimitStates::all(None) }
        }
    }
}

impl LimitStates<Option<f64>> {
    /// The probability of either of two independent events.
    fn or(self, other: LimitStates<Option<f64>>) -> LimitStates<Option<f64>> {
        self.zip(other, |a, b| a.zip(b).map(|(a, b)| a + b - a * b))
    }
}
