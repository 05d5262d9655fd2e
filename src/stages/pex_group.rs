//! All regressions of one group of responses, with their uncertainty, as rows of the pex file.

use std::ops::Range;

use super::groups::Group;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    Biplanar, DemandInference, DemandRefits, DemandReplicate, DemandSample, FitStatus, LinearFit, Measure,
    PLANE, ScanPoint, SmoothFit, Strata, TOGETHER, TransitionSearch, bootstrap_limits, fit_biplanar,
    fit_plane, fit_smooth, fit_univariate, ranges, reset, transition_limits,
};
use crate::pipeline::console::Progress;
use crate::table::pex::{Model, PexReplicate, PexRow};
use crate::table::pex_scan::ScanRow;

/// Every value of a measure.
const EVERYWHERE: Range<f64> = 0.0..f64::INFINITY;
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

/// All fits of one resample.
struct Resampled {
    found: Option<f64>,
    fits: Vec<Option<PexReplicate>>,
}

/// How a regression is made anew.
enum Refit {
    /// From cases that stay the same.
    Of(DemandRefits),
    /// Below the break of the resample.
    Below,
    /// Above it.
    Above,
}

impl PexModel {
    /// The six univariate regressions, the plane, the two planes and those with a smooth transition, and the search for the
    /// break. The smooth ones have no replicates: a search for each would take a hundred times as long as all others.
    ///
    /// # Errors
    /// If whoever follows wants it to stop.
    pub fn fit(&self, group: &Group, progress: &Progress) -> anyhow::Result<(Vec<PexRow>, Vec<ScanRow>)> {
        progress.inc(1)?;
        let (mut rows, scan) = self.regressions(group);
        if self.uncertainty.replicates > 0 {
            self.resample(group, progress, &mut rows)?;
        }
        rows.iter_mut().for_each(|row| self.infer(group, row));
        rows.extend(self.smooth(group));
        for row in &mut rows {
            row.ranges = ranges(&sample(group, row, row.range()).predictors());
        }
        Ok((rows, scan))
    }

    fn regressions(&self, group: &Group) -> (Vec<PexRow>, Vec<ScanRow>) {
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
        (rows, scan)
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
    fn resample(&self, group: &Group, progress: &Progress, rows: &mut [PexRow]) -> anyhow::Result<()> {
        let search = TransitionSearch::new(&DemandSample::new(&group.cases, &PLANE, EVERYWHERE));
        let refits: Vec<Option<Refit>> = rows.iter().map(|row| self.refit(group, row)).collect();
        let resampled = self.uncertainty.bootstrap(group, progress, |resamples| {
            let breaks = search.breaks(resamples);
            let of_all = |refit: &Option<Refit>| match refit {
                Some(Refit::Of(refits)) => refits.replicates(resamples),
                Some(Refit::Below) => breaks.each_ref().map(|at| at.as_ref()?.low.clone()),
                Some(Refit::Above) => breaks.each_ref().map(|at| at.as_ref()?.high.clone()),
                None => [const { None }; TOGETHER],
            };
            let mut fits: Vec<_> = refits.iter().map(of_all).collect();
            std::array::from_fn(|resample| {
                let found = breaks[resample].as_ref().map(|at| at.im4);
                let replicate = |(row, fits): (&PexRow, &mut [Option<DemandReplicate>; TOGETHER])| {
                    let range = row.range_at(self.transition.or(found))?;
                    Some(PexReplicate { range, fit: fits[resample].take()? })
                };
                Resampled { found, fits: rows.iter().zip(&mut fits).map(replicate).collect() }
            })
        })?;
        let found: Vec<Option<f64>> = resampled.iter().map(|resample| resample.found).collect();
        for (k, row) in rows.iter_mut().enumerate() {
            row.replicates = resampled.iter().map(|resample| resample.fits[k].clone()).collect();
            if let Some(estimate) = row.transition_found {
                let limits = bootstrap_limits(estimate, &found, 0.0, self.uncertainty.confidence);
                row.transition_percentile = limits.map(|limits| limits.percentile);
            }
        }
        Ok(())
    }

    fn refit(&self, group: &Group, row: &PexRow) -> Option<Refit> {
        row.fit.as_ref().ok()?;
        Some(match (row.model, self.transition, row.range_high) {
            (Model::Biplanar, None, Some(_)) => Refit::Below,
            (Model::Biplanar, None, None) => Refit::Above,
            _ => Refit::Of(DemandRefits::new(&sample(group, row, row.range()))),
        })
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
fn sample(group: &Group, row: &PexRow, range: Range<f64>) -> DemandSample {
    let measures: Vec<Measure> = std::iter::once(row.im_x).chain(row.im_y).collect();
    DemandSample::new(&group.cases, &measures, range)
}
