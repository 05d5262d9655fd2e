//! Dimensionless intensity measures: IM1 to IM6 (Eq. 13), and other measures of a motion, made dimensionless
//! with p and g tan alpha of a structure (section 2.2.3, Eqs. 9 and 10).

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::peaks::Peaks;
use crate::rocking::Structure;
use crate::units::G_M_S2;

/// The dimensionless intensity measures of Eq. 13: the last columns of responses.parquet. Those of a period
/// are missing where the period is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct IntensityMeasures {
    /// wp / p.
    pub im1: Option<f64>,
    /// wm / p.
    pub im2: Option<f64>,
    /// PGA / (p PGV); missing without a ground velocity.
    pub im3: Option<f64>,
    /// PGA / (g tan alpha).
    pub im4: f64,
    /// p PGV / (g tan alpha).
    pub im5: f64,
    /// wm PGV / (g tan alpha).
    pub im6: Option<f64>,
}

impl IntensityMeasures {
    /// Computes IM1 to IM6 (Eq. 13) of a motion with these peaks and periods (s) for a structure.
    pub fn new(
        structure: &Structure,
        Peaks { pga_m_s2, pgv_m_s }: Peaks,
        tp_s: Option<f64>,
        tm_s: Option<f64>,
    ) -> IntensityMeasures {
        let p = structure.p_rad_s;
        let g_tan_alpha = structure.uplift_acceleration_m_s2();
        let [wp, wm] = [tp_s, tm_s].map(|period_s| Some(2.0 * PI / period_s.filter(|t| *t > 0.0)?));
        IntensityMeasures {
            im1: wp.map(|wp| wp / p),
            im2: wm.map(|wm| wm / p),
            im3: (pgv_m_s > 0.0).then(|| pga_m_s2 / (p * pgv_m_s)),
            im4: pga_m_s2 / g_tan_alpha,
            im5: p * pgv_m_s / g_tan_alpha,
            im6: wm.map(|wm| wm * pgv_m_s / g_tan_alpha),
        }
    }

    pub fn peaks(&self, structure: &Structure) -> Peaks {
        let g_tan_alpha = structure.uplift_acceleration_m_s2();
        Peaks { pga_m_s2: self.im4 * g_tan_alpha, pgv_m_s: self.im5 * g_tan_alpha / structure.p_rad_s }
    }

    /// Returns the measures of a motion without periods: IM3 = IM4 / IM5 (Eq. 13).
    pub fn from_peaks(im4: f64, im5: f64) -> IntensityMeasures {
        let im3 = (im5 > 0.0).then(|| im4 / im5);
        IntensityMeasures { im1: None, im2: None, im3, im4, im5, im6: None }
    }
}

/// Physical quantity of a measure; p and g tan alpha make it dimensionless, as in Eq. 13.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// A duration D, s: p D.
    Duration,
    /// A length d, m: p^2 d / (g tan alpha).
    Length,
    /// A velocity v, m/s: p v / (g tan alpha).
    Velocity,
    /// An acceleration a, m/s2: a / (g tan alpha).
    Acceleration,
    /// An Arias intensity pi / (2 g) times the integral I of the squared acceleration, m/s:
    /// p I / (g tan alpha)^2.
    AriasIntensity,
}

impl Dimension {
    /// Computes the dimensionless measure of a structure from `value` in the unit above.
    pub fn dimensionless(self, value: f64, structure: &Structure) -> f64 {
        let (p, g_tan_alpha) = (structure.p_rad_s, structure.uplift_acceleration_m_s2());
        match self {
            Dimension::Duration => p * value,
            Dimension::Length => p * p * value / g_tan_alpha,
            Dimension::Velocity => p * value / g_tan_alpha,
            Dimension::Acceleration => value / g_tan_alpha,
            Dimension::AriasIntensity => p * (2.0 * G_M_S2 / PI * value) / (g_tan_alpha * g_tan_alpha),
        }
    }
}
