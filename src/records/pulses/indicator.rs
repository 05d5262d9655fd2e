//! Whether one component of a record holds a velocity pulse, after Baker (2007), "Quantitative classification of
//! near-fault ground motions using wavelet analysis", BSSA 97(5).

use super::wavelet::{SampledWavelet, Wavelet, WaveletScratch, WaveletTransform};
use crate::keyword::keywords;
use crate::motion::intensity::peak;

/// Periods of pulses that are looked for, s.
pub const PERIODS_S: (f64, f64) = (0.25, 15.0);
/// Periods at which all of the record is looked at, in equal ratios, and how many between two of them about a local maximum.
const PERIODS: usize = 60;
const REFINED: usize = 20;
/// Local maxima whose square is at least this share of the largest are refined: the steps between the periods are so small that no
/// other becomes the largest.
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
    /// From 0 (no pulse) to 1 (a pulse): 1 / (1 + exp(-23.3 + 14.6 r + 20.5 e)) of the ratios r of peak velocities and e of
    /// energies, of the record without the pulse to the record.
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
    pub fn of(velocity: &[f64], dt_s: f64, scratch: &mut WaveletScratch) -> Option<PulseIndicator> {
        let wavelet = strongest_wavelet(&[velocity], dt_s, scratch)?;
        // Baker's predictors: what of peak velocity and energy remains without the pulse.
        let pulse = extract(velocity, dt_s, wavelet);
        let residual: Vec<f64> = velocity.iter().zip(&pulse).map(|(v, p)| v - p).collect();
        let pgv = peak(velocity);
        let indicator = indicator(peak(&residual) / pgv, energy(&residual) / energy(velocity));
        let early = sample_of_share(&pulse, EARLY.0) < sample_of_share(velocity, EARLY.1);
        let verdict = if indicator <= THRESHOLD {
            Verdict::NoPulse
        } else if pgv < LEAST_PGV_M_S {
            Verdict::Weak
        } else if !early {
            Verdict::Late
        } else {
            Verdict::Pulse
        };
        Some(PulseIndicator { indicator, period_s: wavelet.period_s, centre_s: wavelet.centre_s, verdict })
    }
}

/// Computes Baker's logistic regression.
pub fn indicator(pgv_ratio: f64, energy_ratio: f64) -> f64 {
    1.0 / (1.0 + libm::exp(-23.3 + 14.6 * pgv_ratio + 20.5 * energy_ratio))
}

/// Finds the direction in which two components (velocities, m/s) at right angles have the largest wavelet coefficient: its parts
/// along both, after Shahi & Baker (2014). None if they do not move.
pub fn strongest_direction(
    velocities: [&[f64]; 2],
    dt_s: f64,
    scratch: &mut WaveletScratch,
) -> Option<[f64; 2]> {
    let strongest = strongest_wavelet(&velocities, dt_s, scratch)?;
    Some(velocities.map(|velocity| strongest.coefficient(velocity, dt_s)))
}

/// Finds the wavelet whose coefficients in all velocities have the largest sum of squares, refined from each local maximum among the
/// periods: two of nearly the same height may lie far apart. None if the velocities are zero.
fn strongest_wavelet(velocities: &[&[f64]], dt_s: f64, scratch: &mut WaveletScratch) -> Option<Wavelet> {
    let (shortest, longest) = PERIODS_S;
    let ratio = libm::pow(longest / shortest, 1.0 / (PERIODS - 1) as f64);
    let period_s = |place: f64| (shortest * libm::pow(ratio, place)).clamp(shortest, longest);
    let Decimated { velocities, dt_s } = Decimated::of(velocities, dt_s);
    let transforms: Vec<WaveletTransform> =
        velocities.iter().map(|velocity| WaveletTransform::new(velocity, dt_s, longest, scratch)).collect();
    let of_period = |k: usize| strongest_sample(&transforms, period_s(k as f64), scratch);
    let scan: Vec<(f64, usize)> = (0..PERIODS).map(of_period).collect();
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
    let at_period = |(period_s, k): (f64, usize)| {
        let wavelet = Wavelet { period_s, centre_s: scan[k].1 as f64 * dt_s };
        let squares = velocities.iter().map(|velocity| wavelet.coefficient(velocity, dt_s).powi(2));
        (squares.sum::<f64>(), wavelet)
    };
    refined.map(at_period).max_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, wavelet)| wavelet)
}

/// Finds the sample at which wavelets of a period have the largest sum of squared coefficients, and that sum.
fn strongest_sample(
    transforms: &[WaveletTransform],
    period_s: f64,
    scratch: &mut WaveletScratch,
) -> (f64, usize) {
    let mut coefficients = transforms.iter().map(|transform| transform.coefficients(period_s, scratch));
    let mut squares = coefficients.next().unwrap_or_default();
    squares.iter_mut().for_each(|value| *value *= *value);
    for component in coefficients {
        squares.iter_mut().zip(component).for_each(|(sum, value)| *sum += value * value);
    }
    (0..).zip(squares).fold(
        (0.0, 0),
        |best, (sample, square)| {
            if square > best.0 { (square, sample) } else { best }
        },
    )
}

/// Velocities of which only every so many samples are kept.
struct Decimated {
    velocities: Vec<Vec<f64>>,
    dt_s: f64,
}

impl Decimated {
    fn of(velocities: &[&[f64]], dt_s: f64) -> Decimated {
        let every = ((STEP_S / dt_s) as usize).max(1);
        let decimate = |velocity: &&[f64]| velocity.iter().step_by(every).copied().collect();
        Decimated { velocities: velocities.iter().map(decimate).collect(), dt_s: dt_s * every as f64 }
    }
}

/// Extracts the pulse: the strongest wavelet, and those of the same period near it that are the strongest in what remains, one
/// after the other.
fn extract(velocity: &[f64], dt_s: f64, first: Wavelet) -> Vec<f64> {
    let Decimated { velocities, dt_s: step_s } = Decimated::of(&[velocity], dt_s);
    let mut rest = velocities.into_iter().next().unwrap_or_default();
    let mut pulse = vec![0.0; velocity.len()];
    let reach = (REACH * first.period_s / step_s).ceil() as i64;
    let sampled = SampledWavelet::new(first.period_s, step_s);
    let centre = (first.centre_s / step_s).round() as i64;
    for _ in 0..WAVELETS {
        let at = |k: i64| (sampled.coefficient(&rest, centre + k), k);
        let candidates = (-reach..=reach).map(at);
        let Some((coefficient, k)) = candidates.max_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs())) else {
            break;
        };
        let wavelet = Wavelet { centre_s: first.centre_s + k as f64 * step_s, ..first };
        subtract(&mut rest, step_s, coefficient, &wavelet);
        subtract(&mut pulse, dt_s, -coefficient, &wavelet);
    }
    pulse
}

fn subtract(series: &mut [f64], dt_s: f64, coefficient: f64, wavelet: &Wavelet) {
    let (from, to) = wavelet.support_s();
    let (first, last) = ((from / dt_s).max(0.0) as usize, (to / dt_s).max(0.0) as usize);
    for (k, value) in series.iter_mut().enumerate().take(last + 1).skip(first) {
        *value -= coefficient * wavelet.value(k as f64 * dt_s);
    }
}

fn energy(velocity: &[f64]) -> f64 {
    velocity.iter().map(|v| v * v).sum()
}

/// Finds the first sample at which this share of the squared velocity has passed.
fn sample_of_share(velocity: &[f64], share: f64) -> usize {
    let target = share * energy(velocity);
    let mut sum = 0.0;
    let reached = velocity.iter().position(|v| {
        sum += v * v;
        sum >= target
    });
    reached.unwrap_or(0)
}
