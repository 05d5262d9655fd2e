//! All regressions of one group of responses, with their uncertainty, as rows of the pex file.

use std::ops::Range;

use super::groups::Group;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    Biplanar, DemandInference, DemandSample, FitStatus, LinearFit, Measure, PLANE, Strata, bootstrap_limits,
    fit_biplanar, fit_plane, fit_univariate,
};
use crate::table::pex::{Model, PexReplicate, PexRow, ScanRow};

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

impl PexModel {
    /// The six univariate regressions, the plane and the two planes, and the search for the transition.
    pub fn fit(&self, group: &Group) -> (Vec<PexRow>, Vec<ScanRow>) {
        let (mut rows, scan) = self.regressions(group);
        if self.uncertainty.replicates > 0 {
            self.resample(group, &mut rows);
        }
        rows.iter_mut().for_each(|row| self.infer(group, row));
        (rows, scan)
    }

    fn regressions(&self, group: &Group) -> (Vec<PexRow>, Vec<ScanRow>) {
        let row = |model, im_y, range: Range<f64>, fit: Result<LinearFit, FitStatus>| PexRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            model,
            im_x: Measure::Im4,
            im_y,
            range_low: Some(range.start),
            range_high: Some(range.end).filter(|end| end.is_finite()),
            limit_state: self.limit_state,
            r2_pooled: None,
            r2_overall: None,
            transition_found: None,
            transition_limits: None,
            fit: fit.map(|fit| fit.at_confidence(self.uncertainty.confidence)),
            confidence: self.uncertainty.confidence,
            clustered_errors: Vec::new(),
            limits: Vec::new(),
            replicates: Vec::new(),
        };
        let univariate = |&measure: &Measure| PexRow {
            im_x: measure,
            range_low: None,
            ..row(Model::Univariate, None, 0.0..f64::INFINITY, fit_univariate(&group.cases, measure))
        };
        let mut rows: Vec<PexRow> = Measure::SCALAR.iter().map(univariate).collect();
        let everywhere = 1.0..f64::INFINITY;
        let plane = fit_plane(&group.cases, everywhere.clone());
        rows.push(row(Model::Plane, Some(Measure::Im3), everywhere.clone(), plane));
        let biplanar = match fit_biplanar(&group.cases, self.transition) {
            Ok(biplanar) => biplanar,
            Err(status) => {
                rows.push(row(Model::Biplanar, Some(Measure::Im3), everywhere, Err(status)));
                return (rows, Vec::new());
            }
        };
        let Biplanar { transition: at, found, low, high, r2_pooled, r2_overall, scan } = biplanar;
        let pooled = |row| PexRow { r2_pooled, r2_overall, transition_found: found, ..row };
        rows.push(pooled(row(Model::Biplanar, Some(Measure::Im3), 1.0..at, low)));
        rows.push(pooled(row(Model::Biplanar, Some(Measure::Im3), at..f64::INFINITY, high)));
        let scan = scan.into_iter().map(|point| ScanRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            point,
        });
        (rows, scan.collect())
    }

    fn resample(&self, group: &Group, rows: &mut [PexRow]) {
        let both = DemandSample::new(&group.cases, &PLANE, 0.0..f64::INFINITY);
        let search = both.transition_search();
        let samples: Vec<DemandSample> =
            rows.iter().map(|row| sample(group, row, 0.0..f64::INFINITY)).collect();
        let refit = |(row, sample): (&PexRow, _)| Some(DemandInference::new(sample, row.fit.as_ref().ok()?));
        let refits: Vec<Option<DemandInference>> = rows.iter().zip(&samples).map(refit).collect();
        let resampled = self.uncertainty.bootstrap(group, |counts| {
            let found = search.find(|case| counts[both.rows[case]]).map(|transition| transition.im4);
            let replicate = |(row, refit): (&PexRow, &Option<DemandInference>)| {
                let range = row.range_at(self.transition.or(found))?;
                let fit = refit.as_ref()?.replicate(counts, range.clone())?;
                Some(PexReplicate { range, fit })
            };
            Resampled { found, fits: rows.iter().zip(&refits).map(replicate).collect() }
        });
        let found: Vec<Option<f64>> = resampled.iter().map(|resample| resample.found).collect();
        for (k, row) in rows.iter_mut().enumerate() {
            row.replicates = resampled.iter().map(|resample| resample.fits[k].clone()).collect();
            if let Some(estimate) = row.transition_found {
                let limits = bootstrap_limits(estimate, &found, 0.0, self.uncertainty.confidence);
                row.transition_limits = limits.map(|limits| limits.percentile);
            }
        }
    }

    /// Adds clustered errors, and limits from the replicates if there are any.
    fn infer(&self, group: &Group, row: &mut PexRow) {
        let Ok(fit) = &row.fit else { return };
        let sample = sample(group, row, row.range());
        let inference = DemandInference::new(&sample, fit);
        row.clustered_errors = inference.clustered_errors(&group.cells);
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
