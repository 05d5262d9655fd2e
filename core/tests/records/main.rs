//! The science of records: processing, rotation, pulses, plausibility.

use std::f64::consts::PI;

mod plausibility;
mod processing;
mod pulses;
mod references;
#[path = "../shared/mod.rs"]
mod shared;

const G: f64 = 9.81;
const DT: f64 = 0.01;

/// A motion of about 0.3 g and 0.28 m/s that begins and ends at rest, m/s2.
fn motion(n: usize) -> Vec<f64> {
    let time = |k: usize| (k as f64 - 0.5 * n as f64) * DT;
    (0..n).map(time).map(|t| 3.0 * (-(t / 3.0).powi(2)).exp() * (2.0 * PI * 1.7 * t + 0.4).sin()).collect()
}
