//! The files of fit-pro: one row a fragility curve, and one a curve and resample.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::row::table;
use crate::fragility::overturning::Curve;
use crate::fragility::{CurveParameter, Event, HeldOut, JointPeaks, Measure};
use crate::rocking::Block;
use crate::statistics::{Estimator, FitStatus, Link};

table! {
    /// Maximum-likelihood fits of overturning; a limit beyond all numbers is null.
    pub struct ProRow as PRO = "pro" by "fit-pro" {
        suite: Option<String>,
        structure: String,
        event: Event = fitted_event,
        im_x: Measure,
        im_y: Option<Measure>,
        lambda: Option<f64>,
        mu: Option<f64>,
        beta: Option<f64>,
        theta: Option<f64>,
        log_likelihood: Option<f64>,
        aic: Option<f64>,
        bic: Option<f64>,
        auc: Option<f64>,
        brier: Option<f64>,
        n: usize,
        n_events: usize,
        se_lambda: Option<f64>,
        se_mu: Option<f64>,
        se_beta: Option<f64>,
        se_theta: Option<f64>,
        lambda_low: Option<f64>,
        lambda_high: Option<f64>,
        mu_low: Option<f64>,
        mu_high: Option<f64>,
        beta_low: Option<f64>,
        beta_high: Option<f64>,
        theta_low: Option<f64>,
        theta_high: Option<f64>,
        link: Link,
        estimator: Estimator,
        b0: Option<f64>,
        b1: Option<f64> = index_b1,
        b2: Option<f64> = index_b2,
        se_b0: Option<f64>,
        se_b1: Option<f64>,
        se_b2: Option<f64>,
        cov_b0_b1: Option<f64>,
        cov_b0_b2: Option<f64>,
        cov_b1_b2: Option<f64>,
        se_lambda_clustered: Option<f64>,
        se_mu_clustered: Option<f64>,
        se_beta_clustered: Option<f64>,
        lambda_profile_low: Option<f64>,
        lambda_profile_high: Option<f64>,
        mu_profile_low: Option<f64>,
        mu_profile_high: Option<f64>,
        beta_profile_low: Option<f64>,
        beta_profile_high: Option<f64>,
        confidence: f64,
        replicates: usize,
        lambda_percentile_low: Option<f64>,
        lambda_percentile_high: Option<f64>,
        lambda_bca_low: Option<f64>,
        lambda_bca_high: Option<f64>,
        mu_percentile_low: Option<f64>,
        mu_percentile_high: Option<f64>,
        mu_bca_low: Option<f64>,
        mu_bca_high: Option<f64>,
        beta_percentile_low: Option<f64>,
        beta_percentile_high: Option<f64>,
        beta_bca_low: Option<f64>,
        beta_bca_high: Option<f64>,
        hosmer_lemeshow: Option<f64>,
        hosmer_lemeshow_p: Option<f64>,
        spline_p: Option<f64>,
        interaction_p: Option<f64>,
        clustered_covariance: Option<[f64; 9]>,
        cell_spread: Option<f64>,
        held_out_log_score: Option<f64>,
        gap_straight: Option<f64>,
        gap_bent: Option<f64>,
        bent: Option<[f64; 6]>,
        bent_knots: Option<[f64; 6]>,
        bent_covariance: Option<[f64; 36]>,
        bent_cell_spread: Option<f64>,
        bent_held_out_log_score: Option<f64>,
        im_x_low: Option<f64>,
        im_x_high: Option<f64>,
        im_y_low: Option<f64>,
        im_y_high: Option<f64>,
        ratio_given_pga: Option<[f64; 7]>,
        ratio_given_pgv: Option<[f64; 7]>,
        p_rad_s: Option<f64> = fitted_p_rad_s,
        alpha_rad: Option<f64> = fitted_alpha_rad,
        eta: Option<f64>,
        status: FitStatus,
    }
}

table! {
    /// The curves of resampled cases, null where a resample has no fit.
    pub struct ProReplicateRow as PRO_BOOTSTRAP = "bootstrap replicates of pro" by "fit-pro" {
        suite: Option<Arc<str>>,
        structure: Arc<str>,
        event: Event = fitted_event,
        im_x: Measure,
        im_y: Option<Measure>,
        replicate: usize,
        b0: Option<f64>,
        b1: Option<f64> = index_b1,
        b2: Option<f64> = index_b2,
        bent: Option<[f64; 6]>,
    }
}

/// A curve of a suite and structure.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupCurve {
    /// Suite of the responses, if known.
    pub suite: Option<String>,
    pub structure: String,
    /// Coefficient of restitution of the structure.
    pub eta: f64,
    /// Its size and slenderness, if all cases share them.
    pub block: Option<Block>,
    /// How PGA and PGV go together in the motions of the cases.
    pub peaks: Option<JointPeaks>,
    pub curve: Curve,
}

impl From<&GroupCurve> for ProRow {
    fn from(row: &GroupCurve) -> ProRow {
        let curve = &row.curve;
        let fit = curve.fit.as_ref().ok();
        let (lambda, mu) = (fit.and_then(|fit| fit.lambda), fit.map(|fit| fit.mu));
        let (beta, theta) = (fit.map(|fit| fit.beta), fit.map(|fit| fit.theta));
        let coefficient = |k: usize| fit?.regression.coefficients.get(k).copied();
        let covariance = |i: usize, j: usize| fit?.regression.covariance.get((i, j)).copied();
        let [of_lambda, of_mu, of_beta] = CurveParameter::ALL.map(|parameter| curve.inference_of(parameter));
        let [lambda_limits, mu_limits, beta_limits] = [of_lambda, of_mu, of_beta].map(|parameter| {
            parameter.and_then(|parameter| parameter.bootstrap).map_or([None; 4], |limits| limits.in_order())
        });
        let hosmer_lemeshow = fit.and_then(|fit| fit.goodness.hosmer_lemeshow);
        let gap = curve.bent.as_ref().map(|bent| bent.gap);
        let bent = curve.bent_answer();
        let held_out = |of: Option<HeldOut>| (of.map(|of| of.spread), of.map(|of| of.log_score));
        let (cell_spread, held_out_log_score) = held_out(curve.held_out);
        let (bent_cell_spread, bent_held_out_log_score) = held_out(bent.and_then(|bent| bent.held_out));
        let ends = |measure: usize| curve.data_ranges.get(measure).copied();
        ProRow {
            suite: row.suite.clone(),
            structure: row.structure.clone(),
            event: curve.event,
            im_x: curve.im_x,
            im_y: curve.im_y,
            lambda: lambda.map(|estimate| estimate.value),
            mu: mu.map(|estimate| estimate.value),
            beta: beta.map(|estimate| estimate.value),
            theta: theta.map(|estimate| estimate.value),
            log_likelihood: fit.map(|fit| fit.regression.log_likelihood),
            aic: fit.map(|fit| fit.aic),
            bic: fit.map(|fit| fit.bic),
            auc: fit.map(|fit| fit.goodness.auc),
            brier: fit.map(|fit| fit.goodness.brier),
            n: curve.n,
            n_events: curve.events,
            se_lambda: lambda.map(|estimate| estimate.standard_error),
            se_mu: mu.map(|estimate| estimate.standard_error),
            se_beta: beta.map(|estimate| estimate.standard_error),
            se_theta: theta.map(|estimate| estimate.standard_error),
            lambda_low: lambda.map(|estimate| estimate.low),
            lambda_high: lambda.map(|estimate| estimate.high),
            mu_low: mu.map(|estimate| estimate.low),
            mu_high: mu.map(|estimate| estimate.high),
            beta_low: beta.map(|estimate| estimate.low),
            beta_high: beta.map(|estimate| estimate.high),
            theta_low: theta.map(|estimate| estimate.low),
            theta_high: theta.map(|estimate| estimate.high),
            link: curve.model.link,
            estimator: curve.model.estimator,
            b0: coefficient(0),
            b1: coefficient(1),
            b2: coefficient(2),
            se_b0: covariance(0, 0).map(f64::sqrt),
            se_b1: covariance(1, 1).map(f64::sqrt),
            se_b2: covariance(2, 2).map(f64::sqrt),
            cov_b0_b1: covariance(0, 1),
            cov_b0_b2: covariance(0, 2),
            cov_b1_b2: covariance(1, 2),
            se_lambda_clustered: of_lambda.map(|parameter| parameter.clustered_error),
            se_mu_clustered: of_mu.map(|parameter| parameter.clustered_error),
            se_beta_clustered: of_beta.map(|parameter| parameter.clustered_error),
            lambda_profile_low: of_lambda.map(|parameter| parameter.profile.low),
            lambda_profile_high: of_lambda.map(|parameter| parameter.profile.high),
            mu_profile_low: of_mu.map(|parameter| parameter.profile.low),
            mu_profile_high: of_mu.map(|parameter| parameter.profile.high),
            beta_profile_low: of_beta.map(|parameter| parameter.profile.low),
            beta_profile_high: of_beta.map(|parameter| parameter.profile.high),
            confidence: curve.model.confidence,
            replicates: curve.replicates.iter().flatten().count(),
            lambda_percentile_low: lambda_limits[0],
            lambda_percentile_high: lambda_limits[1],
            lambda_bca_low: lambda_limits[2],
            lambda_bca_high: lambda_limits[3],
            mu_percentile_low: mu_limits[0],
            mu_percentile_high: mu_limits[1],
            mu_bca_low: mu_limits[2],
            mu_bca_high: mu_limits[3],
            beta_percentile_low: beta_limits[0],
            beta_percentile_high: beta_limits[1],
            beta_bca_low: beta_limits[2],
            beta_bca_high: beta_limits[3],
            hosmer_lemeshow: hosmer_lemeshow.map(|test| test.statistic),
            hosmer_lemeshow_p: hosmer_lemeshow.map(|test| test.p),
            spline_p: curve.spline.map(|test| test.p),
            interaction_p: curve.interaction.map(|test| test.p),
            clustered_covariance: curve.clustered_covariance.as_ref().map(padded),
            cell_spread,
            held_out_log_score,
            gap_straight: gap.map(|gap| gap.straight),
            gap_bent: gap.map(|gap| gap.bent),
            bent: bent.map(|bent| bent.coefficients),
            bent_knots: bent.map(|bent| flat(&bent.knots)),
            bent_covariance: bent.map(|bent| flat(&bent.covariance)),
            bent_cell_spread,
            bent_held_out_log_score,
            im_x_low: ends(0).map(|[low, _]| low),
            im_x_high: ends(0).map(|[_, high]| high),
            im_y_low: ends(1).map(|[low, _]| low),
            im_y_high: ends(1).map(|[_, high]| high),
            ratio_given_pga: row.peaks.map(|peaks| peaks.given_pga.to_numbers()),
            ratio_given_pgv: row.peaks.map(|peaks| peaks.given_pgv.to_numbers()),
            p_rad_s: row.block.map(|block| block.p_rad_s),
            alpha_rad: row.block.map(|block| block.alpha_rad),
            eta: Some(row.eta),
            status: curve.status(),
        }
    }
}

impl GroupCurve {
    /// The curves of its resamples.
    pub fn replicates(&self) -> impl Iterator<Item = ProReplicateRow> {
        let (suite, structure): (Option<Arc<str>>, Arc<str>) =
            (self.suite.as_deref().map(Arc::from), self.structure.as_str().into());
        let replicates = self.curve.replicates.iter().zip(&self.curve.bent_replicates).enumerate();
        replicates.map(move |(replicate, (coefficients, bent))| {
            let coefficient = |k: usize| coefficients.as_ref()?.get(k).copied();
            ProReplicateRow {
                suite: suite.clone(),
                structure: structure.clone(),
                event: self.curve.event,
                im_x: self.curve.im_x,
                im_y: self.curve.im_y,
                replicate,
                b0: coefficient(0),
                b1: coefficient(1),
                b2: coefficient(2),
                bent: *bent,
            }
        })
    }
}

/// A matrix row by row.
pub(super) fn flat<const N: usize, const K: usize, const ALL: usize>(rows: &[[f64; K]; N]) -> [f64; ALL] {
    std::array::from_fn(|at| rows[at / K][at % K])
}

/// A covariance of up to three coefficients row by row, 0 where there are fewer.
pub(super) fn padded(covariance: &DMatrix<f64>) -> [f64; 9] {
    std::array::from_fn(|at| covariance.get((at / 3, at % 3)).copied().unwrap_or(0.0))
}
