//! Coefficients, covariance and status of a regression.

use nalgebra::{DMatrix, DVector};

use super::clusters::{MIN_CLUSTERS, widened};
use super::distributions::t_quantile;
use crate::spelling::unknown_word;

/// Whether a fit is usable, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<FitStatus>)]
pub enum FitStatus {
    Ok,
    /// The probability differs from the share of events by more than 0.15 (`scores::largest_difference`).
    PoorFit,
    /// Fewer than ten events or other cases: the limits are too narrow.
    FewEvents,
    /// Demand or probability decreases with the measure, a frequency or the like: it grows with the inverse.
    Inverse,
    /// Demand or probability decreases with a measure of strength.
    WrongSign,
    /// The predictors separate events from the other cases: the likelihood has no maximum.
    Separated,
    /// Fewer than five events or other cases, or fewer than two known capacities.
    TooFewEvents,
    /// A measure is constant, or a combination of others, or there are fewer cases than coefficients.
    Degenerate,
    NotConverged,
}

impl FitStatus {
    pub fn is_usable(self) -> bool {
        matches!(self, FitStatus::Ok | FitStatus::PoorFit | FitStatus::FewEvents)
    }

    /// By the largest difference of a probability from the share of events.
    pub fn by_difference(largest: Option<f64>) -> FitStatus {
        if largest.is_some_and(|largest| largest > POOR_FIT) { FitStatus::PoorFit } else { FitStatus::Ok }
    }
}

const POOR_FIT: f64 = 0.15;

/// A linear predictor z = b0 + b1 x1 + ..., by least squares or maximum likelihood.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Intercept first.
    pub coefficients: DVector<f64>,
    /// Covariance of the coefficients, k x k: of independent cases, widened where few clusters differ.
    pub covariance: DMatrix<f64>,
    /// Cluster-robust covariance, k x k; `None` for too few clusters.
    pub clustered: Option<DMatrix<f64>>,
    /// Number of clusters; 0 if none were given.
    pub clusters: usize,
    /// Degrees of freedom of the limits without clusters: n - k of least squares, infinite of a likelihood.
    pub degrees_of_freedom: f64,
}

impl Fit {
    pub(super) fn new(
        (coefficients, covariance): (DVector<f64>, DMatrix<f64>),
        degrees_of_freedom: f64,
    ) -> Fit {
        Fit { coefficients, covariance, clustered: None, clusters: 0, degrees_of_freedom }
    }

    /// Takes the clustered covariance of many clusters; that of two and more only widens the model's.
    pub(super) fn note_clusters(&mut self, (clustered, clusters): (DMatrix<f64>, usize)) {
        self.clusters = clusters;
        if clusters >= MIN_CLUSTERS {
            self.clustered = Some(clustered);
        } else if clusters > 1 {
            let quantile = |degrees: f64| t_quantile(0.975, degrees);
            let ratio = quantile(clusters as f64 - 1.0) / quantile(self.degrees_of_freedom);
            let wider = widened(&self.covariance, clustered * (ratio * ratio));
            self.covariance = wider.unwrap_or_else(|| self.covariance.clone());
        }
    }

    /// Returns the covariance of the limits, cluster-robust if there is one, and its degrees of freedom.
    pub fn limiting_covariance(&self) -> (&DMatrix<f64>, f64) {
        match &self.clustered {
            Some(clustered) => (clustered, self.clusters as f64 - 1.0),
            None => (&self.covariance, self.degrees_of_freedom),
        }
    }
}

/// Computes z = b0 + b1 x1 + ... of each case.
pub fn predict(coefficients: &[f64], x: &[&[f64]]) -> Vec<f64> {
    let mut z = vec![coefficients[0]; x.first().map_or(0, |x| x.len())];
    for (b, x) in coefficients[1..].iter().zip(x) {
        z.iter_mut().zip(*x).for_each(|(z, x)| *z += b * x);
    }
    z
}

/// Moves the coefficients by this many standard deviations, down and up, along each of k independent errors:
/// the columns of L, where L L' = C is their covariance (k x k, by row). Empty where C has no such L.
pub fn independent_errors(coefficients: &[f64], covariance: &[f64], deviations: f64) -> Vec<[Vec<f64>; 2]> {
    let k = coefficients.len();
    let square = (covariance.len() == k * k).then(|| DMatrix::from_row_slice(k, k, covariance));
    let Some(factor) = square.and_then(DMatrix::cholesky) else { return Vec::new() };
    let errors = factor.l();
    let columns = errors.column_iter().map(|error| {
        [-deviations, deviations]
            .map(|away| coefficients.iter().zip(&error).map(|(b, l)| b + away * l).collect())
    });
    columns.collect()
}

/// Computes g' C g, the variance of a function of gradient g (k) by the delta method; C is k x k, by row.
pub fn delta_variance(covariance: &[f64], gradient: &[f64]) -> f64 {
    let rows = covariance.chunks_exact(gradient.len()).zip(gradient);
    rows.map(|(row, g)| g * row.iter().zip(gradient).map(|(c, g)| c * g).sum::<f64>()).sum()
}
