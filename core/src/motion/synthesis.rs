use std::collections::HashMap;

use rand_distr::{Distribution, StandardNormal};

use super::combine::{Difference, Epoch, combine};
use super::fourier::{Complex64, even_smooth_at_least, invert, transform};
use super::measures::velocity;
use super::pulse::Pulse;
use super::scenario::{Scenario, Suite};
use super::stochastic::{PEAK_SHARE, Source, StochasticModel, Window};
use crate::random::{Purpose, stream};
use crate::units::CM_PER_M;

/// Quiet time before and after the motion, s: the reach of the zero-phase filters.
const MARGIN_S: f64 = 2.0;

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
            difference: Difference::Absolute,
            epoch: Epoch::EnvelopePeak,
            stochastic: StochasticModel::default(),
            seed: 42,
        }
    }
}

impl MotionModel {
    pub fn sample_count(&self, scenario: &Scenario) -> usize {
        let source = Source::new(scenario.mw, scenario.re_km);
        self.time_axis(&Window::new(source.duration_s()), &Pulse::of(scenario)).1
    }

    /// Computes the sample at which the window begins, and the number of samples: padded at the start so that
    /// the pulse is never cut, and at the end to a fast length of Fourier transforms.
    fn time_axis(&self, window: &Window, pulse: &Pulse) -> (usize, usize) {
        let dt_s = self.dt_s;
        let half_pulse_s = 0.5 * pulse.duration_s();
        // Earliest and latest peak of the pulse, from the onset of the window.
        let (earliest_s, latest_s) = match self.epoch {
            Epoch::EnvelopePeak => (PEAK_SHARE * window.duration_s, PEAK_SHARE * window.duration_s),
            Epoch::Pga | Epoch::Pgv => (0.0, window.duration_s),
        };
        let onset = ((MARGIN_S + (half_pulse_s - earliest_s).max(0.0)) / dt_s).ceil() as usize;
        let moving_s = window.duration_s.max(latest_s + half_pulse_s);
        let after = ((moving_s + MARGIN_S) / dt_s).ceil() as usize + 1;
        (onset, even_smooth_at_least(onset + after))
    }
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
///
/// ```
/// use rockfrag_core::motion::{MotionModel, Scenario, Suite, Synthesizer};
/// let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
/// let motion = synthesizer.synthesize(&Scenario::at_quantiles(6.5, 10.0, [0.5; 4]));
/// assert_eq!((motion.dt_s, motion.samples(Suite::Csgm)), (0.005, &motion.combined[..]));
/// ```
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
    fn new(mw: f64, re_km: f64, dt_s: f64) -> Earthquake {
        let source = Source::new(mw, re_km);
        let window = Window::new(source.duration_s());
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
            _ => Earthquake::new(mw, re_km, self.model.dt_s),
        };
        let pulse = Pulse::of(scenario);
        let (onset, sample_count) = self.model.time_axis(&earthquake.window, &pulse);
        let mut made = SyntheticMotion { dt_s: self.model.dt_s, ..SyntheticMotion::default() };
        let mut spectrum = Vec::new();
        if self.high_frequency || self.combined {
            let mut noise = self.windowed_noise(scenario, &earthquake.weights, onset, sample_count);
            spectrum = transform(&mut noise);
            shape_noise(&mut spectrum, earthquake.amplitudes(&self.model, sample_count), made.dt_s);
            if self.high_frequency {
                invert(&mut spectrum.clone(), &mut noise);
                made.high_frequency = noise;
            }
        }
        made.epoch_s = self.epoch_s(&earthquake.window, onset, &made.high_frequency);
        made.pulse = pulse.sample(made.dt_s, made.epoch_s, sample_count);
        if self.combined {
            made.combined = made.pulse.clone();
            let pulse_spectrum = transform(&mut made.combined);
            combine(&mut spectrum, &pulse_spectrum, self.model.difference);
            invert(&mut spectrum, &mut made.combined);
        }
        self.earthquake = Some(earthquake);
        made
    }

    fn windowed_noise(&self, of: &Scenario, weights: &[f64], onset: usize, sample_count: usize) -> Vec<f64> {
        let mut samples = vec![0.0; sample_count];
        let noise = stream(self.model.seed, Purpose::Noise, of.scenario_id as u64);
        let normals = Distribution::<f64>::sample_iter(StandardNormal, noise);
        for ((sample, normal), weight) in samples[onset + 1..].iter_mut().zip(normals).zip(weights) {
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
    // With a mean of 0 the ground comes to rest.
    noise[0] = Complex64::ZERO;
}

fn index_of_peak(series: &[f64]) -> usize {
    (0..series.len()).max_by(|&a, &b| series[a].abs().total_cmp(&series[b].abs())).unwrap_or(0)
}
