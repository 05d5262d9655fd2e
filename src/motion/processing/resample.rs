use std::f64::consts::PI;

/// Zero crossings of the interpolating function on each side.
const LOBES: f64 = 24.0;
/// Shape of the Kaiser window: side lobes of about -80 dB.
const KAISER_BETA: f64 = 8.0;
/// The corner as a share of the lower of the two Nyquist frequencies: the transition band lies below it.
const CORNER: f64 = 0.9;

/// How many samples a record of `samples` has at another time step.
pub fn resampled_length(samples: usize, dt_s: f64, new_dt_s: f64) -> f64 {
    // A billionth of a step, so that rounding does not cost the last sample.
    ((samples.max(1) - 1) as f64 * dt_s / new_dt_s + 1e-9).floor() + 1.0
}

/// The record at the time step `new_dt_s` (s): band-limited interpolation by a sinc under a Kaiser window, which passes
/// nothing above the Nyquist frequency of the longer of the two steps. The record counts as zero outside.
pub fn resample(samples: &[f64], dt_s: f64, new_dt_s: f64) -> Vec<f64> {
    let corner = if new_dt_s > dt_s { CORNER * dt_s / new_dt_s } else { 1.0 };
    let reach = LOBES / corner;
    let length = resampled_length(samples.len(), dt_s, new_dt_s) as usize;
    let value = |k: usize| {
        let centre = k as f64 * new_dt_s / dt_s;
        let first = (centre - reach).ceil().max(0.0) as usize;
        let last = ((centre + reach).floor() as usize + 1).min(samples.len());
        let near = samples.iter().enumerate().take(last).skip(first);
        near.map(|(n, sample)| {
            let x = centre - n as f64;
            sample * corner * sinc(corner * x) * kaiser(x / reach)
        })
        .sum()
    };
    (0..length).map(value).collect()
}

fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { libm::sin(PI * x) / (PI * x) }
}

/// The Kaiser window at a place from -1 to 1.
fn kaiser(x: f64) -> f64 {
    bessel_i0(KAISER_BETA * (1.0 - x * x).max(0.0).sqrt()) / bessel_i0(KAISER_BETA)
}

/// Modified Bessel function of order 0, by its power series.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..40 {
        term *= quarter / f64::from(k * k);
        sum += term;
    }
    sum
}
