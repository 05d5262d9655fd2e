//! The probabilities of an object in three stages, since a rate needs them for thousands of pairs of peaks:
//!
//! 1. [`ReadyObject`], once: the surface at this structure, limit state and magnitude, a polynomial in x, w
//!    and r, and the errors of its calibration.
//! 2. [`ObjectAtPga`], for each PGA: the surface at this IM4, which leaves a cubic in ln(PGA / PGV).
//! 3. For each PGV / PGA: the cubic and g, and one logistic function for each point. On a floor the second
//!    stage is repeated here, for each of the seven nodes of its peaks.

use super::calibration::{Branch, LogitTerms};
use super::model::{Model, RockingDirection};
use super::model_point::{ModelPoint, Tau};
use super::on_floor::{FloorMotion, FloorMotionDistribution, OnFloor};
use super::surface::{Im4Terms, SurfaceAtIm4};
use super::tree::{LimitStates, NoneOf, p_failure_given_rocking};
use crate::motion::{Floor, IntensityMeasures, Peaks};
use crate::rocking::Structure;
use crate::statistics::Interval;

/// First stage: a structure under motions of one magnitude.
pub(super) struct ReadyDirection<'a> {
    structure: &'a Structure,
    uplift_m_s2: f64,
    by: ReadyModel<'a>,
}

/// Something of P_ro and of P_ex.
pub(super) struct PerBranch<T> {
    pub p_ro: T,
    pub p_ex: T,
}

impl<T> PerBranch<T> {
    pub fn map<U>(&self, f: impl Fn(&T) -> U) -> PerBranch<U> {
        PerBranch { p_ro: f(&self.p_ro), p_ex: f(&self.p_ex) }
    }

    fn zip<U, V>(&self, other: &PerBranch<U>, join: impl Fn(&T, &U) -> V) -> PerBranch<V> {
        PerBranch { p_ro: join(&self.p_ro, &other.p_ro), p_ex: join(&self.p_ex, &other.p_ex) }
    }
}

impl PerBranch<Branch<'_>> {
    /// Under a motion that uplifts the structure.
    fn limit_states(&self, terms: &PerBranch<LogitTerms>, point: ModelPoint) -> LimitStates<f64> {
        let PerBranch { p_ro, p_ex } = self.zip(terms, |branch, terms| branch.probability(terms, point));
        LimitStates { rocking: 1.0, failure: p_failure_given_rocking(p_ro, p_ex), overturning: p_ro }
    }

    /// Over the motions of a floor, by weight, that uplift the structure; `rocking` is their probability.
    fn mean(
        &self,
        nodes: &[(f64, PerBranch<LogitTerms>)],
        rocking: f64,
        point: ModelPoint,
    ) -> LimitStates<f64> {
        let (mut failure, mut overturning) = (0.0, 0.0);
        for (weight, terms) in nodes {
            let states = self.limit_states(terms, point);
            failure += weight * states.failure;
            overturning += weight * states.overturning;
        }
        LimitStates { rocking, failure: failure.min(rocking), overturning: overturning.min(rocking) }
    }
}

/// P_ro and P_ex of the calibrated surface, or the paper's fits with each of their errors at its quantiles.
#[expect(clippy::large_enum_variant, reason = "one is made for each direction of an object")]
enum ReadyModel<'a> {
    Ground(PerBranch<Branch<'a>>),
    Floor(PerBranch<Branch<'a>>, OnFloor),
    Paper(&'a Model, Vec<[Model; 2]>),
}

impl<'a> ReadyDirection<'a> {
    pub fn new(structure: &'a Structure, model: &'a Model, mw: Option<f64>) -> ReadyDirection<'a> {
        let by = match model {
            Model::Surface { overturning, exceeding, floor } => {
                let branches = PerBranch { p_ro: overturning, p_ex: exceeding }
                    .map(|calibration| calibration.branch(structure, mw));
                match floor {
                    Some(floor) => {
                        ReadyModel::Floor(branches, OnFloor::new(*floor, structure, exceeding.limit_state))
                    }
                    None => ReadyModel::Ground(branches),
                }
            }
            Model::Paper { .. } => ReadyModel::Paper(model, model.paper_at_quantiles()),
        };
        ReadyDirection { structure, uplift_m_s2: structure.uplift_acceleration_m_s2(), by }
    }

    /// None where no motion of this PGA uplifts the structure.
    pub fn at(&self, pga_m_s2: f64) -> Option<DirectionAtPga<'_>> {
        let im4 = pga_m_s2 / self.uplift_m_s2;
        let ln_im4 = im4.ln();
        Some(match &self.by {
            ReadyModel::Ground(_) if im4.is_nan() || im4 < 1.0 => return None,
            ReadyModel::Ground(branches) => {
                let at = Im4Terms::new(im4, ln_im4);
                DirectionAtPga::Ground(branches, branches.map(|branch| branch.surface.at(&at)))
            }
            ReadyModel::Floor(branches, on_floor) => {
                DirectionAtPga::Floor { branches, on_floor, im4, ln_im4 }
            }
            ReadyModel::Paper(model, at_quantiles) => {
                DirectionAtPga::Paper { model, at_quantiles, structure: self.structure, pga_m_s2 }
            }
        })
    }
}

/// Second stage: a direction under motions of one PGA of the ground.
pub(super) enum DirectionAtPga<'a> {
    Ground(&'a PerBranch<Branch<'a>>, PerBranch<SurfaceAtIm4>),
    Floor { branches: &'a PerBranch<Branch<'a>>, on_floor: &'a OnFloor, im4: f64, ln_im4: f64 },
    Paper { model: &'a Model, at_quantiles: &'a [[Model; 2]], structure: &'a Structure, pga_m_s2: f64 },
}

impl DirectionAtPga<'_> {
    /// Third stage: visits the probabilities at each point, by its number, under motions with this
    /// ln(PGV / PGA), s. `motions` are those of a floor, the same for all directions of an object: the first
    /// that needs them computes them.
    pub fn for_each_point(
        &self,
        ln_pgv_pga: f64,
        motions: &mut Option<(Floor, FloorMotionDistribution)>,
        points: &[ModelPoint],
        mut visit: impl FnMut(usize, LimitStates<Option<f64>>),
    ) {
        let points = points.iter().copied().enumerate();
        match self {
            DirectionAtPga::Ground(branches, at_im4) => {
                let terms = branches.zip(at_im4, |branch, at_im4| {
                    let magnitude = branch.surface.magnitude(ln_pgv_pga + at_im4.excess);
                    branch.terms(at_im4, ln_pgv_pga, magnitude)
                });
                points.for_each(|(number, point)| {
                    visit(number, branches.limit_states(&terms, point).known(ln_pgv_pga));
                });
            }
            DirectionAtPga::Floor { branches, on_floor, im4, ln_im4 } => {
                let known = motions.filter(|(floor, _)| *floor == on_floor.floor);
                let known = known.unwrap_or_else(|| (on_floor.floor, on_floor.motions(ln_pgv_pga)));
                let (_, motions) = motions.insert(known);
                let shifts = on_floor.logit_shifts(motions);
                let terms = |node: &FloorMotion| {
                    let at = Im4Terms::new(im4 * node.pfa, ln_im4 + node.ln_pfa);
                    branches.zip(&shifts, |branch, shift| {
                        let magnitude = branch.surface.magnitude(ln_pgv_pga);
                        let terms = branch.terms(&branch.surface.at(&at), node.ln_pgv_pga, magnitude);
                        LogitTerms { uplift_term: terms.uplift_term + shift, ..terms }
                    })
                };
                let nodes = motions.nodes.iter().filter(|node| im4 * node.pfa >= 1.0);
                let nodes: Vec<_> = nodes.map(|node| (node.weight, terms(node))).collect();
                let rocking = motions.p_rocking(*ln_im4);
                points.for_each(|(number, point)| {
                    visit(number, branches.mean(&nodes, rocking, point).known(ln_pgv_pga));
                });
            }
            DirectionAtPga::Paper { model, at_quantiles, structure, pga_m_s2 } => {
                let peaks = Peaks { pga_m_s2: *pga_m_s2, pgv_m_s: pga_m_s2 * ln_pgv_pga.exp() };
                let measures = IntensityMeasures::new(structure, peaks, None, None);
                points.for_each(|(number, point)| {
                    let model = match point {
                        ModelPoint::Error { number, is_high } => &at_quantiles[number][usize::from(is_high)],
                        _ => *model,
                    };
                    let states =
                        model.probabilities(structure, &measures, None, Tau::Averaged).limit_states();
                    visit(number, states.map(|p| p.map(|p| point.of(p))));
                });
            }
        }
    }
}

/// The first two stages for all directions of an object.
pub(crate) struct ReadyObject<'a> {
    /// With the number of such objects in a list.
    directions: Vec<(ReadyDirection<'a>, Option<f64>)>,
    pub mw: Option<f64>,
}

impl<'a> ReadyObject<'a> {
    pub fn new(directions: &'a [RockingDirection], mw: Option<f64>) -> ReadyObject<'a> {
        let ready = |RockingDirection { structure, model, count }: &'a RockingDirection| {
            (ReadyDirection::new(structure, model, mw), *count)
        };
        ReadyObject { directions: directions.iter().map(ready).collect(), mw }
    }

    pub fn at(&self, pga_m_s2: f64) -> ObjectAtPga<'_> {
        ObjectAtPga(
            self.directions.iter().filter_map(|(one, count)| Some((one.at(pga_m_s2)?, *count))).collect(),
        )
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

pub(crate) struct ObjectAtPga<'a>(Vec<(DirectionAtPga<'a>, Option<f64>)>);

impl ObjectAtPga<'_> {
    /// The limit states at this ln(PGV / PGA), s, and each point; none where a model has none. An object
    /// rocks in each direction independently under one motion; how many of a list rock too far is not asked.
    pub fn limit_states(
        &self,
        ln_pgv_pga: f64,
        points: &[ModelPoint],
        states: &mut [LimitStates<Option<f64>>],
    ) {
        let mut motions = None;
        states.fill(LimitStates::all(Some(0.0)));
        let mut none_of = vec![LimitStates::all(Some(NoneOf::EMPTY)); points.len()];
        for (direction, count) in &self.0 {
            direction.for_each_point(ln_pgv_pga, &mut motions, points, |point, one| match count {
                None => states[point] = states[point].or(one),
                Some(count) => {
                    let one = LimitStates { failure: None, ..one };
                    none_of[point] = none_of[point].zip(one, |none, p| Some(none?.and(p?, *count)));
                }
            });
        }
        if self.0.iter().any(|(_, count)| count.is_some()) {
            states.iter_mut().zip(none_of).for_each(|(of, none)| *of = none.map(|none| Some(none?.p_any())));
        }
    }
}
