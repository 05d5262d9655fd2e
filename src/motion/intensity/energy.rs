use std::f64::consts::PI;

use super::passage::Passage;
use super::trapezoid;
use crate::units::G_M_S2;

/// Arias intensity, m/s: pi/(2 g) times the trapezoidal integral of a^2.
pub fn arias_intensity(acceleration: &[f64], dt_s: f64) -> f64 {
    arias_of(trapezoids(acceleration, dt_s, |a| a * a).sum())
}

/// Arias intensity, m/s, of the integral of a^2, m2/s3.
pub(super) fn arias_of(energy: f64) -> f64 {
    0.5 * PI / G_M_S2 * energy
}

/// Cumulative absolute velocity, m/s: the trapezoidal integral of |a|.
pub fn cumulative_absolute_velocity(acceleration: &[f64], dt_s: f64) -> f64 {
    trapezoids(acceleration, dt_s, f64::abs).sum()
}

/// Significant duration, s: between the moments at which the shares `from` and `to` of the Arias intensity have come;
/// within a time step it grows linearly. 0 for a motion without energy.
pub fn significant_duration(acceleration: &[f64], dt_s: f64, from: f64, to: f64) -> f64 {
    let mut energy = vec![0.0; acceleration.len()];
    Passage::through(acceleration, dt_s, &mut energy);
    moment(&energy, dt_s, to) - moment(&energy, dt_s, from)
}

/// When a share of the last value of a running integral has come, s.
pub(super) fn moment(energy: &[f64], dt_s: f64, share: f64) -> f64 {
    let Some(&total) = energy.last().filter(|total| **total > 0.0) else { return 0.0 };
    let reached = share * total;
    let after = energy.partition_point(|sum| *sum < reached).max(1);
    let (before, sum) = (energy[after - 1], energy[after]);
    dt_s * ((after - 1) as f64 + (reached - before) / (sum - before))
}

fn trapezoids(acceleration: &[f64], dt_s: f64, height: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
    acceleration.windows(2).map(move |pair| trapezoid(dt_s, height(pair[0]), height(pair[1])))
}
