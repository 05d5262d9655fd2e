//! How PGA and PGV of motions go together: what one of them says of the other.

use crate::keyword::keywords;
use crate::statistics::least_squares;

/// A peak of the ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peak {
    /// Peak ground acceleration, m/s2.
    Pga,
    /// Peak ground velocity, m/s.
    Pgv,
}

keywords!(Peak { Pga = "pga", Pgv = "pgv" });

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
    /// Fits the logarithms of the ratio on those of the peak.
    fn fit(ln_peak: &[f64], ln_ratio: &[f64]) -> Option<RatioGiven> {
        let mut sorted = ln_peak.to_vec();
        sorted.sort_by(f64::total_cmp);
        let knots = KNOTS.map(|share| sorted[(share * (sorted.len() - 1) as f64).round() as usize]);
        let are_apart = knots.windows(2).all(|pair| pair[1] - pair[0] > 1e-6);
        let bend: Vec<f64> = ln_peak.iter().map(|&u| restricted_splines(u, &knots).sum()).collect();
        let bent = (are_apart && sorted.len() >= LEAST_FOR_SPLINE)
            .then(|| Some((knots, least_squares(&[ln_peak, &bend], ln_ratio).ok()?)))
            .flatten();
        let (knots, fit) = match bent {
            Some(bent) => bent,
            None => ([0.0, 1.0, 2.0], least_squares(&[ln_peak], ln_ratio).ok()?),
        };
        let b = |k: usize| fit.fit.coefficients.get(k).copied().unwrap_or(0.0);
        Some(RatioGiven { knots, coefficients: [0, 1, 2].map(b), sd: fit.residual_sd() })
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
        let ln = |values: &[f64]| values.iter().map(|value| value.ln()).collect::<Vec<f64>>();
        let (ln_pga, ln_pgv) = (ln(pga_m_s2), ln(pgv_m_s));
        if ln_pga.len() < 3 || ln_pga.iter().chain(&ln_pgv).any(|ln| !ln.is_finite()) {
            return None;
        }
        let ln_ratio: Vec<f64> = ln_pgv.iter().zip(&ln_pga).map(|(pgv, pga)| pgv - pga).collect();
        let given = |ln_peak: &[f64]| RatioGiven::fit(ln_peak, &ln_ratio);
        Some(JointPeaks { given_pga: given(&ln_pga)?, given_pgv: given(&ln_pgv)? })
    }

    /// PGV / PGA (s) of motions with this intensity (m/s2 or m/s of the given peak), so many standard deviations above its median.
    pub fn pgv_over_pga(&self, given: Peak, intensity: f64, deviations: f64) -> f64 {
        match given {
            Peak::Pga => self.given_pga.ratio(intensity, deviations),
            Peak::Pgv => self.given_pgv.ratio(intensity, deviations),
        }
    }
}

/// The cubic functions that let a line in one value bend: cubic between the knots, linear outside of them, one less than there are
/// gaps between knots; none of fewer than three (Harrell 2015, Regression modeling strategies, section 2.4.5).
pub fn restricted_splines(u: f64, knots: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let ends = match *knots {
        [first, .., before, last] => Some((first, before, last)),
        _ => None,
    };
    ends.into_iter().flat_map(move |(first, before, last)| {
        let cube = move |knot: f64| (u - knot).max(0.0).powi(3);
        let width = (last - first) * (last - first);
        knots[..knots.len() - 2].iter().map(move |&knot| {
            let (a, b) = ((last - knot) / (last - before), (before - knot) / (last - before));
            (cube(knot) - a * cube(before) + b * cube(last)) / width
        })
    })
}
