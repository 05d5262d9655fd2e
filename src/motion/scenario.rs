//! An earthquake scenario, the distributions of its random parameters (section 2.1.1), and the suites of motions made of it.

use crate::keyword::keywords;
use crate::statistics::normal;
use crate::units::CM_PER_M;

/// An earthquake as seen from a site: where, how large, and the velocity pulse that it sends.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Scenario {
    /// Cell times samples in a cell, plus sample.
    pub scenario_id: i64,
    /// Cell of the magnitude-distance grid, magnitude first.
    pub cell: i32,
    /// Sample within the cell.
    pub sample: i32,
    /// Moment magnitude.
    pub mw: f64,
    /// Distance from the rupture, km.
    pub re_km: f64,
    /// Amplitude of the velocity pulse, m/s.
    pub vp_m_s: f64,
    /// Period of the pulse, s.
    pub tp_s: f64,
    /// Number of half cycles of the pulse.
    pub gamma: f64,
    /// Phase of the pulse, rad.
    pub nu_rad: f64,
}

/// Magnitude at which the amplitude of the pulse saturates.
const SATURATION_MW: f64 = 7.0;
/// Standard deviation of log10 Vp.
const SIGMA_LOG10_VP: f64 = 0.16;
/// Standard deviation of log10 Tp.
const SIGMA_LOG10_TP: f64 = 0.18;
/// Mean and standard deviation of gamma, which is normal above 1.
const GAMMA: (f64, f64) = (1.93, 0.47);
/// Mean and standard deviation of nu, rad.
const NU_RAD: (f64, f64) = (1.83, 0.98);

impl Scenario {
    /// Makes the scenario of a cell (magnitude, distance in km) whose Vp, Tp, gamma and nu are the quantiles `u`, four numbers in
    /// (0, 1), of their distributions: Vp and Tp lognormal, gamma normal truncated below at 1, nu normal.
    pub fn at_quantiles(
        scenario_id: i64,
        cell: i32,
        sample: i32,
        mw: f64,
        re_km: f64,
        u: [f64; 4],
    ) -> Scenario {
        // Lognormal: both sigmas are of the logarithm to base 10.
        let log10_vp = mean_log10_vp_cm_s(mw, re_km) + SIGMA_LOG10_VP * normal::quantile(u[0]);
        let log10_tp = mean_log10_tp_s(mw) + SIGMA_LOG10_TP * normal::quantile(u[1]);
        let (mean, sd) = GAMMA;
        // The probability below 1 is cut off, and the rest stretched over (0, 1).
        let below = normal::cdf((1.0 - mean) / sd);
        let gamma = mean + sd * normal::quantile(below + u[2] * (1.0 - below));
        Scenario {
            scenario_id,
            cell,
            sample,
            mw,
            re_km,
            vp_m_s: 10_f64.powf(log10_vp) / CM_PER_M,
            tp_s: 10_f64.powf(log10_tp),
            gamma: gamma.max(1.0),
            nu_rad: NU_RAD.0 + NU_RAD.1 * normal::quantile(u[3]),
        }
    }
}

/// Computes the mean of log10 Vp, of the pulse amplitude in cm/s (Eq. 2), from Mw and Re; the magnitude counts up to 7.
pub fn mean_log10_vp_cm_s(mw: f64, re_km: f64) -> f64 {
    let m = mw.min(SATURATION_MW);
    -5.17 + 1.98 * m - 0.14 * m * m - 0.10 * (re_km * re_km + 0.562).log10()
}

/// Computes the mean of log10 Tp, of the pulse period in s (Eq. 3), from Mw.
pub fn mean_log10_tp_s(mw: f64) -> f64 {
    -2.87 + 0.47 * mw
}

/// A kind of ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Suite {
    /// The coherent pulse alone.
    Pulse,
    /// The combined synthetic ground motion: pulse and high frequencies.
    Csgm,
    /// The stochastic high-frequency component alone.
    Hfc,
    /// A recorded motion.
    Record,
    /// A recorded motion without its pulse.
    Residual,
}

keywords!(Suite { Pulse = "pulse", Csgm = "csgm", Hfc = "hfc", Record = "record", Residual = "residual" });

impl Suite {
    /// The suites that are synthesized from a scenario.
    pub const SYNTHETIC: [Suite; 3] = [Suite::Pulse, Suite::Csgm, Suite::Hfc];
    /// Numbers that each scenario keeps for its motions: one more than the suites that are synthesized.
    const IDS_OF_SCENARIO: i64 = 4;

    /// Returns the number of a scenario's motion in this suite, one of [`Suite::SYNTHETIC`]: unique across them, and the same
    /// whichever suites are made.
    pub fn motion_id(self, scenario_id: i64) -> i64 {
        debug_assert!(Suite::SYNTHETIC.contains(&self), "recorded motions are named after their files");
        scenario_id * Suite::IDS_OF_SCENARIO + self as i64
    }
}
