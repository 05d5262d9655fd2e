//! Bent curves: what answers where tests reject the straight line of the paper.

use nalgebra::{DMatrix, DVector};

use super::curves::CurveModel;
use super::sample::EventSample;
use crate::fragility::clusters::are_many;
use crate::fragility::held_out::HeldOut;
use crate::fragility::predictor::{BENT_TERMS, Bend};
use crate::resampling::{Resamples, TOGETHER};
use crate::statistics::binary::{BinaryFit, BinaryLikelihood, Estimator};
use crate::statistics::design::{DesignMatrix, dot, quantile_knots};
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
pub struct BentSample<'a> {
    sample: &'a EventSample,
    design: DesignMatrix,
    knots: [[f64; 3]; 2],
    /// Which of the terms of [`Bend`] there are.
    terms: &'static [usize],
    penalty: DVector<f64>,
    model: CurveModel,
}

impl<'a> BentSample<'a> {
    /// Of the cases of a curve by maximum likelihood; none of another estimator, or where a measure has too few values for knots.
    pub fn new(sample: &'a EventSample, model: &CurveModel) -> Option<BentSample<'a>> {
        let measures = sample.predictors();
        let knots =
            measures.iter().map(|values| quantile_knots(values, KNOTS)).collect::<Option<Vec<_>>>()?;
        let knots = [knots[0], knots.get(1).copied().unwrap_or([0.0; 3])];
        let bends = |case: usize| Bend::terms(&knots, measures[0][case], measures.get(1).map(|y| y[case]));
        let bends: Vec<[f64; 3]> = (0..sample.happened.len()).map(bends).collect();
        let column = |k: usize| bends.iter().map(|bend| bend[k]).collect::<Vec<f64>>();
        let (columns, terms): (Vec<Vec<f64>>, &[usize]) = match measures[..] {
            [x] => (vec![x.to_vec(), column(0)], &[0, 1, 3]),
            [x, y, ..] => {
                (vec![x.to_vec(), y.to_vec(), column(0), column(1), column(2)], &[0, 1, 2, 3, 4, 5])
            }
            [] => return None,
        };
        let variance = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / values.len() as f64
        };
        // Of the product what is left of it beside the line.
        let centred = |values: &[f64]| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.iter().map(|value| value - mean).collect::<Vec<f64>>()
        };
        let product = |x: &[f64], y: &[f64]| {
            variance(&centred(x).iter().zip(centred(y)).map(|(x, y)| x * y).collect::<Vec<f64>>())
        };
        let penalty = terms.iter().enumerate().map(|(place, &term)| match term {
            3 | 4 => PENALTY * variance(&columns[place - 1]),
            5 => PENALTY * product(measures[0], measures[1]),
            _ => 0.0,
        });
        let penalty = DVector::from_vec(penalty.collect());
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let design = DesignMatrix::new(&columns, sample.happened.len());
        (model.estimator == Estimator::Ml).then_some(BentSample {
            sample,
            design,
            knots,
            terms,
            penalty,
            model: *model,
        })
    }

    /// The fit to all cases, beside the straight line; none where the iterations do not end.
    pub fn fit(&self, straight: &BinaryFit, clusters: &[usize]) -> Option<BentFit> {
        let once_each = vec![1.0; self.sample.happened.len()];
        let mut start = DVector::zeros(self.penalty.len());
        start.rows_mut(0, straight.coefficients.len()).copy_from(&straight.coefficients);
        let Maximum { at, objective, .. } = self.maximum(&once_each, &start, 0.0)?;
        let bread = objective.information.cholesky()?.inverse();
        let many = are_many(clusters, &self.sample.rows);
        let clusters: Vec<usize> = self.sample.rows.iter().map(|&row| clusters[row]).collect();
        let fit = BinaryFit {
            link: self.model.link,
            estimator: Estimator::Ml,
            coefficients: at.clone(),
            covariance: bread.clone(),
            log_likelihood: f64::NAN,
            objective: objective.value,
        };
        let influence = Influence::of_regression(&fit, &self.design, &self.sample.happened);
        let clustered = || influence.clustered_covariance(&self.design, &bread, &clusters);
        let covariance = if many { clustered() } else { bread.clone() };
        let refit = |weights: &[f64]| Some(self.maximum(weights, &at, TOLERANCE)?.at);
        let held_out = HeldOut::new(&self.design, &self.sample.happened, &clusters, self.model.link, refit);
        let (coefficients, covariance) = (self.placed(&at), self.placed_covariance(&covariance));
        Some(BentFit { knots: self.knots, coefficients, covariance, held_out, gap: self.gap(straight, &fit) })
    }

    /// The coefficients in each resample, as [`BentFit`] has them.
    pub fn refits(&self, fit: &BentFit, resamples: &Resamples) -> [Option<[f64; BENT_TERMS]>; TOGETHER] {
        let start = DVector::from_iterator(self.terms.len(), self.terms.iter().map(|&k| fit.coefficients[k]));
        std::array::from_fn(|resample| {
            let weights = resamples.of(resample, &self.sample.rows);
            Some(self.placed(&self.maximum(&weights, &start, TOLERANCE)?.at))
        })
    }

    fn maximum(&self, weights: &[f64], start: &DVector<f64>, tolerance: f64) -> Option<Maximum> {
        let likelihood = BinaryLikelihood {
            design: &self.design,
            events: &self.sample.happened,
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
        let probabilities = |fit: &BinaryFit, design: &DesignMatrix| -> Vec<f64> {
            fit.indices(design).into_iter().map(|index| fit.link.probability(index)).collect()
        };
        let both =
            probabilities(straight, &self.sample.design()).into_iter().zip(probabilities(bent, &self.design));
        let mut gaps: Vec<Gap> = both.map(|(straight, bent)| Gap { straight, bent }).collect();
        gaps.sort_by(|a, b| b.size().total_cmp(&a.size()));
        gaps[gaps.len() / SELDOM]
    }
}
