//! Whether one component of a record holds a velocity pulse, after Baker (2007), "Quantitative classification
//! of near-fault ground motions using wavelet analysis", BSSA 97(5).

use super::wavelet::{Wavelet, WaveletTransform};
use crate::keyword::keywords;
use crate::motion::intensity::peak;

/// Periods of pulses that are looked for, s.
pub const PERIODS_S: (f64, f64) = (0.25, 15.0);
/// Periods at which all of the record is looked at, in equal ratios, and how many between two of them about a
/// local maximum.
const PERIODS: usize = 60;
const REFINED: usize = 20;
/// Local maxima whose square is at least this share of the largest are refined: the steps between the periods
/// are so small that no other becomes the largest.
const LEAST_PEAK: f64 = 0.9;
/// Wavelets that make up the extracted pulse.
const WAVELETS: usize = 10;
/// How far from the first wavelet the others may lie, as a share of its scale (their period times 5/7).
const REACH: f64 = 10.0 / 25.0 * 5.0 / 7.0;
/// The velocity is looked at in steps of about this, s: no pulse needs finer ones.
const STEP_S: f64 = 0.02;
/// The indicator above which a record holds a pulse.
pub const THRESHOLD: f64 = 0.85;
/// The least peak velocity of a record with a pulse, m/s.
pub const LEAST_PGV_M_S: f64 = 0.3;
/// A pulse comes early if this share of its squared velocity has passed before that share of the record's.
const EARLY: (f64, f64) = (0.10, 0.20);

/// The pulse indicator of one component, and what it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PulseIndicator {
    /// From 0 (no pulse) to 1 (a pulse): 1 / (1 + exp(-23.3 + 14.6 r + 20.5 e)) of the ratios r of peak
    /// velocities and e of energies, of the record without the pulse to the record.
    pub indicator: f64,
    /// Period of the extracted pulse, s.
    pub period_s: f64,
    /// Middle of its strongest wavelet, s.
    pub centre_s: f64,
    /// Whether the record holds a pulse, and if not, why.
    pub verdict: Verdict,
}

/// Whether a record holds a pulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Pulse,
    /// The indicator is too low.
    NoPulse,
    /// The pulse comes late: it is no effect of directivity.
    Late,
    /// The peak velocity is below 0.3 m/s.
    Weak,
}

keywords!(Verdict { Pulse = "pulse", NoPulse = "no_pulse", Late = "late", Weak = "weak" });

impl PulseIndicator {
    /// Judges a velocity (m/s) at steps of `dt_s`; none if it does not move.
    pub fn of(velocity: &[f64], dt_s: f64) -> Option<PulseIndicator> {
        let (period_s, centre) = strongest_wavelet(&[velocity], dt_s)?;
        // Baker's predictors: what of peak velocity and energy remains without the pulse.
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

/// Computes Baker's logistic regression.
pub fn indicator(pgv_ratio: f64, energy_ratio: f64) -> f64 {
    1.0 / (1.0 + (-23.3 + 14.6 * pgv_ratio + 20.5 * energy_ratio).exp())
}

/// Finds the direction in which two components (velocities, m/s) at right angles have the largest wavelet
/// coefficient: its parts along both, after Shahi & Baker (2014). None if they do not move.
pub fn strongest_direction(velocities: [&[f64]; 2], dt_s: f64) -> Option<[f64; 2]> {
    let (period_s, centre) = strongest_wavelet(&velocities, dt_s)?;
    let wavelet = Wavelet::new(period_s, dt_s);
    Some(velocities.map(|velocity| wavelet.coefficient(velocity, centre)))
}

/// Finds the period (s) and the central sample of the wavelet whose coefficients in all velocities have the
/// largest sum of squares, refined from each local maximum among the periods: two of nearly the same height
/// may lie far apart. None if the velocities are zero.
fn strongest_wavelet(velocities: &[&[f64]], dt_s: f64) -> Option<(f64, i64)> {
    let (shortest, longest) = PERIODS_S;
    let ratio = (longest / shortest).powf(1.0 / (PERIODS - 1) as f64);
    let period_s = |place: f64| (shortest * ratio.powf(place)).clamp(shortest, longest);
    let every = samples_in_step(dt_s);
    let dt_s = dt_s * every as f64;
    let decimated = |velocity: &&[f64]| velocity.iter().step_by(every).copied().collect();
    let velocities: Vec<Vec<f64>> = velocities.iter().map(decimated).collect();
    let transform = WaveletTransform::new(&velocities, dt_s, longest);
    // The largest sum of squares of each period, and its sample.
    let strongest = |k: usize| {
        let squares = transform.squares(period_s(k as f64)).into_iter().zip(0..);
        squares.fold((0.0, 0), |best, (square, at)| if square > best.0 { (square, at) } else { best })
    };
    let scan: Vec<(f64, i64)> = (0..PERIODS).map(strongest).collect();
    let largest = scan.iter().map(|(square, _)| *square).fold(0.0, f64::max);
    let square = |k: usize| scan.get(k).map_or(0.0, |(square, _)| *square);
    let is_peak = |k: &usize| {
        let beside = square(k.wrapping_sub(1)).max(square(k + 1));
        square(*k) > 0.0 && square(*k) >= beside.max(LEAST_PEAK * largest)
    };
    let refined = (0..PERIODS).filter(is_peak).flat_map(|k| {
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

/// Counts the samples in a step at which the velocity is looked at.
fn samples_in_step(dt_s: f64) -> usize {
    ((STEP_S / dt_s) as usize).max(1)
}

/// Extracts the pulse: the strongest wavelet, and those of the same period near it that are the strongest in
/// what remains, one after the other.
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

/// Finds the first sample at which this share of the squared velocity has passed.
fn sample_of_share(velocity: &[f64], share: f64) -> usize {
    let target = share * energy(velocity);
    let mut sum = 0.0;
    let has_passed = |v: &f64| {
        sum += v * v;
        sum >= target
    };
    velocity.iter().position(has_passed).unwrap_or(0)
}
