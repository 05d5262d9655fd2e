//! How PGA and PGV of motions go together: what one of them says of the other.

use std::sync::Arc;

use super::slice::Peak;
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, columns_of, quantile_knots, restricted_splines};
use crate::statistics::regression::regress;

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
    /// Of columns of the logarithms of the peak and of the ratio.
    fn of(columns: &Columns) -> Option<RatioGiven> {
        let design = Design::new(columns, 1);
        let knots = quantile_knots(&design, 0, KNOTS).filter(|_| design.cases() >= LEAST_FOR_SPLINE);
        let bent = knots.and_then(|knots| {
            let spline =
                |x: &[&[f64]]| vec![x[0].iter().map(|&u| restricted_splines(u, &knots).sum()).collect()];
            Some((knots, regress(&design.with(1, &spline)).ok()?))
        });
        let (knots, fit) = match bent {
            Some(bent) => bent,
            None => ([0.0, 1.0, 2.0], regress(&design).ok()?),
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
        let (u, [b0, b1, b2]) = (libm::log(intensity), self.coefficients);
        let bend: f64 = restricted_splines(u, &self.knots).sum();
        libm::exp(b0 + b1 * u + b2 * bend + deviations * self.sd)
    }
}

impl JointPeaks {
    /// That of these motions (m/s2 and m/s); none with fewer than three, or if a peak is not above 0 or the same in all.
    pub fn of(pga_m_s2: &[f64], pgv_m_s: &[f64]) -> Option<JointPeaks> {
        let ln = |values: &[f64]| values.iter().map(|&value| libm::log(value)).collect::<Vec<f64>>();
        JointPeaks::of_logarithms(&columns_of(&[&ln(pga_m_s2)], ln(pgv_m_s)))
    }

    /// The same of columns of the logarithms of both.
    pub fn of_logarithms(peaks: &Columns) -> Option<JointPeaks> {
        let are_finite = |_: usize, peaks: &[&[f64]]| peaks.iter().copied().flatten().all(|u| u.is_finite());
        if peaks.rows() < 3 || !peaks.fold(2, are_finite, |all, part| *all &= part) {
            return None;
        }
        let given = |peak: usize| {
            let mut beside = Columns::new(2, &Arc::default());
            let of_block = |_: usize, peaks: &[&[f64]]| {
                let ratio = peaks[0].iter().zip(peaks[1]).map(|(pga, pgv)| pgv - pga);
                [peaks[peak].to_vec(), ratio.collect()]
            };
            peaks.each(2, of_block, |some| beside.append(&some));
            RatioGiven::of(&beside)
        };
        Some(JointPeaks { given_pga: given(0)?, given_pgv: given(1)? })
    }

    /// PGV / PGA (s) of motions with this intensity (m/s2 or m/s of the given peak), so many standard deviations above its median.
    pub fn pgv_over_pga(&self, given: Peak, intensity: f64, deviations: f64) -> f64 {
        match given {
            Peak::Pga => self.given_pga.ratio(intensity, deviations),
            Peak::Pgv => self.given_pgv.ratio(intensity, deviations),
        }
    }
}
