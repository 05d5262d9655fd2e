//! How PGA and PGV of motions go together: what one of them says of the other.

use super::slice::Peak;
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, Moments, columns_of};

/// A joint lognormal distribution of the two peaks, PGA in m/s2 and PGV in m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPeaks {
    /// Mean of ln PGA.
    pub ln_pga_mean: f64,
    /// Standard deviation of ln PGA.
    pub ln_pga_sd: f64,
    /// Mean of ln PGV.
    pub ln_pgv_mean: f64,
    /// Standard deviation of ln PGV.
    pub ln_pgv_sd: f64,
    /// Correlation of the two.
    pub correlation: f64,
}

impl JointPeaks {
    /// The distribution with the moments of these motions; none with fewer than three, or if a peak is not above 0 or the same
    /// in all.
    pub fn of(pga_m_s2: &[f64], pgv_m_s: &[f64]) -> Option<JointPeaks> {
        let ln = |values: &[f64]| values.iter().map(|value| value.ln()).collect::<Vec<f64>>();
        JointPeaks::of_logarithms(&columns_of(&[&ln(pga_m_s2)], ln(pgv_m_s)))
    }

    /// The same of columns of the logarithms of both.
    pub fn of_logarithms(peaks: &Columns) -> Option<JointPeaks> {
        let moments = Moments::of(&Design::new(peaks, 1));
        let covariance = |i: usize, j: usize| moments.product(i, j) / (moments.n as f64 - 1.0);
        let [ln_pga_sd, ln_pgv_sd] = [0, 1].map(|peak| covariance(peak, peak).sqrt());
        let correlation = covariance(0, 1) / (ln_pga_sd * ln_pgv_sd);
        let (ln_pga_mean, ln_pgv_mean) = (moments.means[0], moments.means[1]);
        let peaks = JointPeaks { ln_pga_mean, ln_pga_sd, ln_pgv_mean, ln_pgv_sd, correlation };
        (moments.n > 2 && correlation.is_finite()).then_some(peaks)
    }

    /// PGV / PGA (s) of motions with this intensity (m/s2 or m/s of the given peak), so many standard deviations above its median.
    pub fn pgv_over_pga(&self, given: Peak, intensity: f64, deviations: f64) -> f64 {
        let (pga, pgv) = ((self.ln_pga_mean, self.ln_pga_sd), (self.ln_pgv_mean, self.ln_pgv_sd));
        // Of jointly normal values, one is linear in the other.
        let other = |(mean, sd): (f64, f64), (other_mean, other_sd): (f64, f64), deviations: f64| {
            let r = self.correlation;
            let expected = other_mean + r * other_sd / sd * (intensity.ln() - mean);
            expected + deviations * other_sd * (1.0 - r * r).sqrt()
        };
        match given {
            Peak::Pga => (other(pga, pgv, deviations) - intensity.ln()).exp(),
            Peak::Pgv => (intensity.ln() - other(pgv, pga, -deviations)).exp(),
        }
    }
}
