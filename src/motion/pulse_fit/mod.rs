//! The pulse of Mavroeidis & Papageorgiou (Eq. 1) that is nearest to a recorded velocity, by separable least squares: Eq. 1
//! is linear in A cos nu and A sin nu, so that only period, gamma and time are searched.

mod least_squares;

use self::least_squares::{Linear, Series, Shape};
use super::pulse::Pulse;
use super::pulse_indicator::PERIODS_S;

/// Where the search starts: gammas, periods as shares of the given one, times from the given one in periods.
const START_GAMMAS: [f64; 5] = [1.1, 1.5, 2.0, 2.7, 3.6];
const START_PERIODS: [f64; 9] = [0.55, 0.65, 0.76, 0.87, 1.0, 1.15, 1.32, 1.52, 1.8];
const START_TIMES: [f64; 9] = [-0.8, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6, 0.8];
/// A pulse fitted to a series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedPulse {
    /// Amplitude A, period, gamma and phase.
    pub pulse: Pulse,
    /// Time t0 of its middle from the first sample, s.
    pub t0_s: f64,
    /// Share of the squared velocity that it explains.
    pub r2: f64,
}

impl FittedPulse {
    /// The pulse nearest to a velocity (m/s) at steps of `dt_s`, searched from a period and a time (s) about which a
    /// wavelet found it. None if the velocity is zero.
    pub fn to(velocity: &[f64], dt_s: f64, period_s: f64, time_s: f64) -> Option<FittedPulse> {
        let series = Series::of(velocity, dt_s, period_s);
        let starts = START_GAMMAS.iter().flat_map(|&gamma| {
            START_PERIODS.iter().flat_map(move |&share| {
                START_TIMES.iter().map(move |&shift| Shape {
                    tp_s: (share * period_s).clamp(PERIODS_S.0, PERIODS_S.1),
                    gamma,
                    t0_s: time_s + shift * period_s,
                })
            })
        });
        let best = starts
            .map(|shape| (series.solve(&shape).explained, shape))
            .max_by(|(a, _), (b, _)| a.total_cmp(b))
            .map(|(_, shape)| series.climb(shape))?;
        let Linear { cosine, sine, .. } = series.solve(&best);
        let pulse = Pulse {
            amplitude_m_s: libm::hypot(cosine, sine),
            tp_s: best.tp_s,
            gamma: best.gamma,
            nu_rad: libm::atan2(sine, cosine),
        };
        let left = |(k, v): (usize, &f64)| (v - pulse.velocity_m_s(k as f64 * dt_s - best.t0_s)).powi(2);
        let residual: f64 = velocity.iter().enumerate().map(left).sum();
        let r2 = 1.0 - residual / velocity.iter().map(|v| v * v).sum::<f64>();
        r2.is_finite().then_some(FittedPulse { pulse, t0_s: best.t0_s, r2 })
    }

    /// The pulse of the same record scaled by a factor.
    pub fn scaled(&self, factor: f64) -> FittedPulse {
        let pulse = Pulse { amplitude_m_s: factor * self.pulse.amplitude_m_s, ..self.pulse };
        FittedPulse { pulse, ..*self }
    }
}
