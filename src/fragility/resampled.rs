//! Limits of probabilities from the fits of resampled cases: of the curves themselves, whatever their coefficients do.

use super::model::{FragilityModel, GivenRocking};
use super::probability::Probability;
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::resampling::limits::{are_too_few, bootstrap_limits};

/// How limits follow from replicates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReplicateLimits {
    /// The quantiles of the replicates.
    Percentile,
    /// The same, corrected for their bias: BCa limits without acceleration (Efron 1982, The jackknife, the bootstrap and
    /// other resampling plans, chapter 10).
    BiasCorrected,
}

keywords!(ReplicateLimits { Percentile = "percentile", BiasCorrected = "bc" });

/// The fits of resampled cases.
#[derive(Debug, Clone, PartialEq)]
pub struct ResampledModel {
    /// Of each resample; none where a fit does not exist.
    pub replicates: Vec<Option<FragilityModel>>,
    /// How limits follow.
    pub limits: ReplicateLimits,
}

/// The probability with which limits hold the truth.
const CONFIDENCE: f64 = 0.95;

impl ResampledModel {
    /// The probabilities of the fit to all cases, with limits by the replicates.
    pub fn with_limits(&self, given: &GivenRocking, measures: &IntensityMeasures) -> GivenRocking {
        let replicates: Vec<Option<[f64; 3]>> =
            self.replicates.iter().map(|model| model.as_ref()?.given(measures)).collect();
        let limited = |probability: Probability, k: usize| {
            let values: Vec<Option<f64>> =
                replicates.iter().map(|values| Some(values.as_ref()?[k])).collect();
            self.about(probability.value, &values)
        };
        GivenRocking {
            p_ex: limited(given.p_ex, 0),
            p_ro: limited(given.p_ro, 1),
            p_failure: limited(given.p_failure, 2),
        }
    }

    /// How many resamples have no fit, if the others are too few for limits.
    pub fn too_many_missing(&self) -> Option<usize> {
        let (all, fits) = (self.replicates.len(), self.replicates.iter().flatten().count());
        are_too_few(fits, all, CONFIDENCE).then_some(all - fits)
    }

    /// The limits of a value from those in the replicates; NaN where too few have one.
    pub fn about(&self, value: f64, replicates: &[Option<f64>]) -> Probability {
        let limits = bootstrap_limits(value, replicates, 0.0, CONFIDENCE);
        let limits = limits.and_then(|limits| match self.limits {
            ReplicateLimits::Percentile => Some(limits.percentile),
            ReplicateLimits::BiasCorrected => limits.bca,
        });
        let [low, high] = limits.map_or([f64::NAN; 2], |limits| [limits.low, limits.high]);
        Probability { value, low, high }
    }
}
