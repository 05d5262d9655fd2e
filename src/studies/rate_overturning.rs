use super::candidate::Candidate;
use super::folds::Folds;
use super::ranking_sample::RankingSample;
use super::rating::{Foresight, Rating, Skill, Unseen};
use crate::fragility::overturning::curves::{CurveModel, fit_overturning};
use crate::fragility::overturning::inference::CurveInference;
use crate::fragility::overturning::sample::EventSample;
use crate::statistics::FitStatus;
use crate::statistics::link::Link;

/// Rates the curve of overturning on the measures of a candidate, from all cases and without each fold.
///
/// # Errors
/// With the status that says why there is no curve.
pub fn rate_overturning(
    sample: &RankingSample,
    candidate: &Candidate,
    folds: Option<&Folds>,
) -> Result<Rating, FitStatus> {
    let events = EventSample::of_columns(sample.columns(&candidate.measures), sample.happened.clone());
    let fit = fit_overturning(&events, &CurveModel::default())?;
    let inference = CurveInference::new(&events, &fit.regression);
    let design = events.design();
    let unseen = folds.and_then(|folds| {
        folds.leave_out(|_, weights| {
            let coefficients = inference.coefficients(weights)?;
            let indices = design.indices(coefficients.as_slice());
            Some(move |case: usize| {
                let index = indices[case];
                let log_score = Link::Probit.ln_probability(index, sample.happened[case]);
                Foresight { log_score, index }
            })
        })
    });
    Ok(Rating {
        coefficients: fit.regression.coefficients.as_slice().to_vec(),
        log_likelihood: fit.regression.log_likelihood,
        aic: fit.aic,
        bic: fit.bic,
        fitted: Skill { auc: fit.auc, brier: fit.brier },
        beta: fit.beta.value,
        zeta: None,
        unseen: unseen.map(|unseen| Unseen::of(&unseen, &sample.happened)),
    })
}
