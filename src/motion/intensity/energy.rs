use std::f64::consts::PI;

use crate::units::G_M_S2;

/// Arias intensity, m/s: pi/(2 g) times the trapezoidal integral of a^2.
pub fn arias_intensity(acceleration: &[f64], dt_s: f64) -> f64 {
    0.5 * PI / G_M_S2 * trapezoids(acceleration, dt_s, |a| a * a).sum::<f64>()
}

/// Cumulative absolute velocity, m/s: the trapezoidal integral of |a|.
pub fn cumulative_absolute_velocity(acceleration: &[f64], dt_s: f64) -> f64 {
    trapezoids(acceleration, dt_s, f64::abs).sum()
}

/// Significant duration, s: between the moments at which the shares `from` and `to` of the Arias intensity have come;
/// within a time step it grows linearly. 0 for a motion without energy.
pub fn significant_duration(acceleration: &[f64], dt_s: f64, from: f64, to: f64) -> f64 {
    let total: f64 = trapezoids(acceleration, dt_s, |a| a * a).sum();
    let moment = |share: f64| {
        let mut so_far = 0.0;
        for (step, area) in trapezoids(acceleration, dt_s, |a| a * a).enumerate() {
            if so_far + area >= share * total && area > 0.0 {
                return dt_s * (step as f64 + (share * total - so_far) / area);
            }
            so_far += area;
        }
        0.0
    };
    moment(to) - moment(from)
}

fn trapezoids(acceleration: &[f64], dt_s: f64, height: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
    acceleration.windows(2).map(move |pair| 0.5 * dt_s * (height(pair[0]) + height(pair[1])))
}
