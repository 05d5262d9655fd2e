//! P_ex: the demand in safe rocking as a power law of intensity, and the probability that it exceeds a limit
//! state (section 2.3.2, Eqs. 14 to 18). From top to bottom: the probability, the law of one measure, the
//! plane of two, the two planes below and above the transition, the search for the transition.

use std::ops::Range;

use nalgebra::{Matrix4, Vector4};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::cases::{Cases, Event, Group, MeasureRanges, Sample};
use super::measure_names::{Measure, Predictors, design_row, values};
use super::parameter::{Parameter, ParameterRow, quantile};
use crate::motion::IntensityMeasures;
use crate::paper::TRANSITION;
use crate::rocking::Structure;
use crate::spelling::unknown_word;
use crate::statistics::scores::largest_difference;
use crate::statistics::{FitStatus, Interval, LinearFit, clustered_least_squares, held_out};
use crate::statistics::{delta_variance, independent_errors, least_squares, normal};

/// P_ex from the logarithm of the median demand Dm and the dispersion beta: Phi((ln Dm - ln c) / beta)
/// (Eq. 14, which prints the argument with the other sign, by which P_ex would fall with demand).
pub fn p_exceeding(ln_median: f64, limit_state: f64, beta: f64) -> f64 {
    normal::cdf((ln_median - limit_state.ln()) / beta)
}

/// ln Dm = ln a + b1 ln IMx + b2 ln IMy (Eqs. 17 and 18), or ln a + b ln IM (Eqs. 15 and 16).
pub fn ln_median_demand(coefficients: &[f64], ims: &[f64]) -> f64 {
    coefficients[0] + coefficients[1..].iter().zip(ims).map(|(b, im)| b * im.ln()).sum::<f64>()
}

pub const PLANE: [Measure; 2] = [Measure::Im4, Measure::Im3];
const EVERYWHERE: Range<f64> = 0.0..f64::INFINITY;

/// Fits Dm = a IM^b over all cases (Eqs. 15 and 16) or, of two measures, Dm = a IMx^b1 IMy^b2 (Eqs. 17 and
/// 18).
pub fn fit_law(cases: &Cases, predictors: Predictors) -> DemandFit {
    let model = if predictors.im_y.is_some() { DemandModel::Plane } else { DemandModel::Univariate };
    let measures: Vec<Measure> = predictors.measures().cloned().collect();
    DemandFit::new(cases, model, &measures, EVERYWHERE)
}

/// Fits two planes, one below and one from the transition on, an IM4 = PGA/(g tan alpha) (Table II).
pub fn fit_planes(cases: &Cases, transition: f64) -> [DemandFit; 2] {
    let mut planes = [0.0..transition, transition..f64::INFINITY]
        .map(|range| DemandFit::new(cases, DemandModel::Biplanar, &PLANE, range));
    if let [Some((low_rss, low_tss)), Some((high_rss, high_tss))] = planes.each_ref().map(DemandFit::squares)
    {
        let rss = low_rss + high_rss;
        for fit in &mut planes {
            fit.r2_pooled = Some(1.0 - rss / (low_tss + high_tss));
        }
    }
    let score: Option<f64> = planes.iter().map(|fit| Some(fit.held_out_log_score? * fit.n as f64)).sum();
    let n: i64 = planes.iter().map(|fit| fit.n).sum();
    planes.iter_mut().for_each(|fit| fit.held_out_log_score = score.map(|score| score / n as f64));
    planes
}

/// ln EDP and ln IM of the cases that rocked safely and whose IM4 lies in `range`.
fn demands(cases: &Cases, measures: &[Measure], range: &Range<f64>) -> Sample<f64> {
    cases.sample(measures, |case| case.ln_demand().filter(|_| range.contains(&case.measures.im4)))
}

/// The IM4 at which the planes may meet: first, step and number of places.
const PLACES: (f64, f64, usize) = (1.05, 0.01, 96);
/// A plane needs this many cases on its side.
const LEAST_CASES: usize = 20;

/// The pooled residual of two planes that meet at an IM4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TransitionPoint {
    pub im4: f64,
    pub pooled_rss: f64,
}

/// Tries all places where two planes may meet with enough cases on each side.
pub fn scan_transition(cases: &Cases) -> Vec<TransitionPoint> {
    let Sample { ln_im, y, .. } = demands(cases, &PLANE, &EVERYWHERE);
    let [x_mean, y_mean, edp_mean] =
        [&ln_im[0], &ln_im[1], &y].map(|values| values.iter().sum::<f64>() / values.len() as f64);
    let centred = |k: usize| Vector4::new(1.0, ln_im[0][k] - x_mean, ln_im[1][k] - y_mean, y[k] - edp_mean);
    let mut rows: Vec<Vector4<f64>> = (0..y.len()).map(centred).collect();
    rows.sort_by(|a, b| a[1].total_cmp(&b[1]));
    let (all, mut low, mut n_low) = (moments(&rows), Matrix4::zeros(), 0);
    let (first, step, places) = PLACES;
    let mut points = Vec::new();
    for place in 0..places {
        let im4 = first + step * place as f64;
        let below = rows.partition_point(|row| row[1] < im4.ln() - x_mean);
        low += moments(&rows[n_low..below]);
        n_low = below;
        if n_low.min(rows.len() - n_low) >= LEAST_CASES {
            let both = residual(low).zip(residual(all - low));
            points.extend(both.map(|(low, high)| TransitionPoint { im4, pooled_rss: low + high }));
        }
    }
    points
}

/// Sums the squares and products of 1, ln IM4, ln IM3 and ln EDP about their means.
fn moments(rows: &[Vector4<f64>]) -> Matrix4<f64> {
    rows.iter().map(|row| row * row.transpose()).sum()
}

/// The residual sum of squares of the last of four variables on the others, an element of the inverse of
/// their moments; none where these are singular.
fn residual(moments: Matrix4<f64>) -> Option<f64> {
    Some(1.0 / moments.try_inverse()?[(3, 3)])
}

/// The place of the least pooled residual in a scan.
pub fn transition(scan: &[TransitionPoint]) -> Option<f64> {
    Some(scan.iter().min_by(|a, b| a.pooled_rss.total_cmp(&b.pooled_rss))?.im4)
}

/// Fits two planes that meet at this IM4 (`None`: where their pooled residual is least or, with too few
/// cases, where the paper's meet); if `all`, each measure alone and one plane over all cases; then what is
/// `asked` for over all cases. P_ex at `limit_states` is compared with the share of cases that exceed them.
pub fn fit_demand(
    cases: &Cases,
    im4: Option<f64>,
    limit_states: &[f64],
    asked: &[Predictors],
    all: bool,
) -> Vec<DemandFit> {
    let transition_found = transition(&scan_transition(cases));
    let mut fits = fit_planes(cases, im4.or(transition_found).unwrap_or(TRANSITION)).to_vec();
    fits.iter_mut().for_each(|fit| fit.transition_found = transition_found);
    let usual = Measure::SCALAR.map(Predictors::one).into_iter().chain([Predictors::two(PLANE)]);
    let predictors = Predictors::without_repeats(usual.filter(|_| all).collect(), asked);
    fits.par_extend(predictors.into_par_iter().map(|predictors| fit_law(cases, predictors)));
    fits.iter_mut().for_each(|fit| fit.compare(cases, limit_states));
    fits
}

/// A regression of demand on one measure, on two, or on two on one side of the transition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<DemandModel>)]
pub enum DemandModel {
    Univariate,
    Plane,
    Biplanar,
}

/// A regression of ln EDP in safe rocking: a row of pex.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DemandFit {
    pub suite: Option<String>,
    pub structure: Structure,
    pub model: DemandModel,
    pub im_x: Measure,
    pub im_y: Option<Measure>,
    /// IM4 from which and below which the fit holds; `None` without such a bound.
    pub range_low: Option<f64>,
    pub range_high: Option<f64>,
    /// ln a, b1 and, on two measures, b2; empty without a fit.
    pub coefficients: Vec<f64>,
    /// Covariance of the coefficients, row by row.
    pub covariance: Vec<f64>,
    /// Whether the covariance allows for dependence within clusters; else there are too few of them.
    pub is_clustered: bool,
    pub n_clusters: i64,
    /// Degrees of freedom of limits: clusters - 1, or n - k.
    pub degrees: Option<f64>,
    /// Dispersion: the residual standard deviation of ln EDP.
    pub beta: Option<f64>,
    pub r2: Option<f64>,
    /// R2 of both planes, each about the mean on its own side, as in the paper.
    pub r2_pooled: Option<f64>,
    /// Mean log-likelihood of the cases of a cluster by a fit to the others; of two planes, over both.
    pub held_out_log_score: Option<f64>,
    /// Slope of ln EDP on its mean by a fit to the others: 1 is best, below it the regression is too steep.
    pub calibration_slope: Option<f64>,
    /// IM4 of the least pooled residual of two planes.
    pub transition_found: Option<f64>,
    pub n: i64,
    pub ranges: MeasureRanges,
    /// Largest difference of P_ex at the limit states from the share of events in bins, beyond chance.
    pub largest_difference: Option<f64>,
    pub status: FitStatus,
}

impl DemandFit {
    pub fn group(&self) -> Group<'_> {
        Group::of(&self.suite, &self.structure.name)
    }

    pub fn predictors(&self) -> Predictors {
        Predictors { im_x: self.im_x.clone(), im_y: self.im_y.clone() }
    }

    /// `range` is that of IM4.
    fn new(cases: &Cases, model: DemandModel, measures: &[Measure], range: Range<f64>) -> DemandFit {
        let sample = demands(cases, measures, &range);
        let linear = clustered_least_squares(&sample.x(), &sample.y, &sample.clusters);
        let fitted = linear.as_ref().ok();
        let without = |x: &[Vec<f64>], ln_edp: &[f64]| {
            least_squares(x, ln_edp).ok().map(|law| (law.fit.clone(), law.residual_sd()))
        };
        let held_out = fitted.and_then(|_| held_out(&sample.x(), &sample.y, &sample.clusters, without));
        let limiting = fitted.map(|linear| linear.fit.limiting_covariance());
        DemandFit {
            suite: cases.suite.clone(),
            structure: cases.structure.clone(),
            model,
            im_x: measures[0].clone(),
            im_y: measures.get(1).cloned(),
            range_low: Some(range.start).filter(|start| *start > 0.0),
            range_high: Some(range.end).filter(|end| end.is_finite()),
            coefficients: fitted.map_or(Vec::new(), |linear| linear.fit.coefficients.as_slice().to_vec()),
            covariance: limiting.map_or(Vec::new(), |(covariance, _)| covariance.as_slice().to_vec()),
            is_clustered: fitted.is_some_and(|linear| linear.fit.clustered.is_some()),
            n_clusters: fitted.map_or(0, |linear| linear.fit.clusters as i64),
            degrees: limiting.map(|(_, degrees)| degrees),
            beta: fitted.map(LinearFit::residual_sd),
            r2: fitted.map(LinearFit::r2),
            r2_pooled: None,
            held_out_log_score: held_out.as_ref().map(|cases| {
                let score = |(&(mean, sd), ln_edp): (&(f64, f64), &f64)| {
                    normal::ln_density((ln_edp - mean) / sd) - sd.ln()
                };
                cases.iter().zip(&sample.y).map(score).sum::<f64>() / cases.len() as f64
            }),
            calibration_slope: held_out.and_then(|cases| {
                let means: Vec<f64> = cases.iter().map(|(mean, _)| *mean).collect();
                Some(least_squares(&[means], &sample.y).ok()?.fit.coefficients[1])
            }),
            transition_found: None,
            n: sample.y.len() as i64,
            ranges: sample.ranges(),
            largest_difference: None,
            status: match &linear {
                Ok(linear) if linear.fit.coefficients[1] <= 0.0 => measures[0].falling(measures.get(1)),
                Ok(_) => FitStatus::Ok,
                Err(status) => *status,
            },
        }
    }

    /// Compares P_ex at limit states with the share of the cases that exceed them.
    fn compare(&mut self, cases: &Cases, limit_states: &[f64]) {
        let Some(beta) = self.beta else { return };
        let differences = limit_states.iter().filter_map(|&limit_state| {
            let pairs = cases.all.iter().filter(|case| self.holds_at(case.measures.im4)).filter_map(|case| {
                let ims = values(&self.im_x, self.im_y.as_ref(), &case.measures)?;
                let p = p_exceeding(ln_median_demand(&self.coefficients, &ims), limit_state, beta);
                Some((p, Event::Exceeding.happened(case.outcome, limit_state)?))
            });
            let (probabilities, events): (Vec<f64>, Vec<bool>) = pairs.unzip();
            largest_difference(&probabilities, &events)
        });
        self.largest_difference = differences.reduce(f64::max);
        if self.status == FitStatus::Ok {
            self.status = FitStatus::by_difference(self.largest_difference);
        }
    }

    /// The residual sum of squares, and that about the mean.
    fn squares(&self) -> Option<(f64, f64)> {
        let rss = self.beta?.powi(2) * self.residual_degrees();
        Some((rss, rss / (1.0 - self.r2?)))
    }

    pub fn holds_at(&self, im4: f64) -> bool {
        self.range_low.is_none_or(|low| im4 >= low) && self.range_high.is_none_or(|high| im4 < high)
    }

    /// P_ex (Eq. 14) with limits by the delta method on the scale of ln Dm, to which the error of beta is
    /// converted. None without a fit, or where a measure is missing.
    pub fn p_exceeding(
        &self,
        measures: &IntensityMeasures,
        limit_state: f64,
        confidence: f64,
    ) -> Option<Interval> {
        let beta = self.beta?;
        let ims = values(&self.im_x, self.im_y.as_ref(), measures)?;
        let ln_median = ln_median_demand(&self.coefficients, &ims);
        let by_median = delta_variance(&self.covariance, &design_row(&ims));
        let by_beta = (ln_median - limit_state.ln()).powi(2) / (2.0 * self.residual_degrees());
        let half_width = quantile(confidence, self.degrees) * (by_median + by_beta).sqrt();
        Some(Interval::shifted(half_width, |shift| p_exceeding(ln_median + shift, limit_state, beta)))
    }

    /// The fit with each independent error of its coefficients, and of beta, at the limits of confidence.
    pub(super) fn at_quantiles(&self, confidence: f64) -> Vec<[DemandFit; 2]> {
        let away = quantile(confidence, self.degrees);
        let errors = independent_errors(&self.coefficients, &self.covariance, away).into_iter();
        let errors = errors
            .map(|at_quantiles| at_quantiles.map(|coefficients| DemandFit { coefficients, ..self.clone() }));
        let off = away / (2.0 * self.residual_degrees()).sqrt();
        let by_beta =
            [-off, off].map(|off| DemandFit { beta: self.beta.map(|beta| beta * off.exp()), ..self.clone() });
        errors.chain([by_beta]).collect()
    }

    /// Degrees of freedom of beta, whose large-sample variance is beta^2 / (2 degrees).
    fn residual_degrees(&self) -> f64 {
        (self.n - self.coefficients.len() as i64) as f64
    }

    /// ln a, b1, b2, beta and zeta = beta / |b1|; none without a fit.
    pub fn parameters(&self, confidence: f64) -> Vec<ParameterRow> {
        let Some(beta) = self.beta else { return Vec::new() };
        let b = &self.coefficients;
        let errors: Vec<f64> = (0..b.len()).map(|k| self.covariance[k * (b.len() + 1)].sqrt()).collect();
        let error_of_beta = beta / (2.0 * self.residual_degrees()).sqrt();
        let error_of_zeta = (error_of_beta / b[1]).hypot(beta * errors[1] / (b[1] * b[1]));
        let names = [Parameter::LnA, Parameter::B1, Parameter::B2];
        let coefficients = names.into_iter().zip(b.iter().copied().zip(errors));
        let dispersions =
            [(Parameter::Beta, (beta, error_of_beta)), (Parameter::Zeta, (beta / b[1].abs(), error_of_zeta))];
        let quantile = quantile(confidence, self.degrees);
        let rows = coefficients.chain(dispersions).map(|(parameter, (value, standard_error))| ParameterRow {
            suite: self.suite.clone(),
            structure: self.structure.name.clone(),
            model: self.model.to_string(),
            im_x: self.im_x.clone(),
            im_y: self.im_y.clone(),
            range_low: self.range_low,
            parameter,
            value,
            standard_error,
            low: parameter.around(value, quantile * standard_error).low,
            high: parameter.around(value, quantile * standard_error).high,
            confidence,
            status: self.status,
        });
        rows.collect()
    }
}
