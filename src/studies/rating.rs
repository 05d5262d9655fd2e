//! How well a set of measures predicts, in figures that do not depend on how a measure is scaled: the dispersion beta of a hybrid
//! measure shrinks with its units, a log score does not (Gneiting & Raftery 2007, Strictly proper scoring rules, prediction, and
//! estimation, J. American Statistical Association 102, 359-378).

use std::f64::consts::PI;

use crate::fragility::case::Measure;
use crate::fragility::demand::inference::{DemandInference, DemandReplicate};
use crate::fragility::demand::regressions::PLANE;
use crate::fragility::demand::transition::TransitionSearch;
use crate::fragility::overturning::curves::{CurveModel, fit_overturning};
use crate::fragility::overturning::inference::CurveInference;
use crate::fragility::sample::Sample;
use crate::resampling::folds::{Folds, Scores};
use crate::statistics::FitStatus;
use crate::statistics::binary::{Estimator, binary_regression};
use crate::statistics::goodness::{auc, brier_score, log_score, rising_groups};
use crate::statistics::link::Link;
use crate::statistics::separation::is_separated;
use crate::studies::candidate::{Candidate, Form};
use crate::studies::ranking_sample::RankingSample;

/// A power law needs more cases than so many for each parameter, as a smooth transition does.
const CASES_A_PARAMETER: f64 = 2.0;
/// Groups of a reliability curve.
const GROUPS: usize = 10;

/// What a fit says of a case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prediction {
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
    pub held_out: Option<HeldOut>,
}

impl Rating {
    /// Without what is as long as the cases are many: enough for a ranking.
    pub fn without_cases(mut self) -> Rating {
        if let Some(held_out) = &mut self.held_out {
            held_out.log_scores = Vec::new();
        }
        self
    }
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
    pub fn of(predictions: &[Prediction], happened: &[bool]) -> Skill {
        let (indices, probabilities) = indices_and_probabilities(predictions);
        Skill { auc: auc(&indices, happened), brier: brier_score(&probabilities, happened) }
    }
}

/// Forecasts of clusters that were left out of the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Of each case; none of [`Rating::without_cases`].
    pub log_scores: Vec<f64>,
    /// Their sums.
    pub scores: Scores,
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

impl HeldOut {
    /// Of forecasts that were made without the clusters they are of.
    pub fn of(predictions: &[Prediction], happened: &[bool], clusters: &[usize]) -> HeldOut {
        let (indices, probabilities) = indices_and_probabilities(predictions);
        let log_scores: Vec<f64> = predictions.iter().map(|prediction| prediction.log_score).collect();
        HeldOut {
            scores: Scores::of(&log_scores, clusters),
            log_scores,
            event_log_score: log_score(&probabilities, happened),
            skill: Skill::of(predictions, happened),
            calibration: calibration(&indices, happened),
            reliability: reliability(&probabilities, happened),
        }
    }

    /// The mean of the scores.
    pub fn log_score(&self) -> f64 {
        self.scores.mean()
    }
}

fn indices_and_probabilities(predictions: &[Prediction]) -> (Vec<f64>, Vec<f64>) {
    predictions.iter().map(|Prediction { index, .. }| (*index, Link::Probit.probability(*index))).unzip()
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

/// Where the demand breaks: ln IM4, from all cases and without each fold.
#[derive(Debug, Clone, PartialEq)]
pub struct Breaks {
    all: Option<f64>,
    without: Vec<Option<f64>>,
}

impl Breaks {
    /// At this IM4, or where the pooled residual of the paper's two planes is least in the cases at hand: what is left out has
    /// no say in it.
    pub fn new(sample: &RankingSample, folds: Option<&Folds>, transition: Option<f64>) -> Breaks {
        let count = folds.map_or(0, |folds| folds.count);
        if let Some(im4) = transition {
            return Breaks { all: Some(libm::log(im4)), without: vec![Some(libm::log(im4)); count] };
        }
        let [Some(im4), Some(im3)] = PLANE.map(|measure| sample.place(measure)) else {
            return Breaks { all: None, without: vec![None; count] };
        };
        let search = TransitionSearch::new(&sample.demands(&[im4, im3]));
        let find = |weights: &[f64]| Some(libm::log(search.find(weights)?.im4));
        Breaks {
            all: find(&vec![1.0; sample.len()]),
            without: folds
                .map_or(Vec::new(), |folds| (0..count).map(|fold| find(&folds.without(fold))).collect()),
        }
    }
}

/// One power law, or one each side of a break.
#[derive(Clone)]
struct Law {
    parts: Vec<Part>,
}

/// A power law below an ln IM4.
#[derive(Clone)]
struct Part {
    below: f64,
    fit: DemandReplicate,
    n: f64,
}

impl Part {
    fn degrees(&self) -> f64 {
        self.n - self.fit.coefficients.len() as f64
    }

    /// Coefficients and the variance.
    fn parameters(&self) -> f64 {
        self.fit.coefficients.len() as f64 + 1.0
    }

    fn rss(&self) -> f64 {
        self.fit.residual_sd.powi(2) * self.degrees()
    }

    fn log_likelihood(&self) -> f64 {
        -0.5 * self.n * (libm::log(2.0 * PI * self.rss() / self.n) + 1.0)
    }
}

impl Law {
    /// Of the cases that count. None if they do not determine it, or there is no break where there should be one.
    fn fit(
        inference: &DemandInference,
        form: Form,
        break_at: Option<f64>,
        ln_im4: &[f64],
        weights: &[f64],
    ) -> Option<Law> {
        let edges = match form {
            Form::Single => vec![f64::INFINITY],
            Form::Broken => vec![break_at?, f64::INFINITY],
        };
        let mut above = f64::NEG_INFINITY;
        let part = |below: f64| {
            let within = |(weight, ln): (&f64, &f64)| if (above..below).contains(ln) { *weight } else { 0.0 };
            let weights: Vec<f64> = weights.iter().zip(ln_im4).map(within).collect();
            above = below;
            Some(Part { below, fit: inference.refit(&weights)?, n: weights.iter().sum() })
        };
        Some(Law { parts: edges.into_iter().map(part).collect::<Option<_>>()? })
    }

    /// Which part holds at this ln IM4.
    fn part_at(&self, ln_im4: f64) -> usize {
        self.parts.iter().position(|part| ln_im4 < part.below).unwrap_or(self.parts.len() - 1)
    }
}

/// Rates the demand on the measures of a candidate, from all cases and without each fold.
///
/// # Errors
/// With the status that says why there is no regression.
pub fn rate_demand(
    sample: &RankingSample,
    candidate: &Candidate,
    folds: Option<&Folds>,
    breaks: &Breaks,
) -> Result<Rating, FitStatus> {
    let n = sample.len();
    let cases = sample.demands(&candidate.measures);
    let regression = cases.fit()?;
    let inference = DemandInference::new(&cases, &regression);
    let design = cases.design();
    let ln_im4 = &sample.ln_im[sample.place(Measure::Im4).ok_or(FitStatus::TooFewCases)?];
    let law = |break_at: Option<f64>, weights: &[f64]| {
        Law::fit(&inference, candidate.form, break_at, ln_im4, weights)
    };
    let foresee = |law: &Law| {
        let laws: Vec<(Vec<f64>, f64)> = law
            .parts
            .iter()
            .map(|part| (design.indices(&part.fit.coefficients), part.fit.residual_sd))
            .collect();
        let law = law.clone();
        move |case: usize| {
            let (means, residual_sd) = &laws[law.part_at(ln_im4[case])];
            let z = (sample.ln_edp[case] - means[case]) / residual_sd;
            Prediction {
                log_score: -0.5 * (z * z + libm::log(2.0 * PI)) - libm::log(*residual_sd),
                index: (means[case] - sample.ln_limit) / residual_sd,
            }
        }
    };
    let whole = law(breaks.all, &vec![1.0; n]).ok_or(FitStatus::TooFewCases)?;
    if whole.parts.iter().any(|part| part.n <= CASES_A_PARAMETER * part.parameters()) {
        return Err(FitStatus::TooFewCases);
    }
    let fitted: Vec<Prediction> = (0..n).map(foresee(&whole)).collect();
    let held_out = folds.and_then(|folds| {
        folds.leave_out(|fold, weights| Some(foresee(&law(breaks.without[fold], weights)?)))
    });
    // Those of each part, and the break.
    let parameters = whole.parts.iter().map(Part::parameters).sum::<f64>() + whole.parts.len() as f64 - 1.0;
    let log_likelihood: f64 = whole.parts.iter().map(Part::log_likelihood).sum();
    let degrees: f64 = whole.parts.iter().map(Part::degrees).sum();
    let beta = (whole.parts.iter().map(Part::rss).sum::<f64>() / degrees).sqrt();
    let coefficients = match &whole.parts[..] {
        [Part { fit, .. }] => fit.coefficients.clone(),
        _ => Vec::new(),
    };
    Ok(Rating {
        log_likelihood,
        aic: 2.0 * parameters - 2.0 * log_likelihood,
        bic: parameters * libm::log(n as f64) - 2.0 * log_likelihood,
        fitted: Skill::of(&fitted, &sample.happened),
        beta,
        zeta: if let [_, slope] = coefficients[..] { Some(beta / slope) } else { None },
        coefficients,
        held_out: held_out.map(|held_out| HeldOut::of(&held_out, &sample.happened, &sample.clusters)),
    })
}

/// Rates the curve of overturning on the measures of a candidate, from all cases and without each fold.
///
/// # Errors
/// With the status that says why there is no curve.
pub fn rate_overturning(
    sample: &RankingSample,
    candidate: &Candidate,
    folds: Option<&Folds>,
) -> Result<Rating, FitStatus> {
    let events = Sample::of_happened(sample.columns(&candidate.measures), &sample.happened);
    let fit = fit_overturning(&events, &CurveModel::default())?;
    let inference = CurveInference::new(&events, &fit.regression);
    let design = events.design();
    let held_out = folds.and_then(|folds| {
        folds.leave_out(|_, weights| {
            let coefficients = inference.coefficients(weights)?;
            let indices = design.indices(coefficients.as_slice());
            Some(move |case: usize| {
                let index = indices[case];
                let log_score = Link::Probit.ln_probability(index, sample.happened[case]);
                Prediction { log_score, index }
            })
        })
    });
    Ok(Rating {
        coefficients: fit.regression.coefficients.as_slice().to_vec(),
        log_likelihood: fit.regression.log_likelihood,
        aic: fit.aic,
        bic: fit.bic,
        fitted: Skill { auc: fit.goodness.auc, brier: fit.goodness.brier },
        beta: fit.beta.value,
        zeta: None,
        held_out: held_out.map(|held_out| HeldOut::of(&held_out, &sample.happened, &sample.clusters)),
    })
}
