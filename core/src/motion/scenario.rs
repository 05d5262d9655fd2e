//! Earthquake scenarios, the distributions of their random parameters (section 2.1.1), and suites of motions.

use crate::spelling::unknown_word;
use crate::statistics::normal;
use crate::units::CM_PER_M;

/// An earthquake at a site: magnitude, distance and velocity pulse.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Scenario {
    /// Number of the scenario: cell times samples per cell, plus sample.
    pub scenario_id: i64,
    /// Cell of the magnitude-distance grid, magnitude by magnitude.
    pub cell: i32,
    pub sample: i32,
    pub mw: f64,
    /// Distance from the rupture, km.
    pub re_km: f64,
    /// Amplitude of the velocity pulse, m/s.
    pub vp_m_s: f64,
    pub tp_s: f64,
    /// Number of half cycles of the pulse.
    pub gamma: f64,
    pub nu_rad: f64,
}

/// Magnitude at which the pulse amplitude saturates.
const SATURATION_MW: f64 = 7.0;
/// Standard deviations of log10 Vp (Eq. 2) and log10 Tp (Eq. 3).
const SIGMA_LOG10_VP: f64 = 0.16;
const SIGMA_LOG10_TP: f64 = 0.18;
/// Mean and standard deviation of gamma, before truncation below 1.
const GAMMA: (f64, f64) = (1.93, 0.47);
/// Mean and standard deviation of nu, rad.
const NU_RAD: (f64, f64) = (1.83, 0.98);

impl Scenario {
    /// Makes the first scenario of a grid at a magnitude and a distance (km), from quantiles `u` in (0, 1) of
    /// Vp and Tp, lognormal (Eqs. 2 and 3), gamma, normal and truncated below at 1, and nu, normal.
    pub fn at_quantiles(mw: f64, re_km: f64, u: [f64; 4]) -> Scenario {
        let log10_vp = mean_log10_vp_cm_s(mw, re_km) + SIGMA_LOG10_VP * normal::quantile(u[0]);
        let log10_tp = mean_log10_tp_s(mw) + SIGMA_LOG10_TP * normal::quantile(u[1]);
        let (mean, sd) = GAMMA;
        // Maps u to the probabilities above that of gamma < 1.
        let below = normal::cdf((1.0 - mean) / sd);
        let gamma = mean + sd * normal::quantile(below + u[2] * (1.0 - below));
        Scenario {
            scenario_id: 0,
            cell: 0,
            sample: 0,
            mw,
            re_km,
            vp_m_s: 10_f64.powf(log10_vp) / CM_PER_M,
            tp_s: 10_f64.powf(log10_tp),
            gamma: gamma.max(1.0),
            nu_rad: NU_RAD.0 + NU_RAD.1 * normal::quantile(u[3]),
        }
    }
}

/// Computes the mean of log10 Vp, Vp in cm/s (Eq. 2), from magnitude (at most 7 counts) and distance (km).
pub fn mean_log10_vp_cm_s(mw: f64, re_km: f64) -> f64 {
    let m = mw.min(SATURATION_MW);
    -5.17 + 1.98 * m - 0.14 * m * m - 0.10 * (re_km * re_km + 0.562).log10()
}

/// Eq. 3.
pub fn mean_log10_tp_s(mw: f64) -> f64 {
    -2.87 + 0.47 * mw
}

/// A kind of ground motion in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Suite>)]
pub enum Suite {
    Pulse,
    /// The combined synthetic ground motion: pulse and high frequencies.
    Csgm,
    /// The stochastic high-frequency component alone.
    Hfc,
    Record,
}

impl Suite {
    /// Motion numbers reserved for each scenario.
    const IDS_OF_SCENARIO: i64 = 4;

    /// End of the suite of motions of a floor: `record floor`.
    pub const ON_FLOOR: &str = " floor";

    /// Returns whether a suite, by its word in tables, is of motions of a floor.
    pub fn is_floor(suite: Option<&str>) -> bool {
        suite.is_some_and(|suite| suite.ends_with(Suite::ON_FLOOR))
    }

    /// Returns the number of the motion of a scenario in this suite: unique, and independent of the suites
    /// synthesized.
    pub fn motion_id(self, scenario_id: i64) -> i64 {
        scenario_id * Suite::IDS_OF_SCENARIO + self as i64
    }
}
