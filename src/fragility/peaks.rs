//! How PGA and PGV of motions go together: what one of them predicts of the other.

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

/// The ratio PGV / PGA given each peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPeaks {
    pub given_pga: RatioGiven,
    pub given_pgv: RatioGiven,
}

/// ln(PGV / PGA), s, is normal about intercept + slope ln(peak); m/s2 or m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatioGiven {
    pub intercept: f64,
    pub slope: f64,
    pub sd: f64,
}

impl RatioGiven {
    fn fit(ln_peak: &[f64], ln_ratio: &[f64]) -> Option<RatioGiven> {
        let line = least_squares(&[ln_peak], ln_ratio).ok()?;
        let b = &line.fit.coefficients;
        Some(RatioGiven { intercept: b[0], slope: b[1], sd: line.residual_sd() })
    }

    /// Returns intercept, slope and standard deviation.
    pub fn to_numbers(self) -> Vec<f64> {
        vec![self.intercept, self.slope, self.sd]
    }

    /// Of intercept, slope and standard deviation; none of another number of numbers.
    pub fn of_numbers(numbers: &[f64]) -> Option<RatioGiven> {
        let &[intercept, slope, sd] = numbers else { return None };
        Some(RatioGiven { intercept, slope, sd })
    }

    fn ratio(&self, intensity: f64, deviations: f64) -> f64 {
        (self.intercept + self.slope * intensity.ln() + deviations * self.sd).exp()
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
