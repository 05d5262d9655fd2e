//! Motions of one peak, along which the probabilities of a hazard's intensities are taken.

use std::f64::consts::TAU;

use super::answers::Answers;
use crate::fragility::{Fragility, JointPeaks, Lognormal, Peak, Probability, Slice};
use crate::keyword::Keyword;
use crate::pipeline::UsageError;
use crate::pipeline::options::check;
use crate::rocking::Structure;

/// Motions of one peak, and what their other peak is.
pub struct Line {
    /// The slice of the motions' median p PGV / PGA at uplift, or of the only one.
    pub slice: Slice,
    ratio: Ratio,
}

/// The p PGV / PGA of motions.
#[derive(Clone, Copy)]
enum Ratio {
    Single(f64),
    /// Distributed as in the motions of the fits, given the intensity.
    Distributed(JointPeaks),
    /// So many standard deviations above the median of that distribution.
    Quantile(JointPeaks, f64),
}

/// The widest step and the last node of the integral over the distribution, in standard deviations: the trapezoidal rule of a
/// smooth function under a normal density is exact to 1e-8 with these.
const STEP: f64 = 0.5;
const LAST_NODE: i32 = 12;

impl Line {
    /// Of one ratio, or of those that motions of an intensity have.
    ///
    /// # Errors
    /// If the ratio is none, or what answers does not know those of its motions.
    pub fn new(
        ratio: Option<f64>,
        structure: &Structure,
        peak: Peak,
        answers: &dyn Answers,
    ) -> anyhow::Result<Line> {
        let ratio = match (ratio, answers.peaks()) {
            (Some(ratio), _) => {
                check(ratio > 0.0 && ratio.is_finite(), "ratio", ratio, "a p PGV / PGA above 0")?;
                Ratio::Single(ratio)
            }
            (None, Some(peaks)) => Ratio::Distributed(peaks),
            (None, None) => {
                return Err(UsageError::because(format!(
                    "a hazard of {} alone needs --ratio, the p PGV / PGA of its motions: what answers does not know it",
                    peak.as_str()
                )));
            }
        };
        let mut line = Line { slice: Slice { structure: structure.clone(), peak, ratio: 1.0 }, ratio };
        line.slice.ratio = line.median_ratio(line.slice.intensity_at_im4(1.0));
        Ok(line)
    }

    /// The line along a quantile of the ratio alone.
    pub fn quantile(&self, deviations: f64) -> Line {
        let ratio = match self.ratio {
            Ratio::Distributed(peaks) | Ratio::Quantile(peaks, _) => Ratio::Quantile(peaks, deviations),
            Ratio::Single(ratio) => Ratio::Single(ratio),
        };
        Line { slice: self.slice.clone(), ratio }
    }

    /// Whether motions of one intensity have many ratios.
    pub fn is_distributed(&self) -> bool {
        matches!(self.ratio, Ratio::Distributed(_))
    }

    /// The median of the ratios at an intensity.
    pub fn median_ratio(&self, intensity: f64) -> f64 {
        self.quantile(0.0).ratios(intensity)[0].0
    }

    /// The ratios at an intensity, with their weights.
    fn ratios(&self, intensity: f64) -> Vec<(f64, f64)> {
        let (p, peak) = (self.slice.structure.p_rad_s, self.slice.peak);
        match self.ratio {
            Ratio::Single(ratio) => vec![(ratio, 1.0)],
            Ratio::Quantile(peaks, deviations) => {
                vec![(p * peaks.pgv_over_pga(peak, intensity, deviations), 1.0)]
            }
            Ratio::Distributed(peaks) => (-LAST_NODE..=LAST_NODE)
                .map(|node| STEP * f64::from(node))
                .map(|z| {
                    (p * peaks.pgv_over_pga(peak, intensity, z), STEP * libm::exp(-0.5 * z * z) / TAU.sqrt())
                })
                .collect(),
        }
    }

    /// The probabilities of the limit states at an intensity with their limits, over the ratios.
    pub fn terms(&self, model: &dyn Fragility, intensity: f64) -> [f64; 9] {
        let (mut slice, mut mean) = (self.slice.clone(), [0.0; 9]);
        for (ratio, weight) in self.ratios(intensity) {
            slice.ratio = ratio;
            let states = terms(model.limit_states(&slice, intensity));
            mean.iter_mut().zip(states).for_each(|(mean, state)| *mean += weight * state);
        }
        mean
    }

    /// The probabilities of the limit states at an intensity, over the ratios; NaN where a measure is missing.
    pub fn limit_states(&self, model: &dyn Fragility, intensity: f64) -> [f64; 3] {
        let terms = self.terms(model, intensity);
        // The weights of the ratios are a quadrature's.
        [terms[0], terms[3], terms[6]].map(|p| if p > 1.0 { 1.0 } else { p })
    }

    /// Overturning along the line, where it is lognormal in the intensity.
    pub fn lognormal(&self, model: &dyn Fragility) -> Option<Lognormal> {
        matches!(self.ratio, Ratio::Single(_)).then(|| model.lognormal(&self.slice))?
    }
}

/// The terms of the sums over a hazard: value and limits of each limit state in turn.
pub fn terms(states: Option<[Probability; 3]>) -> [f64; 9] {
    states.map_or([f64::NAN; 9], |states| {
        let mut terms = [0.0; 9];
        let all = states.into_iter().flat_map(|p| [p.value, p.low, p.high]);
        terms.iter_mut().zip(all).for_each(|(term, value)| *term = value);
        terms
    })
}
