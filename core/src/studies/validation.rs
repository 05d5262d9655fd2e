//! Tests of forecast probabilities on the outcomes of cases that were not fitted.

use serde::{Deserialize, Serialize};

use crate::fragility::Event;
use crate::statistics::clusters::clustered_error_of_mean;
use crate::statistics::normal::Z_95;
use crate::statistics::scores::{auc, brier_score, log_score};
use crate::statistics::{Interval, clustered_probit, normal};

const BINS: usize = 10;
/// A probability is taken no nearer to 0 or 1 than this where its quantile is needed.
const LEAST: f64 = 1e-15;

/// Probabilities of an event in some cases of a structure and suite by one model, and whether it happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecasts<'a> {
    pub suite: Option<&'a str>,
    pub structure: &'a str,
    pub event: Event,
    pub model: &'a str,
    pub probabilities: &'a [f64],
    pub happened: &'a [bool],
    /// Cases of one cluster may depend on each other.
    pub clusters: &'a [u32],
}

/// The scores of forecasts: a row of validation.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Validation {
    pub suite: Option<String>,
    pub structure: String,
    pub event: Event,
    pub model: String,
    pub n: i64,
    pub observed: i64,
    /// Events expected: the sum of the probabilities.
    pub expected: f64,
    /// Standard error of observed - expected, where cases of one cluster may depend on each other.
    pub expected_error: f64,
    /// Mean logarithm of the probability of what happened; none where a probability of 0 happened.
    pub log_score: Option<f64>,
    pub brier: f64,
    /// Area under the receiver operating characteristic; none where all or none happened.
    pub auc: Option<f64>,
    /// Intercept and slope of the probit regression of the events on Phi^-1 of their probability, 0 and 1 at
    /// best: with a slope below 1, probabilities are too extreme (Cox 1958, Biometrika 45, 562-565). None
    /// where there is no such fit.
    pub calibration_intercept: Option<f64>,
    pub calibration_slope: Option<f64>,
}

/// Cases of about the same probability: a row of validation.reliability.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ReliabilityBin {
    pub suite: Option<String>,
    pub structure: String,
    pub event: Event,
    pub model: String,
    pub predicted: f64,
    /// Share of events, with Wilson's 95 % limits.
    pub share: f64,
    pub share_low: f64,
    pub share_high: f64,
    pub n: i64,
    pub observed: i64,
}

impl Forecasts<'_> {
    /// Tests the forecasts; none without a case.
    pub fn validate(&self) -> Option<Validation> {
        let Forecasts { probabilities, happened, clusters, .. } = *self;
        let n = happened.len();
        if n == 0 {
            return None;
        }
        let observed = happened.iter().filter(|happened| **happened).count();
        let excess: Vec<f64> = happened.iter().zip(probabilities).map(|(y, p)| f64::from(*y) - p).collect();
        let z: Vec<f64> =
            probabilities.iter().map(|p| normal::quantile(p.clamp(LEAST, 1.0 - LEAST))).collect();
        let calibration =
            clustered_probit(&[&z], happened, clusters).ok().map(|probit| probit.fit.coefficients);
        Some(Validation {
            suite: self.suite.map(str::to_string),
            structure: self.structure.to_string(),
            event: self.event,
            model: self.model.to_string(),
            n: n as i64,
            observed: observed as i64,
            expected: probabilities.iter().sum(),
            expected_error: n as f64 * clustered_error_of_mean(&excess, clusters),
            log_score: Some(log_score(probabilities, happened)).filter(|score| score.is_finite()),
            brier: brier_score(probabilities, happened),
            auc: (0 < observed && observed < n).then(|| auc(probabilities, happened)),
            calibration_intercept: calibration.as_ref().map(|b| b[0]),
            calibration_slope: calibration.as_ref().map(|b| b[1]),
        })
    }

    /// Groups the cases by rising probability, in ten groups of about equal size.
    pub fn reliability(&self) -> Vec<ReliabilityBin> {
        let Forecasts { probabilities, happened, .. } = *self;
        let mut order: Vec<usize> = (0..happened.len()).collect();
        order.sort_by(|&a, &b| probabilities[a].total_cmp(&probabilities[b]));
        let bins = (0..BINS).map(|k| &order[order.len() * k / BINS..order.len() * (k + 1) / BINS]);
        let bins = bins.filter(|cases| !cases.is_empty()).map(|cases| {
            let n = cases.len();
            let observed = cases.iter().filter(|&&case| happened[case]).count();
            let share = observed_share(observed, n);
            ReliabilityBin {
                suite: self.suite.map(str::to_string),
                structure: self.structure.to_string(),
                event: self.event,
                model: self.model.to_string(),
                predicted: cases.iter().map(|&case| probabilities[case]).sum::<f64>() / n as f64,
                share: share.value,
                share_low: share.low,
                share_high: share.high,
                n: n as i64,
                observed: observed as i64,
            }
        });
        bins.collect()
    }
}

/// Estimates the probability of what happened in `observed` of `n` independent cases: their share, with 95 %
/// limits (Wilson 1927, Journal of the American Statistical Association 22, 209-212).
pub fn observed_share(observed: usize, n: usize) -> Interval {
    let (n, share) = (n as f64, observed as f64 / n as f64);
    let (middle, width) = (share + Z_95 * Z_95 / (2.0 * n), 1.0 + Z_95 * Z_95 / n);
    let half = Z_95 * (share * (1.0 - share) / n + (Z_95 / (2.0 * n)).powi(2)).sqrt();
    Interval {
        value: share,
        low: ((middle - half) / width).max(0.0),
        high: ((middle + half) / width).min(1.0),
    }
}
