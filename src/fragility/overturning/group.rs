//! All curves of a group of cases, with their uncertainty.

use std::fmt;
use std::str::FromStr;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bent::{BentFit, BentSample};
use super::curves::{CurveModel, OverturningFit, fit_overturning, has_few_events};
use super::curves::{fit_with_interaction, fit_with_spline};
use super::inference::CurveInference;
use super::inference::CurveRefits;
use super::parameter::CurveParameter;
use super::sample::EventSample;
use crate::fragility::case::{Event, Measure};
use crate::fragility::clusters::are_many;
use crate::fragility::group::{CaseGroup, Progress, Uncertainty, fit_jointly};
use crate::fragility::held_out::HeldOut;
use crate::fragility::predictor::{BENT_TERMS, ranges};
use crate::keyword::{self, Keyword};
use crate::resampling::{BootstrapLimits, Resamples, Strata, TOGETHER, bootstrap_limits};
use crate::statistics::{BinaryFit, Estimator, FitStatus, Limits, Test, likelihood_ratio};

/// Two measures that make a hybrid one (Eq. 23), written as `im4:im3_inv`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair(pub Measure, pub Measure);

impl FromStr for Pair {
    type Err = String;

    fn from_str(text: &str) -> Result<Pair, String> {
        let (x, y) =
            text.split_once(':').ok_or_else(|| format!("'{text}': expected two measures as im4:im3_inv"))?;
        let measure = |name: &str| keyword::parse(name.trim()).map_err(|unknown| unknown.to_string());
        let pair = Pair(measure(x)?, measure(y)?);
        if pair.0 == pair.1 { Err(format!("'{text}': expected two different measures")) } else { Ok(pair) }
    }
}

impl fmt::Display for Pair {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.0.as_str(), self.1.as_str())
    }
}

/// A fragility curve of one measure or of a hybrid of two.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What it is the probability of.
    pub event: Event,
    /// First measure.
    pub im_x: Measure,
    /// Second measure, of a hybrid.
    pub im_y: Option<Measure>,
    /// Cases used.
    pub n: usize,
    /// Those in which the event happened.
    pub events: usize,
    /// Least and largest value of each measure in the cases.
    pub data_ranges: Vec<[f64; 2]>,
    /// How it was fitted.
    pub model: CurveModel,
    /// The fit, or why there is none.
    pub fit: Result<OverturningFit, FitStatus>,
    /// The likelihood-ratio test against a curve that bends as a spline.
    pub spline: Option<Test>,
    /// The same against one with an interaction.
    pub interaction: Option<Test>,
    /// What cases say that were left out.
    pub held_out: Option<HeldOut>,
    /// The covariance of the coefficients where cases of one cluster may depend on each other, if there are many clusters.
    pub clustered_covariance: Option<DMatrix<f64>>,
    /// The curve that bends, where a test rejects the straight one.
    pub bent: Option<BentFit>,
    /// How uncertain each of its parameters is.
    pub inference: Vec<ParameterInference>,
    /// The coefficients in each resample, where it has a curve.
    pub replicates: Vec<Option<DVector<f64>>>,
    /// Those of the curve that bends.
    pub bent_replicates: Vec<Option<[f64; BENT_TERMS]>>,
}

/// How uncertain a parameter of a curve is, besides the errors and limits of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterInference {
    pub parameter: CurveParameter,
    /// Standard error where cases of one cluster may depend on each other.
    pub clustered_error: f64,
    /// Limits by the profile likelihood.
    pub profile: Limits,
    /// Limits from the replicates, if they give any.
    pub bootstrap: Option<BootstrapLimits>,
}

/// The level of the tests of a curve, all together.
pub(crate) const REJECTED: f64 = 0.01;
/// A difference in probability that matters to nobody.
const SMALL_GAP: f64 = 0.05;

impl Curve {
    /// Fits the curve of a sample of these measures, and tests it; what cases left out and resamples say is not asked.
    pub fn new(
        sample: &EventSample,
        event: Event,
        im_x: Measure,
        im_y: Option<Measure>,
        model: CurveModel,
    ) -> Curve {
        let fit = fit_overturning(sample, &model);
        let needed = |bent: fn(&EventSample, &CurveModel) -> Result<BinaryFit, FitStatus>| {
            let straight = &fit.as_ref().ok().filter(|_| model.estimator == Estimator::Ml)?.regression;
            Some(likelihood_ratio(straight, &bent(sample, &model).ok()?))
        };
        let (spline, interaction) = (needed(fit_with_spline), needed(fit_with_interaction));
        Curve {
            event,
            im_x,
            im_y,
            n: sample.happened.len(),
            events: sample.events(),
            data_ranges: ranges(&sample.predictors()),
            model,
            fit,
            spline,
            interaction,
            held_out: None,
            clustered_covariance: None,
            bent: None,
            inference: Vec::new(),
            replicates: Vec::new(),
            bent_replicates: Vec::new(),
        }
    }

    /// Whether there is a curve, and if not, why.
    pub fn status(&self) -> FitStatus {
        match &self.fit {
            Ok(fit) => match fit.status() {
                FitStatus::Ok if self.is_misfit() => FitStatus::Misfit,
                status => status,
            },
            Err(status) => *status,
        }
    }

    /// Whether a test rejects the curve, and the curve is off by more than a little. Many cases reject any model, few none: so
    /// both are asked.
    fn is_misfit(&self) -> bool {
        self.is_rejected() && self.bent.as_ref().is_none_or(|bent| bent.gap.size() > SMALL_GAP)
    }

    fn is_rejected(&self) -> bool {
        let tests =
            [self.fit.as_ref().ok().and_then(|fit| fit.hosmer_lemeshow), self.spline, self.interaction];
        tests.into_iter().flatten().any(|test| test.p < REJECTED / tests.len() as f64)
    }

    /// The curve that bends, if it is to answer: the straight one fits badly, and this one does better on cases left out.
    pub fn bent_answer(&self) -> Option<&BentFit> {
        let bent = self.bent.as_ref().filter(|_| self.status() == FitStatus::Misfit)?;
        let log_score = |held_out: Option<HeldOut>| held_out.map(|held_out| held_out.log_score);
        let is_better =
            log_score(bent.held_out).zip(log_score(self.held_out)).is_none_or(|(bent, own)| bent > own);
        is_better.then_some(bent)
    }

    /// How uncertain a parameter is.
    pub fn inference_of(&self, parameter: CurveParameter) -> Option<&ParameterInference> {
        self.inference.iter().find(|inference| inference.parameter == parameter)
    }

    /// Whether there is a curve, from so few events that some of its limits are too narrow.
    pub fn has_few_events(&self) -> bool {
        let measures = 1 + usize::from(self.im_y.is_some());
        self.fit.is_ok() && has_few_events(self.events, self.n, measures)
    }
}

/// How all curves of a group are made.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveOptions {
    /// The event: overturning or rocking, which need no limit state.
    pub event: Event,
    /// The hybrid measures, besides the six scalar ones.
    pub pairs: Vec<Pair>,
    /// How a curve is fitted.
    pub model: CurveModel,
    /// The limits that are asked for.
    pub uncertainty: Uncertainty,
}

/// A curve with the cases that it was fitted to.
type SampledCurve = (Curve, EventSample);

/// A curve, to be fitted in resamples of its cases.
struct Refits<'a> {
    straight: CurveRefits<'a>,
    bent: Option<(BentSample<'a>, &'a BentFit)>,
}

/// The coefficients of a curve in a resample.
type Replicate = (Option<DVector<f64>>, Option<[f64; BENT_TERMS]>);

impl<'a> Refits<'a> {
    fn new((curve, sample): &'a SampledCurve) -> Option<Refits<'a>> {
        let straight = CurveRefits::new(sample, &curve.fit.as_ref().ok()?.regression);
        let bent = curve.bent_answer().and_then(|fit| Some((BentSample::new(sample, &curve.model)?, fit)));
        Some(Refits { straight, bent })
    }

    fn replicates(&self, resamples: &Resamples) -> [Replicate; TOGETHER] {
        let mut straight = self.straight.coefficients(resamples);
        let bent = self.bent.as_ref().map(|(sample, fit)| sample.refits(fit, resamples));
        std::array::from_fn(|resample| {
            (straight[resample].take(), bent.as_ref().and_then(|bent| bent[resample]))
        })
    }
}

impl CurveOptions {
    /// Fits the curves of each group: those of the six scalar measures, then of the hybrid ones.
    ///
    /// # Errors
    /// Those of `progress`.
    pub fn fit<E: Send>(&self, groups: &[CaseGroup], progress: Progress<E>) -> Result<Vec<Vec<Curve>>, E> {
        fit_jointly(groups, |groups| self.fit_alike(groups, progress))
    }

    /// Of groups with the same cells.
    fn fit_alike<E: Send>(&self, groups: &[CaseGroup], progress: Progress<E>) -> Result<Vec<Vec<Curve>>, E> {
        let curves = |group: &CaseGroup| {
            progress(1)?;
            Ok(self.curves(group))
        };
        let mut fitted = groups.par_iter().map(curves).collect::<Result<Vec<_>, E>>()?;
        if self.uncertainty.replicates > 0 {
            self.resample(groups[0].cells, progress, &mut fitted)?;
        }
        let infer = |(curves, group): (Vec<SampledCurve>, &CaseGroup)| {
            let inferred = |(curve, sample)| self.infer(group, curve, &sample);
            curves.into_iter().map(inferred).collect()
        };
        Ok(fitted.into_par_iter().zip(groups).map(infer).collect())
    }

    fn curves(&self, group: &CaseGroup) -> Vec<SampledCurve> {
        let scalar = Measure::SCALAR.into_iter().map(|measure| (measure, None));
        let measures = scalar.chain(self.pairs.iter().map(|&Pair(x, y)| (x, Some(y))));
        measures.map(|(im_x, im_y)| self.curve(group, im_x, im_y)).collect()
    }

    fn curve(&self, group: &CaseGroup, im_x: Measure, im_y: Option<Measure>) -> SampledCurve {
        let measures: Vec<Measure> = std::iter::once(im_x).chain(im_y).collect();
        let sample =
            EventSample::new(group.cases, &measures, |case| self.event.happened(case, f64::INFINITY));
        let mut curve = Curve::new(&sample, self.event, im_x, im_y, self.model);
        if let Ok(fit) = &curve.fit {
            let straight = &fit.regression;
            let inference = CurveInference::new(&sample, straight);
            curve.held_out = inference.held_out(group.clusters);
            let many = are_many(group.clusters, &sample.rows);
            curve.clustered_covariance = many.then(|| inference.clustered_covariance(group.clusters));
            let bent = || BentSample::new(&sample, &self.model)?.fit(straight, group.clusters);
            curve.bent = curve.is_rejected().then(bent).flatten();
        }
        (curve, sample)
    }

    /// Adds the coefficients in each resample.
    fn resample<E: Send>(
        &self,
        cells: &[usize],
        progress: Progress<E>,
        fitted: &mut [Vec<SampledCurve>],
    ) -> Result<(), E> {
        let groups: Vec<Vec<Option<Refits>>> =
            fitted.par_iter().map(|curves| curves.iter().map(Refits::new).collect()).collect();
        let resampled = self.uncertainty.bootstrap(cells, &groups, progress, |refits, resamples| {
            let of_all = |refits: &Option<Refits>| Some(refits.as_ref()?.replicates(resamples));
            let mut fits: Vec<Option<[Replicate; TOGETHER]>> = refits.iter().map(of_all).collect();
            std::array::from_fn(|resample| -> Vec<Replicate> {
                let of_curve = |fit: &mut Option<[Replicate; TOGETHER]>| {
                    fit.as_mut().map(|fits| std::mem::take(&mut fits[resample])).unwrap_or_default()
                };
                fits.iter_mut().map(of_curve).collect()
            })
        })?;
        for (curves, replicates) in fitted.iter_mut().zip(resampled) {
            for fits in replicates {
                for ((curve, _), (straight, bent)) in curves.iter_mut().zip(fits) {
                    curve.replicates.push(straight);
                    curve.bent_replicates.push(bent);
                }
            }
        }
        Ok(())
    }

    /// Adds clustered errors, profile-likelihood limits, and limits from the replicates if there are any.
    fn infer(&self, group: &CaseGroup, mut curve: Curve, sample: &EventSample) -> Curve {
        let Ok(fit) = &curve.fit else { return curve };
        let (inference, confidence) =
            (CurveInference::new(sample, &fit.regression), self.uncertainty.confidence);
        let strata = Strata::new(group.cells);
        let clustered = inference.clustered_covariance(group.clusters);
        let of = |parameter: &CurveParameter| {
            let replicates = inference.parameters(*parameter, &curve.replicates);
            let acceleration = inference.acceleration(*parameter, &strata);
            let estimate = inference.fitted(*parameter);
            ParameterInference {
                parameter: *parameter,
                clustered_error: inference.standard_error(*parameter, &clustered),
                profile: inference.profile_limits(*parameter, confidence),
                bootstrap: bootstrap_limits(estimate, &replicates, acceleration, confidence),
            }
        };
        curve.inference = inference.curve_parameters().iter().map(of).collect();
        curve
    }
}
