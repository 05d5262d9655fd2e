//! One curve for all structures: what they differ in as covariates, and how well it predicts structures that it has not seen.

use super::transfer::CurveSubject;
use crate::fragility::case::{Case, Event, Measure};
use crate::fragility::demand::inference::DemandInference;
use crate::fragility::overturning::inference::CurveInference;
use crate::fragility::probability::exceeding_index;
use crate::fragility::sample::Sample;
use crate::keyword::{Keyword, keywords};
use crate::normal;
use crate::resampling::folds::{Folds, MOST_FOLDS};
use crate::statistics::FitStatus;
use crate::statistics::binary::Estimator;
use crate::statistics::binary::regress;
use crate::statistics::design::{Dependence, Moments};
use crate::statistics::link::Link;

/// What the index of a pooled curve consists of, each with all of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PooledTerms {
    /// The logarithms of the measures: one lognormal curve for all structures.
    Line,
    /// Their squares and products too.
    Curved,
    /// The coefficient of restitution, the dimensionless group that the measures lack.
    Restitution,
    /// ln p and ln alpha, which the measures should have made superfluous.
    Structure,
}

keywords!(PooledTerms { Line = "line", Curved = "curved", Restitution = "restitution", Structure = "structure" });

/// A structure among others; its parameters as differences from those of a reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PooledStructure<'a> {
    pub cases: &'a [Case],
    /// ln p.
    pub ln_p: f64,
    /// ln alpha.
    pub ln_alpha: f64,
    /// Coefficient of restitution.
    pub eta: f64,
}

/// A coefficient of a pooled curve.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledTerm {
    /// Of what, in words.
    pub name: String,
    pub coefficient: f64,
    /// Its standard error; all cases of a structure may depend on each other.
    pub standard_error: f64,
}

/// The curve in a range of the first measure.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledPart {
    pub range: std::ops::Range<f64>,
    /// The coefficients, the intercept first.
    pub terms: Vec<PooledTerm>,
    /// Of P_ex, the dispersion of ln EDP.
    pub residual_sd: Option<f64>,
    /// Cases.
    pub n: usize,
}

/// One curve for all structures.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledFit {
    /// The curve; of P_ex that of ln EDP, on each side of the transition that has cases.
    pub parts: Vec<PooledPart>,
    /// Mean log score of the cases of each structure by the curve of others; none without a case.
    pub log_scores: Vec<Option<f64>>,
}

/// What a structure brings besides its measures, and its name.
type Covariate = (&'static str, fn(&PooledStructure) -> f64);

impl PooledTerms {
    fn names(self, measures: &[Measure]) -> Vec<String> {
        let ln = |measure: &Measure| format!("ln {}", measure.as_str());
        let mut names: Vec<String> = measures.iter().map(ln).collect();
        if self != PooledTerms::Line {
            let products =
                pairs(measures.len()).map(|(i, j)| format!("{} {}", ln(&measures[i]), ln(&measures[j])));
            names.extend(products.collect::<Vec<_>>());
        }
        names.extend(self.covariates().iter().map(|(name, _)| name.to_string()));
        names
    }

    fn covariates(self) -> &'static [Covariate] {
        match self {
            PooledTerms::Line | PooledTerms::Curved => &[],
            PooledTerms::Restitution => &[("eta", |of| of.eta)],
            PooledTerms::Structure => {
                &[("eta", |of| of.eta), ("ln p", |of| of.ln_p), ("ln alpha", |of| of.ln_alpha)]
            }
        }
    }

    /// Appends the terms of cases with these logarithms to those of other structures, term by term.
    fn append(self, columns: &mut Vec<Vec<f64>>, ln_im: &[Vec<f64>], structure: &PooledStructure) {
        let mut terms: Vec<Vec<f64>> = ln_im.to_vec();
        if self != PooledTerms::Line {
            let product =
                |(i, j): (usize, usize)| ln_im[i].iter().zip(&ln_im[j]).map(|(x, y)| x * y).collect();
            terms.extend(pairs(ln_im.len()).map(product));
        }
        terms.extend(self.covariates().iter().map(|(_, of)| vec![of(structure); ln_im[0].len()]));
        columns.resize(terms.len(), Vec::new());
        columns.iter_mut().zip(terms).for_each(|(column, term)| column.extend(term));
    }
}

/// All pairs, each with itself too.
fn pairs(of: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..of).flat_map(move |i| (i..of).map(move |j| (i, j)))
}

/// Sums of log scores and cases, by structure.
type Scores = Vec<(f64, usize)>;

/// The curve of all structures. Structures that it has not seen are those of a fold that is left out.
///
/// # Errors
/// With the status that says why there is none: a covariate may be the same in all structures.
pub fn fit_pooled(
    subject: &CurveSubject,
    structures: &[PooledStructure],
    terms: PooledTerms,
) -> Result<PooledFit, FitStatus> {
    let mut scores: Scores = vec![(0.0, 0); structures.len()];
    let part = |range| match subject.event {
        Event::Exceeding => demand(subject, structures, terms, range, &mut scores),
        _ => overturning(subject, structures, terms, range, &mut scores),
    };
    let parts = subject.parts().into_iter().map(part).collect::<Result<Vec<_>, _>>()?;
    let mean = |(sum, count): (f64, usize)| (count > 0).then(|| sum / count as f64);
    Ok(PooledFit {
        parts: parts.into_iter().flatten().collect(),
        log_scores: scores.into_iter().map(mean).collect(),
    })
}

fn overturning(
    subject: &CurveSubject,
    structures: &[PooledStructure],
    terms: PooledTerms,
    range: std::ops::Range<f64>,
    scores: &mut Scores,
) -> Result<Option<PooledPart>, FitStatus> {
    let (mut columns, mut happened, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    for (k, structure) in structures.iter().enumerate() {
        let sample = Sample::of_events(structure.cases, &subject.measures(), |case| subject.happened(case));
        terms.append(&mut columns, &sample.predictors(), structure);
        owners.extend(vec![k; sample.cases()]);
        happened.extend(sample.observed());
    }
    let sample = Sample::of_columns(columns, happened.clone());
    let design = sample.design();
    match Moments::of(&design).dependence() {
        Some(Dependence::Constant) => return Err(FitStatus::Constant),
        Some(Dependence::Collinear) => return Err(FitStatus::Collinear),
        None => {}
    }
    let fit = regress(design, Link::Probit, Estimator::Ml).map_err(|_| FitStatus::NotConverged)?;
    let inference = CurveInference::new(&sample, &fit);
    leave_structures_out(&owners, |counts| {
        let b = inference.coefficients(counts).ok_or(FitStatus::NotConverged)?;
        let indices = design.indices(b.as_slice());
        let cases = indices.into_iter().zip(&happened).zip(&owners).zip(counts);
        for (((index, &event), &owner), _) in cases.filter(|(_, count)| **count == 0.0) {
            add(scores, owner, index, event != 0.0);
        }
        Ok(())
    })?;
    let errors = inference.clustered_covariance(&owners).diagonal().map(f64::sqrt);
    let terms = named_terms(terms.names(&subject.measures()), fit.coefficients.as_slice(), errors.as_slice());
    Ok(Some(PooledPart { range, terms, residual_sd: None, n: owners.len() }))
}

fn demand(
    subject: &CurveSubject,
    structures: &[PooledStructure],
    terms: PooledTerms,
    range: std::ops::Range<f64>,
    scores: &mut Scores,
) -> Result<Option<PooledPart>, FitStatus> {
    let (mut columns, mut ln_edp, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    for (k, structure) in structures.iter().enumerate() {
        let sample = Sample::of_demands(structure.cases, &subject.measures(), range.clone());
        terms.append(&mut columns, &sample.predictors(), structure);
        owners.extend(vec![k; sample.cases()]);
        ln_edp.extend(sample.observed());
    }
    if ln_edp.is_empty() {
        return Ok(None);
    }
    let sample = Sample::of_columns(columns, ln_edp.clone());
    let fit = sample.fit()?;
    let (inference, design) = (DemandInference::new(&sample, &fit), sample.design());
    leave_structures_out(&owners, |counts| {
        let refit = inference.refit(counts).ok_or(FitStatus::TooFewCases)?;
        let means = design.indices(&refit.coefficients);
        let cases = means.into_iter().zip(&ln_edp).zip(&owners).zip(counts);
        for (((mean, &ln_edp), &owner), _) in cases.filter(|(_, count)| **count == 0.0) {
            let index = exceeding_index(mean, subject.limit, refit.residual_sd);
            add(scores, owner, index, ln_edp > libm::log(subject.limit));
        }
        Ok(())
    })?;
    let (values, errors) = (fit.values(), inference.clustered_errors(&owners));
    let terms = named_terms(terms.names(&subject.measures()), values.as_slice(), &errors);
    Ok(Some(PooledPart { range, terms, residual_sd: Some(fit.residual_sd), n: owners.len() }))
}

/// Calls `refit` once for each fold of structures, with how often each case counts: those of the fold never.
fn leave_structures_out(
    owners: &[usize],
    mut refit: impl FnMut(&[f64]) -> Result<(), FitStatus>,
) -> Result<(), FitStatus> {
    let folds = Folds::new(owners, MOST_FOLDS).ok_or(FitStatus::TooFewCases)?;
    for fold in 0..folds.count {
        refit(&folds.without(fold))?;
    }
    Ok(())
}

fn add(scores: &mut Scores, owner: usize, index: f64, happened: bool) {
    let (sum, count) = &mut scores[owner];
    *sum += normal::ln_cdf(if happened { index } else { -index });
    *count += 1;
}

fn named_terms(names: Vec<String>, coefficients: &[f64], errors: &[f64]) -> Vec<PooledTerm> {
    let names = std::iter::once("intercept".to_string()).chain(names);
    let term = |(name, (&coefficient, &standard_error))| PooledTerm { name, coefficient, standard_error };
    names.zip(coefficients.iter().zip(errors)).map(term).collect()
}
