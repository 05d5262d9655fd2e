//! The motions of a floor given that of the ground: the distribution of its peaks, and the narrowness of its
//! frequency band, which changes the probabilities.

use super::ready::PerBranch;
use crate::motion::Floor;
use crate::motion::floor::{Amplification, CORRELATION, FloorModes};
use crate::rocking::Structure;
use crate::statistics::normal;

/// a, b and, of P_ex, c of f (a + b ln(p T1) + c ln(limit state / 0.1)), by which a floor whose velocity has
/// the resonant share f raises a logit (scripts/floors/surface.py).
const OVERTURNING: [f64; 2] = [-1.69, 1.94];
const EXCEEDING: [f64; 3] = [-0.09, 1.74, -1.22];
/// Amplification of PGA by the strongest floor, 3 standard deviations above the largest median, and by a
/// usual resonant floor.
pub(super) const AMPLIFIED: [f64; 2] = [7.0, 2.5];
/// Seven nodes of the standard normal in a plane with their weights, exact to degree 5: the middle, and six
/// around it (Stroud 1971).
const NODES: [[f64; 3]; 7] = [
    [2.0, 0.0, 1.0 / 12.0],
    [1.0, ROOT_3, 1.0 / 12.0],
    [-1.0, ROOT_3, 1.0 / 12.0],
    [-2.0, 0.0, 1.0 / 12.0],
    [-1.0, -ROOT_3, 1.0 / 12.0],
    [1.0, -ROOT_3, 1.0 / 12.0],
    [0.0, 0.0, 0.5],
];
const ROOT_3: f64 = 1.732_050_807_568_877_2;

/// Intensities that uplift an object, m/s2 or m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UpliftIntensities {
    /// By the strongest floor, or with the smallest PGV / PGA.
    pub least: f64,
    /// By a usual floor, with the median PGV / PGA.
    pub usual: f64,
}

pub(super) struct OnFloor {
    pub floor: Floor,
    modes: FloorModes,
    /// Added to the logits of P_ro and P_ex by a motion that is all resonance.
    shifts_at_resonance: PerBranch<f64>,
}

impl OnFloor {
    pub fn new(floor: Floor, structure: &Structure, limit_state: Option<f64>) -> OnFloor {
        let ln_periods = (structure.p_rad_s * floor.period_s).ln();
        let [a, b, by_limit] = EXCEEDING;
        let shifts_at_resonance = PerBranch {
            p_ro: OVERTURNING[0] + OVERTURNING[1] * ln_periods,
            p_ex: a + by_limit * limit_state.map_or(0.0, |limit| (limit / 0.1).ln()) + b * ln_periods,
        };
        OnFloor { floor, modes: floor.modes(), shifts_at_resonance }
    }

    /// For motions of the ground with this ln(PGV / PGA), s.
    pub fn motions(&self, ln_pgv_pga: f64) -> FloorMotionDistribution {
        let amplification = self.modes.amplification(ln_pgv_pga);
        let nodes = NODES.map(|[x, y, weight]| {
            let along = CORRELATION * x + (1.0 - CORRELATION * CORRELATION).sqrt() * y;
            let ln_pfa = amplification.ln_pfa + amplification.sd_ln_pfa * x;
            let ln_pfv = amplification.ln_pfv + amplification.sd_ln_pfv * along;
            FloorMotion { pfa: ln_pfa.exp(), ln_pfa, ln_pgv_pga: ln_pgv_pga + ln_pfv - ln_pfa, weight }
        });
        FloorMotionDistribution { nodes, amplification }
    }

    /// Added to the logits of P_ro and P_ex.
    pub fn logit_shifts(&self, motions: &FloorMotionDistribution) -> PerBranch<f64> {
        self.shifts_at_resonance.map(|shift| motions.amplification.resonant_share * shift)
    }
}

/// The motions of a floor for one motion of the ground.
#[derive(Debug, Clone, Copy)]
pub(super) struct FloorMotionDistribution {
    pub nodes: [FloorMotion; NODES.len()],
    amplification: Amplification,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct FloorMotion {
    /// PFA / PGA and its logarithm.
    pub pfa: f64,
    pub ln_pfa: f64,
    /// ln(PFV / PFA), s.
    pub ln_pgv_pga: f64,
    /// The weights of all sum to 1.
    pub weight: f64,
}

impl FloorMotionDistribution {
    /// The probability that the floor uplifts a structure whose IM4 is by the PGA of the ground.
    pub fn p_rocking(&self, ln_im4: f64) -> f64 {
        let Amplification { ln_pfa, sd_ln_pfa, .. } = self.amplification;
        let ln_median = ln_im4 + ln_pfa;
        match sd_ln_pfa > 0.0 {
            true => 1.0 - normal::cdf(-ln_median / sd_ln_pfa),
            false => f64::from(ln_median >= 0.0),
        }
    }
}
