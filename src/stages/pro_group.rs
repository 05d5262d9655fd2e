//! All curves of one group of responses, with their uncertainty, as rows of the pro file.

use rayon::prelude::*;

use super::fit_pro::{FittedEvent, Pair};
use super::groups::Group;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    CurveInference, CurveModel, CurveParameter, CurveRefits, EventSample, Measure, fit_overturning,
    fit_with_interaction, fit_with_spline, ranges,
};
use crate::keyword::Keyword;
use crate::pipeline::console::Progress;
use crate::resampling::Strata;
use crate::statistics::{BinaryFit, Estimator, FitStatus, bootstrap_limits, likelihood_ratio};
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

/// A curve with the sample it was fitted to.
struct Curve {
    row: ProRow,
    sample: EventSample,
}

impl Curve {
    fn refits(&self) -> Option<CurveRefits<'_>> {
        Some(CurveRefits::new(&self.sample, &self.row.fit.as_ref().ok()?.regression))
    }
}

impl ProModel {
    /// The curves of the six scalar measures and of the hybrid ones, of groups with the same cells.
    ///
    /// # Errors
    /// If whoever follows wants it to stop.
    pub fn fit(&self, groups: &[Group], progress: &Progress) -> anyhow::Result<Vec<ProRow>> {
        let curves = |group| {
            progress.inc(1)?;
            Ok(self.curves(group))
        };
        let mut fitted: Vec<Vec<Curve>> = groups.par_iter().map(curves).collect::<anyhow::Result<_>>()?;
        if self.uncertainty.replicates > 0 {
            self.resample(&groups[0].cells, progress, &mut fitted)?;
        }
        let infer = |(mut curves, group): (Vec<Curve>, &Group)| {
            curves.iter_mut().for_each(|curve| self.infer(group, curve));
            curves.into_iter().map(|curve| curve.row).collect::<Vec<_>>()
        };
        Ok(fitted.into_par_iter().zip(groups).flat_map_iter(infer).collect())
    }

    fn curves(&self, group: &Group) -> Vec<Curve> {
        let scalar = Measure::SCALAR.into_iter().map(|measure| (measure, None));
        let measures = scalar.chain(self.pairs.iter().map(|&Pair(x, y)| (x, Some(y))));
        measures.map(|(im_x, im_y)| self.curve(group, im_x, im_y)).collect()
    }

    fn curve(&self, group: &Group, im_x: Measure, im_y: Option<Measure>) -> Curve {
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
        Curve { row, sample }
    }

    /// Adds the coefficients in each resample.
    fn resample(
        &self,
        cells: &[usize],
        progress: &Progress,
        fitted: &mut [Vec<Curve>],
    ) -> anyhow::Result<()> {
        let groups: Vec<Vec<Option<CurveRefits>>> =
            fitted.par_iter().map(|curves| curves.iter().map(Curve::refits).collect()).collect();
        let resampled = self.uncertainty.bootstrap(cells, &groups, progress, |refits, resamples| {
            let of_all = |refits: &Option<CurveRefits>| Some(refits.as_ref()?.coefficients(resamples));
            let mut fits: Vec<_> = refits.iter().map(of_all).collect();
            std::array::from_fn(|resample| -> Vec<_> {
                fits.iter_mut().map(|fit| fit.as_mut()?[resample].take()).collect()
            })
        })?;
        for (curves, replicates) in fitted.iter_mut().zip(resampled) {
            for fits in replicates {
                curves.iter_mut().zip(fits).for_each(|(curve, fit)| curve.row.replicates.push(fit));
            }
        }
        Ok(())
    }

    /// Adds clustered errors, profile-likelihood limits, and limits from the replicates if there are any.
    fn infer(&self, group: &Group, Curve { row, sample }: &mut Curve) {
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
