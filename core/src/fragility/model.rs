//! The model that predicts: the calibrated surface, or the paper's fits.

use std::sync::Arc;

use super::calibration::Calibration;
use super::demand::DemandFit;
use super::joint_peaks::JointPeaks;
use super::magnitude::AssumedMagnitude;
use super::model_point::{ModelPoint, Tau};
use super::on_floor::{AMPLIFIED, UpliftIntensities};
use super::overturning::CurveFit;
use super::ready::ReadyDirection;
use super::surface::{self, MotionKind};
use super::tree::{GivenRocking, LimitStates, Probabilities};
use super::tree::{independent_failure, p_failure_given_rocking, p_no_rocking};
use crate::motion::{Floor, IntensityMeasures, Peaks, Suite};
use crate::number::{counted, name};
use crate::rocking::Structure;
use crate::statistics::FitStatus;
use crate::warning::Warning;

/// The model of one structure and limit state.
#[derive(Debug, Clone, PartialEq)]
pub enum Model {
    /// The universal surface.
    Surface { overturning: Calibration, exceeding: Calibration, floor: Option<Floor> },
    /// The paper's planes (or the one line that holds everywhere) and its lognormal curve.
    Paper { demand: Vec<DemandFit>, overturning: CurveFit, limit_state: f64, peaks: JointPeaks },
}

/// A direction in which an object rocks, with its model.
#[derive(Debug, Clone, PartialEq)]
pub struct RockingDirection {
    pub structure: Structure,
    pub model: Arc<Model>,
    /// Number of such objects in a list of which any may rock so; none of a single object.
    pub count: Option<f64>,
}

impl RockingDirection {
    pub fn uplift_m_s2(&self) -> UpliftIntensities {
        let uplift = self.structure.uplift_acceleration_m_s2();
        let [most, usual] = self.model.floor().map_or([1.0; 2], |_| AMPLIFIED);
        UpliftIntensities { least: uplift / most, usual: uplift / usual }
    }
}

/// The confidence of limits by the paper's model.
pub(super) const CONFIDENCE: f64 = 0.95;

impl Model {
    /// The uncalibrated surface. `limit_state` is the demand |theta|max / alpha of failure, such as 0.10.
    pub fn uncalibrated(kind: MotionKind, structure: &Structure, limit_state: f64) -> Model {
        Model::Surface {
            overturning: Calibration::uncalibrated(kind, structure, None),
            exceeding: Calibration::uncalibrated(kind, structure, Some(limit_state)),
            floor: None,
        }
    }

    /// `None` for the paper's model, which is fitted to the ground.
    pub fn on(mut self, on: Option<Floor>) -> Option<Model> {
        match &mut self {
            Model::Surface { floor, .. } => *floor = on,
            Model::Paper { .. } if on.is_some() => return None,
            Model::Paper { .. } => {}
        }
        Some(self)
    }

    /// Number of independent errors of the parameters: those of both calibrations of the surface have the same
    /// causes.
    pub(super) fn errors(&self) -> usize {
        match self {
            Model::Surface { overturning, exceeding, .. } => {
                overturning.errors().len().min(exceeding.errors().len())
            }
            Model::Paper { .. } => self.paper_at_quantiles().len(),
        }
    }

    /// The paper's fits with each independent error of their parameters at its 2.5 and 97.5 % quantiles.
    pub(super) fn paper_at_quantiles(&self) -> Vec<[Model; 2]> {
        let Model::Paper { demand, overturning, limit_state, peaks } = self else { return Vec::new() };
        let with = |demand, overturning| Model::Paper {
            demand,
            overturning,
            limit_state: *limit_state,
            peaks: *peaks,
        };
        let curves = overturning.at_quantiles(CONFIDENCE).into_iter();
        let mut all: Vec<[Model; 2]> =
            curves.map(|at_quantiles| at_quantiles.map(|curve| with(demand.clone(), curve))).collect();
        for (at, plane) in demand.iter().enumerate() {
            all.extend(plane.at_quantiles(CONFIDENCE).into_iter().map(|at_quantiles| {
                at_quantiles.map(|plane| {
                    let mut planes = demand.clone();
                    planes[at] = plane;
                    with(planes, overturning.clone())
                })
            }));
        }
        all
    }

    pub fn kind(&self) -> MotionKind {
        match self {
            Model::Surface { overturning, .. } => overturning.kind,
            Model::Paper { overturning, .. } => MotionKind::from_suite(overturning.suite.as_deref()),
        }
    }

    /// `None` on the ground.
    pub fn floor(&self) -> Option<Floor> {
        let Model::Surface { floor, .. } = self else { return None };
        *floor
    }

    pub fn limit_state(&self) -> Option<f64> {
        match self {
            Model::Surface { exceeding, .. } => exceeding.limit_state,
            Model::Paper { limit_state, .. } => Some(*limit_state),
        }
    }

    pub fn responses(&self) -> i64 {
        let (Model::Surface { overturning: Calibration { n, .. }, .. }
        | Model::Paper { overturning: CurveFit { n, .. }, .. }) = self;
        *n
    }

    pub fn description(&self) -> String {
        match self {
            Model::Surface { overturning, .. } => {
                let Calibration { n, structure, kind, suite, .. } = overturning;
                let (n, motions) = (*n as usize, kind.description());
                let place = if Suite::is_floor(suite.as_deref()) { " of a floor" } else { "" };
                let calibrated = match n {
                    0 => " for".to_string(),
                    _ if overturning.is_of_outcomes() => {
                        format!(", calibrated on {}, for", counted(n, "observed outcome"))
                    }
                    _ => {
                        format!(", calibrated on {} of {} to", counted(n, "response"), name(&structure.name))
                    }
                };
                format!("rockfrag's universal surface{calibrated} {motions}{place}")
            }
            Model::Paper { overturning: CurveFit { n, structure, .. }, .. } => {
                let (responses, motions) = (counted(*n as usize, "response"), self.kind().description());
                let structure = name(&structure.name);
                format!(
                    "rockfrag's fit of the paper's curve and planes to {responses} of {structure} \
                     to {motions}"
                )
            }
        }
    }

    /// The magnitude of a motion, if nobody gives it; none where probabilities do not depend on it.
    pub fn inferred_magnitude(&self, motion: Peaks) -> Option<AssumedMagnitude> {
        let Model::Surface { overturning, .. } = self else { return None };
        Some(surface::inferred_magnitude(overturning.kind, motion))
    }

    /// The values of ln(PGV / PGA), s, at which probabilities bend.
    pub(super) fn bends(&self, mw: Option<f64>) -> Vec<f64> {
        let Model::Surface { overturning, .. } = self else { return Vec::new() };
        surface::bends(overturning.kind, mw)
    }

    pub fn peaks(&self) -> JointPeaks {
        match self {
            Model::Surface { overturning, .. } => overturning.peaks(),
            Model::Paper { peaks, .. } => *peaks,
        }
    }

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
                let points = ModelPoint::at_limits(tau);
                let at_pga = direction.at(pga_m_s2).into_iter();
                at_pga.for_each(|at| {
                    at.for_each_point(ln_pgv_pga, &mut None, &points, |point, of| states[point] = of);
                });
                Probabilities::on_floor(LimitStates::from_points(&states))
            }
            Model::Paper { demand, overturning, limit_state, .. } => {
                paper_probabilities(demand, overturning, measures, *limit_state, CONFIDENCE)
            }
        }
    }

    pub fn warnings(&self, structure: &Structure, measures: &IntensityMeasures) -> Vec<Warning> {
        let on_floor = self.floor().map(|floor| {
            let median = floor.peaks(measures.peaks(structure));
            IntensityMeasures::new(structure, median, None, None)
        });
        let measures = on_floor.as_ref().unwrap_or(measures);
        let rocks = p_no_rocking(measures.im4) == 0.0;
        let mut warnings = match self {
            Model::Surface { overturning, exceeding, .. } => {
                let covered = exceeding
                    .limit_state
                    .is_none_or(|limit| surface::covers_motion(structure, measures, limit))
                    && overturning.covers(structure, measures);
                let unusual = (!surface::covers_structure(structure)).then_some(Warning::UnusualStructure);
                let outside = (rocks && !covered).then_some(Warning::Extrapolated);
                let fits = [overturning.warnings(), exceeding.warnings()].concat();
                outside.into_iter().chain(unusual).chain(fits).collect()
            }
            Model::Paper { demand, overturning, .. } => {
                let demand = demand.iter().find(|fit| fit.holds_at(measures.im4));
                let is_poor = overturning.status == FitStatus::PoorFit
                    || demand.is_none_or(|demand| demand.status != FitStatus::Ok);
                let outside = (rocks && !overturning.covers(measures)).then_some(Warning::Extrapolated);
                let few = (!overturning.is_clustered).then_some(Warning::FewClusters);
                let rare = (overturning.status == FitStatus::FewEvents).then_some(Warning::FewEvents);
                let poor = is_poor.then_some(Warning::PoorFit);
                [outside, few, rare, poor].into_iter().flatten().collect::<Vec<Warning>>()
            }
        };
        warnings.sort_unstable();
        warnings.dedup();
        if warnings.contains(&Warning::NoEvents) {
            warnings.retain(|warning| *warning != Warning::FewEvents);
        }
        warnings
    }
}

/// The tree (Eq. 12) by the paper's fits: P_ex of the demand fit that holds at the IM4, P_ro of a curve.
/// `demand` are the two planes, or one regression that holds everywhere.
pub fn paper_probabilities(
    demand: &[DemandFit],
    overturning: &CurveFit,
    measures: &IntensityMeasures,
    limit_state: f64,
    confidence: f64,
) -> Probabilities {
    Probabilities::new(measures.im4, || {
        let p_ro = overturning.probability(measures, confidence)?;
        let fit = demand.iter().find(|fit| fit.holds_at(measures.im4));
        let p_ex = fit.and_then(|fit| fit.p_exceeding(measures, limit_state, confidence));
        Some(GivenRocking { p_ex, p_ro, p_failure: p_ex.map(|p_ex| independent_failure(p_ro, p_ex)) })
    })
}
