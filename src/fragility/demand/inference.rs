//! How uncertain a regression of the demand is: clustered errors, and refits of resampled cases.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::fragility::held_out::HeldOut;
use crate::fragility::probability::exceeding_index;
use crate::fragility::sample::{CLUSTER, Sample};
use crate::resampling::bootstrap::{Resamples, Sizes, Strata, TOGETHER};
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::limits::{Moves, acceleration_of, add_move, join_moves};
use crate::resampling::normal_equations::{LeastSquares, NormalEquations};
use crate::statistics::design::{Moments, Rows};
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
    sample: &'a Sample,
    coefficients: DVector<f64>,
    residual_sd: f64,
    /// The inverse of X'X.
    bread: DMatrix<f64>,
    rss: f64,
    n: usize,
    influence: Influence,
}

impl<'a> DemandInference<'a> {
    /// Of a regression to any sample of the same measures. Least squares being quadratic, one Newton step leads from
    /// one sample to another.
    pub fn new(sample: &'a Sample, fit: &LinearFit) -> DemandInference<'a> {
        let coefficients = fit.values();
        let influence = Influence::of_least_squares(coefficients.clone());
        let bread = &fit.covariance / fit.residual_sd.powi(2);
        let LinearFit { residual_sd, rss, n, .. } = *fit;
        DemandInference { sample, coefficients, residual_sd, bread, rss, n, influence }
    }

    /// Standard errors of the coefficients where cases of one cluster may depend on each other; `clusters` are those of
    /// all cases. Of the sample of the fit.
    pub fn clustered_errors(&self, clusters: &[usize]) -> Vec<f64> {
        self.clustered_covariance(clusters).diagonal().iter().map(|variance| variance.sqrt()).collect()
    }

    /// The covariance behind them.
    pub fn clustered_covariance(&self, clusters: &[usize]) -> DMatrix<f64> {
        self.sandwich(|rows, case| clusters[rows.labels[0][case] as usize])
    }

    /// The same, of the clusters of the sample.
    pub fn covariance_by_cluster(&self) -> DMatrix<f64> {
        self.sandwich(|rows, case| rows.labels[CLUSTER][case] as usize)
    }

    fn sandwich(&self, cluster: impl Fn(&Rows, usize) -> usize + Sync) -> DMatrix<f64> {
        self.influence.clustered_covariance(&self.sample.design(), &self.bread, cluster)
    }

    /// What cases say that were left out, whole clusters of the sample at once, of a demand above `limit`.
    pub fn held_out(&self, limit: f64) -> Option<HeldOut> {
        let index = |fit: &DemandReplicate, rows: &Rows| -> Vec<f64> {
            let means = rows.indices(&fit.coefficients).into_iter();
            means.map(|mean| exceeding_index(mean, limit, fit.residual_sd)).collect()
        };
        let thinned = self.sample.thinned();
        let some = thinned.as_ref().unwrap_or(self.sample);
        let refit = |weights: &[f64]| self.refit_to(some, weights);
        let ln_limit = libm::log(limit);
        HeldOut::new(&some.design(), Link::Probit, refit, index, |ln_edp| ln_edp > ln_limit)
    }

    /// The fit itself.
    pub fn fitted(&self) -> DemandReplicate {
        let coefficients = self.coefficients.as_slice().to_vec();
        DemandReplicate { coefficients, residual_sd: self.residual_sd }
    }

    /// The regression where each case of the sample counts so often; none if they do not determine it.
    pub fn refit(&self, weights: &[f64]) -> Option<DemandReplicate> {
        self.refit_to(self.sample, weights)
    }

    fn refit_to(&self, sample: &Sample, weights: &[f64]) -> Option<DemandReplicate> {
        let design = sample.design();
        let coefficients = &self.coefficients + self.influence.step(&design, weights)?;
        let degrees = weights.iter().sum::<f64>() - coefficients.len() as f64;
        let squares = |rows: &Rows| {
            let fitted = rows.indices(coefficients.as_slice());
            let square = |((fitted, y), weight): ((f64, &f64), &f64)| weight * (y - fitted).powi(2);
            fitted.into_iter().zip(rows.y).zip(&weights[rows.first..]).map(square).sum::<f64>()
        };
        let rss = design.fold(0, squares, |sum, part| *sum += part);
        (degrees > 0.0).then(|| DemandReplicate {
            coefficients: coefficients.as_slice().to_vec(),
            residual_sd: (rss / degrees).sqrt(),
        })
    }

    /// Of coefficients and dispersion, for BCa limits. Of the sample of the fit.
    pub fn accelerations(&self, strata: &Strata) -> Vec<f64> {
        self.accelerations_within(&strata.sizes(), |rows, case| {
            strata.label_of(rows.labels[0][case] as usize)
        })
    }

    /// The same within the cells of the sample, which have such sizes among all cases.
    pub fn accelerations_by_cell(&self, sizes: &Sizes) -> Vec<f64> {
        self.accelerations_within(sizes, |rows, case| rows.labels[2][case] as usize)
    }

    fn accelerations_within(&self, sizes: &Sizes, cell: impl Fn(&Rows, usize) -> usize + Sync) -> Vec<f64> {
        let k = self.coefficients.len();
        let degrees = (self.n - 1 - k) as f64;
        let of_block = |rows: &Rows| {
            let mut moves = vec![Moves::new(); k + 1];
            let fitted = rows.indices(self.coefficients.as_slice());
            let cases = rows.each().zip(self.influence.without_each(rows, &self.bread)).enumerate();
            for (case, (x, change)) in cases {
                let (residual, cell) = (rows.y[case] - fitted[case], cell(rows, case));
                let rss = self.rss - residual * (residual - x.dot(&change));
                let by = change.iter().copied().chain([(rss / degrees).sqrt() - self.residual_sd]);
                moves.iter_mut().zip(by).for_each(|(moves, by)| add_move(moves, cell, by));
            }
            moves
        };
        let moves = self.sample.design().fold(3, of_block, |all, part| {
            all.iter_mut().zip(part).for_each(|(all, part)| join_moves(all, part));
        });
        moves.iter().map(|moves| acceleration_of(moves, sizes)).collect()
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
    pub fn new(sample: &Sample) -> DemandRefits {
        DemandRefits::about(Moments::of(&sample.design()).means, sample)
    }

    /// Of some of the cases that have these means.
    pub fn about(means: Vec<f64>, sample: &Sample) -> DemandRefits {
        let columns: Vec<Vec<f64>> = sample.predictors().into_iter().chain([sample.observed()]).collect();
        let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let rows = sample.rows();
        DemandRefits::in_order(means, &columns, &rows, &(0..rows.len()).collect::<Vec<_>>())
    }

    /// Of cases with these logarithms of measures and demands, which all have such means, in an order; `rows` are their rows among
    /// all.
    pub fn in_order(means: Vec<f64>, columns: &[&[f64]], rows: &[usize], order: &[usize]) -> DemandRefits {
        let products = |&case: &usize| -> Vec<f64> {
            let centred = columns.iter().zip(&means).map(|(column, mean)| column[case] - mean);
            let z: Vec<f64> = std::iter::once(1.0).chain(centred).collect();
            (0..z.len())
                .flat_map(|i| z[..=i].iter().map(move |zj| (i, zj)))
                .map(|(i, zj)| z[i] * zj)
                .collect()
        };
        let rows: Vec<usize> = order.iter().map(|&case| rows[case]).collect();
        let terms = NormalEquations::empty(means.len()).products.len();
        DemandRefits { products: CaseTerms::new(&rows, terms, order.iter().map(products)), means }
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.products.cases()
    }

    /// The means.
    pub fn means(&self) -> &[f64] {
        &self.means
    }

    /// The normal equations of some of the cases.
    pub fn equations(&self, cases: Range<usize>, resamples: &Resamples) -> NormalEquations {
        NormalEquations { products: self.products.sums_of(cases, resamples) }
    }

    /// The regression in each resample; none where its cases do not determine it.
    pub fn replicates(&self, resamples: &Resamples) -> [Option<DemandReplicate>; TOGETHER] {
        solutions(&self.means, &self.equations(0..self.cases(), resamples))
    }
}

/// The regressions that normal equations of deviations from these means lead to.
pub fn solutions(means: &[f64], equations: &NormalEquations) -> [Option<DemandReplicate>; TOGETHER] {
    let k = means.len();
    let LeastSquares { coefficients, rss } = equations.solve(k);
    std::array::from_fn(|resample| {
        let mut b: Vec<f64> = coefficients.iter().map(|b| b[resample]).collect();
        let (of_response, of_predictors) = means.split_last()?;
        let shift: f64 = of_predictors.iter().zip(&b[1..]).map(|(mean, b)| mean * b).sum();
        b[0] += of_response - shift;
        let degrees = equations.products[0][resample] - k as f64;
        let residual_sd = (rss[resample].max(0.0) / degrees).sqrt();
        let replicate = DemandReplicate { coefficients: b, residual_sd };
        (degrees > 0.0 && replicate.parameters().all(f64::is_finite)).then_some(replicate)
    })
}
