//! PGV / PGA of the motions of a site, and its uncertainty: by the hazard curves of both peaks, or by one of
//! them and ground-motion models.

use nalgebra::{DMatrix, DVector, Vector2};

use super::curve::HazardCurve;
use crate::fragility::{Model, MotionKind, Peak, RatioGiven};
use crate::object::{LowHigh, UncertaintySource};
use crate::plausibility::PGV_PGA_OF_SITE_S;
use crate::spelling::unknown_word;
use crate::statistics::normal;
use crate::statistics::numerics::equal_ratios;
use crate::units::G_M_S2;

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<VelocitySource>)]
pub enum VelocitySource {
    /// Curves of PGA and PGV.
    Pgv,
    /// Curves of PGA and of the spectral acceleration at 1 s.
    Sa,
    /// A ratio that the user gives.
    Ratio,
    /// The motions that the model was fitted to.
    Motions,
    /// Ground-motion models, at an average site.
    Sites,
}

/// PGV / PGA of the motions of a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PgvPgaRatio {
    /// Given the peak of the hazard, at the magnitude [`MIDDLE`].
    ratio: RatioGiven,
    /// Rise of ln(PGV / PGA) with magnitude.
    per_magnitude: f64,
    /// Standard deviation of the level of ln(PGV / PGA).
    sd: f64,
    pub source: VelocitySource,
}

/// The magnitude at which the lines of generic sites hold.
const MIDDLE: f64 = 6.3;
/// ln(PGV / PGA), s, at generic sites: linear in ln of the given peak.
#[derive(Clone, Copy)]
struct LineOfSites {
    /// The peak at which the line has this level, m/s2 or m/s.
    at: f64,
    level: f64,
    slope: f64,
    /// Standard deviation about the line.
    sd: f64,
    per_magnitude: f64,
    /// Standard deviation of the level between sites of one magnitude.
    sd_of_level: f64,
    /// Rise of the level with ln(Vs30 / 440 m/s), and standard deviation of the level where Vs30 is known.
    per_ln_vs30: f64,
    sd_at_vs30: f64,
}

/// By scripts/reference/sites.py.
#[rustfmt::skip]
const GIVEN_PGA: LineOfSites = LineOfSites {
    at: 0.4 * G_M_S2, level: -2.86, slope: -0.06, sd: 0.58, per_magnitude: 0.30,
    sd_of_level: 0.28, per_ln_vs30: -0.31, sd_at_vs30: 0.23,
};
#[rustfmt::skip]
const GIVEN_PGV: LineOfSites = LineOfSites {
    at: 0.4, level: -2.21, slope: 0.25, sd: 0.50, per_magnitude: 0.33,
    sd_of_level: 0.23, per_ln_vs30: -0.20, sd_at_vs30: 0.21,
};
/// Of motions as recorded, by scripts/reference/recorded_peaks.py.
#[rustfmt::skip]
const RECORDED_GIVEN_PGA: LineOfSites = LineOfSites {
    level: -2.58, slope: -0.15, sd: 0.43, per_magnitude: 0.49,
    sd_of_level: 0.25, sd_at_vs30: 0.25, ..GIVEN_PGA
};
/// Vs30 at which these lines hold, m/s.
const USUAL_VS30_M_S: f64 = 440.0;
/// Standard deviation of ln(PGV / PGA) given PGA, where the curves of both peaks give the line.
const SCATTER: f64 = 0.42;
/// Standard deviation of the level by two curves, of PGA and PGV, and of PGA and SA(1.0 s).
const SD_BY_VELOCITY: f64 = 0.08;
const SD_BY_SPECTRUM: f64 = 0.12;
/// PGV (m/s) = 0.090 SA(1.0 s)^0.64 PGA^0.36 exp(0.13 (M - 6.3)), accelerations in m/s2 and each exceeded as
/// often (scripts/reference/sites.py). Newmark & Hall's (1982) 0.096 SA(1.0 s), without PGA, scatters twice
/// as much between sites.
const BY_SPECTRUM: f64 = 0.090;
const EXPONENT_OF_PGA: f64 = 0.36;
const PER_MAGNITUDE_BY_SPECTRUM: f64 = 0.13;

/// Annual rates between which two curves are matched, and at how many.
const LEAST_MATCHED: f64 = 1e-6;
const MOST_MATCHED: f64 = 2e-2;
const LEVELS: usize = 16;
/// Widest panel of the quadrature, in ln PGA.
const PANEL: f64 = 0.25;
/// Root mean square of ln rate above which two curves are not of one site.
const LARGEST_REMAINDER: f64 = 0.4;

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MatchError {
    #[error("the curves have no rates in common: {0:.1e} to {1:.1e} a year; expected three times as far")]
    NothingInCommon(f64, f64),
    #[error(
        "PGV/PGA is {ratio_s:.3} s at {pga_g:.2} g; expected 0.01 to 0.5 s: curves of one site, in these \
         units?"
    )]
    ImpossibleRatio { ratio_s: f64, pga_g: f64 },
    #[error(
        "no PGV/PGA reconciles the two curves: rates differ by {:.0} %; expected at most 50 %: curves of one \
         site?",
        100.0 * (.0.exp() - 1.0)
    )]
    Unlike(f64),
}

/// PGV (m/s) at magnitude 6.3 from accelerations in m/s2.
pub fn velocity_of_spectrum(pga: &HazardCurve, sa_1s: &HazardCurve) -> HazardCurve {
    sa_1s.map(|sa, rate| {
        BY_SPECTRUM * sa.powf(1.0 - EXPONENT_OF_PGA) * pga.intensity(rate).powf(EXPONENT_OF_PGA)
    })
}

impl PgvPgaRatio {
    /// The same ratio (s) in all motions.
    pub fn given(ratio_s: f64) -> PgvPgaRatio {
        let ratio = RatioGiven::line(ratio_s.ln(), 0.0, 0.0);
        PgvPgaRatio { ratio, per_magnitude: 0.0, sd: 0.0, source: VelocitySource::Ratio }
    }

    /// The ratio of the motions that a model was fitted to, else of generic sites, of this Vs30 (m/s).
    pub fn by_model(model: &Model, given: Peak, vs30_m_s: Option<f64>) -> PgvPgaRatio {
        PgvPgaRatio::by_line(model, given, [GIVEN_PGA, GIVEN_PGV][given as usize], vs30_m_s)
    }

    /// Likewise of motions as recorded, of one magnitude or with this standard deviation of magnitudes.
    pub fn as_recorded(model: &Model, given: Peak, vs30_m_s: Option<f64>, sd_of_mw: f64) -> PgvPgaRatio {
        let line = [RECORDED_GIVEN_PGA, GIVEN_PGV][given as usize];
        let line = LineOfSites { sd: line.sd.hypot(line.per_magnitude * sd_of_mw), ..line };
        PgvPgaRatio::by_line(model, given, line, vs30_m_s)
    }

    fn by_line(model: &Model, given: Peak, line: LineOfSites, vs30_m_s: Option<f64>) -> PgvPgaRatio {
        let is_of_sites = matches!(model, Model::Surface { overturning, .. }
            if overturning.n == 0 && overturning.kind == MotionKind::Recorded);
        if !is_of_sites {
            let (ratio, sd) = (model.peaks().given(given), line.sd_of_level);
            return PgvPgaRatio { ratio, per_magnitude: 0.0, sd, source: VelocitySource::Motions };
        }
        let by_vs30 = vs30_m_s.map_or(0.0, |vs30| line.per_ln_vs30 * (vs30 / USUAL_VS30_M_S).ln());
        PgvPgaRatio {
            ratio: RatioGiven::line(line.level + by_vs30 - line.slope * line.at.ln(), line.slope, line.sd),
            per_magnitude: line.per_magnitude,
            sd: if vs30_m_s.is_some() { line.sd_at_vs30 } else { line.sd_of_level },
            source: VelocitySource::Sites,
        }
    }

    /// PGV / PGA given PGA that reconciles the curves of PGA (m/s2) and PGV (m/s): its level and slope by
    /// least squares in ln rate.
    ///
    /// # Errors
    /// If the curves cannot belong together.
    pub fn by_curves(
        pga: &HazardCurve,
        pgv: &HazardCurve,
        source: VelocitySource,
    ) -> Result<PgvPgaRatio, MatchError> {
        let [[(_, first), (_, last)], [(_, first_v), (_, last_v)]] = [pga.ends(), pgv.ends()];
        let most = MOST_MATCHED.min(0.5 * first).min(first_v);
        let least = LEAST_MATCHED.max(2.0 * last).max(last_v);
        if most < 3.0 * least {
            return Err(MatchError::NothingInCommon(least, most));
        }
        let rates = equal_ratios(most, least, LEVELS - 1);
        let levels: Vec<(f64, f64)> = rates.map(|rate| (pgv.intensity(rate), rate)).collect();
        let at_equal_rates = levels.iter().map(|(v, rate)| (v / pga.intensity(*rate)).ln());
        let start = Vector2::new(at_equal_rates.sum::<f64>() / LEVELS as f64, 0.0);
        let (found, remainder) = least_squares_of_two(start, |line| {
            let line = line_at_pga(line[0], line[1]);
            let off = levels.iter().map(|&(v, rate)| (exceedance_of_velocity(pga, &line, v) / rate).ln());
            DVector::from_iterator(LEVELS, off)
        });
        let line = line_at_pga(found[0], found[1]);
        for a in [most, least].map(|rate| pga.intensity(rate)) {
            let ratio_s = line.ratio(a, 0.0);
            if !PGV_PGA_OF_SITE_S.contains(&ratio_s) {
                return Err(MatchError::ImpossibleRatio { ratio_s, pga_g: a / G_M_S2 });
            }
        }
        if remainder > LARGEST_REMAINDER || remainder.is_nan() {
            return Err(MatchError::Unlike(remainder));
        }
        let (per_magnitude, sd) = match source {
            VelocitySource::Sa => (PER_MAGNITUDE_BY_SPECTRUM, SD_BY_SPECTRUM),
            _ => (0.0, SD_BY_VELOCITY),
        };
        Ok(PgvPgaRatio { ratio: line, per_magnitude, sd, source })
    }

    /// The uncertainty of the level, as ln of a factor.
    pub fn at_quantiles(&self) -> LowHigh<f64> {
        LowHigh::normal(UncertaintySource::Velocity, self.sd)
    }

    /// PGV / PGA in earthquakes of a magnitude, times exp(`ln_factor`).
    pub fn at(&self, mw: f64, ln_factor: f64) -> RatioGiven {
        let intercept = self.ratio.intercept + (self.per_magnitude * (mw - MIDDLE) + ln_factor);
        RatioGiven { intercept, ..self.ratio }
    }
}

/// The line through a level at 0.4 g.
fn line_at_pga(level: f64, slope: f64) -> RatioGiven {
    RatioGiven::line(level - slope * GIVEN_PGA.at.ln(), slope, SCATTER)
}

/// The annual rate of exceedance of a PGV (m/s), by a curve of PGA and PGV / PGA given PGA.
fn exceedance_of_velocity(pga: &HazardCurve, line: &RatioGiven, pgv_m_s: f64) -> f64 {
    pga.mean_annual_rate(&[], PANEL, |a| normal::cdf((a * line.ratio(a, 0.0) / pgv_m_s).ln() / line.sd_above))
}

/// Minimises by Gauss-Newton steps; with the root mean square of `off` at the minimum.
fn least_squares_of_two(
    start: Vector2<f64>,
    off: impl Fn(&Vector2<f64>) -> DVector<f64>,
) -> (Vector2<f64>, f64) {
    const STEP: f64 = 1e-4;
    const MOST: usize = 30;
    let (mut at, mut current) = (start, off(&start));
    for _ in 0..MOST {
        let slopes = [0, 1].map(|k| (off(&(at + Vector2::ith(k, STEP))) - &current) / STEP);
        let slopes = DMatrix::from_columns(&slopes);
        let Some(inverse) = slopes.tr_mul(&slopes).try_inverse() else { break };
        let step = inverse * slopes.tr_mul(&current);
        // Far from the minimum, steps are limited so that PGV rises with PGA.
        let held = step.map(|step| step.clamp(-0.5, 0.5));
        at = Vector2::new(at.x - held[0], (at.y - held[1]).max(-0.95));
        current = off(&at);
        if step.amax() < 1e-9 {
            break;
        }
    }
    (at, current.norm() / (current.len() as f64).sqrt())
}
