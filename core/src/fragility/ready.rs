//! The probabilities of an object in three stages, since a rate needs them for thousands of pairs of peaks:
//!
//! 1. [`ReadyObject`], once: the surface at this structure, limit state and magnitude, a polynomial in x, w
//!    and r, and the errors of its calibration.
//! 2. [`ObjectAtPga`], for each PGA: the surface at this IM4, which leaves a cubic in ln(PGA / PGV).
//! 3. For each PGV / PGA: the cubic and g, and one logistic function for each point. On a floor the second
//!    stage is repeated here, for each of the seven nodes of its peaks.

use super::calibration::{Branch, LogitTerms};
use super::model::{CONFIDENCE, Model, RockingDirection, paper_probabilities};
use super::model_point::{ModelPoint, Tau};
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
        tau: Tau,
    ) -> Probabilities {
        match self {
            Model::Surface { overturning, exceeding, floor: None } => {
                Probabilities::new(measures.im4, || {
                    let p_ro = overturning.probability(structure, measures, mw, tau)?;
                    let p_ex = exceeding.probability(structure, measures, mw, tau)?;
                    // Errors of both have the same causes, so that their limits are joined in pairs.
                    let p_failure = p_ro.zip(p_ex, p_failure_given_rocking);
                    Some(GivenRocking { p_ex: Some(p_ex), p_ro, p_failure: Some(p_failure) })
                })
            }
            Model::Surface { floor: Some(_), .. } => {
                let Peaks { pga_m_s2, pgv_m_s } = measures.peaks(structure);
                let ln_pgv_pga = if pgv_m_s > 0.0 { (pgv_m_s / pga_m_s2).ln() } else { f64::NEG_INFINITY };
                let mut states = [LimitStates::all(Some(0.0)); 3];
                let direction = ReadyDirection::new(structure, self, mw);
                direction.at(pga_m_s2).combine_into(
                    ln_pgv_pga,
                    &mut None,
                    &ModelPoint::at_limits(tau),
                    &mut states,
                );
                Probabilities::on_floor(LimitStates::from_points(&states))
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
            Model::Surface { overturning, exceeding, floor } => {
                let branches = [overturning, exceeding].map(|calibration| calibration.branch(structure, mw));
                match floor {
                    Some(floor) => {
                        ReadyModel::Floor(branches, OnFloor::new(*floor, structure, exceeding.limit_state))
                    }
                    None => ReadyModel::Ground(branches),
                }
            }
            Model::Paper { .. } => ReadyModel::Paper(model, model.at_quantiles()),
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
            ReadyModel::Paper(model, at_quantiles) => {
                DirectionAtPga::Paper { model, at_quantiles, structure: self.structure, pga_m_s2 }
            }
        }
    }
}

/// Second stage: a direction under motions of one PGA of the ground.
enum DirectionAtPga<'a> {
    Still,
    Ground(&'a [Branch<'a>; 2], [SurfaceAtIm4; 2]),
    Floor { branches: &'a [Branch<'a>; 2], on_floor: &'a OnFloor, im4: f64, ln_im4: f64 },
    Paper { model: &'a Model, at_quantiles: &'a [[Model; 2]], structure: &'a Structure, pga_m_s2: f64 },
}

impl DirectionAtPga<'_> {
    /// Third stage: joins the probabilities at each point under motions with this ln(PGV / PGA), s, to those
    /// of other directions: an object falls in either, independently under one motion. `motions` are those of
    /// the floor, the same for all directions: the first that needs them computes them.
    fn combine_into(
        &self,
        ln_pgv_pga: f64,
        motions: &mut Option<FloorMotionDistribution>,
        points: &[ModelPoint],
        joined: &mut [LimitStates<Option<f64>>],
    ) {
        let points = joined.iter_mut().zip(points);
        match self {
            DirectionAtPga::Still => {}
            DirectionAtPga::Ground(branches, at_im4) => {
                let terms = [0, 1].map(|k| {
                    let (branch, at_im4) = (&branches[k], &at_im4[k]);
                    branch.terms(at_im4, ln_pgv_pga, branch.surface.magnitude(ln_pgv_pga + at_im4.excess))
                });
                for (joined, point) in points {
                    let [p_ro, p_ex] = [0, 1].map(|k| branches[k].probability(&terms[k], *point));
                    let failure = p_failure_given_rocking(p_ro, p_ex);
                    let states = LimitStates { rocking: 1.0, failure, overturning: p_ro };
                    *joined = joined.or(states.known(ln_pgv_pga));
                }
            }
            DirectionAtPga::Floor { branches, on_floor, im4, ln_im4 } => {
                let motions = motions.get_or_insert_with(|| on_floor.motions(ln_pgv_pga));
                let (shifts, rocking) = (on_floor.logit_shifts(motions), motions.p_rocking(*ln_im4));
                let magnitudes = branches.each_ref().map(|branch| branch.surface.magnitude(ln_pgv_pga));
                let rocks = motions.nodes.iter().filter(|node| im4 * node.pfa >= 1.0).map(|node| {
                    let at = Im4Terms::new(im4 * node.pfa, ln_im4 + node.ln_pfa);
                    let terms = [0, 1].map(|k| {
                        let at_im4 = branches[k].surface.at(&at);
                        let terms = branches[k].terms(&at_im4, node.ln_pgv_pga, magnitudes[k]);
                        LogitTerms { uplift_term: terms.uplift_term + shifts[k], ..terms }
                    });
                    (node.weight, terms)
                });
                let rocks: Vec<(f64, [LogitTerms; 2])> = rocks.collect();
                for (joined, point) in points {
                    let (mut failure, mut overturning) = (0.0, 0.0);
                    for (weight, terms) in &rocks {
                        let [p_ro, p_ex] = [0, 1].map(|k| branches[k].probability(&terms[k], *point));
                        failure += weight * p_failure_given_rocking(p_ro, p_ex);
                        overturning += weight * p_ro;
                    }
                    let [failure, overturning] = [failure, overturning].map(|p: f64| p.min(rocking));
                    *joined = joined.or(LimitStates { rocking, failure, overturning }.known(ln_pgv_pga));
                }
            }
            DirectionAtPga::Paper { model, at_quantiles, structure, pga_m_s2 } => {
                let peaks = Peaks { pga_m_s2: *pga_m_s2, pgv_m_s: pga_m_s2 * ln_pgv_pga.exp() };
                let measures = IntensityMeasures::new(structure, peaks, None, None);
                for (joined, point) in points {
                    let model = match *point {
                        ModelPoint::Error { number, is_high } => &at_quantiles[number][usize::from(is_high)],
                        _ => *model,
                    };
                    let tree = model.probabilities(structure, &measures, None, Tau::Averaged);
                    *joined = joined.or(tree.limit_states().map(|p| {
                        p.map(|p| match point {
                            ModelPoint::Low(_) => p.low,
                            ModelPoint::High(_) => p.high,
                            ModelPoint::Estimate | ModelPoint::Error { .. } => p.value,
                        })
                    }));
                }
            }
        }
    }
}

impl ModelPoint {
    /// The estimate, then each error of the models at both quantiles: the same error moves all directions.
    pub fn at_errors(directions: &[RockingDirection]) -> Vec<ModelPoint> {
        let fewest =
            directions.iter().map(|direction| direction.model.at_quantiles().len()).min().unwrap_or(0);
        let errors =
            (0..fewest).flat_map(|number| [false, true].map(|is_high| ModelPoint::Error { number, is_high }));
        [ModelPoint::Estimate].into_iter().chain(errors).collect()
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

    pub fn limit_states(&self, peaks: Peaks, points: &[ModelPoint]) -> Vec<LimitStates<Option<f64>>> {
        let mut states = vec![LimitStates::all(Some(0.0)); points.len()];
        let ln_pgv_pga = (peaks.pgv_m_s / peaks.pga_m_s2).ln();
        self.at(peaks.pga_m_s2).limit_states(ln_pgv_pga, points, &mut states);
        states
    }

    pub fn estimates(&self, peaks: Peaks, tau: Tau) -> LimitStates<Option<Interval>> {
        LimitStates::from_points(&self.limit_states(peaks, &ModelPoint::at_limits(tau)))
    }
}

pub(crate) struct ObjectAtPga<'a>(Vec<DirectionAtPga<'a>>);

impl ObjectAtPga<'_> {
    /// The limit states at this ln(PGV / PGA), s, and each point; none where a model has none.
    pub fn limit_states(
        &self,
        ln_pgv_pga: f64,
        points: &[ModelPoint],
        states: &mut [LimitStates<Option<f64>>],
    ) {
        let mut motions = None;
        states.fill(LimitStates::all(Some(0.0)));
        for direction in &self.0 {
            direction.combine_into(ln_pgv_pga, &mut motions, points, states);
        }
    }
}

impl LimitStates<f64> {
    /// Without a PGV, only rocking is known.
    fn known(self, ln_pgv_pga: f64) -> LimitStates<Option<f64>> {
        let states = self.map(Some);
        if ln_pgv_pga.is_finite() {
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
