//! Floors of buildings: their motion, and its peaks from those of the ground. The building is a linear
//! uniform shear beam; its modes i = 1 to 5 have periods T1/(2i - 1) and, at height z (1 at the roof), the
//! shares G_i = 4/((2i - 1) pi) sin((2i - 1) pi z/2) of the motion.

use std::f64::consts::{PI, TAU};

use super::measures::Oscillator;
use super::peaks::Peaks;

/// A floor of a building, or the ground: level 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// First period of the building, s.
    pub period_s: f64,
    /// Height over that of the roof, 0 to 1.
    pub level: f64,
}

/// Correlation of the logarithms of both peaks of a floor about their medians, by scripts/floors/peaks.py.
pub const CORRELATION: f64 = 0.58;
/// Modes: three give peak accelerations up to 30 % too low in long-period buildings.
const MODES: usize = 5;
/// Share of the first mode's motion that is left where a floor's record ends.
const LEFT: f64 = 0.05;

/// How a peak of a floor depends on u = ln(T1/Tg), Tg = 2 pi PGV/PGA, by scripts/floors/peaks.py. The rigid
/// share of mode i is r = 1/(1 + exp(k (u_i - b))), its resonance D = d/(exp(-l (u_i - e)) + exp(h (u_i -
/// e))), u_i = u - ln(2i - 1).
#[derive(Clone, Copy)]
struct PeakByPeriod {
    b: f64,
    k: f64,
    d: f64,
    e: f64,
    l: f64,
    h: f64,
}

const ACCELERATION_BY_PERIOD: PeakByPeriod =
    PeakByPeriod { b: -0.090, k: 3.430, d: 3.635, e: 0.112, l: 0.434, h: 1.494 };
const VELOCITY_BY_PERIOD: PeakByPeriod =
    PeakByPeriod { b: 0.930, k: 3.199, d: 3.569, e: -0.225, l: 1.574, h: 0.637 };
/// Standard deviations of ln PFA and ln PFV of a motion that is all resonance, by scripts/floors/peaks.py.
const SCATTER_OF_ACCELERATION: f64 = 0.284;
const SCATTER_OF_VELOCITY: f64 = 0.314;

impl Floor {
    fn shares(&self) -> [f64; MODES] {
        std::array::from_fn(|i| {
            let odd = (2 * i + 1) as f64;
            4.0 / (odd * PI) * (odd * PI * self.level / 2.0).sin()
        })
    }

    /// Computes the absolute acceleration of the floor (m/s2) under one of the ground, lines between samples
    /// of step `dt_s`, of modes with this damping ratio: a (1 - sum G_i) + sum G_i A_i, A_i that of an
    /// oscillator. After the last sample the ground is at rest until the first mode has all but decayed; at
    /// level 0 the floor is the ground.
    pub fn motion(&self, ground: &[f64], dt_s: f64, damping: f64) -> Vec<f64> {
        if self.level == 0.0 {
            return ground.to_vec();
        }
        let shares = self.shares();
        let tail_s = -LEFT.ln() * self.period_s / (TAU * damping);
        let mut rested = ground.to_vec();
        rested.resize(ground.len() + (tail_s / dt_s).ceil() as usize, 0.0);
        let rigid = 1.0 - shares.iter().sum::<f64>();
        let mut floor: Vec<f64> = rested.iter().map(|a| rigid * a).collect();
        for (i, share) in shares.iter().enumerate() {
            let mut mode = Oscillator::new(self.period_s / (2 * i + 1) as f64, damping, dt_s);
            for (at, pair) in floor[1..].iter_mut().zip(rested.windows(2)) {
                mode.step(pair[0], pair[1]);
                *at += share * mode.absolute_acceleration();
            }
        }
        floor
    }

    /// Predicts the median peaks of the floor from those of the ground.
    pub fn peaks(&self, ground: Peaks) -> Peaks {
        let Amplification { ln_pfa, ln_pfv, .. } = self.amplification(ground);
        Peaks { pga_m_s2: ln_pfa.exp() * ground.pga_m_s2, pgv_m_s: ln_pfv.exp() * ground.pgv_m_s }
    }

    /// Predicts by how much the floor amplifies the peaks of the ground.
    pub fn amplification(&self, ground: Peaks) -> Amplification {
        self.modes().amplification((ground.pgv_m_s / ground.pga_m_s2).ln())
    }

    /// Computes what depends on the floor only, once for the peaks of many motions.
    pub(crate) fn modes(&self) -> FloorModes {
        FloorModes {
            ln_period: (self.period_s / TAU).ln(),
            modes: [ACCELERATION_BY_PERIOD, VELOCITY_BY_PERIOD].map(|peak| {
                let mut odd = 1.0_f64;
                self.shares().map(|share| {
                    let mode = Mode {
                        share,
                        by_k: odd.powf(-peak.k),
                        by_l: odd.powf(peak.l),
                        by_h: odd.powf(-peak.h),
                    };
                    odd += 2.0;
                    mode
                })
            }),
        }
    }
}

/// The part of the prediction of peaks that depends on the floor only.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FloorModes {
    /// ln(T1 / 2 pi), s.
    ln_period: f64,
    /// Modes of acceleration and of velocity.
    modes: [[Mode; MODES]; 2],
}

/// Share of a mode, and (2i - 1) to the powers -k, l and -h of a peak.
#[derive(Debug, Clone, Copy)]
struct Mode {
    share: f64,
    by_k: f64,
    by_l: f64,
    by_h: f64,
}

/// Amplification of the peaks of the ground by a floor. Deviations from both medians have the correlation
/// [`CORRELATION`].
#[derive(Debug, Clone, Copy)]
pub struct Amplification {
    /// Median ln(PFA / PGA).
    pub ln_pfa: f64,
    pub sd_ln_pfa: f64,
    /// Median ln(PFV / PGV).
    pub ln_pfv: f64,
    pub sd_ln_pfv: f64,
    /// Share of resonance in the squared velocity, 0 on the ground: near 1, the frequency band is narrow.
    pub resonant_share: f64,
}

impl FloorModes {
    /// Predicts the peaks of the floor from ln(PGV / PGA), s, of the ground: ln(floor/ground) = ln(A^2 + B)/2
    /// with the rigid part A = 1 - sum G_i (1 - r_i) and the resonant one B = sum G_i^2 D_i^2.
    pub fn amplification(&self, ln_pgv_pga: f64) -> Amplification {
        let u = self.ln_period - ln_pgv_pga;
        let [(ln_pfa, resonant_a), (ln_pfv, resonant_v)] =
            [0, 1].map(|k| ln_factor([ACCELERATION_BY_PERIOD, VELOCITY_BY_PERIOD][k], &self.modes[k], u));
        Amplification {
            ln_pfa,
            sd_ln_pfa: SCATTER_OF_ACCELERATION * resonant_a.sqrt(),
            ln_pfv,
            sd_ln_pfv: SCATTER_OF_VELOCITY * resonant_v.sqrt(),
            resonant_share: resonant_v,
        }
    }
}

/// ln of the factor of a peak at u = ln(T1 / Tg), and the share of resonance in its square.
fn ln_factor(peak: PeakByPeriod, modes: &[Mode; MODES], u: f64) -> (f64, f64) {
    let PeakByPeriod { b, k, d, e, l, h } = peak;
    let [by_k, by_l, by_h] = [k * (u - b), -l * (u - e), h * (u - e)].map(f64::exp);
    let (mut rigid, mut resonant) = (1.0, 0.0);
    for mode in modes {
        let r = 1.0 / (1.0 + by_k * mode.by_k);
        let resonance = d / (by_l * mode.by_l + by_h * mode.by_h);
        rigid -= mode.share * (1.0 - r);
        resonant += (mode.share * resonance).powi(2);
    }
    let square = rigid * rigid + resonant;
    (0.5 * square.ln(), resonant / square)
}
