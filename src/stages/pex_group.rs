//! All regressions of one group of responses, with their uncertainty, as rows of the pex file.

use std::ops::Range;

use rayon::prelude::*;

use super::groups::Group;
use super::pex_refits::PexRefits;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    Biplanar, DemandInference, DemandSample, Measure, PLANE, ScanPoint, SmoothFit, fit_biplanar, fit_plane,
    fit_smooth, fit_univariate, ranges, transition_limits,
};
use crate::pipeline::console::Progress;
use crate::resampling::Strata;
use crate::statistics::{FitStatus, LinearFit, bootstrap_limits, reset};
use crate::table::pex::{Model, PexReplicate, PexRow};
use crate::table::pex_scan::ScanRow;

/// Every value of a measure.
pub(super) const EVERYWHERE: Range<f64> = 0.0..f64::INFINITY;
/// Every IM4 at which there is rocking.
const ABOVE_UPLIFT: Range<f64> = 1.0..f64::INFINITY;

/// How all regressions are made.
pub struct PexModel {
    /// Demand that P_ex is about.
    pub limit_state: f64,
    /// The IM4 at which two planes meet, if not where their pooled residual is least.
    pub transition: Option<f64>,
    /// The limits that are asked for.
    pub uncertainty: Uncertainty,
}

/// The regressions of a group.
pub struct Regressions {
    /// Each.
    pub rows: Vec<PexRow>,
    /// The search for the break.
    pub scan: Vec<ScanRow>,
}

impl PexModel {
    /// The six univariate regressions, the plane, the two planes and those with a smooth transition, and the search for the
    /// break. The smooth ones have no replicates: a search for each would take a hundred times as long as all others.
    ///
    /// Of groups with the same cells.
    ///
    /// # Errors
    /// If whoever follows wants it to stop.
    pub fn fit(&self, groups: &[Group], progress: &Progress) -> anyhow::Result<Vec<Regressions>> {
        let regressions = |group| {
            progress.inc(1)?;
            Ok(self.regressions(group))
        };
        let mut fitted: Vec<Regressions> =
            groups.par_iter().map(regressions).collect::<anyhow::Result<_>>()?;
        if self.uncertainty.replicates > 0 {
            self.resample(groups, progress, &mut fitted)?;
        }
        fitted.par_iter_mut().zip(groups).for_each(|(fitted, group)| {
            fitted.rows.iter_mut().for_each(|row| self.infer(group, row));
            fitted.rows.extend(self.smooth(group));
            for row in &mut fitted.rows {
                row.ranges = ranges(&sample(group, row, row.range()).predictors());
            }
        });
        Ok(fitted)
    }

    fn regressions(&self, group: &Group) -> Regressions {
        let univariate = |&measure: &Measure| PexRow {
            im_x: measure,
            im_y: None,
            range_low: None,
            ..self.row(group, Model::Univariate, EVERYWHERE, fit_univariate(&group.cases, measure))
        };
        let mut rows: Vec<PexRow> = Measure::SCALAR.iter().map(univariate).collect();
        rows.push(self.row(group, Model::Plane, ABOVE_UPLIFT, fit_plane(&group.cases, ABOVE_UPLIFT)));
        let (biplanar, scan) = self.biplanar(group);
        rows.extend(biplanar);
        Regressions { rows, scan }
    }

    fn biplanar(&self, group: &Group) -> (Vec<PexRow>, Vec<ScanRow>) {
        let Biplanar { transition, found, low, high, r2_pooled, r2_overall, scan } =
            match fit_biplanar(&group.cases, self.transition) {
                Ok(biplanar) => biplanar,
                Err(status) => {
                    return (vec![self.row(group, Model::Biplanar, ABOVE_UPLIFT, Err(status))], Vec::new());
                }
            };
        let side = |range, fit| PexRow {
            r2_pooled,
            r2_overall,
            transition_found: found,
            transition_limits: transition_limits(&scan, self.uncertainty.confidence),
            ..self.row(group, Model::Biplanar, range, fit)
        };
        let rows = vec![side(1.0..transition, low), side(transition..f64::INFINITY, high)];
        let place = |&point: &ScanPoint| ScanRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            point,
        };
        (rows, scan.iter().map(place).collect())
    }

    fn smooth(&self, group: &Group) -> Vec<PexRow> {
        let sample = DemandSample::new(&group.cases, &PLANE, EVERYWHERE);
        let SmoothFit { transition, width, low, high, reset } =
            match fit_smooth(&sample, self.uncertainty.confidence) {
                Ok(smooth) => smooth,
                Err(status) => return vec![self.row(group, Model::Smooth, ABOVE_UPLIFT, Err(status))],
            };
        let side = |range, fit: LinearFit| PexRow {
            r2_overall: Some(fit.r2),
            transition_found: Some(transition.value),
            transition_limits: Some(transition.limits()),
            transition_width: Some(width),
            reset,
            ..self.row(group, Model::Smooth, range, Ok(fit))
        };
        vec![side(1.0..transition.value, low), side(transition.value..f64::INFINITY, high)]
    }

    /// A regression on IM4 and IM3 with nothing said of the transition.
    fn row(
        &self,
        group: &Group,
        model: Model,
        range: Range<f64>,
        fit: Result<LinearFit, FitStatus>,
    ) -> PexRow {
        PexRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            eta: group.eta,
            model,
            im_x: Measure::Im4,
            im_y: Some(Measure::Im3),
            range_low: Some(range.start),
            range_high: Some(range.end).filter(|end| end.is_finite()),
            limit_state: self.limit_state,
            ranges: Vec::new(),
            r2_pooled: None,
            r2_overall: None,
            transition_found: None,
            transition_limits: None,
            transition_percentile: None,
            transition_width: None,
            reset: None,
            fit: fit.map(|fit| fit.at_confidence(self.uncertainty.confidence)),
            confidence: self.uncertainty.confidence,
            clustered_errors: Vec::new(),
            limits: Vec::new(),
            replicates: Vec::new(),
        }
    }

    /// Adds the regressions of each resample.
    fn resample(
        &self,
        groups: &[Group],
        progress: &Progress,
        fitted: &mut [Regressions],
    ) -> anyhow::Result<()> {
        let pairs = groups.par_iter().zip(&*fitted);
        let refits: Vec<PexRefits> =
            pairs.map(|(group, fitted)| PexRefits::new(group, &fitted.rows, self.transition)).collect();
        let cells = &groups[0].cells;
        let resampled = self.uncertainty.bootstrap(cells, &refits, progress, PexRefits::resampled)?;
        for (fitted, resampled) in fitted.iter_mut().zip(resampled) {
            let found: Vec<Option<f64>> = resampled.iter().map(|resample| resample.found).collect();
            for resample in resampled {
                let fits = fitted.rows.iter_mut().zip(resample.fits);
                fits.for_each(|(row, fit)| row.replicates.push(fit));
            }
            for row in &mut fitted.rows {
                if let Some(estimate) = row.transition_found {
                    let limits = bootstrap_limits(estimate, &found, 0.0, self.uncertainty.confidence);
                    row.transition_percentile = limits.map(|limits| limits.percentile);
                }
            }
        }
        Ok(())
    }

    /// Adds Ramsey's test, clustered errors, and limits from the replicates if there are any.
    fn infer(&self, group: &Group, row: &mut PexRow) {
        let Ok(fit) = &row.fit else { return };
        let sample = sample(group, row, row.range());
        let inference = DemandInference::new(&sample, fit);
        row.reset = reset(&sample.predictors(), &sample.ln_edp, fit);
        row.clustered_errors = inference.clustered_errors(&group.clusters.numbers);
        if row.replicates.is_empty() {
            return;
        }
        let limits = |(k, (estimate, acceleration)): (usize, (f64, f64))| {
            let parameter = |replicate: &Option<PexReplicate>| replicate.as_ref()?.fit.parameters().nth(k);
            let replicates: Vec<Option<f64>> = row.replicates.iter().map(parameter).collect();
            bootstrap_limits(estimate, &replicates, acceleration, self.uncertainty.confidence)
        };
        let accelerations = inference.accelerations(&Strata::new(&group.cells));
        row.limits = inference.fitted().parameters().zip(accelerations).enumerate().map(limits).collect();
    }
}

/// The cases of a regression in a range of its first measure.
pub(super) fn sample(group: &Group, row: &PexRow, range: Range<f64>) -> DemandSample {
    let measures: Vec<Measure> = std::iter::once(row.im_x).chain(row.im_y).collect();
    DemandSample::new(&group.cases, &measures, range)
}
