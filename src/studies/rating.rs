//! How well a set of measures predicts, in figures that do not depend on how a measure is scaled: the dispersion beta of a hybrid
//! measure shrinks with its units, a log score does not (Gneiting & Raftery 2007, Strictly proper scoring rules, prediction, and
//! estimation, J. American Statistical Association 102, 359-378).

use crate::statistics::binary::binary_regression;
use crate::statistics::firth::Estimator;
use crate::statistics::goodness::rising_groups;
use crate::statistics::link::Link;
use crate::statistics::separation::is_separated;
use crate::statistics::skill::{auc, brier_score, log_score};

/// Groups of a reliability curve.
const GROUPS: usize = 10;

/// What a fit says of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foresight {
    /// Logarithm of the probability of what happened; of a demand, of the density at ln EDP.
    pub log_score: f64,
    /// The event of overturning, or of exceeding the limit, has the probability Phi(index).
    pub index: f64,
}

/// How well a set of measures predicts.
#[derive(Debug, Clone, PartialEq)]
pub struct Rating {
    /// Intercept first; none of two parts.
    pub coefficients: Vec<f64>,
    /// Log-likelihood of the fit at its maximum; of a demand, with normal residuals of ln EDP.
    pub log_likelihood: f64,
    /// Akaike's criterion; residual variances and the break of a demand count as parameters.
    pub aic: f64,
    /// Bayesian criterion.
    pub bic: f64,
    /// How the fit tells the events apart that it was fitted to.
    pub fitted: Skill,
    /// Dispersion: that of the curve of the hybrid measure, the residual standard deviation of a demand.
    pub beta: f64,
    /// beta over the slope of a demand on one measure.
    pub zeta: Option<f64>,
    /// How well it predicts clusters that it has not seen, where they can be left out.
    pub unseen: Option<Unseen>,
}

/// How probabilities tell events apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Skill {
    /// Area under the receiver operating characteristic.
    pub auc: f64,
    /// Brier score.
    pub brier: f64,
}

impl Skill {
    /// Of forecasts with these indices.
    pub fn of(foresights: &[Foresight], happened: &[bool]) -> Skill {
        let (indices, probabilities) = indices_and_probabilities(foresights);
        Skill { auc: auc(&indices, happened), brier: brier_score(&probabilities, happened) }
    }
}

/// Forecasts of clusters that were left out of the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Unseen {
    /// Of each case.
    pub log_scores: Vec<f64>,
    /// The mean of ln P of whether the event happened; for overturning, the mean of the same scores.
    pub event_log_score: f64,
    /// How they tell the events apart.
    pub skill: Skill,
    /// Intercept (0 is best) and slope (1 is best; less: the forecasts are too sure) of the events regressed on their
    /// index by a probit (Cox 1958, Two further applications of a model for binary regression, Biometrika 45, 562-565);
    /// none where there is no such fit.
    pub calibration: Option<[f64; 2]>,
    /// The share of events as the probability rises.
    pub reliability: Vec<ReliabilityGroup>,
}

/// Cases of about the same probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReliabilityGroup {
    /// Mean probability.
    pub forecast: f64,
    /// Cases.
    pub n: usize,
    /// Those in which the event happened.
    pub seen: usize,
}

impl Unseen {
    /// Of forecasts that were made without the clusters they are of.
    pub fn of(foresights: &[Foresight], happened: &[bool]) -> Unseen {
        let (indices, probabilities) = indices_and_probabilities(foresights);
        Unseen {
            log_scores: foresights.iter().map(|foresight| foresight.log_score).collect(),
            event_log_score: log_score(&probabilities, happened),
            skill: Skill::of(foresights, happened),
            calibration: calibration(&indices, happened),
            reliability: reliability(&probabilities, happened),
        }
    }

    /// The mean of the scores.
    pub fn log_score(&self) -> f64 {
        self.log_scores.iter().sum::<f64>() / self.log_scores.len() as f64
    }
}

fn indices_and_probabilities(foresights: &[Foresight]) -> (Vec<f64>, Vec<f64>) {
    foresights.iter().map(|Foresight { index, .. }| (*index, Link::Probit.probability(*index))).unzip()
}

fn calibration(indices: &[f64], happened: &[bool]) -> Option<[f64; 2]> {
    if is_separated(&[indices], happened) {
        return None;
    }
    let line = binary_regression(&[indices], happened, Link::Probit, Estimator::Ml).ok()?;
    Some([line.coefficients[0], line.coefficients[1]])
}

fn reliability(probabilities: &[f64], happened: &[bool]) -> Vec<ReliabilityGroup> {
    let group = |rows: &Vec<usize>| ReliabilityGroup {
        forecast: rows.iter().map(|&row| probabilities[row]).sum::<f64>() / rows.len() as f64,
        n: rows.len(),
        seen: rows.iter().filter(|&&row| happened[row]).count(),
    };
    rising_groups(probabilities, GROUPS).iter().map(group).collect()
}
