use std::f64::consts::PI;

use nalgebra::DVector;

use super::candidate::{Candidate, Form};
use super::folds::Folds;
use super::ranking_sample::RankingSample;
use super::rating::{Foresight, Rating, Skill, Unseen};
use crate::fragility::case::Measure;
use crate::fragility::demand::inference::{DemandInference, DemandReplicate};
use crate::fragility::demand::regressions::PLANE;
use crate::fragility::demand::transition::TransitionSearch;
use crate::statistics::FitStatus;
use crate::statistics::design_matrix::dot;

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
            return Breaks { all: Some(im4.ln()), without: vec![Some(im4.ln()); count] };
        }
        let [Some(im4), Some(im3)] = PLANE.map(|measure| sample.place(measure)) else {
            return Breaks { all: None, without: vec![None; count] };
        };
        let search = TransitionSearch::new(&sample.demands(&[im4, im3]));
        let find = |weights: &[f64]| Some(search.find(weights)?.im4.ln());
        Breaks {
            all: find(&vec![1.0; sample.len()]),
            without: folds
                .map_or(Vec::new(), |folds| (0..count).map(|fold| find(&folds.without(fold))).collect()),
        }
    }
}

/// One power law, or one each side of a break.
struct Law {
    parts: Vec<Part>,
}

/// A power law below an ln IM4.
struct Part {
    below: f64,
    fit: DemandReplicate,
    n: f64,
}

impl Part {
    fn degrees(&self) -> f64 {
        self.n - self.fit.coefficients.len() as f64
    }

    fn rss(&self) -> f64 {
        self.fit.residual_sd.powi(2) * self.degrees()
    }

    fn log_likelihood(&self) -> f64 {
        -0.5 * self.n * ((2.0 * PI * self.rss() / self.n).ln() + 1.0)
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

    fn at(&self, ln_im4: f64) -> &DemandReplicate {
        let last = self.parts.len() - 1;
        &self.parts.iter().find(|part| ln_im4 < part.below).unwrap_or(&self.parts[last]).fit
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
    let rows: Vec<DVector<f64>> = design.rows().collect();
    let ln_im4 = &sample.ln_im[sample.place(Measure::Im4).ok_or(FitStatus::TooFewCases)?];
    let law = |break_at: Option<f64>, weights: &[f64]| {
        Law::fit(&inference, candidate.form, break_at, ln_im4, weights)
    };
    let foresee = |law: &Law, case: usize| {
        let DemandReplicate { coefficients, residual_sd } = law.at(ln_im4[case]);
        let mean = dot(rows[case].as_slice(), coefficients);
        let z = (sample.ln_edp[case] - mean) / residual_sd;
        Foresight {
            log_score: -0.5 * (z * z + (2.0 * PI).ln()) - residual_sd.ln(),
            index: (mean - sample.ln_limit) / residual_sd,
        }
    };
    let whole = law(breaks.all, &vec![1.0; n]).ok_or(FitStatus::TooFewCases)?;
    let fitted: Vec<Foresight> = (0..n).map(|case| foresee(&whole, case)).collect();
    let unseen = folds.and_then(|folds| {
        folds.leave_out(|fold, weights| {
            let (law, foresee) = (law(breaks.without[fold], weights)?, &foresee);
            Some(move |case| foresee(&law, case))
        })
    });
    let parts = whole.parts.len() as f64;
    // Coefficients and the variance of each part, and the break.
    let parameters = parts * (candidate.measures.len() as f64 + 2.0) + parts - 1.0;
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
        bic: parameters * (n as f64).ln() - 2.0 * log_likelihood,
        fitted: Skill::of(&fitted, &sample.happened),
        beta,
        zeta: if let [_, slope] = coefficients[..] { Some(beta / slope) } else { None },
        coefficients,
        unseen: unseen.map(|unseen| Unseen::of(&unseen, &sample.happened)),
    })
}
