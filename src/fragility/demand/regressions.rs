//! P_ex: the demand in safe rocking as a power law of intensity (Eqs. 14-18).

use super::transition::{ScanPoint, Transition, find_transition};
use crate::fragility::case::Measure;
use crate::fragility::cases::Cases;
use crate::fragility::sample::Sample;
use crate::statistics::FitStatus;
use crate::statistics::design::{Moments, Rows};
use crate::statistics::regression::LinearFit;

/// The measures of a plane.
pub const PLANE: [Measure; 2] = [Measure::Im4, Measure::Im3];

/// A regression with less R2 explains next to nothing.
pub const USEFUL_R2: f64 = 0.1;

/// ln EDP = ln a + b1 ln IMx + b2 ln IMy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Intercept.
    pub ln_a: f64,
    /// Slope on ln IMx.
    pub b1: f64,
    /// Slope on ln IMy.
    pub b2: f64,
}

impl Plane {
    /// ln of the median demand at these measures (Eqs. 16 and 18).
    pub fn ln_demand(&self, im_x: f64, im_y: f64) -> f64 {
        self.ln_a + self.b1 * libm::log(im_x) + self.b2 * libm::log(im_y)
    }
}

/// ln EDP on ln IM over all safe-rocking cases that have the measure (Eq. 15). Its dispersion beta is the residual
/// standard deviation, zeta = beta / b.
///
/// # Errors
/// With the status that says why there is no fit.
pub fn fit_univariate<C: Cases + ?Sized>(cases: &C, measure: Measure) -> Result<LinearFit, FitStatus> {
    Sample::of_demands(cases, &[measure], 0.0..f64::INFINITY).fit()
}

/// ln EDP on ln IM4 and ln IM3 over the safe-rocking cases whose IM4 lies in `range` (Eq. 17).
///
/// # Errors
/// With the status that says why there is no fit.
pub fn fit_plane<C: Cases + ?Sized>(cases: &C, range: std::ops::Range<f64>) -> Result<LinearFit, FitStatus> {
    plane_sample(cases, range).fit()
}

/// Two planes that meet at an IM4.
#[derive(Debug, Clone, PartialEq)]
pub struct Biplanar {
    /// The IM4 that parts them.
    pub transition: f64,
    /// The IM4 of the least pooled residual, whether or not the planes meet there.
    pub found: Option<f64>,
    /// Below it.
    pub low: Result<LinearFit, FitStatus>,
    /// Above it.
    pub high: Result<LinearFit, FitStatus>,
    /// Coefficient of determination of both together, each about the mean on its own side: the share that the planes
    /// explain beyond the jump between the sides. The pooled R2 of the paper follow this definition.
    pub r2_pooled: Option<f64>,
    /// Coefficient of determination of both together about the mean of all cases.
    pub r2_overall: Option<f64>,
    /// How the residual depends on the transition.
    pub scan: Vec<ScanPoint>,
}

/// Two planes (Eqs. 17 and 18), parted where `transition` says or where their pooled residual is least.
///
/// # Errors
/// If no transition can be found, for want of cases or as one plane would say.
pub fn fit_biplanar<C: Cases + ?Sized>(cases: &C, transition: Option<f64>) -> Result<Biplanar, FitStatus> {
    let sample = plane_sample(cases, 0.0..f64::INFINITY);
    let (found, scan) = match find_transition(&sample) {
        Some(Transition { im4, scan }) => (Some(im4), scan),
        None => (None, Vec::new()),
    };
    // What one plane over all cases cannot do, two cannot for the same reason.
    let why = || sample.fit().err().unwrap_or(FitStatus::TooFewCases);
    let transition = transition.or(found).ok_or_else(why)?;
    let low = fit_plane(cases, 0.0..transition);
    let high = fit_plane(cases, transition..f64::INFINITY);
    let (mut r2_pooled, mut r2_overall) = (None, None);
    if let (Ok(low), Ok(high)) = (&low, &high) {
        let rss = low.rss + high.rss;
        r2_pooled = Some(1.0 - rss / (low.tss + high.tss));
        r2_overall = Some(1.0 - rss / Moments::of(&sample.design()).product(PLANE.len(), PLANE.len()));
    }
    Ok(Biplanar { transition, found, low, high, r2_pooled, r2_overall, scan })
}

/// The safe-rocking cases whose IM4 lies in `range`, with the measures of a plane.
pub fn plane_sample<C: Cases + ?Sized>(cases: &C, range: std::ops::Range<f64>) -> Sample {
    Sample::of_demands(cases, &PLANE, range)
}

/// Root of the mean squared difference of two planes in ln EDP, over the cases of a [`plane_sample`]; none if it is empty.
pub fn rms_difference(a: &Plane, b: &Plane, sample: &Sample) -> Option<f64> {
    let squares = |rows: &Rows| {
        let square = |(x, y): (&f64, &f64)| {
            let difference = (a.ln_a - b.ln_a) + (a.b1 - b.b1) * x + (a.b2 - b.b2) * y;
            difference * difference
        };
        rows.x[1].iter().zip(rows.x[2]).map(square).sum::<f64>()
    };
    let sum = sample.design().fold(0, squares, |sum, part| *sum += part);
    (sample.cases() > 0).then(|| (sum / sample.cases() as f64).sqrt())
}
