//! All curves of one group of responses, with their uncertainty, as rows of the pro file.

use super::fit_pro::{FittedEvent, Pair};
use super::groups::Group;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    BinaryFit, CurveInference, CurveModel, CurveParameter, CurveRefits, Estimator, EventSample, FitStatus,
    Measure, Strata, bootstrap_limits, fit_overturning, fit_with_interaction, fit_with_spline,
    likelihood_ratio, ranges,
};
use crate::keyword::Keyword;
use crate::pipeline::console::Progress;
use crate::table::pro::{ParameterInference, ProRow};

/// How all curves are made.
pub struct ProModel {
    /// What they are about.
    pub event: FittedEvent,
    /// The hybrid measures.
    pub pairs: Vec<Pair>,
    /// How a curve is fitted.
    pub curve: CurveModel,
    /// The limits that are asked for.
    pub uncertainty: Uncertainty,
}

impl ProModel {
    /// The curves of the six scalar measures and of the hybrid ones.
    ///
    /// # Errors
    /// If whoever follows wants it to stop.
    pub fn fit(&self, group: &Group, progress: &Progress) -> anyhow::Result<Vec<ProRow>> {
        progress.inc(1)?;
        let scalar = Measure::SCALAR.into_iter().map(|measure| (measure, None));
        let measures = scalar.chain(self.pairs.iter().map(|&Pair(x, y)| (x, Some(y))));
        let (mut rows, samples): (Vec<ProRow>, Vec<EventSample>) =
            measures.map(|(im_x, im_y)| self.curve(group, im_x, im_y)).unzip();
        if self.uncertainty.replicates > 0 {
            self.resample(group, progress, &mut rows, &samples)?;
        }
        rows.iter_mut().zip(&samples).for_each(|(row, sample)| self.infer(group, row, sample));
        Ok(rows)
    }

    fn curve(&self, group: &Group, im_x: Measure, im_y: Option<Measure>) -> (ProRow, EventSample) {
        let measures: Vec<Measure> = std::iter::once(im_x).chain(im_y).collect();
        let sample = EventSample::new(&group.cases, &measures, |case| self.event.happened(case));
        let fit = fit_overturning(&sample, &self.curve);
        let needed = |bent: fn(&EventSample, &CurveModel) -> Result<BinaryFit, FitStatus>| {
            let straight = &fit.as_ref().ok().filter(|_| self.curve.estimator == Estimator::Ml)?.regression;
            Some(likelihood_ratio(straight, &bent(&sample, &self.curve).ok()?))
        };
        let (spline, interaction) = (needed(fit_with_spline), needed(fit_with_interaction));
        let row = ProRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            eta: group.eta,
            event: self.event.as_str(),
            im_x,
            im_y,
            n: sample.happened.len(),
            events: sample.events(),
            ranges: ranges(&sample.predictors()),
            model: self.curve,
            fit,
            spline,
            interaction,
            inference: Vec::new(),
            replicates: Vec::new(),
        };
        (row, sample)
    }

    /// Adds the coefficients in each resample.
    fn resample(
        &self,
        group: &Group,
        progress: &Progress,
        rows: &mut [ProRow],
        samples: &[EventSample],
    ) -> anyhow::Result<()> {
        let pairs = rows.iter().zip(samples);
        let refits: Vec<Option<CurveRefits>> = pairs
            .map(|(row, sample)| Some(CurveRefits::new(sample, &row.fit.as_ref().ok()?.regression)))
            .collect();
        let resampled = self.uncertainty.bootstrap(group, progress, |resamples| {
            let of_all = |refits: &Option<CurveRefits>| Some(refits.as_ref()?.coefficients(resamples));
            let mut fits: Vec<_> = refits.iter().map(of_all).collect();
            std::array::from_fn(|resample| -> Vec<_> {
                fits.iter_mut().map(|fit| fit.as_mut()?[resample].take()).collect()
            })
        })?;
        for (k, row) in rows.iter_mut().enumerate() {
            row.replicates = resampled.iter().map(|fits| fits[k].clone()).collect();
        }
        Ok(())
    }

    /// Adds clustered errors, profile-likelihood limits, and limits from the replicates if there are any.
    fn infer(&self, group: &Group, row: &mut ProRow, sample: &EventSample) {
        let Ok(fit) = &row.fit else { return };
        let (inference, confidence) =
            (CurveInference::new(sample, &fit.regression), self.uncertainty.confidence);
        let (strata, clustered) =
            (Strata::new(&group.cells), inference.clustered_covariance(&group.clusters.numbers));
        let of = |parameter: &CurveParameter| {
            let replicates = inference.parameters(*parameter, &row.replicates);
            let acceleration = inference.acceleration(*parameter, &strata);
            let estimate = inference.fitted(*parameter);
            ParameterInference {
                parameter: *parameter,
                clustered_error: inference.standard_error(*parameter, &clustered),
                profile: inference.profile_limits(*parameter, confidence),
                bootstrap: bootstrap_limits(estimate, &replicates, acceleration, confidence),
            }
        };
        row.inference = inference.curve_parameters().iter().map(of).collect();
    }
}
