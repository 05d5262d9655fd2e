//! All curves of a group of cases, with their uncertainty.

use std::fmt;
use std::str::FromStr;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bent::{BentFit, BentSample, placed};
use super::curves::{CurveModel, OverturningFit, fit_overturning, has_few_events};
use super::curves::{fit_with_interaction, fit_with_spline};
use super::inference::CurveInference;
use super::parameter::CurveParameter;
use super::refits::CurveRefits;
use crate::fragility::case::{Case, Event, Measure};
use crate::fragility::cases::{CaseTable, Cases};
use crate::fragility::group::{Progress, Refits, Uncertainty, fit_jointly};
use crate::fragility::held_out::HeldOut;
use crate::fragility::predictor::BENT_TERMS;
use crate::fragility::sample::Sample;
use crate::keyword::{self, Keyword};
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::{BootstrapLimits, Resamples, Sizes, TOGETHER, bootstrap_limits};
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
const REJECTED: f64 = 0.01;
/// How many there are.
const TESTS: usize = 3;
/// A difference in probability that matters to nobody.
const SMALL_GAP: f64 = 0.05;

/// Whether a test of this probability rejects a curve.
pub(crate) fn rejects(p: f64) -> bool {
    p < REJECTED / TESTS as f64
}

impl Curve {
    /// Fits the curve of a sample of these measures, and tests it; what cases left out and resamples say is not asked.
    pub fn new(
        sample: &Sample,
        event: Event,
        im_x: Measure,
        im_y: Option<Measure>,
        model: CurveModel,
    ) -> Curve {
        let fit = fit_overturning(sample, &model);
        let needed = |bent: fn(&Sample, &CurveModel) -> Result<BinaryFit, FitStatus>| {
            let straight = &fit.as_ref().ok().filter(|_| model.estimator == Estimator::Ml)?.regression;
            Some(likelihood_ratio(straight, &bent(sample, &model).ok()?))
        };
        let (spline, interaction) = (needed(fit_with_spline), needed(fit_with_interaction));
        Curve {
            event,
            im_x,
            im_y,
            n: sample.cases(),
            events: sample.events(),
            data_ranges: sample.ranges(),
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
        let tests: [Option<Test>; TESTS] = [
            self.fit.as_ref().ok().and_then(|fit| fit.goodness.hosmer_lemeshow),
            self.spline,
            self.interaction,
        ];
        tests.into_iter().flatten().any(|test| rejects(test.p))
    }

    /// The curve that bends, if it is to answer: the straight one fits badly, and this one does better on cases left out.
    pub fn bent_answer(&self) -> Option<&BentFit> {
        let bent = self.bent.as_ref().filter(|_| self.status() == FitStatus::Misfit)?;
        let log_score = |held_out: Option<HeldOut>| held_out.map(|held_out| held_out.log_score);
        let is_better =
            log_score(bent.held_out).zip(log_score(self.held_out)).is_none_or(|(bent, own)| bent > own);
        is_better.then_some(bent)
    }

    /// The cases that it is about.
    fn sample(&self, cases: &[Case]) -> Sample {
        event_sample(self.event, self.im_x, self.im_y, cases)
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

/// The cases of a curve: those that count for its event.
fn event_sample<C: Cases + ?Sized>(event: Event, im_x: Measure, im_y: Option<Measure>, cases: &C) -> Sample {
    let measures: Vec<Measure> = std::iter::once(im_x).chain(im_y).collect();
    Sample::of_events(cases, &measures, |case| event.happened(case, f64::INFINITY))
}

/// A curve with the cases that it was fitted to.
type SampledCurve = (Curve, Sample);

/// The coefficients of a curve in a resample, straight and bent.
type Replicate = [Option<DVector<f64>>; 2];

/// The curves of a group, to be made anew in resamples of its cases.
struct GroupRefits<'a> {
    curves: &'a [SampledCurve],
    /// Of each the straight one, and the bent one if that answers.
    refits: Vec<[Option<CurveRefits<'a>>; 2]>,
}

impl<'a> GroupRefits<'a> {
    fn new(curves: &'a Vec<SampledCurve>) -> GroupRefits<'a> {
        let refits = |(curve, sample): &'a SampledCurve| {
            let straight = curve.fit.as_ref().ok().map(|fit| CurveRefits::new(sample, &fit.regression));
            let bent = |fit| Some(CurveRefits::of_bent(BentSample::new(sample, &curve.model)?, fit));
            [straight, curve.bent_answer().and_then(bent)]
        };
        GroupRefits { curves, refits: curves.iter().map(refits).collect() }
    }
}

impl Refits for GroupRefits<'_> {
    type Terms = Vec<[Option<CaseTerms>; 2]>;
    type Sums = Vec<[Vec<[f64; TOGETHER]>; 2]>;
    type Refit = Vec<Replicate>;

    fn terms(&self, cases: &[Case]) -> Self::Terms {
        let of_curve = |((curve, _), both): (&SampledCurve, &[Option<CurveRefits>; 2])| {
            let sample = both[0].is_some().then(|| curve.sample(cases));
            both.each_ref().map(|refits| refits.as_ref()?.terms(sample.as_ref()?))
        };
        self.curves.iter().zip(&self.refits).map(of_curve).collect()
    }

    fn none(&self) -> Self::Sums {
        let none = |refits: &Option<CurveRefits>| {
            vec![[0.0; TOGETHER]; refits.as_ref().map_or(0, CurveRefits::count)]
        };
        self.refits.iter().map(|both| both.each_ref().map(none)).collect()
    }

    fn add(&self, terms: &Self::Terms, resamples: &Resamples, sums: &mut Self::Sums) {
        for (sums, terms) in sums.iter_mut().flatten().zip(terms.iter().flatten()) {
            let more = terms.as_ref().map_or(Vec::new(), |terms| terms.sums(resamples));
            let all = sums.iter_mut().flatten().zip(more.iter().flatten());
            all.for_each(|(sum, more)| *sum += more);
        }
    }

    fn refits<'w>(
        &self,
        sums: Self::Sums,
        whole: &(dyn Fn() -> &'w Resamples + 'w),
    ) -> [Self::Refit; TOGETHER] {
        let of_all = |refits: &Option<CurveRefits>, sums| match refits {
            Some(refits) => refits.of_sums(sums, whole),
            None => [const { None }; TOGETHER],
        };
        let of_both = |([straight, bent], [of_straight, of_bent]): (&[_; 2], [_; 2])| {
            [of_all(straight, of_straight), of_all(bent, of_bent)]
        };
        let mut refits: Vec<_> = self.refits.iter().zip(sums).map(of_both).collect();
        std::array::from_fn(|resample| {
            let of_resample = |both: &mut [[Option<DVector<f64>>; TOGETHER]; 2]| {
                both.each_mut().map(|refits| refits[resample].take())
            };
            refits.iter_mut().map(of_resample).collect()
        })
    }
}

impl CurveOptions {
    /// Fits the curves of each group: those of the six scalar measures, then of the hybrid ones.
    ///
    /// # Errors
    /// Those of `progress`.
    pub fn fit<E: Send>(&self, groups: &[&CaseTable], progress: Progress<E>) -> Result<Vec<Vec<Curve>>, E> {
        fit_jointly(groups, &self.uncertainty, |groups, sizes| self.fit_alike(groups, sizes, progress))
    }

    /// Of groups with the same cells.
    fn fit_alike<E: Send>(
        &self,
        groups: &[&CaseTable],
        sizes: &Sizes,
        progress: Progress<E>,
    ) -> Result<Vec<Vec<Curve>>, E> {
        let curves = |group: &&CaseTable| {
            progress(1)?;
            Ok(self.curves(group))
        };
        let mut fitted = groups.par_iter().map(curves).collect::<Result<Vec<_>, E>>()?;
        if self.uncertainty.replicates > 0 {
            self.resample(groups, sizes, progress, &mut fitted)?;
        }
        let infer = |curves: Vec<SampledCurve>| {
            curves.into_par_iter().map(|(curve, sample)| self.infer(sizes, curve, &sample)).collect()
        };
        Ok(fitted.into_par_iter().map(infer).collect())
    }

    fn curves(&self, cases: &CaseTable) -> Vec<SampledCurve> {
        let scalar = Measure::SCALAR.into_iter().map(|measure| (measure, None));
        let measures = scalar.chain(self.pairs.iter().map(|&Pair(x, y)| (x, Some(y))));
        measures
            .collect::<Vec<_>>()
            .into_par_iter()
            .map(|(im_x, im_y)| self.curve(cases, im_x, im_y))
            .collect()
    }

    fn curve(&self, cases: &CaseTable, im_x: Measure, im_y: Option<Measure>) -> SampledCurve {
        let sample = event_sample(self.event, im_x, im_y, cases);
        let mut curve = Curve::new(&sample, self.event, im_x, im_y, self.model);
        if let Ok(fit) = &curve.fit {
            let straight = &fit.regression;
            let inference = CurveInference::new(&sample, straight);
            curve.held_out = inference.held_out();
            let many = sample.has_many_clusters();
            curve.clustered_covariance = many.then(|| inference.covariance_by_cluster());
            let bent = || BentSample::new(&sample, &self.model)?.fit(straight);
            curve.bent = curve.is_rejected().then(bent).flatten();
        }
        (curve, sample)
    }

    /// Adds the coefficients in each resample.
    fn resample<E: Send>(
        &self,
        groups: &[&CaseTable],
        sizes: &Sizes,
        progress: Progress<E>,
        fitted: &mut [Vec<SampledCurve>],
    ) -> Result<(), E> {
        let refits: Vec<GroupRefits> = fitted.iter().map(GroupRefits::new).collect();
        let resampled = self.uncertainty.bootstrap(groups, sizes, &refits, progress)?;
        for (curves, replicates) in fitted.iter_mut().zip(resampled) {
            for fits in replicates {
                for ((curve, _), [straight, bent]) in curves.iter_mut().zip(fits) {
                    curve.replicates.push(straight);
                    curve.bent_replicates.push(bent.as_ref().map(placed));
                }
            }
        }
        Ok(())
    }

    /// Adds clustered errors, profile-likelihood limits, and limits from the replicates if there are any.
    fn infer(&self, sizes: &Sizes, mut curve: Curve, sample: &Sample) -> Curve {
        let Ok(fit) = &curve.fit else { return curve };
        let (inference, confidence) =
            (CurveInference::new(sample, &fit.regression), self.uncertainty.confidence);
        let clustered = inference.covariance_by_cluster();
        let of = |parameter: &CurveParameter| {
            let of_replicates = || {
                let replicates = inference.parameters(*parameter, &curve.replicates);
                let acceleration = inference.acceleration_by_cell(*parameter, sizes);
                bootstrap_limits(inference.fitted(*parameter), &replicates, acceleration, confidence)
            };
            ParameterInference {
                parameter: *parameter,
                clustered_error: inference.standard_error(*parameter, &clustered),
                profile: inference.profile_limits(*parameter, confidence),
                bootstrap: if curve.replicates.is_empty() { None } else { of_replicates() },
            }
        };
        curve.inference = inference.curve_parameters().iter().map(of).collect();
        curve
    }
}
