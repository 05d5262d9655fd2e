use std::collections::HashMap;
use std::f64::consts::PI;

use rand_distr::{Distribution, StandardNormal};

use super::combine::{Difference, Epoch, combine};
use super::fourier::{Complex64, even_smooth_at_least, invert, transform};
use super::measures::velocity;
use super::pulse::Pulse;
use super::scenario::{Scenario, Suite};
use super::stochastic::{PEAK_SHARE, Source, StochasticModel, Window};
use crate::random::{Purpose, stream};
use crate::units::CM_PER_M;

/// Time before and after the motion in which its zero-phase filters die away: at least this, s, and this
/// share of the duration of source and path, of which the corner of the source is the greater part.
const MARGIN_S: f64 = 2.0;
const MARGIN_SHARE: f64 = 0.5;
/// Time at rest at both ends, s.
const REST_S: f64 = 0.5;

/// The model of synthetic motions, with its options.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionModel {
    pub dt_s: f64,
    pub difference: Difference,
    pub epoch: Epoch,
    pub stochastic: StochasticModel,
    pub seed: u64,
}

impl Default for MotionModel {
    fn default() -> MotionModel {
        MotionModel {
            dt_s: 0.005,
            difference: Difference::Clamp,
            epoch: Epoch::EnvelopePeak,
            stochastic: StochasticModel::default(),
            seed: 42,
        }
    }
}

impl MotionModel {
    pub fn sample_count(&self, scenario: &Scenario) -> usize {
        let source = Source::new(scenario.mw, scenario.re_km);
        self.time_axis(&source, &Pulse::of(scenario)).samples
    }

    /// Pads at the start so that the pulse is never cut, and at the end to a fast length of Fourier
    /// transforms.
    fn time_axis(&self, source: &Source, pulse: &Pulse) -> TimeAxis {
        let dt_s = self.dt_s;
        let window_s = self.stochastic.window * source.duration_s();
        let margin_s = MARGIN_S.max(MARGIN_SHARE * source.duration_s());
        let half_pulse_s = 0.5 * pulse.duration_s();
        // Earliest and latest peak of the pulse, from the onset of the window.
        let (earliest_s, latest_s) = match self.epoch {
            Epoch::EnvelopePeak => (PEAK_SHARE * window_s, PEAK_SHARE * window_s),
            Epoch::Pga | Epoch::Pgv => (0.0, window_s),
        };
        let onset = ((margin_s + (half_pulse_s - earliest_s).max(0.0)) / dt_s).ceil() as usize;
        let moving_s = window_s.max(latest_s + half_pulse_s);
        let after = ((moving_s + margin_s) / dt_s).ceil() as usize + 1;
        TimeAxis { margin_s, onset, samples: even_smooth_at_least(onset + after) }
    }
}

struct TimeAxis {
    margin_s: f64,
    /// Sample at which the window begins.
    onset: usize,
    samples: usize,
}

/// The motions of one scenario on one time axis: accelerations, m/s2. The pulse is always there; others
/// that were not needed are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SyntheticMotion {
    pub dt_s: f64,
    /// Time of the middle of the pulse from the first sample, s.
    pub epoch_s: f64,
    pub pulse: Vec<f64>,
    pub high_frequency: Vec<f64>,
    pub combined: Vec<f64>,
}

impl SyntheticMotion {
    pub fn samples(&self, suite: Suite) -> &[f64] {
        match suite {
            Suite::Pulse => &self.pulse,
            Suite::Hfc => &self.high_frequency,
            Suite::Csgm => &self.combined,
            Suite::Record => &[],
        }
    }
}

/// Synthesizes motions, each independent of the motions before. Use one for each thread: it keeps the values
/// that scenarios of one magnitude and distance share.
pub struct Synthesizer {
    model: MotionModel,
    /// Whether to compute the high frequencies, and the combined motion.
    high_frequency: bool,
    combined: bool,
    earthquake: Option<Earthquake>,
}

/// Values that the scenarios of one magnitude and distance share.
struct Earthquake {
    mw: f64,
    re_km: f64,
    source: Source,
    window: Window,
    /// Window at the samples after its onset.
    weights: Vec<f64>,
    /// Fourier amplitudes (m/s) by length of motion.
    amplitudes: HashMap<usize, Vec<f64>>,
}

impl Earthquake {
    fn new(mw: f64, re_km: f64, model: &MotionModel) -> Earthquake {
        let (source, dt_s) = (Source::new(mw, re_km), model.dt_s);
        let window = Window::new(model.stochastic.window * source.duration_s());
        let sample_count = (window.duration_s / dt_s).floor() as usize;
        let weights = (1..=sample_count).map(|k| window.value(k as f64 * dt_s)).collect();
        Earthquake { mw, re_km, source, window, weights, amplitudes: HashMap::new() }
    }

    fn amplitudes(&mut self, model: &MotionModel, sample_count: usize) -> &[f64] {
        let step_hz = 1.0 / (sample_count as f64 * model.dt_s);
        self.amplitudes.entry(sample_count).or_insert_with(|| {
            let frequencies_hz = (0..=sample_count / 2).map(|k| k as f64 * step_hz);
            let model = &model.stochastic;
            frequencies_hz.map(|f| model.fourier_amplitude_cm_s(&self.source, f) / CM_PER_M).collect()
        })
    }
}

impl Synthesizer {
    pub fn new(model: MotionModel, suites: &[Suite]) -> Synthesizer {
        Synthesizer {
            high_frequency: suites.contains(&Suite::Hfc) || model.epoch != Epoch::EnvelopePeak,
            combined: suites.contains(&Suite::Csgm),
            model,
            earthquake: None,
        }
    }

    pub fn synthesize(&mut self, scenario: &Scenario) -> SyntheticMotion {
        let Scenario { mw, re_km, .. } = *scenario;
        let mut earthquake = match self.earthquake.take() {
            Some(known) if (known.mw, known.re_km) == (mw, re_km) => known,
            _ => Earthquake::new(mw, re_km, &self.model),
        };
        let pulse = Pulse::of(scenario);
        let axis = self.model.time_axis(&earthquake.source, &pulse);
        let sample_count = axis.samples;
        let mut made = SyntheticMotion { dt_s: self.model.dt_s, ..SyntheticMotion::default() };
        let mut spectrum = Vec::new();
        if self.high_frequency || self.combined {
            let mut noise = self.windowed_noise(scenario, &earthquake.weights, &axis);
            spectrum = transform(&mut noise);
            shape_noise(&mut spectrum, earthquake.amplitudes(&self.model, sample_count), made.dt_s);
            if self.high_frequency {
                invert(&mut spectrum.clone(), &mut noise);
                bring_to_rest(&mut noise, made.dt_s, axis.margin_s);
                made.high_frequency = noise;
            }
        }
        made.epoch_s = self.epoch_s(&earthquake.window, axis.onset, &made.high_frequency);
        made.pulse = pulse.sample(made.dt_s, made.epoch_s, sample_count);
        if self.combined {
            made.combined = made.pulse.clone();
            let pulse_spectrum = transform(&mut made.combined);
            let periods = pulse.duration_s() / (sample_count as f64 * made.dt_s);
            combine(&mut spectrum, &pulse_spectrum, self.model.difference, periods);
            invert(&mut spectrum, &mut made.combined);
            bring_to_rest(&mut made.combined, made.dt_s, axis.margin_s);
        }
        self.earthquake = Some(earthquake);
        made
    }

    fn windowed_noise(&self, of: &Scenario, weights: &[f64], axis: &TimeAxis) -> Vec<f64> {
        let mut samples = vec![0.0; axis.samples];
        let noise = stream(self.model.seed, Purpose::Noise, of.scenario_id as u64);
        let normals = Distribution::<f64>::sample_iter(StandardNormal, noise);
        for ((sample, normal), weight) in samples[axis.onset + 1..].iter_mut().zip(normals).zip(weights) {
            *sample = normal * weight;
        }
        samples
    }

    fn epoch_s(&self, window: &Window, onset: usize, high_frequency: &[f64]) -> f64 {
        let dt_s = self.model.dt_s;
        let onset_s = onset as f64 * dt_s;
        let from_onset = match self.model.epoch {
            Epoch::EnvelopePeak => PEAK_SHARE * window.duration_s,
            Epoch::Pga => index_of_peak(high_frequency) as f64 * dt_s - onset_s,
            Epoch::Pgv => index_of_peak(&velocity(high_frequency, dt_s)) as f64 * dt_s - onset_s,
        };
        onset_s + from_onset.clamp(0.0, window.duration_s)
    }
}

/// Scales the spectrum of the noise to the Fourier amplitudes of the model.
fn shape_noise(noise: &mut [Complex64], amplitudes: &[f64], dt_s: f64) {
    // Normalises the noise to a mean square of 1 over all frequencies but the first and the last.
    let inner = &noise[1..noise.len() - 1];
    let mean_square = inner.iter().map(|x| x.norm_sqr()).sum::<f64>() / inner.len() as f64;
    // From the continuous spectrum to the discrete one.
    let scale = 1.0 / (mean_square.sqrt() * dt_s);
    noise.iter_mut().zip(amplitudes).for_each(|(x, amplitude)| *x *= scale * amplitude);
}

/// Brings the ground to rest at both ends. A zero-phase filter has no end: what is left of it in the margins
/// is tapered by a raised cosine, and the mean under this taper is taken out, so that no velocity is left.
fn bring_to_rest(acceleration: &mut [f64], dt_s: f64, margin_s: f64) {
    let last = acceleration.len() - 1;
    let taper = |k: usize| {
        let from_end_s = k.min(last - k) as f64 * dt_s;
        let share = ((from_end_s - REST_S) / (margin_s - REST_S)).clamp(0.0, 1.0);
        0.5 - 0.5 * (PI * share).cos()
    };
    let tapers: Vec<f64> = (0..=last).map(taper).collect();
    let weighted = acceleration.iter().zip(&tapers).map(|(a, taper)| a * taper).sum::<f64>();
    let mean = weighted / tapers.iter().sum::<f64>();
    acceleration.iter_mut().zip(&tapers).for_each(|(a, taper)| *a = taper * (*a - mean));
}

fn index_of_peak(series: &[f64]) -> usize {
    (0..series.len()).max_by(|&a, &b| series[a].abs().total_cmp(&series[b].abs())).unwrap_or(0)
}
