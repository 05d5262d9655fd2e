//! Section 2.2 as the paper prints it, for one structure and in small steps: the readable form of the solver.
//! The equation of motion is theta'' = -p^2 [sin(alpha sgn theta - theta) + a/g cos(alpha sgn theta -
//! theta)] (Eq. 4), from uplift at |a| = g tan alpha (Eq. 5) on; at an impact theta'+ = eta theta'- (Eq. 6).
//!
//! [`simulate_all`](super::simulate_all) solves the same equations by Taylor series in vector registers,
//! hundreds of times faster; a test compares each with quadruple precision.

use std::f64::consts::FRAC_PI_2;

use super::record::Record;
use super::response::{Response, free_rocking};
use super::structure::Structure;
use super::taylor::{MOST_IMPACTS, REST_VELOCITY, RockingState};
use super::uplift::Uplift;
use crate::spelling::unknown_word;
use crate::statistics::numerics::bisect_first_true;
use crate::units::G_PER_M_S2;

/// Longest step, as p h sqrt(1 + PGA/g): truncation changes the median peak by 1e-12 of itself.
const LONGEST_STEP: f64 = 5e-4;

/// A rocking structure: its side (1 or -1), rotation theta (rad) and angular velocity theta' (rad/s).
#[derive(Clone, Copy, Default)]
struct Rocking {
    side: f64,
    theta: f64,
    velocity: f64,
}

/// theta'', rad/s2 (Eq. 4); `ground` is the ground acceleration over g.
fn angular_acceleration(structure: &Structure, side: f64, theta: f64, ground: f64) -> f64 {
    let p2 = structure.p_rad_s * structure.p_rad_s;
    let angle = structure.alpha_rad * side - theta;
    -p2 * (angle.sin() + ground * angle.cos())
}

/// Finds the uplift (Eq. 5) of a structure at rest while the ground acceleration over g goes linearly from
/// `now` to `next` in `left` seconds: the time until |a|/g = tan alpha, and the state then. The structure
/// leans opposite to the acceleration.
fn uplift(structure: &Structure, now: f64, next: f64, left: f64) -> Option<(f64, Rocking)> {
    let Uplift { fraction, ground, .. } = Uplift::between(now, next, structure.alpha_rad.tan())?;
    Some((fraction * left, Rocking { side: -ground.signum(), theta: 0.0, velocity: 0.0 }))
}

/// Computes the state after an impact, on the other side: theta'+ = eta theta'- (Eq. 6).
fn impact(structure: &Structure, before: Rocking) -> Rocking {
    Rocking { side: -before.side, theta: 0.0, velocity: structure.eta * before.velocity }
}

/// Integrates the equation of motion (Eq. 4) over `h` seconds by the classical Runge-Kutta method; `ground`
/// is the ground acceleration over g as a function of time from the start of the step.
fn step(structure: &Structure, from: Rocking, ground: impl Fn(f64) -> f64, h: f64) -> Rocking {
    let Rocking { side, theta, velocity } = from;
    let acceleration = |time: f64, theta: f64| angular_acceleration(structure, side, theta, ground(time));
    let k1 = acceleration(0.0, theta);
    let k2 = acceleration(0.5 * h, theta + 0.5 * h * velocity);
    let k3 = acceleration(0.5 * h, theta + 0.5 * h * velocity + 0.25 * h * h * k1);
    let k4 = acceleration(h, theta + h * velocity + 0.5 * h * h * k2);
    let theta = theta + h * velocity + h * h / 6.0 * (k1 + k2 + k3);
    Rocking { side, theta, velocity: velocity + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4) }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<SolverEvent>)]
pub enum SolverEvent {
    /// The structure leaves its base.
    Uplift,
    /// The structure strikes its base and continues on the other side.
    Impact,
    Rest,
    /// Its rotation reaches pi/2.
    Overturn,
}

/// A point of a traced response: a sample of the record, or an event between two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    pub time_s: f64,
    /// Rotation theta, rad; a positive ground acceleration turns a structure at rest to negative theta.
    pub theta_rad: f64,
    /// Angular velocity, rad/s; after an impact, if there is one.
    pub theta_dot_rad_s: f64,
    /// Event; none at a sample of the record.
    pub solver_event: Option<SolverEvent>,
}

/// Simulates a structure, initially at rest, through a record and the free rocking after it. The points are
/// each sample and event of the record and of the `tail_s` seconds of still ground after it, in steps of the
/// record, up to where theta reaches pi/2.
pub fn trace(structure: &Structure, record: &Record, tail_s: f64) -> (Response, Vec<TracePoint>) {
    let (samples, dt_s, alpha) = (record.acceleration_m_s2(), record.dt_s(), structure.alpha_rad);
    let still = std::iter::repeat_n([0.0; 2], (tail_s / dt_s).ceil() as usize);
    let steps: Vec<[f64; 2]> = samples.array_windows().copied().chain(still).collect();
    let longest_s = LONGEST_STEP / (structure.p_rad_s * (1.0 + record.peak_m_s2() * G_PER_M_S2).sqrt());
    let (mut state, mut peak, mut impacts, mut uplifted) = (None, 0.0_f64, 0, false);
    let mut points = Vec::new();
    let mut note = |time_s: f64, state: Option<Rocking>, solver_event| {
        let Rocking { theta, velocity, .. } = state.unwrap_or_default();
        points.push(TracePoint { time_s, theta_rad: theta, theta_dot_rad_s: velocity, solver_event });
    };
    for (k, [from, to]) in steps.iter().enumerate() {
        let ground = |t: f64| (from + (to - from) * t / dt_s) * G_PER_M_S2;
        let (sample_s, mut t, most_impacts) = (k as f64 * dt_s, 0.0, impacts + MOST_IMPACTS);
        note(sample_s, state, None);
        while t < dt_s {
            let Some(now) = state else {
                let soon = uplift(structure, ground(t), ground(dt_s), dt_s - t);
                let Some((wait, start)) = soon.filter(|_| impacts < most_impacts) else { break };
                (t, state, uplifted) = (t + wait, Some(start), true);
                note(sample_s + t, state, Some(SolverEvent::Uplift));
                continue;
            };
            let at = |h: f64| step(structure, now, |after| ground(t + after), h);
            let strikes = |at: Rocking| now.side * at.theta < 0.0;
            let overturns = |at: Rocking| now.side * at.theta >= FRAC_PI_2;
            let returns = |at: Rocking| now.side * at.velocity < 0.0;
            let mut h = longest_s.min(dt_s - t);
            if strikes(at(h)) || overturns(at(h)) {
                h = bisect_first_true(0.0, h, |h| strikes(at(h)) || overturns(at(h)));
            }
            let next = at(h);
            let top = if returns(next) && !returns(now) {
                at(bisect_first_true(0.0, h, |h| returns(at(h))))
            } else {
                next
            };
            (t, state, peak) = (t + h, Some(next), peak.max(now.side * top.theta));
            if overturns(next) {
                note(sample_s + t, state, Some(SolverEvent::Overturn));
                return (Response::after_rocking(None, peak, alpha, impacts), points);
            }
            if strikes(next) {
                let after = impact(structure, next);
                impacts += 1;
                note(sample_s + t, Some(after), Some(SolverEvent::Impact));
                let rocks = after.velocity.abs() >= REST_VELOCITY * structure.p_rad_s;
                state = Some(after).filter(|_| rocks && impacts < most_impacts);
                if state.is_none() {
                    note(sample_s + t, None, Some(SolverEvent::Rest));
                }
            }
        }
    }
    note(steps.len() as f64 * dt_s, state, None);
    let Rocking { side, theta, velocity } = state.unwrap_or_default();
    let later = free_rocking(
        RockingState { rotation: side * theta, velocity: side * velocity / structure.p_rad_s },
        alpha,
        structure.eta,
    );
    let rocked = Response::after_rocking(later, peak, alpha, impacts);
    (if uplifted { rocked } else { Response::NO_ROCKING }, points)
}
