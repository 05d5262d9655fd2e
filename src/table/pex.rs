//! The files of fit-pex: one row a regression of the demand in safe rocking, one a regression and resample, and one a place
//! that was tried for the transition.

use std::sync::Arc;

use super::pro::padded;
use super::row::table;
use crate::fragility::Measure;
use crate::fragility::demand::{Form, Regression};
use crate::resampling::BootstrapLimits;
use crate::rocking::Block;
use crate::statistics::FitStatus;

table! {
    /// Regressions of the demand in safe rocking; what is not a finite number is null.
    pub struct PexRow as PEX = "pex" by "fit-pex" {
        suite: Option<String>,
        structure: String,
        model: Form,
        im_x: Measure,
        im_y: Option<Measure>,
        range_low: Option<f64>,
        range_high: Option<f64>,
        limit_state: f64,
        ln_a: Option<f64>,
        b1: Option<f64>,
        b2: Option<f64>,
        r2: Option<f64>,
        r2_pooled: Option<f64>,
        r2_overall: Option<f64>,
        transition_found: Option<f64>,
        beta: Option<f64>,
        zeta: Option<f64>,
        n: usize,
        se_ln_a: Option<f64>,
        se_b1: Option<f64>,
        se_b2: Option<f64>,
        ln_a_low: Option<f64>,
        ln_a_high: Option<f64>,
        b1_low: Option<f64>,
        b1_high: Option<f64>,
        b2_low: Option<f64>,
        b2_high: Option<f64>,
        cov_ln_a_b1: Option<f64>,
        cov_ln_a_b2: Option<f64>,
        cov_b1_b2: Option<f64>,
        se_ln_a_clustered: Option<f64>,
        se_b1_clustered: Option<f64>,
        se_b2_clustered: Option<f64>,
        clustered_covariance: Option<[f64; 9]>,
        cell_spread: Option<f64>,
        confidence: f64,
        replicates: usize,
        ln_a_percentile_low: Option<f64>,
        ln_a_percentile_high: Option<f64>,
        ln_a_bca_low: Option<f64>,
        ln_a_bca_high: Option<f64>,
        b1_percentile_low: Option<f64>,
        b1_percentile_high: Option<f64>,
        b1_bca_low: Option<f64>,
        b1_bca_high: Option<f64>,
        b2_percentile_low: Option<f64>,
        b2_percentile_high: Option<f64>,
        b2_bca_low: Option<f64>,
        b2_bca_high: Option<f64>,
        beta_percentile_low: Option<f64>,
        beta_percentile_high: Option<f64>,
        beta_bca_low: Option<f64>,
        beta_bca_high: Option<f64>,
        transition_low: Option<f64>,
        transition_high: Option<f64>,
        transition_percentile_low: Option<f64>,
        transition_percentile_high: Option<f64>,
        transition_width: Option<f64>,
        se_transition_width: Option<f64>,
        reset: Option<f64>,
        reset_p: Option<f64>,
        im_x_low: Option<f64>,
        im_x_high: Option<f64>,
        im_y_low: Option<f64>,
        im_y_high: Option<f64>,
        p_rad_s: Option<f64> = fitted_p_rad_s,
        alpha_rad: Option<f64> = fitted_alpha_rad,
        eta: Option<f64>,
        status: FitStatus,
    }
}

table! {
    /// The regressions of resampled cases, null where a resample has no fit.
    pub struct PexReplicateRow as PEX_BOOTSTRAP = "bootstrap replicates of pex" by "fit-pex" {
        suite: Option<Arc<str>>,
        structure: Arc<str>,
        model: Form,
        im_x: Measure,
        im_y: Option<Measure>,
        replicate: usize,
        range_low: Option<f64>,
        range_high: Option<f64>,
        ln_a: Option<f64>,
        b1: Option<f64>,
        b2: Option<f64>,
        beta: Option<f64>,
    }
}

table! {
    /// The search for the transition between the two planes.
    pub struct ScanRow as PEX_SCAN = "transition scan" by "fit-pex" {
        suite: Option<String>,
        structure: String,
        transition: f64,
        pooled_rss: f64,
        n_low: usize,
        n_high: usize,
    }
}

/// A regression of a suite and structure.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupRegression {
    /// Suite of the responses, if known.
    pub suite: Option<String>,
    pub structure: String,
    /// Coefficient of restitution of the structure.
    pub eta: f64,
    /// Its size and slenderness, if all cases share them.
    pub block: Option<Block>,
    /// The demand that P_ex is about.
    pub limit_state: f64,
    pub regression: Regression,
}

impl From<&GroupRegression> for PexRow {
    fn from(row: &GroupRegression) -> PexRow {
        let regression = &row.regression;
        let fit = regression.fit.as_ref().ok();
        let [ln_a, b1, b2] = [0, 1, 2].map(|index| regression.coefficient(index));
        let limits = |limits: Option<BootstrapLimits>| limits.map_or([None; 4], |limits| limits.in_order());
        let [ln_a_limits, b1_limits, b2_limits] =
            [0, 1, 2].map(|index| limits(regression.coefficient_limits(index)));
        let beta_limits = limits(regression.beta_limits());
        let ends = |measure: usize| regression.data_ranges.get(measure).copied();
        PexRow {
            suite: row.suite.clone(),
            structure: row.structure.clone(),
            model: regression.form,
            im_x: regression.im_x,
            im_y: regression.im_y,
            range_low: Some(regression.range.start).filter(|start| *start > 0.0),
            range_high: Some(regression.range.end),
            limit_state: row.limit_state,
            ln_a: ln_a.map(|estimate| estimate.value),
            b1: b1.map(|estimate| estimate.value),
            b2: b2.map(|estimate| estimate.value),
            r2: fit.map(|fit| fit.r2),
            r2_pooled: regression.r2_pooled,
            r2_overall: regression.r2_overall,
            transition_found: regression.transition_found,
            beta: fit.map(|fit| fit.residual_sd),
            zeta: regression.zeta(),
            n: fit.map_or(0, |fit| fit.n),
            se_ln_a: ln_a.map(|estimate| estimate.standard_error),
            se_b1: b1.map(|estimate| estimate.standard_error),
            se_b2: b2.map(|estimate| estimate.standard_error),
            ln_a_low: ln_a.map(|estimate| estimate.low),
            ln_a_high: ln_a.map(|estimate| estimate.high),
            b1_low: b1.map(|estimate| estimate.low),
            b1_high: b1.map(|estimate| estimate.high),
            b2_low: b2.map(|estimate| estimate.low),
            b2_high: b2.map(|estimate| estimate.high),
            cov_ln_a_b1: regression.covariance((0, 1)),
            cov_ln_a_b2: regression.covariance((0, 2)),
            cov_b1_b2: regression.covariance((1, 2)),
            se_ln_a_clustered: regression.clustered_errors.first().copied(),
            se_b1_clustered: regression.clustered_errors.get(1).copied(),
            se_b2_clustered: regression.clustered_errors.get(2).copied(),
            clustered_covariance: regression.clustered_covariance.as_ref().map(padded),
            cell_spread: regression.held_out.map(|held_out| held_out.spread),
            confidence: regression.confidence,
            replicates: regression.replicates.iter().flatten().count(),
            ln_a_percentile_low: ln_a_limits[0],
            ln_a_percentile_high: ln_a_limits[1],
            ln_a_bca_low: ln_a_limits[2],
            ln_a_bca_high: ln_a_limits[3],
            b1_percentile_low: b1_limits[0],
            b1_percentile_high: b1_limits[1],
            b1_bca_low: b1_limits[2],
            b1_bca_high: b1_limits[3],
            b2_percentile_low: b2_limits[0],
            b2_percentile_high: b2_limits[1],
            b2_bca_low: b2_limits[2],
            b2_bca_high: b2_limits[3],
            beta_percentile_low: beta_limits[0],
            beta_percentile_high: beta_limits[1],
            beta_bca_low: beta_limits[2],
            beta_bca_high: beta_limits[3],
            transition_low: regression.transition_limits.map(|limits| limits.low),
            transition_high: regression.transition_limits.map(|limits| limits.high),
            transition_percentile_low: regression.transition_percentile.map(|limits| limits.low),
            transition_percentile_high: regression.transition_percentile.map(|limits| limits.high),
            transition_width: regression.transition_width.map(|width| width.value),
            se_transition_width: regression.transition_width.map(|width| width.standard_error),
            reset: regression.reset.map(|test| test.statistic),
            reset_p: regression.reset.map(|test| test.p),
            im_x_low: ends(0).map(|[low, _]| low),
            im_x_high: ends(0).map(|[_, high]| high),
            im_y_low: ends(1).map(|[low, _]| low),
            im_y_high: ends(1).map(|[_, high]| high),
            p_rad_s: row.block.map(|block| block.p_rad_s),
            alpha_rad: row.block.map(|block| block.alpha_rad),
            eta: Some(row.eta),
            status: regression.status(),
        }
    }
}

impl GroupRegression {
    /// The regressions of its resamples.
    pub fn replicates(&self) -> impl Iterator<Item = PexReplicateRow> + '_ {
        let (suite, structure): (Option<Arc<str>>, Arc<str>) =
            (self.suite.as_deref().map(Arc::from), self.structure.as_str().into());
        self.regression.replicates.iter().enumerate().map(move |(replicate, fit)| {
            let coefficient = |k: usize| fit.as_ref()?.fit.coefficients.get(k).copied();
            PexReplicateRow {
                suite: suite.clone(),
                structure: structure.clone(),
                model: self.regression.form,
                im_x: self.regression.im_x,
                im_y: self.regression.im_y,
                replicate,
                range_low: fit.as_ref().map(|fit| fit.range.start),
                range_high: fit.as_ref().map(|fit| fit.range.end),
                ln_a: coefficient(0),
                b1: coefficient(1),
                b2: coefficient(2),
                beta: fit.as_ref().map(|fit| fit.fit.residual_sd),
            }
        })
    }
}
