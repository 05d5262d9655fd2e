//! The universal surface, calibrated by three numbers: logit P = c + s L + m (M - 6.9) + g, with the logit L
//! of the surface, the magnitude M and a term g by which P is 0 at uplift. c, s and m are estimated from the
//! responses of a structure to a suite of motions; without responses they are those of the kind of motion.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::cases::{Case, Cases, Event, Group};
use super::joint_peaks::{JointPeaks, RatioGiven};
use super::measure_names::Measure;
use super::model_point::{ModelPoint, Tau};
use super::surface::{self, Im4Terms, MotionKind, Prior, StructureSurface, SurfaceAtIm4};
use crate::motion::{IntensityMeasures, Peaks};
use crate::rocking::Structure;
use crate::statistics::clusters::{MIN_CLUSTERS, sandwich};
use crate::statistics::newton::{Objective, maximise};
use crate::statistics::normal::Z_95;
use crate::statistics::{Bounds, FEW_EVENTS, Interval, delta_variance, independent_errors};
use crate::warning::Warning;

/// The universal surface, calibrated for one structure and suite.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    pub suite: Option<String>,
    pub kind: MotionKind,
    pub structure: Structure,
    /// Demand |theta|max / alpha of P_ex; `None` for P_ro.
    pub limit_state: Option<f64>,
    pub c: f64,
    pub ln_s: f64,
    pub m: f64,
    /// Covariance of c, ln s and m, row by row.
    pub covariance: Vec<f64>,
    /// Standard deviation of the logit between cells or earthquakes.
    pub tau: f64,
    pub n: i64,
    pub n_events: i64,
    /// Number of events that the uncalibrated surface predicts.
    pub expected: f64,
    pub n_clusters: i64,
    /// Least and largest PGA (m/s2), PGV (m/s) and PGV/PGA (s) of the fitted motions.
    pub pga: Bounds,
    pub pgv: Bounds,
    pub ratio: Bounds,
    /// ln(PGV/PGA) of all motions given ln PGA and ln PGV: the fields of RatioGiven.
    pub ratio_given_pga: Vec<f64>,
    pub ratio_given_pgv: Vec<f64>,
}

/// The terms of the logit for one case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogitTerms {
    /// L, the logit of the surface.
    pub logit: f64,
    /// M - 6.9, M within the magnitudes of the kind of motion; an unknown M is inferred from PGV / PGA.
    pub magnitude: f64,
    /// Standard deviation of M where it is not known, else 0.
    pub magnitude_sd: f64,
    /// g = -(d / ((IM4 - 1) IM5^k))^n, minus infinity at uplift; on a floor with its shift.
    pub uplift_term: f64,
}

/// An object that stood or fell in an earthquake.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedOutcome {
    pub structure: Structure,
    pub peaks: Peaks,
    pub mw: Option<f64>,
    /// Number of the earthquake: its outcomes depend on each other.
    pub earthquake: u32,
    pub fell: bool,
}

/// The suite of calibrations to observed outcomes.
const OUTCOMES: &str = "outcomes";
/// From so many clusters on their scores tell the errors; else the usual spread between clusters does.
const MANY_CLUSTERS: usize = 30;
/// A peak within this factor of the fitted ones is covered.
const LIKE: f64 = 1.2;

impl Calibration {
    pub fn group(&self) -> Group<'_> {
        Group::of(&self.suite, &self.structure.name)
    }

    /// The prior of a kind of motion, for a structure without responses; `limit_state` is `None` for P_ro.
    pub fn uncalibrated(kind: MotionKind, structure: &Structure, limit_state: Option<f64>) -> Calibration {
        let Prior { mean: [c, ln_s, m], sd, tau, .. } = surface::prior(kind, limit_state);
        let variances = DVector::from_vec(sd.map(|sd| sd * sd).to_vec());
        let peaks = surface::peaks(kind);
        Calibration {
            kind,
            structure: structure.clone(),
            limit_state,
            c,
            ln_s,
            m,
            covariance: DMatrix::from_diagonal(&variances).as_slice().to_vec(),
            tau,
            ratio_given_pga: peaks.given_pga.to_numbers(),
            ratio_given_pgv: peaks.given_pgv.to_numbers(),
            ..Calibration::default()
        }
    }

    /// Fits c, ln s and m to responses: the maximum of their posterior density, with the priors of the kind
    /// of motion.
    pub fn fit(cases: &Cases, limit_state: Option<f64>) -> Calibration {
        let kind = MotionKind::from_suite(cases.suite.as_deref());
        let uncalibrated = Calibration::uncalibrated(kind, &cases.structure, limit_state);
        let peaks = JointPeaks::fit(cases.all.iter().map(|case| case.peaks)).unwrap_or(surface::peaks(kind));
        Calibration {
            suite: cases.suite.clone(),
            ratio_given_pga: peaks.given_pga.to_numbers(),
            ratio_given_pgv: peaks.given_pgv.to_numbers(),
            ..uncalibrated.fitted(&observed(cases, &uncalibrated))
        }
    }

    /// Fits c, ln s and m of P_ro to observed outcomes. Objects that the motion does not uplift do not count;
    /// p, alpha and eta are those of the first object.
    pub fn fit_outcomes(outcomes: &[ObservedOutcome]) -> Option<Calibration> {
        let uncalibrated =
            Calibration::uncalibrated(MotionKind::Recorded, &outcomes.first()?.structure, None);
        let observed = outcomes.iter().filter_map(|outcome| {
            let ObservedOutcome { structure, peaks, mw, earthquake: cluster, fell } = outcome.clone();
            let measures = IntensityMeasures::new(&structure, peaks, None, None);
            let (terms, expected) = uncalibrated.prediction(&structure, &measures, mw)?;
            Some(Observation { terms, happened: fell, expected, peaks, cluster })
        });
        let observed: Vec<Observation> = observed.collect();
        let mut fitted = uncalibrated.fitted(&observed);
        fitted.structure.name = OUTCOMES.to_string();
        Some(Calibration { suite: Some(OUTCOMES.to_string()), ..fitted })
    }

    /// Whether it was fitted to observed outcomes, and so applies to other objects too.
    pub fn is_of_outcomes(&self) -> bool {
        self.suite.as_deref() == Some(OUTCOMES)
    }

    fn fitted(&self, cases: &[Observation]) -> Calibration {
        let (at, covariance, n_clusters) = maximum(cases, &surface::prior(self.kind, self.limit_state));
        let peaks = cases.iter().map(|case| case.peaks);
        Calibration {
            c: at[0],
            ln_s: at[1],
            m: at[2],
            covariance: covariance.as_slice().to_vec(),
            n: cases.len() as i64,
            n_events: cases.iter().filter(|case| case.happened).count() as i64,
            expected: cases.iter().map(|case| case.expected).sum(),
            n_clusters: n_clusters as i64,
            pga: peaks.clone().map(|peaks| peaks.pga_m_s2).collect(),
            pgv: peaks.clone().map(|peaks| peaks.pgv_m_s).collect(),
            ratio: peaks.map(|peaks| peaks.pgv_m_s / peaks.pga_m_s2).collect(),
            ..self.clone()
        }
    }

    /// The terms of the logit of a motion, of magnitude `mw` if known; none where a measure is missing.
    pub fn terms(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
        mw: Option<f64>,
    ) -> Option<LogitTerms> {
        self.branch(structure, mw).terms_of(structure, measures)
    }

    /// The terms with its probability; none at uplift, or where a measure is missing.
    fn prediction(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
        mw: Option<f64>,
    ) -> Option<(LogitTerms, f64)> {
        let branch = self.branch(structure, mw);
        let terms = branch.terms_of(structure, measures)?;
        let p = branch.probability(&terms, ModelPoint::Estimate);
        (terms.logit.is_finite() && terms.uplift_term.is_finite()).then_some((terms, p))
    }

    pub(super) fn branch(&self, structure: &Structure, mw: Option<f64>) -> Branch<'_> {
        let surface = StructureSurface::new(self.kind, structure, self.limit_state, mw);
        let parameters = Parameters::new([self.c, self.ln_s, self.m]);
        let errors = self.errors().into_iter().map(|errors| errors.map(Parameters::new)).collect();
        Branch { calibration: self, surface, parameters, errors }
    }

    /// The probability given rocking, with limits; none where a measure is missing.
    pub fn probability(
        &self,
        structure: &Structure,
        measures: &IntensityMeasures,
        mw: Option<f64>,
        tau: Tau,
    ) -> Option<Interval> {
        let branch = self.branch(structure, mw);
        let terms = branch.terms_of(structure, measures)?;
        let [value, low, high] = ModelPoint::at_limits(tau).map(|point| branch.probability(&terms, point));
        Some(Interval { value, low, high })
    }

    /// c, ln s and m with each of their independent errors at its 2.5 and 97.5 % quantiles.
    pub fn errors(&self) -> Vec<[[f64; 3]; 2]> {
        let errors = independent_errors(&[self.c, self.ln_s, self.m], &self.covariance, Z_95);
        errors.into_iter().map(|at_quantiles| at_quantiles.map(|b| [b[0], b[1], b[2]])).collect()
    }

    pub fn peaks(&self) -> JointPeaks {
        let usual = surface::peaks(self.kind);
        JointPeaks {
            given_pga: RatioGiven::from_numbers(&self.ratio_given_pga).unwrap_or(usual.given_pga),
            given_pgv: RatioGiven::from_numbers(&self.ratio_given_pgv).unwrap_or(usual.given_pgv),
        }
    }

    /// Warnings about the calibration as a whole; none without responses.
    pub fn warnings(&self) -> Vec<Warning> {
        if self.n == 0 {
            return Vec::new();
        }
        let rarer = self.n_events.min(self.n - self.n_events) as usize;
        let few_events = match (rarer, self.limit_state) {
            (0, None) => Some(Warning::NoEvents),
            (0..FEW_EVENTS, _) => Some(Warning::FewEvents),
            _ => None,
        };
        let few_clusters = (self.n_clusters < MIN_CLUSTERS as i64).then_some(Warning::FewClusters);
        few_events.into_iter().chain(few_clusters).collect()
    }

    /// Whether PGA, PGV and PGV / PGA are like those fitted; always so without responses.
    pub fn covers(&self, structure: &Structure, measures: &IntensityMeasures) -> bool {
        let Peaks { pga_m_s2, pgv_m_s } = measures.peaks(structure);
        let fitted = [(self.pga, pga_m_s2), (self.pgv, pgv_m_s), (self.ratio, pgv_m_s / pga_m_s2)];
        fitted.iter().all(|(bounds, value)| bounds.has(*value, LIKE))
    }
}

/// P_ro or P_ex of a structure under motions of one magnitude.
#[derive(Debug, Clone)]
pub(super) struct Branch<'a> {
    calibration: &'a Calibration,
    pub surface: StructureSurface,
    parameters: Parameters,
    /// At the 2.5 and 97.5 % quantiles of each independent error.
    errors: Vec<[Parameters; 2]>,
}

#[derive(Debug, Clone, Copy)]
struct Parameters {
    c: f64,
    s: f64,
    m: f64,
}

impl Parameters {
    fn new([c, ln_s, m]: [f64; 3]) -> Parameters {
        Parameters { c, s: ln_s.exp(), m }
    }
}

impl Branch<'_> {
    fn terms_of(&self, structure: &Structure, measures: &IntensityMeasures) -> Option<LogitTerms> {
        let im5 = Measure::Im5.value_of(measures)?;
        let ln_pgv_pga = (im5 / (measures.im4 * structure.p_rad_s)).ln();
        let at_im4 = self.surface.at(&Im4Terms::new(measures.im4, measures.im4.ln()));
        Some(self.terms(&at_im4, ln_pgv_pga, self.surface.magnitude(ln_pgv_pga + at_im4.excess)))
    }

    /// For motions with this ln(PGV / PGA), s, and M - 6.9.
    pub fn terms(&self, at_im4: &SurfaceAtIm4, ln_pgv_pga: f64, magnitude: f64) -> LogitTerms {
        LogitTerms {
            logit: at_im4.logit(ln_pgv_pga),
            magnitude,
            magnitude_sd: self.surface.magnitude.sd,
            uplift_term: at_im4.uplift_term(ln_pgv_pga),
        }
    }

    pub fn probability(&self, terms: &LogitTerms, point: ModelPoint) -> f64 {
        logistic(self.logit(terms, point))
    }

    /// The logit c + s L + m (M - 6.9) + g. Its 95 % limits are by the delta method, J V J', without g; those
    /// of one scenario add tau and the spread of an unknown magnitude.
    pub fn logit(&self, terms: &LogitTerms, point: ModelPoint) -> f64 {
        let Parameters { c, s, m } = match point {
            ModelPoint::Error { number, is_high } => self.errors[number][usize::from(is_high)],
            ModelPoint::Magnitude(off) => {
                let Parameters { c, s, m } = self.parameters;
                Parameters { c: c + m * off, s, m }
            }
            _ => self.parameters,
        };
        // P must not fall as PGV rises: where it would, a magnitude inferred from PGV / PGA does not count.
        let is_inferred = terms.magnitude_sd > 0.0;
        let magnitude =
            if is_inferred && m < 0.0 { self.surface.middle_magnitude() } else { terms.magnitude };
        let scaled = s * terms.logit;
        let logit = c + scaled + m * magnitude + terms.uplift_term;
        let (sign, tau) = match point {
            ModelPoint::Low(tau) => (-1.0, tau),
            ModelPoint::High(tau) => (1.0, tau),
            _ => return logit,
        };
        let between = match tau {
            Tau::Included => self.calibration.tau.hypot(m * terms.magnitude_sd),
            Tau::Averaged => 0.0,
        };
        let variance = delta_variance(&self.calibration.covariance, &[1.0, scaled, magnitude]);
        logit + sign * Z_95 * variance.sqrt().hypot(between)
    }
}

fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}

struct Observation {
    terms: LogitTerms,
    happened: bool,
    /// The probability by the uncalibrated surface.
    expected: f64,
    peaks: Peaks,
    /// Cases of one cluster may depend on each other.
    cluster: u32,
}

fn observed(cases: &Cases, uncalibrated: &Calibration) -> Vec<Observation> {
    let (event, limit_state) = match uncalibrated.limit_state {
        Some(limit_state) => (Event::Exceeding, limit_state),
        None => (Event::Overturning, f64::INFINITY),
    };
    let counts = cases.all.iter().filter_map(|&Case { outcome, measures, peaks, mw, cluster }| {
        let happened = event.happened(outcome, limit_state)?;
        let (terms, expected) = uncalibrated.prediction(&cases.structure, &measures, mw)?;
        Some(Observation { terms, happened, expected, peaks, cluster })
    });
    counts.collect()
}

/// What the posterior density is of: c, ln s, m and, of few clusters, a shift of the logit for each.
struct Unknowns<'a> {
    cases: &'a [Observation],
    mean: DVector<f64>,
    /// Inverse variances.
    precision: DVector<f64>,
    /// The clusters that have a shift, rising.
    shifted: Vec<u32>,
}

/// c, ln s and m of greatest posterior density, their covariance V and the number of clusters. Of fewer than
/// [`MANY_CLUSTERS`] each has a shift of standard deviation tau, and V is the part of the inverse B of the
/// information, prior included, without the shifts. Else V = B (M + P) B, M the sum over clusters of the
/// squares of their scores and P the information of the prior, which counts as one more cluster.
fn maximum(cases: &[Observation], prior: &Prior) -> (DVector<f64>, DMatrix<f64>, usize) {
    let clusters: Vec<u32> = cases.iter().map(|case| case.cluster).collect();
    let mut shifted: Vec<u32> = clusters.iter().copied().collect::<BTreeSet<u32>>().into_iter().collect();
    let n_clusters = shifted.len();
    shifted.truncate(if n_clusters < MANY_CLUSTERS { n_clusters } else { 0 });
    let of_shifts = |value: f64| std::iter::repeat_n(value, shifted.len());
    let k = 3 + shifted.len();
    let mean = DVector::from_iterator(k, prior.mean.into_iter().chain(of_shifts(0.0)));
    let sds = prior.sd.into_iter().chain(of_shifts(prior.tau));
    let precision = DVector::from_iterator(k, sds.map(|sd| 1.0 / (sd * sd)));
    let unknowns = Unknowns { cases, mean, precision, shifted };
    let found = maximise(|at| unknowns.log_posterior(at), unknowns.mean.clone());
    let bread = found.objective.information.try_inverse().expect("the prior makes it definite");
    let (c, s, m) = (found.at[0], found.at[1].exp(), found.at[2]);
    if n_clusters < MANY_CLUSTERS {
        return (found.at, bread.view((0, 0), (3, 3)).into_owned(), n_clusters);
    }
    let slopes: Vec<f64> = cases.iter().map(|case| s * case.terms.logit).collect();
    let magnitudes: Vec<f64> = cases.iter().map(|case| case.terms.magnitude).collect();
    let scores = cases.iter().map(|Observation { terms, happened, .. }| {
        let z = c + s * terms.logit + m * terms.magnitude + terms.uplift_term;
        f64::from(*happened) - logistic(z)
    });
    let scores: Vec<f64> = scores.collect();
    let (clustered, _) = sandwich(&[&slopes, &magnitudes], &scores, &bread, &clusters);
    let prior = DMatrix::from_diagonal(&unknowns.precision);
    (found.at, clustered + &bread * prior * &bread, n_clusters)
}

impl Unknowns<'_> {
    /// ln likelihood + ln prior with its derivatives: of z = c + s L + m (M - 6.9) + shift + g the sum of
    /// y z - ln(1 + e^z), whose second derivative by ln s has the slope s L itself. Where the second
    /// derivatives are not those of a maximum, their expectation stands for them.
    fn log_posterior(&self, at: &DVector<f64>) -> Objective {
        let s = at[1].exp();
        let mut sum = Objective::sum(self.cases.len(), at.len(), |case, sum| {
            let Observation { terms, happened, cluster, .. } = &self.cases[case];
            let shift = self.shifted.binary_search(cluster).ok().map(|number| (3 + number, 1.0));
            let by = [(0, 1.0), (1, s * terms.logit), (2, terms.magnitude)].into_iter().chain(shift);
            let z = at[0] + s * terms.logit + at[2] * terms.magnitude + terms.uplift_term;
            let z = shift.map_or(z, |(place, _)| z + at[place]);
            let (p, sign) = (logistic(z), if *happened { 1.0 } else { -1.0 });
            let (score, weight) = (0.5 * (1.0 + sign) - p, p * (1.0 - p));
            sum.value -= softplus(-sign * z);
            for (row, slope) in by.clone() {
                sum.gradient[row] += score * slope;
                by.clone()
                    .for_each(|(column, other)| sum.information[(row, column)] += weight * slope * other);
            }
        });
        let away = at - &self.mean;
        let bend = sum.gradient[1];
        sum.value -= 0.5 * away.component_mul(&self.precision).dot(&away);
        sum.gradient -= away.component_mul(&self.precision);
        sum.information += DMatrix::from_diagonal(&self.precision);
        let mut observed = sum.information.clone();
        observed[(1, 1)] -= bend;
        if observed.clone().cholesky().is_some() {
            sum.information = observed;
        }
        sum
    }
}

/// ln(1 + e^x).
fn softplus(x: f64) -> f64 {
    x.max(0.0) + (-x.abs()).exp().ln_1p()
}
