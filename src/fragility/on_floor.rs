//! The probabilities on a floor: those at its own peaks, averaged over what they may be, and moved by how
//! narrow the band of its motion is.

use super::tree::{GivenRocking, LimitState, Probabilities};
use crate::motion::{Floor, IntensityMeasures, floor};
use crate::rocking::Structure;
use crate::statistics::{Estimate, normal};

/// What a floor adds to the logits of P_ro and of P_ex: f (a + b ln(p T1)), f the resonant share of its
/// velocity; of P_ex a falls with ln of the limit state over 0.1. By scripts/floors/surface.py.
const OVERTURNING: [f64; 2] = [-1.69, 1.94];
const EXCEEDING: [f64; 3] = [-0.09, 1.74, -1.22];
/// No floor has a larger peak acceleration than this times that of the ground; the median one that it has at
/// most.
const MOST_AMPLIFIED: f64 = 7.0;
const MEDIAN_AMPLIFIED: f64 = 2.5;
/// Seven nodes of the standard normal in a plane, exact to degree 5: the middle, and six around it (Stroud
/// 1971).
const AROUND: (f64, f64) = (2.0, 1.0 / 12.0);
const MIDDLE: f64 = 0.5;

/// Ground accelerations that uplift a structure on a floor: by the strongest floor, and by a usual one, m/s2.
pub(super) fn uplift_m_s2(structure: &Structure) -> [f64; 2] {
    [MOST_AMPLIFIED, MEDIAN_AMPLIFIED].map(|factor| structure.uplift_acceleration_m_s2() / factor)
}

/// The measures of a floor with median peaks, of those of the ground.
pub(super) fn median_measures(
    floor: Floor,
    structure: &Structure,
    ground: &IntensityMeasures,
) -> IntensityMeasures {
    let [pga, pgv] = ground.peaks(structure);
    let peaks = floor.peaks(pga, pgv);
    IntensityMeasures::new(structure, peaks.pfa_m_s2, peaks.pfv_m_s, None, None)
}

/// Averages the probabilities over the peaks of a floor. `given` gives those at its measures, with this added
/// to the logits of P_ro and P_ex.
pub(super) fn probabilities(
    floor: Floor,
    structure: &Structure,
    ground: &IntensityMeasures,
    limit_state: f64,
    given: impl Fn(&IntensityMeasures, [f64; 2]) -> Probabilities,
) -> Probabilities {
    let [pga, pgv] = ground.peaks(structure);
    let peaks = floor.peaks(pga, pgv);
    let narrow = (structure.p_rad_s * floor.period_s).ln();
    let [a, b, by_limit] = EXCEEDING;
    let added =
        [OVERTURNING[0] + OVERTURNING[1] * narrow, a + by_limit * (limit_state / 0.1).ln() + b * narrow]
            .map(|term| peaks.resonant_share * term);
    let at = |x: f64, y: f64| {
        let along = floor::CORRELATION * x + (1.0 - floor::CORRELATION.powi(2)).sqrt() * y;
        let pfa = peaks.pfa_m_s2 * (peaks.sd_ln_pfa * x).exp();
        let pfv = peaks.pfv_m_s * (peaks.sd_ln_pfv * along).exp();
        given(&IntensityMeasures::new(structure, pfa, pfv, None, None), added)
    };
    let around = (0..6).map(|k| (f64::from(k) * std::f64::consts::FRAC_PI_3).sin_cos());
    let nodes = around.map(|(sin, cos)| (at(AROUND.0 * cos, AROUND.0 * sin), AROUND.1));
    let nodes: Vec<(Probabilities, f64)> = nodes.chain([(at(0.0, 0.0), MIDDLE)]).collect();
    let p_nr = match peaks.sd_ln_pfa > 0.0 {
        true => normal::cdf((structure.uplift_acceleration_m_s2() / peaks.pfa_m_s2).ln() / peaks.sd_ln_pfa),
        false => nodes[0].0.p_nr,
    };
    let rocks = 1.0 - p_nr;
    let mean = |state: LimitState| {
        let add = |sum: Estimate, (node, weight): &(Probabilities, f64)| {
            Some(sum.zip(node.limit_states()?.get(state), |sum, p| sum + weight * p))
        };
        let sum = nodes.iter().try_fold(Estimate::exact(0.0), add)?;
        Some(sum.map(|p| (p / rocks).min(1.0)))
    };
    let given_rocking = || {
        let (p_failure, p_ro) = (mean(LimitState::Failure)?, mean(LimitState::Overturning)?);
        let p_ex = p_failure
            .zip(p_ro, |failure, overturning| ((failure - overturning) / (1.0 - overturning)).max(0.0));
        Some(GivenRocking { p_ex, p_ro, p_failure })
    };
    Probabilities { p_nr, given_rocking: if rocks > 0.0 { given_rocking() } else { None } }
}
