//! Fit of the pulse of Mavroeidis & Papageorgiou (Eq. 1) to a recorded velocity. The pulse is linear in A cos
//! nu and A sin nu, which follow from normal equations (variable projection); period, gamma and time are
//! searched by the Nelder-Mead simplex.

use std::f64::consts::PI;

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::neldermead::NelderMead;
use argmin_math::{ArgminAdd, ArgminMul, ArgminSub};
use nalgebra::Vector3;

use super::indicator::PERIODS_S;
use crate::motion::Pulse;

/// Candidate starts: gammas; periods and times from the centre, in periods of the wavelet.
const START_GAMMAS: [f64; 3] = [1.2, 2.0, 3.2];
const START_PERIODS: [f64; 5] = [0.6, 0.78, 1.0, 1.28, 1.65];
const START_TIMES: [f64; 7] = [-0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75];
/// Number of searches, from the best starts.
const SEARCHES: usize = 3;
/// Sides of the initial simplex, in periods, gamma, and times in periods.
const SIDES: [f64; 3] = [0.1, 0.3, 0.1];
/// Range of gamma; the pulse (Eq. 1) needs more than 1.
const GAMMA: (f64, f64) = (1.0, 5.0);
/// Averaging intervals per period: the pulse changes little within one.
const PARTS_OF_PERIOD: f64 = 100.0;
/// Largest number of steps of a search, and relative spread of the simplex at its end.
const MOST_STEPS: u64 = 300;
const TOLERANCE: f64 = 1e-10;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedPulse {
    pub pulse: Pulse,
    /// Time t0 of its middle from the first sample, s.
    pub t0_s: f64,
    /// Explained share of the squared velocity.
    pub r2: f64,
}

impl FittedPulse {
    /// Fits a velocity (m/s) at steps of `dt_s`, from period and time (s) of a wavelet; none if it is zero.
    pub fn fit(velocity: &[f64], dt_s: f64, period_s: f64, time_s: f64) -> Option<FittedPulse> {
        let series = Series::new(velocity, dt_s, period_s);
        let mut starts = Vec::new();
        for gamma in START_GAMMAS {
            for share in START_PERIODS {
                for shift in START_TIMES {
                    let place =
                        PulseParameters(Vector3::new(share * period_s, gamma, time_s + shift * period_s));
                    starts.push((series.nearest(&place).1, place));
                }
            }
        }
        starts.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let found = starts.iter().take(SEARCHES);
        let found = found.filter_map(|(explained, place)| series.search(place, *explained));
        let best = found.max_by(|a, b| series.nearest(a).1.total_cmp(&series.nearest(b).1))?;
        let ((pulse, _), t0_s) = (series.nearest(&best), best.0.z);
        let left = velocity.iter().enumerate().map(|(k, v)| v - pulse.velocity_m_s(k as f64 * dt_s - t0_s));
        let residual: f64 = left.map(|left| left.powi(2)).sum();
        let r2 = 1.0 - residual / velocity.iter().map(|v| v * v).sum::<f64>();
        r2.is_finite().then_some(FittedPulse { pulse, t0_s, r2 })
    }
}

/// A velocity as means over equal intervals, within which a pulse hardly changes.
struct Series {
    means: Vec<f64>,
    /// Middle of the first interval, s.
    first_s: f64,
    step_s: f64,
}

impl Series {
    /// Averages a velocity (m/s) at steps of `dt_s` for pulses of about `period_s`.
    fn new(velocity: &[f64], dt_s: f64, period_s: f64) -> Series {
        let samples = ((period_s / PARTS_OF_PERIOD / dt_s) as usize).max(1);
        let sums = velocity.chunks_exact(samples).map(|part| part.iter().sum::<f64>());
        let means = sums.map(|sum| sum / samples as f64).collect();
        Series { means, first_s: 0.5 * (samples - 1) as f64 * dt_s, step_s: samples as f64 * dt_s }
    }

    /// Computes the pulse nearest to a period (s), gamma and time of its middle (s), clamped to their bounds,
    /// by the normal equations of A cos nu and A sin nu, and its explained sum of squares.
    fn nearest(&self, PulseParameters(place): &PulseParameters) -> (Pulse, f64) {
        let (tp_s, gamma) = (place.x.clamp(PERIODS_S.0, PERIODS_S.1), place.y.clamp(GAMMA.0, GAMMA.1));
        let (t0_s, half) = (place.z, 0.5 * gamma * tp_s);
        let part = |time_s: f64| ((time_s - self.first_s) / self.step_s).max(0.0) as usize;
        let [mut cc, mut cs, mut ss, mut cv, mut sv] = [0.0; 5];
        let last = part(t0_s + half).saturating_add(2);
        for (k, v) in self.means.iter().enumerate().take(last).skip(part(t0_s - half)) {
            let x = 2.0 * PI * (self.first_s + k as f64 * self.step_s - t0_s) / tp_s;
            if x.abs() <= PI * gamma {
                // The pulse (Eq. 1) with cos(x + nu) expanded.
                let envelope = 0.5 * (1.0 + (x / gamma).cos());
                let (c, s) = (envelope * x.cos(), -envelope * x.sin());
                (cc, cs, ss) = (cc + c * c, cs + c * s, ss + s * s);
                (cv, sv) = (cv + c * v, sv + s * v);
            }
        }
        let determinant = cc * ss - cs * cs;
        // With few samples in the pulse both functions are collinear.
        let is_sound = determinant > 1e-12 * cc * ss;
        let solved = ((ss * cv - cs * sv) / determinant, (cc * sv - cs * cv) / determinant);
        let (cosine, sine) = if is_sound { solved } else { (0.0, 0.0) };
        let pulse = Pulse { amplitude_m_s: cosine.hypot(sine), tp_s, gamma, nu_rad: sine.atan2(cosine) };
        (pulse, cosine * cv + sine * sv)
    }

    /// Maximises the explained sum of squares from a start, where it is `explained`.
    fn search(&self, PulseParameters(start): &PulseParameters, explained: f64) -> Option<PulseParameters> {
        let sides = Vector3::new(SIDES[0] * start.x, SIDES[1], SIDES[2] * start.x);
        let corners =
            (0..3).map(|axis| PulseParameters(start + sides.component_mul(&Vector3::ith(axis, 1.0))));
        let simplex = corners.chain([PulseParameters(*start)]).collect();
        let solver = NelderMead::new(simplex).with_sd_tolerance(TOLERANCE * explained).ok()?;
        let search = Executor::new(self, solver).timer(false).configure(|state| state.max_iters(MOST_STEPS));
        search.run().ok()?.state.take_best_param()
    }
}

impl CostFunction for &Series {
    type Param = PulseParameters;
    type Output = f64;

    fn cost(&self, place: &PulseParameters) -> Result<f64, Error> {
        Ok(-self.nearest(place).1)
    }
}

/// Period (s), gamma, and time of the middle (s) of a pulse, with the operations that argmin needs.
#[derive(Clone)]
struct PulseParameters(Vector3<f64>);

impl ArgminAdd<PulseParameters, PulseParameters> for PulseParameters {
    fn add(&self, other: &PulseParameters) -> PulseParameters {
        PulseParameters(self.0 + other.0)
    }
}

impl ArgminSub<PulseParameters, PulseParameters> for PulseParameters {
    fn sub(&self, other: &PulseParameters) -> PulseParameters {
        PulseParameters(self.0 - other.0)
    }
}

impl ArgminMul<f64, PulseParameters> for PulseParameters {
    fn mul(&self, factor: &f64) -> PulseParameters {
        PulseParameters(self.0 * *factor)
    }
}
