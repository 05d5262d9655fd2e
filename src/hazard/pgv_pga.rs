//! PGV / PGA of the motions of a site, and how well it is known: by the curves of both peaks, or by one and
//! ground-motion models.

use nalgebra::{DMatrix, DVector, Vector2};

use super::curve::HazardCurve;
use crate::fragility::{Kind, Model, Peak, RatioGiven, Z_95};
use crate::keyword::keywords;
use crate::object::{Part, Unknown};
use crate::plausibility::PGV_PGA_OF_SITE_S;
use crate::statistics::normal;
use crate::units::G_M_S2;

keywords! {
    /// Source of PGV / PGA.
    pub enum VelocitySource {
        /// Curves of PGA and PGV.
        Velocity = "pgv",
        /// Curves of PGA and of the spectral acceleration at 1 s.
        Spectrum = "sa",
        /// A ratio that the user gives.
        Given = "ratio",
        /// The motions that the model was fitted to.
        Motions = "motions",
        /// Ground-motion models, at an average site.
        Sites = "sites",
    }
}

/// PGV / PGA of the motions of a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PgvPgaRatio {
    /// Given the peak of the hazard, at the magnitude [`MIDDLE`].
    ratio: RatioGiven,
    /// By how much ln(PGV / PGA) rises with magnitude.
    per_magnitude: f64,
    /// Standard deviation of the level of ln(PGV / PGA).
    sd: f64,
    /// Where it comes from.
    pub source: VelocitySource,
}

/// The magnitude that lines of sites in general are for.
const MIDDLE: f64 = 6.3;
/// Mean and standard deviation of the magnitude of the motions that matter, at sites in general, and the
/// standard deviation about a mean that is given.
const MAGNITUDE: [f64; 2] = [6.35, 0.6];
const SD_OF_MEAN: f64 = 0.2;
/// By how much the mean magnitude of the motions that overturn exceeds that of the disaggregation of PGA at
/// 2475 years, and its standard deviation between sites (scripts/reference/magnitudes.py). That of SA(1.0 s)
/// lies half way, and needs no correction.
const ABOVE_MEAN_OF_PGA: [f64; 2] = [0.45, 0.3];
/// Lines of sites in general (scripts/reference/sites.py): ln(PGV / PGA) in s at PGA of 0.4 g or PGV of 0.4
/// m/s, its slope over ln of the peak, the standard deviation about it, its rise with magnitude, and the
/// standard deviation of the level between sites of one magnitude.
const GIVEN_PGA: [f64; 5] = [-2.86, -0.06, 0.58, 0.30, 0.28];
const GIVEN_PGV: [f64; 5] = [-2.21, 0.25, 0.50, 0.33, 0.23];
/// At a known Vs30, given PGA and given PGV: the rise of these lines with ln(Vs30 / 440 m/s), and the
/// standard deviation of the level that is left.
const AT_VS30: [[f64; 2]; 2] = [[-0.31, 0.23], [-0.20, 0.21]];
/// Vs30 at which the lines of sites in general hold, m/s.
const USUAL_VS30_M_S: f64 = 440.0;
/// Where the lines of sites in general have their level: m/s2 and m/s.
const LEVEL_AT: [f64; 2] = [0.4 * G_M_S2, 0.4];
/// Standard deviation of ln(PGV / PGA) given PGA, where the curves of both peaks give the line.
const SCATTER: f64 = 0.42;
/// Standard deviations of the level by two curves: of PGA and PGV, and of PGA and SA(1.0 s).
const SD_BY_CURVES: [f64; 2] = [0.08, 0.12];
/// PGV (m/s) = 0.090 SA(1.0 s)^0.64 PGA^0.36 exp(0.13 (M - 6.3)), accelerations in m/s2 and each exceeded as
/// often (scripts/reference/sites.py): the factor, the exponent of PGA and the rise with magnitude. Newmark
/// & Hall's (1982) 0.096 SA(1.0 s), without PGA, scatters twice as much between sites.
const BY_SPECTRUM: [f64; 3] = [0.090, 0.36, 0.13];

/// Rates a year between which two curves are matched, and at how many.
const MATCHED: [f64; 2] = [1e-6, 2e-2];
const LEVELS: usize = 16;
/// Widest panel of the quadrature, in ln PGA.
const PANEL: f64 = 0.25;
/// Root mean square of ln rate above which two curves do not belong together.
const LARGEST_REMAINDER: f64 = 0.4;

/// Why two curves do not belong together.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message says it")]
pub enum MatchError {
    #[error("the curves have no rates in common: {0:.1e} to {1:.1e} a year; expected three times as far")]
    NothingInCommon(f64, f64),
    #[error(
        "PGV/PGA is {ratio_s:.3} s at {pga_g:.2} g; expected 0.01 to 0.5 s: curves of one site, in these units?"
    )]
    ImpossibleRatio { ratio_s: f64, pga_g: f64 },
    #[error(
        "no PGV/PGA reconciles the two curves: rates differ by {:.0} %; expected at most 50 %: curves of one \
         site?",
        100.0 * (.0.exp() - 1.0)
    )]
    Unlike(f64),
}

/// Magnitude of the controlling earthquakes: its median, by the one that is given, and what is not known of
/// it; `sd` of a mean of the disaggregation.
pub fn magnitude(given: Option<f64>, sd: Option<f64>) -> (f64, Unknown<f64>) {
    let [median, sd] = given.map_or(MAGNITUDE, |mean| [mean, sd.unwrap_or(SD_OF_MEAN)]);
    let (low, high) = (median - Z_95 * sd, median + Z_95 * sd);
    (median, Unknown { part: Part::Magnitude, low, high })
}

/// The curve of PGV (m/s) at magnitude 6.3 for those of PGA and of the spectral acceleration at 1 s (m/s2).
pub fn velocity_of_spectrum(pga: &HazardCurve, sa_1s: &HazardCurve) -> HazardCurve {
    let [factor, of_pga, _] = BY_SPECTRUM;
    sa_1s.map(|sa, rate| factor * sa.powf(1.0 - of_pga) * pga.intensity(rate).powf(of_pga))
}

impl PgvPgaRatio {
    /// Makes a ratio (s) that is the same in all motions.
    pub fn given(ratio_s: f64) -> PgvPgaRatio {
        PgvPgaRatio {
            ratio: RatioGiven::line(ratio_s.ln(), 0.0, 0.0),
            per_magnitude: 0.0,
            sd: 0.0,
            source: VelocitySource::Given,
        }
    }

    /// Makes the ratio of the motions that a model stands for: those that it was fitted to, or sites in
    /// general, of this Vs30 (m/s) if it is known.
    pub fn of_model(model: &Model, given: Peak, vs30_m_s: Option<f64>) -> PgvPgaRatio {
        let [level, slope, sd, per_magnitude, sd_of_level] = match given {
            Peak::Pga => GIVEN_PGA,
            Peak::Pgv => GIVEN_PGV,
        };
        match model {
            Model::Calibrated { overturning, .. }
                if overturning.n == 0 && overturning.kind == Kind::Recorded =>
            {
                let [per_ln_vs30, sd_at_vs30] = AT_VS30[given as usize];
                let [of_vs30, sd_of_level] = vs30_m_s.map_or([0.0, sd_of_level], |vs30| {
                    [per_ln_vs30 * (vs30 / USUAL_VS30_M_S).ln(), sd_at_vs30]
                });
                let at = LEVEL_AT[given as usize];
                let ratio = RatioGiven::line(level + of_vs30 - slope * at.ln(), slope, sd);
                PgvPgaRatio { ratio, per_magnitude, sd: sd_of_level, source: VelocitySource::Sites }
            }
            _ => PgvPgaRatio {
                ratio: model.peaks().given(given),
                per_magnitude: 0.0,
                sd: sd_of_level,
                source: VelocitySource::Motions,
            },
        }
    }

    /// PGV / PGA given PGA by which the curve of PGA (m/s2) has the rates of that of PGV (m/s): its level
    /// and slope by least squares in ln rate.
    ///
    /// # Errors
    /// If the curves cannot belong together.
    pub fn of_curves(
        pga: &HazardCurve,
        pgv: &HazardCurve,
        source: VelocitySource,
    ) -> Result<PgvPgaRatio, MatchError> {
        let [[(_, first), (_, last)], [(_, first_v), (_, last_v)]] = [pga.ends(), pgv.ends()];
        let most = MATCHED[1].min(0.5 * first).min(first_v);
        let least = MATCHED[0].max(2.0 * last).max(last_v);
        if most < 3.0 * least {
            return Err(MatchError::NothingInCommon(least, most));
        }
        let rate = |k: usize| most * (least / most).powf(k as f64 / (LEVELS - 1) as f64);
        let levels: Vec<(f64, f64)> = (0..LEVELS).map(|k| (pgv.intensity(rate(k)), rate(k))).collect();
        let off = |line: &Vector2<f64>| {
            let line = line_at_pga(line[0], line[1]);
            let off = |&(v, rate): &(f64, f64)| (exceedance_of_velocity(pga, &line, v) / rate).ln();
            DVector::from_iterator(LEVELS, levels.iter().map(off))
        };
        let at_equal_rates = |&(v, rate): &(f64, f64)| (v / pga.intensity(rate)).ln();
        let start = levels.iter().map(at_equal_rates).sum::<f64>() / LEVELS as f64;
        let ([level, slope], remainder) = least_squares_of_two([start, 0.0], off);
        let line = line_at_pga(level, slope);
        for a in [most, least].map(|rate| pga.intensity(rate)) {
            let ratio_s = line.ratio(a, 0.0);
            if !PGV_PGA_OF_SITE_S.contains(&ratio_s) {
                return Err(MatchError::ImpossibleRatio { ratio_s, pga_g: a / G_M_S2 });
            }
        }
        if remainder > LARGEST_REMAINDER || remainder.is_nan() {
            return Err(MatchError::Unlike(remainder));
        }
        let is_spectrum = source == VelocitySource::Spectrum;
        let per_magnitude = if is_spectrum { BY_SPECTRUM[2] } else { 0.0 };
        Ok(PgvPgaRatio { ratio: line, per_magnitude, sd: SD_BY_CURVES[usize::from(is_spectrum)], source })
    }

    /// Its uncertainty, as ln of a factor.
    pub fn unknown(&self) -> Unknown<f64> {
        Unknown { part: Part::Velocity, low: -Z_95 * self.sd, high: Z_95 * self.sd }
    }

    /// The magnitude of the motions: `median`, but none where none is given and PGV / PGA tells it, which is
    /// known by two curves or that of the model's motions.
    pub fn magnitude(&self, given: Option<f64>, median: f64) -> Option<f64> {
        match self.source {
            VelocitySource::Sites | VelocitySource::Given => Some(median),
            _ => given.map(|_| median),
        }
    }

    /// By how much the mean magnitude of the motions that overturn exceeds a mean of the disaggregation, and
    /// the standard deviation about it: that of SA(1.0 s) where PGV / PGA is by this curve, else that of PGA.
    pub fn above_mean(&self) -> [f64; 2] {
        if self.source == VelocitySource::Spectrum { [0.0, SD_OF_MEAN] } else { ABOVE_MEAN_OF_PGA }
    }

    /// PGV / PGA given the peak in earthquakes of a magnitude, times exp(`ln`).
    pub fn at(&self, mw: f64, ln: f64) -> RatioGiven {
        let intercept = self.ratio.intercept + (self.per_magnitude * (mw - MIDDLE) + ln);
        RatioGiven { intercept, ..self.ratio }
    }
}

/// The line through a level at 0.4 g.
fn line_at_pga(level: f64, slope: f64) -> RatioGiven {
    RatioGiven::line(level - slope * LEVEL_AT[0].ln(), slope, SCATTER)
}

/// The annual rate at which a PGV (m/s) is exceeded, by a curve of PGA and PGV / PGA given PGA.
fn exceedance_of_velocity(pga: &HazardCurve, line: &RatioGiven, pgv_m_s: f64) -> f64 {
    let exceeds = |a: f64| [normal::cdf((a * line.ratio(a, 0.0) / pgv_m_s).ln() / line.sd_above)];
    pga.mean_annual_rates(&[], PANEL, exceeds)[0]
}

/// Minimises a sum of squares over two parameters by Gauss and Newton, and returns the root mean square at
/// the minimum.
fn least_squares_of_two(start: [f64; 2], off: impl Fn(&Vector2<f64>) -> DVector<f64>) -> ([f64; 2], f64) {
    const STEP: f64 = 1e-4;
    const MOST: usize = 30;
    let mut at = Vector2::from(start);
    let mut current = off(&at);
    for _ in 0..MOST {
        let slope = |k: usize| (off(&(at + Vector2::ith(k, STEP))) - &current) / STEP;
        let slopes = DMatrix::from_columns(&[slope(0), slope(1)]);
        let Some(inverse) = slopes.tr_mul(&slopes).try_inverse() else { break };
        let step = inverse * slopes.tr_mul(&current);
        // Far from the minimum, steps are held to what keeps PGV rising with PGA.
        let held = step.map(|step| step.clamp(-0.5, 0.5));
        at = Vector2::new(at.x - held[0], (at.y - held[1]).max(-0.95));
        current = off(&at);
        if step.amax() < 1e-9 {
            break;
        }
    }
    (at.into(), current.norm() / (current.len() as f64).sqrt())
}
