//! How PGA and PGV of motions go together: what one of them says of the other.

use super::slice::Peak;
use crate::statistics::design::{quantile_knots, restricted_splines};
use crate::statistics::least_squares;

/// What each peak says of the ratio PGV / PGA. Two lines would do for a joint lognormal distribution; but the strongest PGA are of
/// small, near earthquakes, with less PGV than these would have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPeaks {
    pub given_pga: RatioGiven,
    pub given_pgv: RatioGiven,
}

/// ln(PGV / PGA) given the logarithm of a peak: a natural cubic spline of it, and normal about that.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatioGiven {
    knots: [f64; 3],
    /// Of 1, the logarithm and its spline.
    coefficients: [f64; 3],
    sd: f64,
}

/// Shares of the motions below each knot: outer ones, since the tails are what matters.
const KNOTS: [f64; 3] = [0.05, 0.5, 0.95];
/// With fewer motions the spline is left out.
const LEAST_FOR_SPLINE: usize = 30;

impl RatioGiven {
    fn of(ln_peak: &[f64], ln_ratio: &[f64]) -> Option<RatioGiven> {
        let knots = quantile_knots(ln_peak, KNOTS).filter(|_| ln_peak.len() >= LEAST_FOR_SPLINE);
        let spline = |knots: [f64; 3]| -> Vec<f64> {
            ln_peak.iter().map(|&u| restricted_splines(u, &knots).sum()).collect()
        };
        let bent =
            knots.and_then(|knots| Some((knots, least_squares(&[ln_peak, &spline(knots)], ln_ratio).ok()?)));
        let (knots, fit) = match bent {
            Some(bent) => bent,
            None => ([0.0, 1.0, 2.0], least_squares(&[ln_peak], ln_ratio).ok()?),
        };
        let b = |k: usize| fit.coefficients.get(k).map_or(0.0, |b| b.value);
        Some(RatioGiven { knots, coefficients: [0, 1, 2].map(b), sd: fit.residual_sd })
    }

    /// Its knots, coefficients and standard deviation.
    pub fn to_numbers(self) -> [f64; 7] {
        let ([k0, k1, k2], [b0, b1, b2]) = (self.knots, self.coefficients);
        [k0, k1, k2, b0, b1, b2, self.sd]
    }

    /// Of these knots, coefficients and standard deviation.
    pub fn of_numbers([k0, k1, k2, b0, b1, b2, sd]: [f64; 7]) -> RatioGiven {
        RatioGiven { knots: [k0, k1, k2], coefficients: [b0, b1, b2], sd }
    }

    fn ratio(&self, intensity: f64, deviations: f64) -> f64 {
        let (u, [b0, b1, b2]) = (intensity.ln(), self.coefficients);
        let bend: f64 = restricted_splines(u, &self.knots).sum();
        (b0 + b1 * u + b2 * bend + deviations * self.sd).exp()
    }
}

impl JointPeaks {
    /// That of these motions (m/s2 and m/s); none with fewer than three, or if a peak is not above 0 or the same in all.
    pub fn of(pga_m_s2: &[f64], pgv_m_s: &[f64]) -> Option<JointPeaks> {
        let ln = |values: &[f64]| values.iter().map(|value| value.ln()).collect::<Vec<f64>>();
        let (ln_pga, ln_pgv) = (ln(pga_m_s2), ln(pgv_m_s));
        if pga_m_s2.len() < 3 || ln_pga.iter().chain(&ln_pgv).any(|value| !value.is_finite()) {
            return None;
        }
        let ln_ratio: Vec<f64> = ln_pga.iter().zip(&ln_pgv).map(|(pga, pgv)| pgv - pga).collect();
        Some(JointPeaks {
            given_pga: RatioGiven::of(&ln_pga, &ln_ratio)?,
            given_pgv: RatioGiven::of(&ln_pgv, &ln_ratio)?,
        })
    }

    /// PGV / PGA (s) of motions with this intensity (m/s2 or m/s of the given peak), so many standard deviations above its median.
    pub fn pgv_over_pga(&self, given: Peak, intensity: f64, deviations: f64) -> f64 {
        match given {
            Peak::Pga => self.given_pga.ratio(intensity, deviations),
            Peak::Pgv => self.given_pgv.ratio(intensity, deviations),
        }
    }
}
