//! The joint distribution of PGA and PGV of motions.

use crate::motion::Peaks;
use crate::spelling::unknown_word;
use crate::statistics::least_squares;
use crate::units::G_M_S2;

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Peak>)]
pub enum Peak {
    /// Peak ground acceleration, m/s2.
    Pga,
    /// Peak ground velocity, m/s.
    Pgv,
}

impl Peak {
    /// The short name, the unit in SI units, and its symbol.
    pub fn name_and_unit(self) -> (&'static str, f64, &'static str) {
        match self {
            Peak::Pga => ("PGA", G_M_S2, "g"),
            Peak::Pgv => ("PGV", 1.0, "m/s"),
        }
    }
}

/// The distributions of PGV / PGA given each peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointPeaks {
    pub given_pga: RatioGiven,
    pub given_pgv: RatioGiven,
}

/// ln(PGV / PGA), s, is intercept + slope u + bend max(u - knot, 0), u = ln(peak) of m/s2 or m/s, with one sd
/// below and one above: the strongest PGA are of small, near earthquakes, with less PGV than on a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatioGiven {
    pub intercept: f64,
    pub slope: f64,
    pub knot: f64,
    pub bend: f64,
    pub sd_below: f64,
    pub sd_above: f64,
}

/// Share of the motions below the knot.
const KNOT: f64 = 0.9;
/// With fewer motions, and so fewer than 30 above the knot, no bend is fitted.
const LEAST_TO_BEND: usize = 300;

impl RatioGiven {
    fn fit(ln_peak: &[f64], ln_ratio: &[f64]) -> Option<RatioGiven> {
        let mut sorted = ln_peak.to_vec();
        sorted.sort_by(f64::total_cmp);
        let knot = sorted[(KNOT * (sorted.len() - 1) as f64).round() as usize];
        let beyond: Vec<f64> = ln_peak.iter().map(|u| (u - knot).max(0.0)).collect();
        let columns: &[&[f64]] = if sorted.len() < LEAST_TO_BEND { &[ln_peak] } else { &[ln_peak, &beyond] };
        let b = least_squares(columns, ln_ratio).ok()?.fit.coefficients;
        let (intercept, slope, bend) = (b[0], b[1], b.get(2).copied().unwrap_or(0.0));
        let line = RatioGiven { intercept, slope, knot, bend, sd_below: 0.0, sd_above: 0.0 };
        let off: Vec<f64> = ln_peak.iter().zip(ln_ratio).map(|(&u, ratio)| ratio - line.mean(u)).collect();
        let [sd_below, sd_above] = [-1.0, 1.0].map(|side| {
            let squares = off.iter().filter(|off| *off * side > 0.0).map(|off| off * off);
            let (count, sum) =
                squares.fold((0.0_f64, 0.0), |(count, sum), square| (count + 1.0, sum + square));
            (sum / count.max(1.0)).sqrt()
        });
        Some(RatioGiven { sd_below, sd_above, ..line })
    }

    pub(super) fn to_numbers(self) -> Vec<f64> {
        vec![self.intercept, self.slope, self.knot, self.bend, self.sd_below, self.sd_above]
    }

    /// The fields in their order; none if there are not six.
    pub(super) fn from_numbers(numbers: &[f64]) -> Option<RatioGiven> {
        let &[intercept, slope, knot, bend, sd_below, sd_above] = numbers else { return None };
        Some(RatioGiven { intercept, slope, knot, bend, sd_below, sd_above })
    }

    fn mean(&self, ln_peak: f64) -> f64 {
        self.intercept + self.slope * ln_peak + self.bend * (ln_peak - self.knot).max(0.0)
    }

    /// A straight line in ln of the peak (m/s2 or m/s), with a standard deviation about it.
    pub fn line(intercept: f64, slope: f64, sd: f64) -> RatioGiven {
        RatioGiven { intercept, slope, knot: 0.0, bend: 0.0, sd_below: sd, sd_above: sd }
    }

    pub fn is_exact(&self) -> bool {
        self.sd_below == 0.0 && self.sd_above == 0.0
    }

    /// PGV / PGA (s) at an intensity (m/s2 or m/s), this many standard deviations above its median.
    pub fn ratio(&self, intensity: f64, deviations: f64) -> f64 {
        self.ln_ratio(intensity.ln(), deviations).exp()
    }

    pub(super) fn ln_ratio(&self, ln_intensity: f64, deviations: f64) -> f64 {
        let sd = if deviations > 0.0 { self.sd_above } else { self.sd_below };
        self.mean(ln_intensity) + deviations * sd
    }
}

impl JointPeaks {
    /// None with fewer than three motions, or if a peak is not above 0 or the same in all.
    pub fn fit(motions: impl Iterator<Item = Peaks>) -> Option<JointPeaks> {
        let (ln_pga, ln_pgv): (Vec<f64>, Vec<f64>) =
            motions.map(|peaks| (peaks.pga_m_s2.ln(), peaks.pgv_m_s.ln())).unzip();
        if ln_pga.len() < 3 || ln_pga.iter().chain(&ln_pgv).any(|ln| !ln.is_finite()) {
            return None;
        }
        let ln_ratio: Vec<f64> = ln_pgv.iter().zip(&ln_pga).map(|(pgv, pga)| pgv - pga).collect();
        let given_pga = RatioGiven::fit(&ln_pga, &ln_ratio)?;
        Some(JointPeaks { given_pga, given_pgv: RatioGiven::fit(&ln_pgv, &ln_ratio)? })
    }

    pub fn given(&self, peak: Peak) -> RatioGiven {
        match peak {
            Peak::Pga => self.given_pga,
            Peak::Pgv => self.given_pgv,
        }
    }
}
