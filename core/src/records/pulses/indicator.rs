//! Pulse indicator of one component, after Baker (2007), "Quantitative classification of near-fault ground
//! motions using wavelet analysis", BSSA 97(5).

use super::wavelet::{Wavelet, WaveletTransform};
use crate::motion::measures::peak;
use crate::records::rotation::Parts;
use crate::spelling::unknown_word;

// The least indicator and peak velocity, and the early arrival, of a pulse are those of Baker (2007).
pub const PERIODS_S: (f64, f64) = (0.25, 15.0);
/// Number of periods of the scan, in equal ratios, and subdivisions of an interval about a local maximum.
const PERIODS: usize = 60;
const REFINED: usize = 20;
/// Local maxima of at least this share of the largest square are refined; no other can become the largest.
const LEAST_PEAK: f64 = 0.9;
const WAVELETS: usize = 10;
/// Largest distance of the other wavelets from the first, as a fraction of its scale (period times 5/7).
const REACH: f64 = 10.0 / 25.0 * 5.0 / 7.0;
/// Largest time step of the search, s, unless the record is coarser: 12 steps in the shortest period.
const STEP_S: f64 = 0.02;
const THRESHOLD: f64 = 0.85;
const LEAST_PGV_M_S: f64 = 0.3;
/// A pulse is early if the first share of its squared velocity precedes the second share of the record's.
const EARLY: (f64, f64) = (0.10, 0.20);

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PulseIndicator {
    /// From 0 (no pulse) to 1 (a pulse); see [`indicator`].
    pub indicator: f64,
    pub period_s: f64,
    /// Middle of its strongest wavelet, s.
    pub centre_s: f64,
    /// Whether the record has a pulse, and if not, why.
    pub verdict: Verdict,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Verdict>)]
pub enum Verdict {
    /// There is an early pulse.
    Pulse,
    /// The indicator is too low.
    NoPulse,
    /// The pulse is late, and so no effect of directivity.
    Late,
    /// The peak velocity is below 0.3 m/s.
    Weak,
}

impl PulseIndicator {
    /// Computes the indicator of a velocity (m/s) at steps of `dt_s`; none if it is zero.
    pub fn of(velocity: &[f64], dt_s: f64) -> Option<PulseIndicator> {
        let (period_s, centre) = strongest_wavelet(&[velocity], dt_s)?;
        // Baker's predictors: ratios of peak velocity and energy without the pulse.
        let pulse = extract(velocity, dt_s, period_s, centre);
        let residual: Vec<f64> = velocity.iter().zip(&pulse).map(|(v, p)| v - p).collect();
        let pgv = peak(velocity);
        let indicator = indicator(peak(&residual) / pgv, energy(&residual) / energy(velocity));
        let early = sample_of_share(&pulse, EARLY.0) < sample_of_share(velocity, EARLY.1);
        let verdict = match (indicator > THRESHOLD, pgv >= LEAST_PGV_M_S, early) {
            (false, _, _) => Verdict::NoPulse,
            (true, false, _) => Verdict::Weak,
            (true, true, false) => Verdict::Late,
            (true, true, true) => Verdict::Pulse,
        };
        Some(PulseIndicator { indicator, period_s, centre_s: centre as f64 * dt_s, verdict })
    }
}

/// Computes Baker's logistic regression, 1 / (1 + exp(-23.3 + 14.6 r + 20.5 e)), of the ratios r of peak
/// velocities and e of energies, of the record without the pulse to the record.
pub fn indicator(pgv_ratio: f64, energy_ratio: f64) -> f64 {
    1.0 / (1.0 + (-23.3 + 14.6 * pgv_ratio + 20.5 * energy_ratio).exp())
}

/// Finds the direction in which two velocities (m/s) at right angles have the largest wavelet coefficient
/// (Shahi & Baker 2014): its parts along both. None if they are zero.
pub fn strongest_direction(velocities: [&[f64]; 2], dt_s: f64) -> Option<Parts> {
    let (period_s, centre) = strongest_wavelet(&velocities, dt_s)?;
    let wavelet = Wavelet::new(period_s, dt_s);
    let [first, second] = velocities.map(|velocity| wavelet.coefficient(velocity, centre));
    Some(Parts { first, second })
}

/// Finds the period (s) and central sample of the wavelet with the largest sum of squared coefficients over
/// the velocities, refined from each local maximum over the periods, since two of nearly equal height may be
/// far apart. None if the velocities are zero.
fn strongest_wavelet(velocities: &[&[f64]], dt_s: f64) -> Option<(f64, i64)> {
    let (shortest, longest) = PERIODS_S;
    let ratio = (longest / shortest).powf(1.0 / (PERIODS - 1) as f64);
    let period_s = |place: f64| (shortest * ratio.powf(place)).clamp(shortest, longest);
    let every = samples_in_step(dt_s);
    let dt_s = dt_s * every as f64;
    let velocities: Vec<Vec<f64>> =
        velocities.iter().map(|velocity| velocity.iter().step_by(every).copied().collect()).collect();
    let transform = WaveletTransform::new(&velocities, dt_s, longest);
    // Largest sum of squares at each period, and its sample.
    let mut scan = vec![(0.0, 0_i64); PERIODS];
    for (k, best) in scan.iter_mut().enumerate() {
        for (square, at) in transform.squares(period_s(k as f64)).into_iter().zip(0..) {
            if square > best.0 {
                *best = (square, at);
            }
        }
    }
    let largest = scan.iter().map(|(square, _)| *square).fold(0.0, f64::max);
    let square = |k: usize| scan.get(k).map_or(0.0, |(square, _)| *square);
    let peaks = (0..PERIODS).filter(|&k| {
        let beside = square(k.wrapping_sub(1)).max(square(k + 1));
        square(k) > 0.0 && square(k) >= beside.max(LEAST_PEAK * largest)
    });
    let refined = peaks.flat_map(|k| {
        let places = (0..=2 * REFINED).map(move |step| k as f64 + step as f64 / REFINED as f64 - 1.0);
        places.map(move |place| (period_s(place), k))
    });
    let squares = refined.map(|(period_s, k)| {
        let (wavelet, centre) = (Wavelet::new(period_s, dt_s), scan[k].1);
        let coefficients = velocities.iter().map(|velocity| wavelet.coefficient(velocity, centre).powi(2));
        (coefficients.sum::<f64>(), (period_s, centre * every as i64))
    });
    squares.max_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, strongest)| strongest)
}

fn samples_in_step(dt_s: f64) -> usize {
    ((STEP_S / dt_s) as usize).max(1)
}

/// Extracts the pulse: the strongest wavelet, then repeatedly the strongest near it in the remainder.
fn extract(velocity: &[f64], dt_s: f64, period_s: f64, centre: i64) -> Vec<f64> {
    let every = samples_in_step(dt_s);
    let step_s = dt_s * every as f64;
    let (coarse, fine) = (Wavelet::new(period_s, step_s), Wavelet::new(period_s, dt_s));
    let mut rest: Vec<f64> = velocity.iter().step_by(every).copied().collect();
    let mut pulse = vec![0.0; velocity.len()];
    let (reach, centre) = ((REACH * period_s / step_s).ceil() as i64, centre / every as i64);
    for _ in 0..WAVELETS {
        let candidates = (centre - reach..=centre + reach).map(|k| (coarse.coefficient(&rest, k), k));
        let strongest = candidates.max_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs()));
        let (coefficient, k) = strongest.unwrap_or((0.0, centre));
        coarse.add_to(&mut rest, k, -coefficient);
        fine.add_to(&mut pulse, k * every as i64, coefficient);
    }
    pulse
}

fn energy(velocity: &[f64]) -> f64 {
    velocity.iter().map(|v| v * v).sum()
}

fn sample_of_share(velocity: &[f64], share: f64) -> usize {
    let target = share * energy(velocity);
    let mut sum = 0.0;
    let passed = velocity.iter().position(|v| {
        sum += v * v;
        sum >= target
    });
    passed.unwrap_or(0)
}
