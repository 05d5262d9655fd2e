//! Ranking of measures, alone, in pairs and in triples, by Akaike's criterion and by the cross-validated log
//! score, with whole clusters (cells of magnitude and distance, or earthquakes) left out. The dispersion beta
//! of a hybrid measure depends on its units, a log score does not (Gneiting & Raftery 2007, J. American
//! Statistical Association 102, 359-378).

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::fragility::{Case, Cases, Measure};
use crate::keyword::keywords;
use crate::rocking::Outcome;
use crate::statistics::clusters::clustered_mean;
use crate::statistics::{FitStatus, Folds, LinearFit, least_squares, normal, predict, probit};

keywords! {
    /// Target of the prediction.
    pub enum Target {
        /// ln EDP in safe rocking: P_ex.
        Demand = "p_ex",
        /// Overturning given rocking: P_ro.
        Overturning = "p_ro",
    }
}

keywords! {
    /// Form of a set of measures: linear in their logarithms, and so a power law of their product.
    pub enum Form {
        /// One power law.
        Single = "single",
        /// One below the transition in IM4 and one above, as the two planes of Eq. 18; demand only.
        Biplanar = "biplanar",
    }
}

/// Options of a ranking.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankingRules {
    /// Largest number of measures in a set.
    pub terms: usize,
    /// Largest number of folds.
    pub folds: usize,
    /// IM4 at the transition of biplanar forms.
    pub transition: f64,
}

/// Scores of a set of measures: a row of ranking.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "data/columns.csv says it")]
pub struct RankedSet {
    pub suite: Option<String>,
    pub structure: String,
    pub target: Target,
    pub form: Form,
    /// Names of the measures, joined by colons.
    pub measures: String,
    pub terms: i64,
    pub n: i64,
    /// Rank by log score, from 1; by AIC without cross-validation. Sets that make one model share it.
    pub rank: i64,
    /// Log-likelihood of the fit to all cases; for demand, with normal residuals of ln EDP.
    pub log_likelihood: Option<f64>,
    /// Akaike's criterion; residual variances and the transition count as parameters.
    pub aic: Option<f64>,
    /// Mean log-likelihood of cases left out of the fit.
    pub log_score: Option<f64>,
    /// `log_score` minus that of the best set, and its standard error between clusters.
    pub loss: Option<f64>,
    pub loss_error: Option<f64>,
    pub status: FitStatus,
}

impl RankedSet {
    /// Whether it is the same model by other measures, such as IM3 and IM5 in place of IM4 and IM5.
    fn is_one_with(&self, other: &RankedSet) -> bool {
        (self.form, self.terms) == (other.form, other.terms)
            && is_near(self.log_likelihood, other.log_likelihood)
            && is_near(self.log_score, other.log_score)
    }
}

fn is_near(a: Option<f64>, b: Option<f64>) -> bool {
    a.zip(b).is_some_and(|(a, b)| (a - b).abs() <= 1e-8 * a.abs().max(1.0))
}

/// All sets of measures of a structure and suite, best first.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Ranked sets of measures.
    pub sets: Vec<RankedSet>,
    /// Measures missing in some cases, and in how many; they are not ranked.
    pub incomplete: Vec<(String, usize)>,
}

/// The cases of a target, with the measures known in all of them: only then are likelihoods comparable.
struct Contest<'a> {
    target: Target,
    transition: f64,
    rows: Vec<&'a Case>,
    names: Vec<String>,
    ln_im: Vec<Vec<f64>>,
    clusters: Vec<u32>,
}

/// Ranks all sets of up to `rules.terms` measures, those of Eq. 13 and candidates.
///
/// ```
/// use rockfrag::fragility::{Case, Cases, Cluster};
/// use rockfrag::motion::{IntensityMeasures, Peaks};
/// use rockfrag::rocking::{Outcome, Structure};
/// use rockfrag::studies::{RankedSet, RankingRules, Target, rank_measures};
///
/// // Sixty responses in ten earthquakes, whose demands go with PGA.
/// let block = Structure::new("block", 2.5, 0.2, 0.92)?;
/// let mut cases = Cases::new(None, block.clone());
/// for k in 0..60 {
///     let [k, shape] = [k, k % 7].map(f64::from);
///     let peaks = Peaks { pga_m_s2: 2.0 + 0.1 * k, pgv_m_s: 0.3 + 0.1 * shape };
///     let measures = IntensityMeasures::new(&block, peaks, None, None);
///     let outcome = Outcome::SafeRocking(0.01 * measures.im4.powi(2) * (1.0 + 0.1 * (k % 3.0)));
///     let earthquake = Cluster::new(None, Some(6.5), Some(1.0 + k % 10.0));
///     cases.push(Case { outcome, measures, peaks, mw: None, cluster: 0 }, earthquake);
/// }
/// let rules = RankingRules { terms: 1, folds: 10, transition: 1.3 };
/// let RankedSet { measures, rank, .. } = &rank_measures(&cases, Target::Demand, &rules).sets[0];
/// assert_eq!((measures.as_str(), *rank), ("im4", 1));
/// # Ok::<(), rockfrag::rocking::StructureError>(())
/// ```
pub fn rank_measures(cases: &Cases, target: Target, rules: &RankingRules) -> Ranking {
    let (contest, incomplete) = Contest::new(cases, target, rules.transition);
    let folds = Folds::new(&contest.clusters, rules.folds);
    let forms: &[Form] = match target {
        Target::Demand => &[Form::Single, Form::Biplanar],
        Target::Overturning => &[Form::Single],
    };
    let sets = subsets(contest.names.len(), rules.terms);
    let rated = sets.par_iter().flat_map_iter(|set| forms.iter().map(move |form| (set, *form)));
    let rated = rated.map(|(set, form)| {
        let scores = folds.as_ref().and_then(|folds| contest.left_out(set, form, folds));
        (contest.rate(cases, set, form, scores.as_deref()), scores)
    });
    let mut rated: Vec<(RankedSet, Option<Vec<f64>>)> = rated.collect();
    rated.sort_by(|(a, _), (b, _)| {
        let by_score = rounded(b.log_score, -1.0).total_cmp(&rounded(a.log_score, -1.0));
        by_score.then(rounded(a.aic, 1.0).total_cmp(&rounded(b.aic, 1.0)))
    });
    let best = rated.first().and_then(|(_, scores)| scores.clone());
    for at in 1..rated.len() {
        // The measures of one power law have one rank.
        let is_new = !rated[at].0.is_one_with(&rated[at - 1].0);
        rated[at].0.rank = rated[at - 1].0.rank + i64::from(is_new);
    }
    for (set, scores) in &mut rated {
        if let (Some(best), Some(scores)) = (&best, scores) {
            let losses: Vec<f64> = scores.iter().zip(best).map(|(score, best)| score - best).collect();
            let (loss, error) = clustered_mean(&losses, &contest.clusters);
            (set.loss, set.loss_error) = (Some(loss), Some(error));
        }
    }
    Ranking { sets: rated.into_iter().map(|(set, _)| set).collect(), incomplete }
}

/// Rounds a score, so that of equal power laws (IM4 = IM3 IM5) the first stays first; without one it is
/// infinite, of this sign.
fn rounded(score: Option<f64>, sign: f64) -> f64 {
    score.map_or(sign * f64::INFINITY, |score| (score * 1e9).round())
}

/// Returns all sets of up to `most` numbers below `count`, by size.
fn subsets(count: usize, most: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = Vec::new();
    let mut last = vec![Vec::new()];
    for _ in 0..most {
        let mut longer = Vec::new();
        for set in &last {
            let next = set.last().map_or(0, |last| last + 1);
            longer.extend((next..count).map(|more| [&set[..], &[more]].concat()));
        }
        all.extend(longer.clone());
        last = longer;
    }
    all
}

impl<'a> Contest<'a> {
    fn new(cases: &'a Cases, target: Target, transition: f64) -> (Contest<'a>, Vec<(String, usize)>) {
        let counted = cases.all.iter().enumerate().filter(|(_, case)| match target {
            Target::Demand => case.ln_demand().is_some(),
            Target::Overturning => case.outcome != Outcome::NoRocking,
        });
        let (places, rows): (Vec<usize>, Vec<&Case>) = counted.unzip();
        let published = Measure::SCALAR.iter().map(|measure| {
            let values = rows.iter().map(|case| measure.raw_value_of(&case.measures));
            (measure.into(), values.collect::<Vec<_>>())
        });
        let candidates = cases.candidates.iter().map(|(name, values)| {
            (name.as_str(), places.iter().map(|place| values[*place]).collect::<Vec<_>>())
        });
        let (mut names, mut ln_im, mut incomplete) = (Vec::new(), Vec::new(), Vec::new());
        for (name, values) in published.chain(candidates) {
            let ln = values.into_iter().flatten().map(f64::ln).filter(|ln| ln.is_finite());
            let ln: Vec<f64> = ln.collect();
            if ln.len() == rows.len() {
                names.push(name.to_string());
                ln_im.push(ln);
            } else {
                incomplete.push((name.to_string(), rows.len() - ln.len()));
            }
        }
        let clusters = rows.iter().map(|case| case.cluster).collect();
        (Contest { target, transition, rows, names, ln_im, clusters }, incomplete)
    }

    /// The measures of a set in some of the cases.
    fn columns(&self, set: &[usize], rows: &[usize]) -> Vec<Vec<f64>> {
        set.iter().map(|&k| rows.iter().map(|&row| self.ln_im[k][row]).collect()).collect()
    }

    /// Computes the log-likelihood of each case by the fit to some, whose standard deviation of ln EDP is
    /// `sd`.
    fn log_likelihoods(
        &self,
        set: &[usize],
        form: Form,
        fitted: &[usize],
        sd: impl Fn(&LinearFit) -> f64,
    ) -> Result<Vec<f64>, FitStatus> {
        let x: Vec<&[f64]> = set.iter().map(|&k| self.ln_im[k].as_slice()).collect();
        let overturned = |row: usize| self.rows[row].outcome == Outcome::Overturned;
        let mut scores = vec![0.0; self.rows.len()];
        if self.target == Target::Overturning {
            let events: Vec<bool> = fitted.iter().map(|&row| overturned(row)).collect();
            let probit = probit(&self.columns(set, fitted), &events)?;
            for (row, z) in predict(probit.fit.coefficients.as_slice(), &x).into_iter().enumerate() {
                scores[row] = normal::ln_cdf(if overturned(row) { z } else { -z });
            }
            return Ok(scores);
        }
        let is_low = |row: usize| form == Form::Biplanar && self.rows[row].measures.im4 < self.transition;
        let y: Vec<f64> = self.rows.iter().filter_map(|case| case.ln_demand()).collect();
        let sides: &[bool] = if form == Form::Biplanar { &[true, false] } else { &[false] };
        for &side in sides {
            let rows: Vec<usize> = fitted.iter().copied().filter(|row| is_low(*row) == side).collect();
            let its: Vec<f64> = rows.iter().map(|&row| y[row]).collect();
            let law = least_squares(&self.columns(set, &rows), &its)?;
            let (means, sd) = (predict(law.fit.coefficients.as_slice(), &x), sd(&law));
            for row in (0..y.len()).filter(|row| is_low(*row) == side) {
                scores[row] = -0.5 * (((y[row] - means[row]) / sd).powi(2) + (2.0 * PI).ln()) - sd.ln();
            }
        }
        Ok(scores)
    }

    /// Computes the log-likelihood of each case by the fit without its fold; none if a fold has no fit.
    fn left_out(&self, set: &[usize], form: Form, folds: &Folds) -> Option<Vec<f64>> {
        let mut scores = vec![0.0; self.rows.len()];
        for fold in 0..folds.count {
            let (kept, left_out) = folds.split(fold);
            let by_others = self.log_likelihoods(set, form, &kept, LinearFit::residual_sd).ok()?;
            left_out.into_iter().for_each(|row| scores[row] = by_others[row]);
        }
        Some(scores)
    }

    fn rate(&self, cases: &Cases, set: &[usize], form: Form, scores: Option<&[f64]>) -> RankedSet {
        let n = self.rows.len();
        let all: Vec<usize> = (0..n).collect();
        let by_case = self.log_likelihoods(set, form, &all, |law| (law.rss / law.fit.n as f64).sqrt());
        let log_likelihood = by_case.as_ref().ok().map(|by_case| by_case.iter().sum::<f64>());
        let parameters = match (self.target, form) {
            (Target::Overturning, _) => set.len() + 1,
            (Target::Demand, Form::Single) => set.len() + 2,
            (Target::Demand, Form::Biplanar) => 2 * (set.len() + 2) + 1,
        };
        let names: Vec<&str> = set.iter().map(|&k| self.names[k].as_str()).collect();
        RankedSet {
            suite: cases.suite.clone(),
            structure: cases.structure.name.clone(),
            target: self.target,
            form,
            measures: names.join(":"),
            terms: set.len() as i64,
            n: n as i64,
            rank: 1,
            log_likelihood,
            aic: log_likelihood.map(|log_likelihood| 2.0 * (parameters as f64 - log_likelihood)),
            log_score: scores.map(|scores| scores.iter().sum::<f64>() / n as f64),
            loss: None,
            loss_error: None,
            status: by_case.err().unwrap_or(FitStatus::Ok),
        }
    }
}
