//! The pulse of Mavroeidis & Papageorgiou (Eq. 1) that is nearest to a recorded velocity, by separable least squares: Eq. 1
//! is linear in A cos nu and A sin nu, so that only period, gamma and time are searched.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::indicator::PERIODS_S;
use crate::motion::Pulse;

/// Where the search starts: gammas, periods as shares of the wavelet's, times from the wavelet's centre in periods.
const START_GAMMAS: [f64; 5] = [1.1, 1.5, 2.0, 2.7, 3.6];
const START_PERIODS: [f64; 9] = [0.55, 0.65, 0.76, 0.87, 1.0, 1.15, 1.32, 1.52, 1.8];
const START_TIMES: [f64; 9] = [-0.8, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6, 0.8];
/// The numbers of half cycles between which gamma lies. Eq. 1 needs more than 1.
const GAMMA: (f64, f64) = (1.0, 5.0);
/// Parts of a period over which the velocity is averaged: the pulse changes little within them.
const PARTS_OF_PERIOD: f64 = 100.0;
/// Steps of the search, and the relative gain below which it ends.
const MOST_STEPS: usize = 60;
const LEAST_GAIN: f64 = 1e-12;
/// Step of the derivatives by differences, in units of the search.
const DIFFERENCE: f64 = 1e-5;

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
    /// Finds the pulse nearest to a velocity (m/s) at steps of `dt_s`, searched from a period and a time (s) about which a
    /// wavelet found it. None if the velocity is zero.
    pub fn fit(velocity: &[f64], dt_s: f64, period_s: f64, time_s: f64) -> Option<FittedPulse> {
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
            .map(|(_, shape)| series.levenberg_marquardt(shape))?;
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

    /// Returns the pulse of the same record scaled by a factor.
    pub fn scaled(&self, factor: f64) -> FittedPulse {
        let pulse = Pulse { amplitude_m_s: factor * self.pulse.amplitude_m_s, ..self.pulse };
        FittedPulse { pulse, ..*self }
    }
}

/// The parameters in which Eq. 1 is not linear.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shape {
    tp_s: f64,
    gamma: f64,
    /// Time of the middle, s.
    t0_s: f64,
}

impl Shape {
    /// Moves the shape by steps in ln Tp, gamma and t0 / Tp, within the bounds.
    fn moved(&self, steps: &Vector3<f64>) -> Shape {
        Shape {
            tp_s: (self.tp_s * libm::exp(steps.x)).clamp(PERIODS_S.0, PERIODS_S.1),
            gamma: (self.gamma + steps.y).clamp(GAMMA.0, GAMMA.1),
            t0_s: self.t0_s + steps.z * self.tp_s,
        }
    }

    /// Computes the two functions of time that A cos nu and A sin nu multiply (Eq. 1, cos(x + nu) expanded).
    fn functions(&self, time_s: f64) -> (f64, f64) {
        let x = 2.0 * PI * (time_s - self.t0_s) / self.tp_s;
        if x.abs() > PI * self.gamma {
            return (0.0, 0.0);
        }
        let envelope = 0.5 * (1.0 + libm::cos(x / self.gamma));
        (envelope * libm::cos(x), -envelope * libm::sin(x))
    }
}

/// The parameters in which Eq. 1 is linear, and how much of the squared velocity the pulse explains.
struct Linear {
    /// A cos nu, m/s.
    cosine: f64,
    /// A sin nu, m/s.
    sine: f64,
    /// Part of the sum of the squared velocities.
    explained: f64,
}

/// A velocity as means over equal parts of time, which are as good as its samples for a pulse that hardly changes within
/// them.
struct Series {
    means: Vec<f64>,
    /// Middle of the first part, s.
    first_s: f64,
    /// Length of a part, s.
    step_s: f64,
    /// Sum of the squares of the means.
    energy: f64,
}

impl Series {
    /// Averages a velocity (m/s) at steps of `dt_s` for pulses of about this period (s).
    fn of(velocity: &[f64], dt_s: f64, period_s: f64) -> Series {
        let samples = ((period_s / PARTS_OF_PERIOD / dt_s) as usize).max(1);
        let mean = |part: &[f64]| part.iter().sum::<f64>() / samples as f64;
        let means: Vec<f64> = velocity.chunks_exact(samples).map(mean).collect();
        let energy = means.iter().map(|v| v * v).sum();
        Series { means, first_s: 0.5 * (samples - 1) as f64 * dt_s, step_s: samples as f64 * dt_s, energy }
    }

    fn time_s(&self, part: usize) -> f64 {
        self.first_s + part as f64 * self.step_s
    }

    /// Iterates over times and velocities where the pulse is not zero.
    fn inside(&self, shape: &Shape) -> impl Iterator<Item = (f64, f64)> {
        let half = 0.5 * shape.gamma * shape.tp_s;
        let part = |time_s: f64| ((time_s - self.first_s) / self.step_s).max(0.0) as usize;
        let (first, last) = (part(shape.t0_s - half), part(shape.t0_s + half));
        let inside = self.means.iter().enumerate().take(last.saturating_add(2)).skip(first);
        inside.map(|(k, v)| (self.time_s(k), *v))
    }

    /// Sums the normal equations of A cos nu and A sin nu: the matrix (three numbers, being symmetric) and the right side.
    fn normal(&self, shape: &Shape) -> ([f64; 3], [f64; 2]) {
        let (mut matrix, mut right) = ([0.0; 3], [0.0; 2]);
        for (time_s, v) in self.inside(shape) {
            let (c, s) = shape.functions(time_s);
            matrix[0] += c * c;
            matrix[1] += c * s;
            matrix[2] += s * s;
            right[0] += c * v;
            right[1] += s * v;
        }
        (matrix, right)
    }

    /// Finds the best pulse of a shape.
    fn solve(&self, shape: &Shape) -> Linear {
        let ([cc, cs, ss], [cv, sv]) = self.normal(shape);
        let determinant = cc * ss - cs * cs;
        // Both functions are alike where only a few samples lie within the pulse.
        if determinant <= 1e-12 * cc * ss {
            return Linear { cosine: 0.0, sine: 0.0, explained: 0.0 };
        }
        let (cosine, sine) = ((ss * cv - cs * sv) / determinant, (cc * sv - cs * cv) / determinant);
        Linear { cosine, sine, explained: cosine * cv + sine * sv }
    }

    /// Computes what the best pulse of a shape leaves of the velocity.
    fn residual(&self, shape: &Shape) -> Vec<f64> {
        let Linear { cosine, sine, .. } = self.solve(shape);
        let left = |(k, v): (usize, &f64)| {
            let (c, s) = shape.functions(self.time_s(k));
            v - cosine * c - sine * s
        };
        self.means.iter().enumerate().map(left).collect()
    }

    /// Improves a shape by the steps of Levenberg and Marquardt until nothing is gained.
    fn levenberg_marquardt(&self, mut shape: Shape) -> Shape {
        let mut damping = 1e-3;
        let mut explained = self.solve(&shape).explained;
        for _ in 0..MOST_STEPS {
            let (matrix, gradient) = self.derivatives(&shape);
            let damped = matrix + Matrix3::from_diagonal(&matrix.diagonal()) * damping;
            let Some(step) = damped.lu().solve(&gradient) else { break };
            let next = shape.moved(&step);
            let gain = self.solve(&next).explained - explained;
            // Gauss and Newton's step where it gains, the steeper one of the gradient where it does not.
            if gain > 0.0 {
                (shape, explained) = (next, explained + gain);
                damping *= 0.2;
            } else {
                damping *= 5.0;
            }
            if (0.0..LEAST_GAIN * self.energy).contains(&gain) || damping > 1e9 {
                break;
            }
        }
        shape
    }

    /// Computes J'J and -J'r of the residual with respect to the steps, J by central differences.
    fn derivatives(&self, shape: &Shape) -> (Matrix3<f64>, Vector3<f64>) {
        let residual = self.residual(shape);
        let columns: [Vec<f64>; 3] = std::array::from_fn(|axis| {
            let mut step = Vector3::zeros();
            step[axis] = DIFFERENCE;
            let (ahead, behind) = (self.residual(&shape.moved(&step)), self.residual(&shape.moved(&-step)));
            ahead.iter().zip(behind).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
        });
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let matrix = Matrix3::from_fn(|row, column| dot(&columns[row], &columns[column]));
        (matrix, Vector3::from_fn(|row, _| -dot(&columns[row], &residual)))
    }
}
