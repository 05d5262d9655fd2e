use std::f64::consts::PI;

/// Periods at which the Housner intensity is integrated, s: 0.1 to 2.5.
const HOUSNER_PERIODS: (f64, f64, usize) = (0.1, 2.5, 49);
/// Damping ratio of the Housner intensity.
const HOUSNER_DAMPING: f64 = 0.05;

/// Pseudo-spectral acceleration, m/s2: (2 pi / T)^2 times the largest relative displacement of a linear oscillator of
/// period `period_s` and damping ratio `damping` (0 to below 1), exact for an acceleration that is linear between samples (Nigam &
/// Jennings 1969).
pub fn spectral_acceleration(acceleration: &[f64], dt_s: f64, period_s: f64, damping: f64) -> f64 {
    let w = 2.0 * PI / period_s;
    let wd = w * (1.0 - damping * damping).sqrt();
    let decay = libm::exp(-damping * w * dt_s);
    let (sin, cos) = (libm::sin(wd * dt_s), libm::cos(wd * dt_s));
    let (mut displacement, mut velocity, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for pair in acceleration.windows(2) {
        let slope = (pair[1] - pair[0]) / dt_s;
        // The particular solution of u'' + 2 z w u' + w^2 u = -(a0 + slope t) is linear; the rest decays freely.
        let linear = -slope / (w * w);
        let constant = -pair[0] / (w * w) - 2.0 * damping / w * linear;
        let free = displacement - constant;
        let free_rate = (velocity - linear + damping * w * free) / wd;
        displacement = decay * (free * cos + free_rate * sin) + constant + linear * dt_s;
        velocity = decay
            * ((free_rate * wd - damping * w * free) * cos - (free * wd + damping * w * free_rate) * sin)
            + linear;
        largest = largest.max(displacement.abs());
    }
    w * w * largest
}

/// Housner intensity, m: the trapezoidal integral of the pseudo-velocity spectrum at 5 % damping over the periods 0.1 to 2.5 s.
pub fn housner_intensity(acceleration: &[f64], dt_s: f64) -> f64 {
    let (first, last, points) = HOUSNER_PERIODS;
    let step = (last - first) / (points - 1) as f64;
    let pseudo_velocity = |k: usize| {
        let period = first + k as f64 * step;
        spectral_acceleration(acceleration, dt_s, period, HOUSNER_DAMPING) * period / (2.0 * PI)
    };
    let weight = |k: usize| if k == 0 || k == points - 1 { 0.5 } else { 1.0 };
    (0..points).map(|k| weight(k) * step * pseudo_velocity(k)).sum()
}
