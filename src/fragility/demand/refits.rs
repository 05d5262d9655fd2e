//! Regressions of the demand in resamples.

use std::ops::Range;

use super::inference::DemandReplicate;
use super::sample::DemandSample;
use crate::resampling::bootstrap::{Resamples, TOGETHER};
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::normal_equations::{LeastSquares, NormalEquations};

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
