//! The synthetic motions of one scenario on one time axis (section 2.1).

use std::sync::Arc;

use super::combine::{Difference, Epoch, combine};
use super::fourier::{ByLength, Complex64, Transform, even_smooth_at_least};
use super::intensity::velocity;
use super::pulse::Pulse;
use super::scenario::{Scenario, Suite};
use super::stochastic::{PEAK_SHARE, Source, StochasticModel, Window, quality_exponent};
use crate::random::{Purpose, normals, stream};
use crate::units::CM_PER_M;
use crate::wide::widest_on;

/// Quiet time before and after all that moves, s: the zero-phase filters reach this far.
const MARGIN_S: f64 = 2.0;

/// The model that makes motions of scenarios, with its options.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionModel {
    /// Time between samples, s.
    pub dt_s: f64,
    /// What the high frequencies keep where the pulse is the stronger.
    pub difference: Difference,
    /// When the pulse comes.
    pub epoch: Epoch,
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

/// The motions of one scenario on one time axis: accelerations, m/s2. Those of suites that nobody asked for are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Synthetic {
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

impl Synthetic {
    /// Returns the samples of the motion in a suite that is synthesized.
    pub fn samples(&self, suite: Suite) -> &[f64] {
        match suite {
            Suite::Pulse => &self.pulse,
            Suite::Hfc => &self.high_frequency,
            Suite::Csgm | Suite::Record | Suite::Residual => &self.combined,
        }
    }
}

/// Makes motions one after the other, each the same whatever came before. One for each thread: it keeps plans, buffers
/// and what scenarios of one magnitude and distance share.
pub struct Synthesizer {
    model: MotionModel,
    /// Whether the suites need them.
    high_frequency: bool,
    combined: bool,
    axes: ByLength<FrequencyAxis>,
    earthquake: Option<Earthquake>,
    noise: Vec<Complex64>,
    pulse: Vec<Complex64>,
    scratch: Vec<Complex64>,
    synthetic: Synthetic,
}

/// The frequencies of all motions of one length.
struct FrequencyAxis {
    transform: Transform,
    /// Frequency (Hz), its quality exponent and the common factor of the spectrum.
    bins: Vec<(f64, f64, f64)>,
}

/// What the scenarios of one magnitude and distance share.
struct Earthquake {
    mw: f64,
    re_km: f64,
    source: Source,
    window: Window,
    /// The window at the samples after its onset.
    weights: Vec<f64>,
    /// Fourier amplitudes (m/s), for each length of motion.
    amplitudes: ByLength<Vec<f64>>,
}

impl Earthquake {
    fn new(mw: f64, re_km: f64, dt_s: f64) -> Earthquake {
        let source = Source::new(mw, re_km);
        let window = Window::new(source.duration_s());
        let samples = (window.duration_s / dt_s).floor() as usize;
        let weights = (1..=samples).map(|k| window.value(k as f64 * dt_s)).collect();
        Earthquake { mw, re_km, source, window, weights, amplitudes: ByLength::default() }
    }

    fn amplitudes(&mut self, samples: usize, axis: &FrequencyAxis) -> Arc<Vec<f64>> {
        let source = &self.source;
        self.amplitudes.get(samples, || {
            let amplitude =
                |&(f, quality, common): &(f64, f64, f64)| source.amplitude(f, quality) * common / CM_PER_M;
            axis.bins.iter().map(amplitude).collect()
        })
    }
}

/// Where window and pulse lie on the time axis.
#[derive(Debug, Clone, Copy)]
struct Timeline {
    /// The sample at which the window begins.
    onset: usize,
    samples: usize,
}

impl Synthesizer {
    /// Prepares the synthesis of some suites by a model.
    pub fn new(model: MotionModel, suites: &[Suite]) -> Synthesizer {
        Synthesizer {
            high_frequency: suites.contains(&Suite::Hfc) || model.epoch != Epoch::EnvelopePeak,
            combined: suites.contains(&Suite::Csgm),
            synthetic: Synthetic { dt_s: model.dt_s, ..Synthetic::default() },
            model,
            axes: ByLength::default(),
            earthquake: None,
            noise: Vec::new(),
            pulse: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Makes the motions of a scenario.
    pub fn synthesize(&mut self, scenario: &Scenario) -> &Synthetic {
        let Scenario { mw, re_km, .. } = *scenario;
        let mut earthquake = match self.earthquake.take() {
            Some(known) if (known.mw, known.re_km) == (mw, re_km) => known,
            _ => Earthquake::new(mw, re_km, self.model.dt_s),
        };
        let pulse = Pulse::of(scenario);
        let timeline = self.timeline(&earthquake.window, &pulse);
        let axis = self.axis(timeline.samples);
        if self.high_frequency || self.combined {
            let amplitudes = earthquake.amplitudes(timeline.samples, &axis);
            // Step 1 of section 2.1.3: the high frequencies of section 2.1.2.
            self.windowed_noise(scenario, &earthquake.weights, &timeline);
            self.shape_noise(&amplitudes, &axis);
        }
        let epoch_s = self.epoch_s(&earthquake.window, &timeline);
        self.earthquake = Some(earthquake);

        let Synthetic { pulse: samples, combined, .. } = &mut self.synthetic;
        // Step 2: the pulse of Eq. 1, with its middle at the epoch.
        pulse.sample(self.model.dt_s, epoch_s, timeline.samples, samples);
        if self.combined {
            // Steps 3 to 6: both as Fourier coefficients, combined and transformed back.
            combined.clone_from(samples);
            axis.transform.forward(combined, &mut self.pulse, &mut self.scratch);
            combine(&mut self.noise, &self.pulse, self.model.difference);
            axis.transform.inverse(&mut self.noise, combined, &mut self.scratch);
        }
        self.synthetic.epoch_s = epoch_s;
        &self.synthetic
    }

    /// Lays out the time axis: padded at the start so that the pulse is never cut, and at the end; as long as a fast Fourier
    /// transform likes. The window begins at a sample.
    fn timeline(&self, window: &Window, pulse: &Pulse) -> Timeline {
        let dt_s = self.model.dt_s;
        let half_pulse_s = 0.5 * pulse.duration_s();
        // The earliest and the latest moment at which the pulse may peak, from the onset of the window.
        let (earliest_s, latest_s) = match self.model.epoch {
            Epoch::EnvelopePeak => (PEAK_SHARE * window.duration_s, PEAK_SHARE * window.duration_s),
            Epoch::Pga | Epoch::Pgv => (0.0, window.duration_s),
        };
        let onset = ((MARGIN_S + (half_pulse_s - earliest_s).max(0.0)) / dt_s).ceil() as usize;
        let moving_s = window.duration_s.max(latest_s + half_pulse_s);
        let after = ((moving_s + MARGIN_S) / dt_s).ceil() as usize + 1;
        Timeline { onset, samples: even_smooth_at_least(onset + after) }
    }

    /// Draws the noise under the window, into `synthetic.high_frequency`.
    fn windowed_noise(&mut self, scenario: &Scenario, weights: &[f64], timeline: &Timeline) {
        let samples = &mut self.synthetic.high_frequency;
        samples.clear();
        samples.resize(timeline.samples, 0.0);
        let windowed = &mut samples[timeline.onset + 1..][..weights.len()];
        let noise = stream(self.model.seed, Purpose::Noise, scenario.scenario_id as u64);
        for ((sample, normal), weight) in windowed.iter_mut().zip(normals(noise)).zip(weights) {
            *sample = normal * weight;
        }
    }

    /// Gives the noise the Fourier amplitude of the source, in `synthetic.high_frequency` if that is wanted and, transformed, in
    /// `self.noise`.
    fn shape_noise(&mut self, amplitudes: &[f64], axis: &FrequencyAxis) {
        let samples = &mut self.synthetic.high_frequency;
        axis.transform.forward(samples, &mut self.noise, &mut self.scratch);
        // The noise has a mean square of 1 over all frequencies but the first and the last.
        let inner = &self.noise[1..self.noise.len() - 1];
        let mean_square = inner.iter().map(|x| x.norm_sqr()).sum::<f64>() / inner.len() as f64;
        // From the continuous spectrum to the discrete one.
        let scale = 1.0 / (mean_square.sqrt() * self.model.dt_s);
        widest_on(
            &mut self.noise,
            #[inline(always)]
            |noise| noise.iter_mut().zip(amplitudes).for_each(|(x, amplitude)| *x *= scale * amplitude),
        );
        // Without a mean the ground comes to rest.
        self.noise[0] = Complex64::ZERO;
        if self.high_frequency {
            self.pulse.clone_from(&self.noise);
            axis.transform.inverse(&mut self.pulse, samples, &mut self.scratch);
        } else {
            samples.clear();
        }
    }

    fn epoch_s(&self, window: &Window, timeline: &Timeline) -> f64 {
        let dt_s = self.model.dt_s;
        let (onset_s, high_frequency) = (timeline.onset as f64 * dt_s, &self.synthetic.high_frequency);
        let from_onset = match self.model.epoch {
            Epoch::EnvelopePeak => PEAK_SHARE * window.duration_s,
            Epoch::Pga => index_of_peak(high_frequency) as f64 * dt_s - onset_s,
            Epoch::Pgv => index_of_peak(&velocity(high_frequency, dt_s)) as f64 * dt_s - onset_s,
        };
        onset_s + from_onset.clamp(0.0, window.duration_s)
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
