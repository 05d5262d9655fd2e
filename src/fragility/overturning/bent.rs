//! Bent curves: what answers where tests reject the straight line of the paper.

use nalgebra::{DMatrix, DVector};

use super::curves::CurveModel;
use crate::fragility::held_out::HeldOut;
use crate::fragility::predictor::{BENT_TERMS, Bend};
use crate::fragility::sample::{CLUSTER, Sample};
use crate::resampling::{Resamples, TOGETHER};
use crate::statistics::binary::{BinaryFit, BinaryLikelihood, Estimator};
use crate::statistics::design::{Moments, Rows, dot, quantile_knots};
use crate::statistics::influence::Influence;
use crate::statistics::newton::{Along, Maximum, Objective, maximise};

/// Shares of the cases below each knot (Harrell 2015, Regression modeling strategies, Table 2.3).
const KNOTS: [f64; 3] = [0.1, 0.5, 0.9];
/// How firmly the bend is held to none, in cases for each standard deviation of its terms: hardly at all, but so that it exists wherever
/// the straight line does.
const PENALTY: f64 = 0.1;
/// What the last step to a resample's maximum may gain in log-likelihood: it moves the index by some hundredths of its standard error.
const TOLERANCE: f64 = 1e-4;
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
    /// Which of the terms of [`Bend`] there are.
    terms: &'static [usize],
    penalty: DVector<f64>,
    model: CurveModel,
}

impl BentSample {
    /// Of the cases of a curve by maximum likelihood; none of another estimator, or where a measure has too few values for knots.
    pub fn new(sample: &Sample, model: &CurveModel) -> Option<BentSample> {
        let (design, measures) = (sample.design(), sample.measures);
        let terms: &[usize] = match measures {
            _ if model.estimator != Estimator::Ml => return None,
            0 => return None,
            1 => &[0, 1, 3],
            _ => &[0, 1, 2, 3, 4, 5],
        };
        let knots: Vec<[f64; 3]> =
            (0..measures).map(|measure| quantile_knots(&design, measure, KNOTS)).collect::<Option<_>>()?;
        let knots = [knots[0], knots.get(1).copied().unwrap_or([0.0; 3])];
        let bends = |x: &[&[f64]]| -> Vec<Vec<f64>> {
            let of_case = |case: usize| Bend::terms(&knots, x[0][case], x.get(1).map(|y| y[case]));
            let of_cases: Vec<[f64; 3]> = (0..x[0].len()).map(of_case).collect();
            let column = |term: &usize| of_cases.iter().map(|bends| bends[term - 3]).collect();
            terms[1 + measures..].iter().map(column).collect()
        };
        let sample = sample.with(bends);
        let n = sample.cases() as f64;
        let moments = Moments::of(&sample.design());
        // Of the product what is left of it beside the line.
        let product = || {
            let of_case = |(x, y): (&f64, &f64)| (x - moments.means[0]) * (y - moments.means[1]);
            let further = |x: &[&[f64]]| vec![x[0].iter().zip(x[1]).map(of_case).collect()];
            let place = sample.measures;
            Moments::of(&sample.design().with(1, &further)).product(place, place)
        };
        let penalty = terms.iter().enumerate().map(|(place, &term)| match term {
            3 | 4 => PENALTY * moments.product(place - 1, place - 1) / n,
            5 => PENALTY * product() / n,
            _ => 0.0,
        });
        let penalty = DVector::from_vec(penalty.collect());
        Some(BentSample { sample, knots, terms, penalty, model: *model })
    }

    /// The fit to all cases, beside the straight line; none where the iterations do not end.
    pub fn fit(&self, straight: &BinaryFit) -> Option<BentFit> {
        let mut start = DVector::zeros(self.penalty.len());
        start.rows_mut(0, straight.coefficients.len()).copy_from(&straight.coefficients);
        let Maximum { at, objective, .. } = self.maximum(None, &start, 0.0)?;
        let bread = objective.information.cholesky()?.inverse();
        let (design, link) = (self.sample.design(), self.model.link);
        let fit = BinaryFit {
            link,
            estimator: Estimator::Ml,
            coefficients: at.clone(),
            covariance: bread.clone(),
            log_likelihood: f64::NAN,
            objective: objective.value,
        };
        let cluster = |rows: &Rows, case: usize| rows.labels[CLUSTER][case] as usize;
        let clustered = || Influence::of_regression(&fit).clustered_covariance(&design, &bread, cluster);
        let covariance = if self.sample.has_many_clusters() { clustered() } else { bread.clone() };
        let of_some = |sample| BentSample { sample, penalty: self.penalty.clone(), ..*self };
        let thinned = self.sample.thinned().map(of_some);
        let some = thinned.as_ref().unwrap_or(self);
        let refit = |weights: &[f64]| Some(some.maximum(Some(weights), &at, TOLERANCE)?.at);
        let index = |b: &DVector<f64>, rows: &Rows| rows.indices(b.as_slice());
        let held_out = HeldOut::new(&some.sample.design(), link, refit, index, |y| y != 0.0);
        let (coefficients, covariance) = (self.placed(&at), self.placed_covariance(&covariance));
        Some(BentFit { knots: self.knots, coefficients, covariance, held_out, gap: some.gap(straight, &fit) })
    }

    /// The coefficients in each resample, as [`BentFit`] has them. How often each case is drawn is held in memory here, however many
    /// there are: bent curves are few.
    pub fn refits(&self, fit: &BentFit, resamples: &Resamples) -> [Option<[f64; BENT_TERMS]>; TOGETHER] {
        let start = DVector::from_iterator(self.terms.len(), self.terms.iter().map(|&k| fit.coefficients[k]));
        let rows = self.sample.rows();
        std::array::from_fn(|resample| {
            let weights = resamples.of(resample, &rows);
            Some(self.placed(&self.maximum(Some(&weights), &start, TOLERANCE)?.at))
        })
    }

    fn maximum(&self, weights: Option<&[f64]>, start: &DVector<f64>, tolerance: f64) -> Option<Maximum> {
        let likelihood = BinaryLikelihood {
            design: self.sample.design(),
            weights,
            link: self.model.link,
            estimator: Estimator::Ml,
        };
        let penalised = |b: &DVector<f64>| {
            let Objective { value, gradient, information } = likelihood.at(b);
            let slope = self.penalty.component_mul(b);
            Objective {
                value: value - 0.5 * dot(slope.as_slice(), b.as_slice()),
                gradient: gradient - slope,
                information: information + DMatrix::from_diagonal(&self.penalty),
            }
        };
        maximise(penalised, start, Along::All, tolerance)
    }

    fn placed(&self, coefficients: &DVector<f64>) -> [f64; BENT_TERMS] {
        let mut placed = [0.0; BENT_TERMS];
        self.terms.iter().zip(coefficients.iter()).for_each(|(&term, &b)| placed[term] = b);
        placed
    }

    fn placed_covariance(&self, covariance: &DMatrix<f64>) -> [[f64; BENT_TERMS]; BENT_TERMS] {
        let mut placed = [[0.0; BENT_TERMS]; BENT_TERMS];
        for (i, &row) in self.terms.iter().enumerate() {
            self.terms.iter().enumerate().for_each(|(j, &column)| placed[row][column] = covariance[(i, j)]);
        }
        placed
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
