//! All regressions of the demand in a group of cases, with their uncertainty: Table II and more.

use std::ops::Range;

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::inference::DemandRefits;
use super::inference::{DemandInference, DemandReplicate, solutions};
use super::regressions::{Biplanar, PLANE, fit_biplanar, fit_plane, fit_univariate};
use super::smooth::{SmoothFit, fit_smooth};
use super::transition::{ScanPoint, TransitionSearch, breaks, no_parts, transition_limits};
use crate::fragility::case::{Case, Measure};
use crate::fragility::cases::{CaseTable, Cases};
use crate::fragility::group::{Progress, Refits, Uncertainty, fit_jointly};
use crate::fragility::held_out::HeldOut;
use crate::fragility::sample::Sample;
use crate::keyword::keywords;
use crate::resampling::normal_equations::NormalEquations;
use crate::resampling::{BootstrapLimits, Resamples, Sizes, TOGETHER, bootstrap_limits};
use crate::statistics::design::Moments;
use crate::statistics::goodness::reset_of;
use crate::statistics::{Estimate, FitStatus, Limits, LinearFit, Test};

/// All values of a measure.
const EVERYWHERE: Range<f64> = 0.0..f64::INFINITY;
/// All values of IM4 at which there is rocking.
const ABOVE_UPLIFT: Range<f64> = 1.0..f64::INFINITY;

/// The form of a regression.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// On one measure (Eq. 15).
    Univariate,
    /// On two, everywhere (Eq. 17).
    Plane,
    /// On two, on one side of the transition (Eqs. 17 and 18).
    Biplanar,
    /// On two, on one side of a smooth transition; both sides are fitted together.
    Smooth,
}

keywords!(Form { Univariate = "univariate", Plane = "plane", Biplanar = "biplanar", Smooth = "smooth" });

/// A regression of ln EDP, or one of two that meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Regression {
    pub form: Form,
    /// First measure.
    pub im_x: Measure,
    /// Second measure.
    pub im_y: Option<Measure>,
    /// The values of `im_x` within which it holds.
    pub range: Range<f64>,
    /// Least and largest value of each measure in the cases.
    pub data_ranges: Vec<[f64; 2]>,
    /// R2 of both planes, each about the mean on its own side.
    pub r2_pooled: Option<f64>,
    /// R2 of both planes about the mean of all cases.
    pub r2_overall: Option<f64>,
    /// IM4 of the least pooled residual, or where the planes of a smooth transition count the same.
    pub transition_found: Option<f64>,
    /// Limits of `transition_found`: by the residual (Hansen) of a break, by linearisation of a smooth transition.
    pub transition_limits: Option<Limits>,
    /// Percentile limits of `transition_found`.
    pub transition_percentile: Option<Limits>,
    /// Width of a smooth transition, in ln IM4.
    pub transition_width: Option<Estimate>,
    /// Ramsey's test of the form.
    pub reset: Option<Test>,
    /// The fit, or why there is none.
    pub fit: Result<LinearFit, FitStatus>,
    /// Probability with which limits hold the truth.
    pub confidence: f64,
    /// Standard errors of the coefficients where cases of one cluster may depend on each other.
    pub clustered_errors: Vec<f64>,
    /// Their covariance likewise, if there are many clusters.
    pub clustered_covariance: Option<DMatrix<f64>>,
    /// What cases say that were left out, of a demand above the limit state.
    pub held_out: Option<HeldOut>,
    /// Bootstrap limits of the coefficients, then of the dispersion; empty without replicates.
    pub limits: Vec<Option<BootstrapLimits>>,
    /// The regression in each resample, where it has one.
    pub replicates: Vec<Option<Replicate>>,
}

/// A regression of a resample.
#[derive(Debug, Clone, PartialEq)]
pub struct Replicate {
    /// The values of `im_x` within which it holds.
    pub range: Range<f64>,
    /// Coefficients and dispersion.
    pub fit: DemandReplicate,
}

impl Regression {
    /// Whether there is a fit, and if not, why.
    pub fn status(&self) -> FitStatus {
        match &self.fit {
            Ok(fit) => fit.status(),
            Err(status) => *status,
        }
    }

    /// A coefficient, the intercept being the first.
    pub fn coefficient(&self, index: usize) -> Option<Estimate> {
        self.fit.as_ref().ok()?.coefficients.get(index).copied()
    }

    /// The covariance of two coefficients.
    pub fn covariance(&self, place: (usize, usize)) -> Option<f64> {
        self.fit.as_ref().ok()?.covariance.get(place).copied()
    }

    /// The dispersion in units of the first measure, beta / b1.
    pub fn zeta(&self) -> Option<f64> {
        Some(self.fit.as_ref().ok()?.residual_sd / self.coefficient(1)?.value)
    }

    /// Bootstrap limits of a coefficient.
    pub fn coefficient_limits(&self, index: usize) -> Option<BootstrapLimits> {
        self.coefficient(index)?;
        *self.limits.get(index)?
    }

    /// Bootstrap limits of the dispersion.
    pub fn beta_limits(&self) -> Option<BootstrapLimits> {
        *self.limits.last()?
    }

    /// Where it holds if two planes meet at this IM4; none of two planes that meet nowhere.
    fn range_at(&self, transition: Option<f64>) -> Option<Range<f64>> {
        match self.form {
            Form::Univariate | Form::Plane | Form::Smooth => Some(self.range.clone()),
            Form::Biplanar if self.range.end.is_finite() => Some(self.range.start..transition?),
            Form::Biplanar => Some(transition?..f64::INFINITY),
        }
    }

    /// The cases that it was fitted to.
    fn sample<C: Cases + ?Sized>(&self, cases: &C) -> Sample {
        let measures: Vec<Measure> = std::iter::once(self.im_x).chain(self.im_y).collect();
        Sample::of_demands(cases, &measures, self.range.clone())
    }
}

/// The regressions of a group.
#[derive(Debug, Clone, PartialEq)]
pub struct Regressions {
    /// The six univariate ones, the plane, the two planes, and those with a smooth transition.
    pub fits: Vec<Regression>,
    /// The search for the transition of the two planes.
    pub scan: Vec<ScanPoint>,
}

/// How all regressions of a group are made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegressionOptions {
    /// The IM4 at which two planes meet, if not where their pooled residual is least.
    pub transition: Option<f64>,
    /// The demand that P_ex is about.
    pub limit: f64,
    /// The limits that are asked for.
    pub uncertainty: Uncertainty,
}

impl RegressionOptions {
    /// Fits all regressions of each group. Those with a smooth transition have no replicates: a search for each would take a
    /// hundred times as long as all others.
    ///
    /// # Errors
    /// Those of `progress`.
    pub fn fit<E: Send>(&self, groups: &[&CaseTable], progress: Progress<E>) -> Result<Vec<Regressions>, E> {
        fit_jointly(groups, &self.uncertainty, |groups, sizes| self.fit_alike(groups, sizes, progress))
    }

    /// Of groups with the same cells.
    fn fit_alike<E: Send>(
        &self,
        groups: &[&CaseTable],
        sizes: &Sizes,
        progress: Progress<E>,
    ) -> Result<Vec<Regressions>, E> {
        let regressions = |group: &&CaseTable| {
            progress(1)?;
            Ok(self.regressions(group))
        };
        let mut fitted = groups.par_iter().map(regressions).collect::<Result<Vec<_>, E>>()?;
        if self.uncertainty.replicates > 0 {
            self.resample(groups, sizes, progress, &mut fitted)?;
        }
        fitted.par_iter_mut().zip(groups).for_each(|(Regressions { fits, .. }, group)| {
            fits.extend(self.smooth(group));
            fits.par_iter_mut().for_each(|regression| self.infer(group, sizes, regression));
        });
        Ok(fitted)
    }

    fn regressions(&self, cases: &CaseTable) -> Regressions {
        let univariate = |&measure: &Measure| Regression {
            im_x: measure,
            im_y: None,
            ..self.regression(Form::Univariate, EVERYWHERE, fit_univariate(cases, measure))
        };
        let mut fits: Vec<Regression> = Measure::SCALAR.par_iter().map(univariate).collect();
        fits.push(self.regression(Form::Plane, ABOVE_UPLIFT, fit_plane(cases, ABOVE_UPLIFT)));
        let (biplanar, scan) = self.biplanar(cases);
        fits.extend(biplanar);
        Regressions { fits, scan }
    }

    fn biplanar(&self, cases: &CaseTable) -> (Vec<Regression>, Vec<ScanPoint>) {
        let Biplanar { transition, found, low, high, r2_pooled, r2_overall, scan } =
            match fit_biplanar(cases, self.transition) {
                Ok(biplanar) => biplanar,
                Err(status) => {
                    return (vec![self.regression(Form::Biplanar, ABOVE_UPLIFT, Err(status))], Vec::new());
                }
            };
        let side = |range, fit| Regression {
            r2_pooled,
            r2_overall,
            transition_found: found,
            transition_limits: transition_limits(&scan, self.uncertainty.confidence),
            ..self.regression(Form::Biplanar, range, fit)
        };
        (vec![side(1.0..transition, low), side(transition..f64::INFINITY, high)], scan)
    }

    fn smooth(&self, cases: &CaseTable) -> Vec<Regression> {
        let sample = Sample::of_demands(cases, &PLANE, EVERYWHERE);
        let SmoothFit { transition, width, low, high, reset } =
            match fit_smooth(&sample, self.uncertainty.confidence) {
                Ok(smooth) => smooth,
                Err(status) => return vec![self.regression(Form::Smooth, ABOVE_UPLIFT, Err(status))],
            };
        let side = |range, fit: LinearFit| Regression {
            r2_overall: Some(fit.r2),
            transition_found: Some(transition.value),
            transition_limits: Some(transition.limits()),
            transition_width: Some(width),
            reset,
            ..self.regression(Form::Smooth, range, Ok(fit))
        };
        vec![side(1.0..transition.value, low), side(transition.value..f64::INFINITY, high)]
    }

    /// A regression on IM4 and IM3 with nothing said of the transition.
    fn regression(&self, form: Form, range: Range<f64>, fit: Result<LinearFit, FitStatus>) -> Regression {
        let confidence = self.uncertainty.confidence;
        let [im_x, im_y] = PLANE;
        Regression {
            form,
            im_x,
            im_y: Some(im_y),
            range,
            data_ranges: Vec::new(),
            r2_pooled: None,
            r2_overall: None,
            transition_found: None,
            transition_limits: None,
            transition_percentile: None,
            transition_width: None,
            reset: None,
            fit: fit.map(|fit| fit.at_confidence(confidence)),
            confidence,
            clustered_errors: Vec::new(),
            clustered_covariance: None,
            held_out: None,
            limits: Vec::new(),
            replicates: Vec::new(),
        }
    }

    /// Adds the regressions of each resample.
    fn resample<E: Send>(
        &self,
        groups: &[&CaseTable],
        sizes: &Sizes,
        progress: Progress<E>,
        fitted: &mut [Regressions],
    ) -> Result<(), E> {
        let pairs = groups.par_iter().zip(&*fitted);
        let refits: Vec<RegressionRefits> = pairs
            .map(|(group, fitted)| RegressionRefits::new(group, &fitted.fits, self.transition))
            .collect();
        let resampled = self.uncertainty.bootstrap(groups, sizes, &refits, progress)?;
        for (Regressions { fits, .. }, resampled) in fitted.iter_mut().zip(resampled) {
            let found: Vec<Option<f64>> = resampled.iter().map(|resample| resample.found).collect();
            for resample in resampled {
                let pairs = fits.iter_mut().zip(resample.fits);
                pairs.for_each(|(regression, fit)| regression.replicates.push(fit));
            }
            for regression in fits {
                if let Some(estimate) = regression.transition_found {
                    let limits = bootstrap_limits(estimate, &found, 0.0, self.uncertainty.confidence);
                    regression.transition_percentile = limits.map(|limits| limits.percentile);
                }
            }
        }
        Ok(())
    }

    /// Adds the ranges of the data, Ramsey's test, clustered errors, and limits from the replicates if there are any.
    fn infer(&self, group: &CaseTable, sizes: &Sizes, regression: &mut Regression) {
        let sample = regression.sample(group);
        regression.data_ranges = sample.ranges();
        let Ok(fit) = &regression.fit else { return };
        if regression.form == Form::Smooth {
            return;
        }
        let inference = DemandInference::new(&sample, fit);
        regression.reset = reset_of(&sample.columns, sample.measures, fit);
        let clustered = inference.covariance_by_cluster();
        regression.clustered_errors = clustered.diagonal().iter().map(|variance| variance.sqrt()).collect();
        regression.clustered_covariance = sample.has_many_clusters().then_some(clustered);
        regression.held_out = inference.held_out(self.limit);
        if regression.replicates.is_empty() {
            return;
        }
        let limits = |(k, (estimate, acceleration)): (usize, (f64, f64))| {
            let parameter = |replicate: &Option<Replicate>| replicate.as_ref()?.fit.parameters().nth(k);
            let replicates: Vec<Option<f64>> = regression.replicates.iter().map(parameter).collect();
            bootstrap_limits(estimate, &replicates, acceleration, self.uncertainty.confidence)
        };
        let accelerations = inference.accelerations_by_cell(sizes);
        let parameters = inference.fitted();
        regression.limits = parameters.parameters().zip(accelerations).enumerate().map(limits).collect();
    }
}

/// The regressions of a group, to be made anew in resamples of its cases.
struct RegressionRefits<'a> {
    regressions: &'a [Regression],
    /// The IM4 at which two planes meet, if it is not searched anew.
    transition: Option<f64>,
    /// Means of the cases of the search for it.
    means: Vec<f64>,
    refits: Vec<Option<Refit>>,
}

/// How a regression is made anew.
enum Refit {
    /// From the resampled among the cases that it was fitted to, which have these means.
    SameCases(Vec<f64>),
    /// Below the transition of the resample.
    Below,
    /// Above it.
    Above,
}

/// All regressions of one resample.
struct Resampled {
    /// The IM4 of the least pooled residual.
    found: Option<f64>,
    fits: Vec<Option<Replicate>>,
}

impl<'a> RegressionRefits<'a> {
    fn new(
        cases: &CaseTable,
        regressions: &'a [Regression],
        transition: Option<f64>,
    ) -> RegressionRefits<'a> {
        let means = |sample: Sample| Moments::of(&sample.design()).means;
        let refit = |regression: &Regression| {
            regression.fit.as_ref().ok()?;
            Some(match (regression.form, transition) {
                (Form::Biplanar, None) if regression.range.end.is_finite() => Refit::Below,
                (Form::Biplanar, None) => Refit::Above,
                _ => Refit::SameCases(means(regression.sample(cases))),
            })
        };
        RegressionRefits {
            regressions,
            transition,
            means: means(Sample::of_demands(cases, &PLANE, EVERYWHERE)),
            refits: regressions.iter().map(refit).collect(),
        }
    }

    /// Of each refit what `of` makes of those that are made from the same cases.
    fn of_same_cases<T>(&self, of: impl Fn(&Regression, &[f64]) -> T) -> Vec<Option<T>> {
        let of_each = |(regression, refit): (&Regression, &Option<Refit>)| match refit {
            Some(Refit::SameCases(means)) => Some(of(regression, means)),
            _ => None,
        };
        self.regressions.iter().zip(&self.refits).map(of_each).collect()
    }
}

impl Refits for RegressionRefits<'_> {
    type Terms = (Vec<Option<DemandRefits>>, TransitionSearch);
    type Sums = (Vec<Option<NormalEquations>>, Vec<NormalEquations>);
    type Refit = Resampled;

    fn terms(&self, cases: &[Case]) -> Self::Terms {
        let search = Sample::of_demands(cases, &PLANE, EVERYWHERE);
        let of_same_cases = self.of_same_cases(|regression, means| {
            DemandRefits::about(means.to_vec(), &regression.sample(cases))
        });
        (of_same_cases, TransitionSearch::about(self.means.clone(), &search))
    }

    fn none(&self) -> Self::Sums {
        let empty = self.of_same_cases(|_, means| NormalEquations::empty(means.len()));
        (empty, no_parts(self.means.len()))
    }

    fn add(&self, (refits, search): &Self::Terms, resamples: &Resamples, sums: &mut Self::Sums) {
        for (sum, refits) in sums.0.iter_mut().flatten().zip(refits.iter().flatten()) {
            sum.add(&refits.equations(0..refits.cases(), resamples));
        }
        sums.1.iter_mut().zip(search.parts(resamples)).for_each(|(sum, part)| sum.add(&part));
    }

    fn refits<'w>(
        &self,
        (equations, parts): Self::Sums,
        _: &(dyn Fn() -> &'w Resamples + 'w),
    ) -> [Resampled; TOGETHER] {
        let breaks = breaks(&self.means, &parts);
        let of_all = |(refit, equations): (&Option<Refit>, &Option<NormalEquations>)| match (refit, equations)
        {
            (Some(Refit::SameCases(means)), Some(equations)) => solutions(means, equations),
            (Some(Refit::Below), _) => breaks.each_ref().map(|at| at.as_ref()?.low.clone()),
            (Some(Refit::Above), _) => breaks.each_ref().map(|at| at.as_ref()?.high.clone()),
            _ => [const { None }; TOGETHER],
        };
        let mut fits: Vec<_> = self.refits.iter().zip(&equations).map(of_all).collect();
        std::array::from_fn(|resample| {
            let found = breaks[resample].as_ref().map(|at| at.im4);
            let replicate = |(regression, fits): (&Regression, &mut [Option<DemandReplicate>; TOGETHER])| {
                let range = regression.range_at(self.transition.or(found))?;
                Some(Replicate { range, fit: fits[resample].take()? })
            };
            Resampled { found, fits: self.regressions.iter().zip(&mut fits).map(replicate).collect() }
        })
    }
}
