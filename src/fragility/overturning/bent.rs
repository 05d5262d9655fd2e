//! Bent curves: what answers where tests reject the straight line of the paper.

use nalgebra::{DMatrix, DVector};

use super::curves::CurveModel;
use super::expansion::{BENT, Series};
use crate::fragility::held_out::HeldOut;
use crate::fragility::predictor::{BENT_TERMS, Bend};
use crate::fragility::sample::{CLUSTER, Sample};
use crate::statistics::binary::{BinaryFit, BinaryLikelihood, Estimator};
use crate::statistics::design::{Moments, Rows, dot, quantile_knots};
use crate::statistics::influence::Influence;
use crate::statistics::newton::{Along, Maximum, Objective, maximise};

/// Shares of the cases below each knot (Harrell 2015, Regression modeling strategies, Table 2.3).
const KNOTS: [f64; 3] = [0.1, 0.5, 0.9];
/// How firmly the bend is held to none, in cases for each standard deviation of its terms: hardly at all, but so that it exists wherever
/// the straight line does.
const PENALTY: f64 = 0.1;
/// The size of a misfit is the difference in probability that one case of so many passes: not the largest of all, which one case at the
/// rim may have.
const SELDOM: usize = 20;

/// What the line says of a case, and what the bent curve says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    pub straight: f64,
    pub bent: f64,
}

impl Gap {
    /// The size of the difference, in probability.
    pub fn size(&self) -> f64 {
        (self.straight - self.bent).abs()
    }
}

/// The index of a curve with splines and a product besides its line.
#[derive(Debug, Clone, PartialEq)]
pub struct BentFit {
    pub knots: [[f64; 3]; 2],
    /// As [`Bend`] has them, those of the line first; 0 for what a curve of one measure lacks.
    pub coefficients: [f64; BENT_TERMS],
    /// Their covariance, where cases of one cluster may depend on each other, if there are many clusters.
    pub covariance: [[f64; BENT_TERMS]; BENT_TERMS],
    /// What cases say that were left out.
    pub held_out: Option<HeldOut>,
    /// How far the line is from it: where one case of twenty differs by more.
    pub gap: Gap,
}

/// The cases of a curve, with all terms.
pub struct BentSample {
    /// The terms in place of the measures.
    sample: Sample,
    knots: [[f64; 3]; 2],
    penalty: DVector<f64>,
    model: CurveModel,
}

impl BentSample {
    /// Of the cases of a curve by maximum likelihood; none of another estimator, or where a measure has too few values for knots.
    pub fn new(sample: &Sample, model: &CurveModel) -> Option<BentSample> {
        let (design, measures) = (sample.design(), sample.measures);
        if model.estimator != Estimator::Ml {
            return None;
        }
        let knots: Vec<[f64; 3]> =
            (0..measures).map(|measure| quantile_knots(&design, measure, KNOTS)).collect::<Option<_>>()?;
        let knots = [*knots.first()?, knots.get(1).copied().unwrap_or([0.0; 3])];
        let sample = with_bends(sample, &knots);
        let n = sample.cases() as f64;
        let moments = Moments::of(&sample.design());
        // Of the product what is left of it beside the line.
        let product = || {
            let of_case = |(x, y): (&f64, &f64)| (x - moments.means[0]) * (y - moments.means[1]);
            let further = |x: &[&[f64]]| vec![x[0].iter().zip(x[1]).map(of_case).collect()];
            let place = sample.measures;
            Moments::of(&sample.design().with(1, &further)).product(place, place)
        };
        let penalty = terms_of(1 + sample.measures).iter().enumerate().map(|(place, &term)| match term {
            3 | 4 => PENALTY * moments.product(place - 1, place - 1) / n,
            5 => PENALTY * product() / n,
            _ => 0.0,
        });
        let penalty = DVector::from_vec(penalty.collect());
        Some(BentSample { sample, knots, penalty, model: *model })
    }

    /// The fit to all cases, beside the straight line; none where the iterations do not end.
    pub fn fit(&self, straight: &BinaryFit) -> Option<BentFit> {
        let mut start = DVector::zeros(self.penalty.len());
        start.rows_mut(0, straight.coefficients.len()).copy_from(&straight.coefficients);
        let Maximum { at, objective, .. } = self.maximum(None, &start, 0.0)?;
        let fit = self.fit_at(at.clone(), &objective)?;
        let (design, link, bread) = (self.sample.design(), self.model.link, &fit.covariance);
        let cluster = |rows: &Rows, case: usize| rows.labels[CLUSTER][case] as usize;
        let clustered = || Influence::of_regression(&fit).clustered_covariance(&design, bread, cluster);
        let covariance = if self.sample.has_many_clusters() { clustered() } else { bread.clone() };
        let of_some = |sample| BentSample { sample, penalty: self.penalty.clone(), ..*self };
        let thinned = self.sample.thinned().map(of_some);
        let some = thinned.as_ref().unwrap_or(self);
        let refit = |weights: &[f64]| some.refit(weights, &at);
        let index = |b: &DVector<f64>, rows: &Rows| rows.indices(b.as_slice());
        let held_out = HeldOut::new(&some.sample.design(), link, refit, index, |y| y != 0.0);
        let (coefficients, covariance) = (placed(&at), placed_covariance(&covariance));
        Some(BentFit { knots: self.knots, coefficients, covariance, held_out, gap: some.gap(straight, &fit) })
    }

    /// The cases, with all terms.
    pub fn sample(&self) -> &Sample {
        &self.sample
    }

    /// Some of the cases of the curve, with all terms.
    pub fn with_terms(&self, some: &Sample) -> Sample {
        with_bends(some, &self.knots)
    }

    /// The log-likelihood about a fit.
    pub fn series(&self, fit: &BentFit) -> Option<Series> {
        let coefficients = self.coefficients_of(fit);
        let objective = self.penalised(None, &coefficients);
        let fit = self.fit_at(coefficients, &objective)?;
        Some(Series::about(&fit, BENT)?.penalised(&self.penalty))
    }

    /// The coefficients of a fit, without those that its curve lacks.
    pub fn coefficients_of(&self, fit: &BentFit) -> DVector<f64> {
        let terms = terms_of(self.penalty.len());
        DVector::from_iterator(terms.len(), terms.iter().map(|&term| fit.coefficients[term]))
    }

    /// The coefficients where each case counts so often, from those of a fit nearby.
    pub fn refit(&self, weights: &[f64], nearby: &DVector<f64>) -> Option<DVector<f64>> {
        Some(self.maximum(Some(weights), nearby, BENT.gain)?.at)
    }

    fn fit_at(&self, coefficients: DVector<f64>, objective: &Objective) -> Option<BinaryFit> {
        Some(BinaryFit {
            link: self.model.link,
            estimator: Estimator::Ml,
            coefficients,
            covariance: objective.information.clone().cholesky()?.inverse(),
            log_likelihood: f64::NAN,
            objective: objective.value,
        })
    }

    fn maximum(&self, weights: Option<&[f64]>, start: &DVector<f64>, tolerance: f64) -> Option<Maximum> {
        maximise(|b| self.penalised(weights, b), start, Along::All, tolerance)
    }

    /// The log-likelihood less what holds the bend to none.
    fn penalised(&self, weights: Option<&[f64]>, b: &DVector<f64>) -> Objective {
        let likelihood = BinaryLikelihood {
            design: self.sample.design(),
            weights,
            link: self.model.link,
            estimator: Estimator::Ml,
        };
        let Objective { value, gradient, information } = likelihood.at(b);
        let slope = self.penalty.component_mul(b);
        Objective {
            value: value - 0.5 * dot(slope.as_slice(), b.as_slice()),
            gradient: gradient - slope,
            information: information + DMatrix::from_diagonal(&self.penalty),
        }
    }

    fn gap(&self, straight: &BinaryFit, bent: &BinaryFit) -> Gap {
        // The terms of the line come first.
        let of_block = |rows: &Rows| -> Vec<Gap> {
            let probability = |index: f64| self.model.link.probability(index);
            let both = straight.indices(rows).into_iter().zip(bent.indices(rows));
            both.map(|(line, bent)| Gap { straight: probability(line), bent: probability(bent) }).collect()
        };
        let mut gaps = self.sample.design().fold(0, of_block, |all, part| all.extend(part));
        gaps.sort_by(|a, b| b.size().total_cmp(&a.size()));
        gaps[gaps.len() / SELDOM]
    }
}

/// Which of the terms of [`Bend`] an index of so many coefficients has: of one measure the line and its spline, of two all.
fn terms_of(count: usize) -> &'static [usize] {
    if count == 3 { &[0, 1, 3] } else { &[0, 1, 2, 3, 4, 5] }
}

/// The cases with the terms that bend.
fn with_bends(sample: &Sample, knots: &[[f64; 3]; 2]) -> Sample {
    sample.with(|x: &[&[f64]]| -> Vec<Vec<f64>> {
        let of_case = |case: usize| Bend::terms(knots, x[0][case], x.get(1).map(|y| y[case]));
        let of_cases: Vec<[f64; 3]> = (0..x[0].len()).map(of_case).collect();
        let terms = if x.len() == 1 { 0..1 } else { 0..3 };
        terms.map(|term| of_cases.iter().map(|bends| bends[term]).collect()).collect()
    })
}

/// Coefficients as [`BentFit`] has them.
pub fn placed(coefficients: &DVector<f64>) -> [f64; BENT_TERMS] {
    let mut placed = [0.0; BENT_TERMS];
    terms_of(coefficients.len()).iter().zip(coefficients).for_each(|(&term, &b)| placed[term] = b);
    placed
}

/// Their covariance, placed likewise.
fn placed_covariance(covariance: &DMatrix<f64>) -> [[f64; BENT_TERMS]; BENT_TERMS] {
    let (mut placed, terms) = ([[0.0; BENT_TERMS]; BENT_TERMS], terms_of(covariance.nrows()));
    for (i, &row) in terms.iter().enumerate() {
        terms.iter().enumerate().for_each(|(j, &column)| placed[row][column] = covariance[(i, j)]);
    }
    placed
}
