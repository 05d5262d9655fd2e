use std::sync::Arc;

use rand_distr::{Distribution, StandardNormal};
use realfft::num_complex::Complex64;

use super::combine::{Difference, Epoch, combine};
use super::fourier::{ByLength, Transform, even_smooth_at_least};
use super::intensity::velocity;
use super::pulse::Pulse;
use super::scenario::Scenario;
use super::stochastic::{PEAK_SHARE, Source, StochasticModel, Window, quality_exponent};
use crate::random::{Purpose, stream};
use crate::units::CM_PER_M;

/// Quiet time before and after all that moves, s: the zero-phase filters reach this far.
const MARGIN_S: f64 = 2.0;

/// How motions are made of scenarios.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionModel {
    /// Time between samples, s.
    pub dt_s: f64,
    /// What the high frequencies keep where the pulse is the stronger.
    pub difference: Difference,
    /// When the pulse comes.
    pub epoch: Epoch,
    /// Spectrum of the high frequencies.
    pub stochastic: StochasticModel,
    /// Seed of the noise.
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

/// The motions of one scenario on one time axis: accelerations, m/s2.
#[derive(Debug, Clone, PartialEq)]
pub struct Synthetic {
    /// Time between samples, s.
    pub dt_s: f64,
    /// When the pulse peaks, s from the first sample.
    pub epoch_s: f64,
    /// The pulse alone.
    pub pulse: Vec<f64>,
    /// The high frequencies alone.
    pub high_frequency: Vec<f64>,
    /// Both combined.
    pub combined: Vec<f64>,
}

/// Makes motions one after the other, each the same whatever came before. One for each thread: it keeps plans and
/// buffers.
pub struct Synthesizer {
    model: MotionModel,
    axes: ByLength<FrequencyAxis>,
    noise: Vec<Complex64>,
    pulse: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

/// The frequencies of all motions of one length.
struct FrequencyAxis {
    transform: Transform,
    /// Frequency (Hz), its quality exponent and the common factor of the spectrum.
    bins: Vec<(f64, f64, f64)>,
}

/// Where window and pulse lie on the time axis.
#[derive(Debug, Clone, Copy)]
struct Timeline {
    onset_s: f64,
    samples: usize,
}

impl Synthesizer {
    /// For a model.
    pub fn new(model: MotionModel) -> Synthesizer {
        Synthesizer {
            model,
            axes: ByLength::default(),
            noise: Vec::new(),
            pulse: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// The motions of a scenario.
    pub fn synthesize(&mut self, scenario: &Scenario) -> Synthetic {
        let dt_s = self.model.dt_s;
        let source = Source::new(scenario.mw, scenario.re_km);
        let window = Window::new(source.duration_s());
        let pulse = Pulse::of(scenario);
        let timeline = self.timeline(&window, &pulse);
        let axis = self.axis(timeline.samples);

        let mut high_frequency = vec![0.0; timeline.samples];
        self.windowed_noise(scenario, &window, &timeline, &mut high_frequency);
        self.shape_noise(&source, &axis, &mut high_frequency);
        let epoch_s = self.epoch_s(&window, &timeline, &high_frequency);

        let pulse: Vec<f64> =
            (0..timeline.samples).map(|k| pulse.acceleration_m_s2(k as f64 * dt_s - epoch_s)).collect();
        let mut combined = pulse.clone();
        axis.transform.forward(&mut combined, &mut self.pulse, &mut self.scratch);
        combine(&mut self.noise, &self.pulse, self.model.difference);
        axis.transform.inverse(&mut self.noise, &mut combined, &mut self.scratch);
        Synthetic { dt_s, epoch_s, pulse, high_frequency, combined }
    }

    /// Padded at the start so that the pulse is never cut, and at the end; as long as a fast Fourier transform likes.
    fn timeline(&self, window: &Window, pulse: &Pulse) -> Timeline {
        let half_pulse_s = 0.5 * pulse.duration_s();
        // The earliest and the latest moment at which the pulse may peak, from the onset of the window.
        let (earliest_s, latest_s) = match self.model.epoch {
            Epoch::EnvelopePeak => (PEAK_SHARE * window.duration_s, PEAK_SHARE * window.duration_s),
            Epoch::Pga | Epoch::Pgv => (0.0, window.duration_s),
        };
        let onset_s = MARGIN_S + (half_pulse_s - earliest_s).max(0.0);
        let end_s = onset_s + window.duration_s.max(latest_s + half_pulse_s) + MARGIN_S;
        Timeline { onset_s, samples: even_smooth_at_least((end_s / self.model.dt_s).ceil() as usize + 1) }
    }

    fn windowed_noise(&self, scenario: &Scenario, window: &Window, timeline: &Timeline, noise: &mut [f64]) {
        let mut random = stream(self.model.seed, Purpose::Noise, scenario.scenario_id as u64);
        for (k, sample) in noise.iter_mut().enumerate() {
            let weight = window.value(k as f64 * self.model.dt_s - timeline.onset_s);
            if weight > 0.0 {
                let normal: f64 = StandardNormal.sample(&mut random);
                *sample = weight * normal;
            }
        }
    }

    /// Gives the noise the Fourier amplitude of the source, in `samples` and, transformed, in `self.noise`.
    fn shape_noise(&mut self, source: &Source, axis: &FrequencyAxis, samples: &mut [f64]) {
        axis.transform.forward(samples, &mut self.noise, &mut self.scratch);
        let inner = &self.noise[1..self.noise.len() - 1];
        let mean_square = inner.iter().map(|x| x.norm_sqr()).sum::<f64>() / inner.len() as f64;
        // From cm/s of the continuous spectrum to m/s2 of the discrete one.
        let scale = 1.0 / (mean_square.sqrt() * CM_PER_M * self.model.dt_s);
        for (x, &(f, quality, common)) in self.noise.iter_mut().zip(&axis.bins) {
            *x *= scale * source.amplitude(f, quality) * common;
        }
        self.noise[0] = Complex64::ZERO;
        self.pulse.clone_from(&self.noise);
        axis.transform.inverse(&mut self.pulse, samples, &mut self.scratch);
    }

    fn epoch_s(&self, window: &Window, timeline: &Timeline, high_frequency: &[f64]) -> f64 {
        let dt_s = self.model.dt_s;
        let from_onset = match self.model.epoch {
            Epoch::EnvelopePeak => PEAK_SHARE * window.duration_s,
            Epoch::Pga => index_of_peak(high_frequency) as f64 * dt_s - timeline.onset_s,
            Epoch::Pgv => index_of_peak(&velocity(high_frequency, dt_s)) as f64 * dt_s - timeline.onset_s,
        };
        timeline.onset_s + from_onset.clamp(0.0, window.duration_s)
    }

    fn axis(&mut self, samples: usize) -> Arc<FrequencyAxis> {
        let frequency_step_hz = 1.0 / (samples as f64 * self.model.dt_s);
        let model = &self.model.stochastic;
        self.axes.get(samples, || {
            let frequencies = (0..=samples / 2).map(|k| k as f64 * frequency_step_hz);
            let bins = frequencies.map(|f| (f, quality_exponent(f), model.common_factor(f))).collect();
            FrequencyAxis { transform: Transform::new(samples), bins }
        })
    }
}

fn index_of_peak(series: &[f64]) -> usize {
    (0..series.len()).max_by(|&a, &b| series[a].abs().total_cmp(&series[b].abs())).unwrap_or(0)
}
