//! All curves of one group of responses, with their uncertainty, as rows of the pro file.

use super::fit_pro::{FittedEvent, Pair};
use super::groups::Group;
use super::uncertainty::Uncertainty;
use crate::fragility::{
    CurveModel, CurveParameter, CurveRefit, EventSample, Measure, Strata, bootstrap_limits, fit_overturning,
};
use crate::keyword::Keyword;
use crate::table::pro::ProRow;

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
    pub fn fit(&self, group: &Group) -> Vec<ProRow> {
        let scalar = Measure::SCALAR.into_iter().map(|measure| (measure, None));
        let measures = scalar.chain(self.pairs.iter().map(|&Pair(x, y)| (x, Some(y))));
        let (mut rows, samples): (Vec<ProRow>, Vec<EventSample>) =
            measures.map(|(im_x, im_y)| self.curve(group, im_x, im_y)).unzip();
        if self.uncertainty.replicates > 0 {
            self.resample(group, &mut rows, &samples);
        }
        rows
    }

    fn curve(&self, group: &Group, im_x: Measure, im_y: Option<Measure>) -> (ProRow, EventSample) {
        let measures: Vec<Measure> = std::iter::once(im_x).chain(im_y).collect();
        let sample = EventSample::new(&group.cases, &measures, |case| self.event.happened(case));
        let row = ProRow {
            suite: group.suite.clone(),
            structure: group.structure.clone(),
            event: self.event.as_str(),
            im_x,
            im_y,
            n: sample.happened.len(),
            events: sample.events(),
            model: self.curve,
            fit: fit_overturning(&sample, &self.curve),
            limits: Vec::new(),
            replicates: Vec::new(),
        };
        (row, sample)
    }

    fn resample(&self, group: &Group, rows: &mut [ProRow], samples: &[EventSample]) {
        let regressions: Vec<_> =
            rows.iter().map(|row| Some(row.fit.as_ref().ok()?.regression.clone())).collect();
        let refit = |(fit, sample)| Option::map(fit, |fit| CurveRefit::new(sample, fit));
        let fits = regressions.iter().map(Option::as_ref);
        let refits: Vec<Option<CurveRefit>> = fits.zip(samples).map(refit).collect();
        let resampled = self.uncertainty.bootstrap(group, |counts| -> Vec<_> {
            refits.iter().map(|refit| refit.as_ref()?.coefficients(counts)).collect()
        });
        let strata = Strata::new(&group.cells);
        for (k, (row, refit)) in rows.iter_mut().zip(&refits).enumerate() {
            row.replicates = resampled.iter().map(|fits| fits[k].clone()).collect();
            let Some(refit) = refit else { continue };
            let limits = |parameter: &CurveParameter| {
                let replicates = refit.parameters(*parameter, &row.replicates);
                let acceleration = refit.acceleration(*parameter, &strata);
                let confidence = self.uncertainty.confidence;
                let estimate = refit.fitted(*parameter);
                Some((*parameter, bootstrap_limits(estimate, &replicates, acceleration, confidence)?))
            };
            row.limits = refit.curve_parameters().iter().filter_map(limits).collect();
        }
    }
}
