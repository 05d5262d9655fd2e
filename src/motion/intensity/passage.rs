use pulp::NullaryFnOnce;

use super::{larger, peak, trapezoid};
use crate::wide::widest;

/// Samples whose steps and peaks are worked out at once, in wide registers.
const BLOCK: usize = 256;

/// Trapezoidal integrals of a motion up to a sample, and the peaks so far: all in one pass.
#[derive(Default)]
pub struct Passage {
    velocity_m_s: f64,
    displacement_m: f64,
    energy: f64,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Peak ground displacement, m.
    pub pgd_m: f64,
    /// Integral of |a|, m/s.
    pub cav_m_s: f64,
}

impl Passage {
    /// With the integral of a^2 to each sample, of which the first is 0, m2/s3.
    pub fn through(acceleration: &[f64], dt_s: f64, energy: &mut [f64]) -> Passage {
        widest(Integration { acceleration, dt_s, energy })
    }
}

/// A passage before it is done.
struct Integration<'a> {
    acceleration: &'a [f64],
    dt_s: f64,
    energy: &'a mut [f64],
}

impl NullaryFnOnce for Integration<'_> {
    type Output = Passage;

    #[inline(always)]
    fn call(self) -> Passage {
        let Integration { acceleration, dt_s, energy } = self;
        let mut p = Passage { pga_m_s2: peak(acceleration), ..Passage::default() };
        let [mut velocity, mut displacement, mut cav] = [[0.0; BLOCK]; 3];
        for (block, energy) in energy.get_mut(1..).unwrap_or_default().chunks_mut(BLOCK).enumerate() {
            let samples = energy.len();
            let left = &acceleration[block * BLOCK..][..samples];
            let right = &acceleration[block * BLOCK + 1..][..samples];
            for k in 0..samples {
                velocity[k] = trapezoid(dt_s, left[k], right[k]);
                energy[k] = trapezoid(dt_s, left[k] * left[k], right[k] * right[k]);
                cav[k] = trapezoid(dt_s, left[k].abs(), right[k].abs());
            }
            // Each waits for its own last value.
            for k in 0..samples {
                let velocity_m_s = p.velocity_m_s + velocity[k];
                p.displacement_m += trapezoid(dt_s, p.velocity_m_s, velocity_m_s);
                p.velocity_m_s = velocity_m_s;
                p.energy += energy[k];
                p.cav_m_s += cav[k];
                (velocity[k], displacement[k], energy[k]) = (velocity_m_s, p.displacement_m, p.energy);
            }
            p.pgv_m_s = larger(p.pgv_m_s, peak(&velocity[..samples]));
            p.pgd_m = larger(p.pgd_m, peak(&displacement[..samples]));
        }
        p
    }
}
