//! How uncertain a regression of the demand is: clustered errors, and refits of resampled cases.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::fragility::demand::sample::DemandSample;
use crate::fragility::held_out::HeldOut;
use crate::fragility::probability::exceeding_index;
use crate::resampling::bootstrap::{Resamples, Strata, TOGETHER};
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::folds::{Folds, MOST_FOLDS};
use crate::resampling::limits::acceleration;
use crate::resampling::normal_equations::{LeastSquares, NormalEquations};
use crate::statistics::design::DesignMatrix;
use crate::statistics::influence::Influence;
use crate::statistics::link::Link;
use crate::statistics::regression::LinearFit;

/// A regression of resampled cases.
#[derive(Debug, Clone, PartialEq)]
pub struct DemandReplicate {
    /// Intercept first.
    pub coefficients: Vec<f64>,
    /// Dispersion beta.
    pub residual_sd: f64,
}

impl DemandReplicate {
    /// Coefficients and dispersion.
    pub fn parameters(&self) -> impl Iterator<Item = f64> {
        self.coefficients.iter().copied().chain(std::iter::once(self.residual_sd))
    }
}

/// A regression with cases: those it was fitted to, or for refits a larger sample.
pub struct DemandInference<'a> {
    sample: &'a DemandSample,
    coefficients: DVector<f64>,
    residual_sd: f64,
    /// The inverse of X'X.
    bread: DMatrix<f64>,
    rss: f64,
    n: usize,
    design: DesignMatrix,
    residuals: Vec<f64>,
    influence: Influence,
}

impl<'a> DemandInference<'a> {
    /// Of a regression to any sample of the same measures. Least squares being quadratic, one Newton step leads from
    /// one sample to another.
    pub fn new(sample: &'a DemandSample, fit: &LinearFit) -> DemandInference<'a> {
        let (design, coefficients) = (sample.design(), fit.values());
        let fitted = design.indices(coefficients.as_slice());
        let residuals: Vec<f64> = sample.ln_edp.iter().zip(fitted).map(|(y, fitted)| y - fitted).collect();
        let influence = Influence::of_residuals(residuals.clone());
        let bread = &fit.covariance / fit.residual_sd.powi(2);
        let LinearFit { residual_sd, rss, n, .. } = *fit;
        DemandInference { sample, coefficients, residual_sd, bread, rss, n, design, residuals, influence }
    }

    /// The covariance of the coefficients where cases of one cluster may depend on each other; `clusters` are those of all
    /// cases. Of the sample of the fit.
    pub fn clustered_covariance(&self, clusters: &[usize]) -> DMatrix<f64> {
        let clusters: Vec<usize> = self.sample.rows.iter().map(|&row| clusters[row]).collect();
        self.influence.clustered_covariance(&self.design, &self.bread, &clusters)
    }

    /// The standard errors that follow from it.
    pub fn clustered_errors(&self, clusters: &[usize]) -> Vec<f64> {
        self.clustered_covariance(clusters).diagonal().iter().map(|variance| variance.sqrt()).collect()
    }

    /// What cases say that were left out, of a demand above `limit`; `clusters` are those of all cases.
    pub fn held_out(&self, clusters: &[usize], limit: f64) -> Option<HeldOut> {
        let clusters: Vec<usize> = self.sample.rows.iter().map(|&row| clusters[row]).collect();
        let folds = Folds::new(&clusters, MOST_FOLDS)?;
        let indices = folds.leave_out(|_, weights| {
            let DemandReplicate { coefficients, residual_sd } = self.refit(weights)?;
            let means = self.design.indices(&coefficients);
            Some(move |case: usize| exceeding_index(means[case], limit, residual_sd))
        })?;
        let happened: Vec<bool> = self.sample.ln_edp.iter().map(|ln_edp| *ln_edp > limit.ln()).collect();
        HeldOut::of_indices(&indices, &happened, &clusters, Link::Probit)
    }

    /// The fit itself.
    pub fn fitted(&self) -> DemandReplicate {
        let coefficients = self.coefficients.as_slice().to_vec();
        DemandReplicate { coefficients, residual_sd: self.residual_sd }
    }

    /// The regression where each case of the sample counts so often; none if they do not determine it.
    pub fn refit(&self, weights: &[f64]) -> Option<DemandReplicate> {
        let change = self.influence.step(&self.design, weights)?;
        let degrees = weights.iter().sum::<f64>() - change.len() as f64;
        let shifts = self.design.indices(change.as_slice());
        let square = |((residual, shift), weight): ((&f64, f64), &f64)| weight * (residual - shift).powi(2);
        let rss: f64 = self.residuals.iter().zip(shifts).zip(weights).map(square).sum();
        (degrees > 0.0).then(|| DemandReplicate {
            coefficients: (&self.coefficients + change).as_slice().to_vec(),
            residual_sd: (rss / degrees).sqrt(),
        })
    }

    /// Of coefficients and dispersion, for BCa limits. Of the sample of the fit.
    pub fn accelerations(&self, strata: &Strata) -> Vec<f64> {
        let fit = self.fitted();
        let mut without_each = vec![fit.clone(); strata.rows()];
        let degrees = (self.n - 1 - fit.coefficients.len()) as f64;
        let changes = self.influence.without_each(&self.design, &self.bread);
        let cases = self.sample.rows.iter().zip(&self.residuals).zip(self.design.rows());
        for (((&row, residual), x), change) in cases.zip(changes) {
            let rss = self.rss - residual * (residual - x.dot(&change));
            without_each[row].residual_sd = (rss / degrees).sqrt();
            without_each[row].coefficients.iter_mut().zip(&change).for_each(|(b, change)| *b += change);
        }
        let parameter = |k: usize| -> Vec<f64> {
            without_each.iter().filter_map(|fit| fit.parameters().nth(k)).collect()
        };
        (0..=fit.coefficients.len()).map(|k| acceleration(&parameter(k), strata)).collect()
    }
}

/// The cases of a regression, to be fitted in resamples. They are taken about their means, so that sums of products do not cancel.
pub struct DemandRefits {
    /// Of each ln IM and of ln EDP.
    means: Vec<f64>,
    products: CaseTerms,
}

impl DemandRefits {
    /// Of the cases of a sample.
    pub fn new(sample: &DemandSample) -> DemandRefits {
        DemandRefits::in_order(sample, &(0..sample.rows.len()).collect::<Vec<_>>())
    }

    /// The same with the cases in this order.
    pub fn in_order(sample: &DemandSample, order: &[usize]) -> DemandRefits {
        let columns: Vec<&[f64]> = sample.predictors().into_iter().chain([&sample.ln_edp[..]]).collect();
        let mean = |column: &&[f64]| column.iter().sum::<f64>() / column.len() as f64;
        let means: Vec<f64> = columns.iter().map(mean).collect();
        let products = |&case: &usize| -> Vec<f64> {
            let centred = columns.iter().zip(&means).map(|(column, mean)| column[case] - mean);
            let z: Vec<f64> = std::iter::once(1.0).chain(centred).collect();
            (0..z.len())
                .flat_map(|i| z[..=i].iter().map(move |zj| (i, zj)))
                .map(|(i, zj)| z[i] * zj)
                .collect()
        };
        let rows: Vec<usize> = order.iter().map(|&case| sample.rows[case]).collect();
        let terms = NormalEquations::empty(means.len()).products.len();
        DemandRefits { products: CaseTerms::new(&rows, terms, order.iter().map(products)), means }
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.products.cases()
    }

    /// How many coefficients there are.
    pub fn coefficients(&self) -> usize {
        self.means.len()
    }

    /// The normal equations of some of the cases.
    pub fn equations(&self, cases: Range<usize>, resamples: &Resamples) -> NormalEquations {
        NormalEquations { products: self.products.sums_of(cases, resamples) }
    }

    /// The regression in each resample; none where its cases do not determine it.
    pub fn replicates(&self, resamples: &Resamples) -> [Option<DemandReplicate>; TOGETHER] {
        self.solutions(&NormalEquations { products: self.products.sums(resamples) })
    }

    /// The regressions that normal equations lead to.
    pub fn solutions(&self, equations: &NormalEquations) -> [Option<DemandReplicate>; TOGETHER] {
        let k = self.coefficients();
        let LeastSquares { coefficients, rss } = equations.solve(k);
        std::array::from_fn(|resample| {
            let mut b: Vec<f64> = coefficients.iter().map(|b| b[resample]).collect();
            let (of_response, of_predictors) = self.means.split_last()?;
            let shift: f64 = of_predictors.iter().zip(&b[1..]).map(|(mean, b)| mean * b).sum();
            b[0] += of_response - shift;
            let degrees = equations.products[0][resample] - k as f64;
            let residual_sd = (rss[resample].max(0.0) / degrees).sqrt();
            let replicate = DemandReplicate { coefficients: b, residual_sd };
            (degrees > 0.0 && replicate.parameters().all(f64::is_finite)).then_some(replicate)
        })
    }
}
