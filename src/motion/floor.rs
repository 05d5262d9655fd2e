//! Floors of buildings: the motion of one, and its peaks from those of the ground. The building is a linear
//! uniform shear beam; its modes i = 1 to 5 have periods T1/(2i - 1) and at height z (of the roof) the shares
//! G_i = 4/((2i - 1) pi) sin((2i - 1) pi z/2).

use std::f64::consts::{PI, TAU};

use super::measures::Oscillator;

/// A floor of a building, or the ground: level 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// First period of the building, s.
    pub period_s: f64,
    /// Height over that of the roof, 0 to 1.
    pub level: f64,
}

/// What the peaks of a floor are, given those of the ground: medians, and scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FloorPeaks {
    /// Peak floor acceleration, m/s2.
    pub pfa_m_s2: f64,
    /// Peak floor velocity, m/s.
    pub pfv_m_s: f64,
    /// Standard deviation of ln PFA.
    pub sd_ln_pfa: f64,
    /// Standard deviation of ln PFV; the correlation of both is [`CORRELATION`].
    pub sd_ln_pfv: f64,
    /// Share of resonance in the squared velocity, 0 on the ground: how narrow the band of its motion is.
    pub resonant_share: f64,
}

/// Correlation of the logarithms of a floor's peaks about their medians.
pub const CORRELATION: f64 = 0.58;
/// Modes: three give peak accelerations up to 30 % too low in long buildings.
const MODES: usize = 5;
/// Share of the first mode's motion that is left where a floor's record ends.
const LEFT: f64 = 0.05;

/// How a peak of a floor depends on u = ln(T1/Tg), by scripts/floors/peaks.py: [b, k, d, e, l, h]. The rigid
/// share of a mode is r = 1/(1 + exp(k (u - b))), its resonance D = d/(exp(-l (u - e)) + exp(h (u - e))).
const OF_ACCELERATION: [f64; 6] = [-0.090, 3.430, 3.635, 0.112, 0.434, 1.494];
const OF_VELOCITY: [f64; 6] = [0.930, 3.199, 3.569, -0.225, 1.574, 0.637];
/// Scatter s of both peaks, of a motion that is all resonance.
const SCATTER: [f64; 2] = [0.284, 0.314];

impl Floor {
    /// Shares G_i of the modes.
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

    /// Predicts the peaks of the floor from PGA (m/s2) and PGV (m/s) of the ground: ln(floor/ground) =
    /// ln(A^2 + B)/2 with the rigid part A = 1 - sum G_i (1 - r_i) and the resonant one B = sum G_i^2 D_i^2.
    pub fn peaks(&self, pga_m_s2: f64, pgv_m_s: f64) -> FloorPeaks {
        let period_of_ground = TAU * pgv_m_s / pga_m_s2;
        let u = (self.period_s / period_of_ground).ln();
        let (acceleration, resonant_a) = self.amplified(OF_ACCELERATION, u);
        let (velocity, resonant_v) = self.amplified(OF_VELOCITY, u);
        FloorPeaks {
            pfa_m_s2: acceleration * pga_m_s2,
            pfv_m_s: velocity * pgv_m_s,
            sd_ln_pfa: SCATTER[0] * resonant_a.sqrt(),
            sd_ln_pfv: SCATTER[1] * resonant_v.sqrt(),
            resonant_share: resonant_v,
        }
    }

    /// The factor of a peak, and the share of resonance in its square.
    fn amplified(&self, [b, k, d, e, l, h]: [f64; 6], u: f64) -> (f64, f64) {
        let (mut rigid, mut resonant) = (1.0, 0.0);
        for (i, share) in self.shares().into_iter().enumerate() {
            let of_mode = u - ((2 * i + 1) as f64).ln();
            let r = 1.0 / (1.0 + (k * (of_mode - b)).exp());
            let resonance = d / ((-l * (of_mode - e)).exp() + (h * (of_mode - e)).exp());
            rigid -= share * (1.0 - r);
            resonant += (share * resonance).powi(2);
        }
        let square = rigid * rigid + resonant;
        (square.sqrt(), resonant / square)
    }
}
