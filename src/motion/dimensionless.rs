use std::f64::consts::PI;

use crate::rocking::Structure;

/// The dimensionless intensity measures of Eq. 13. Those of periods are missing where the period is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntensityMeasures {
    /// wp / p.
    pub im1: Option<f64>,
    /// wm / p.
    pub im2: Option<f64>,
    /// PGA / (p PGV); missing where the ground does not move.
    pub im3: Option<f64>,
    /// PGA / (g tan alpha).
    pub im4: f64,
    /// p PGV / (g tan alpha).
    pub im5: f64,
    /// wm PGV / (g tan alpha).
    pub im6: Option<f64>,
}

impl IntensityMeasures {
    /// Of a structure and a motion of these peaks (m/s2, m/s) and periods (s).
    pub fn new(
        structure: &Structure,
        pga_m_s2: f64,
        pgv_m_s: f64,
        tp_s: Option<f64>,
        tm_s: Option<f64>,
    ) -> IntensityMeasures {
        let p = structure.p_rad_s;
        let uplift = structure.uplift_acceleration_m_s2();
        let circular = |period_s: Option<f64>| period_s.filter(|&period| period > 0.0).map(|t| 2.0 * PI / t);
        let wm = circular(tm_s);
        IntensityMeasures {
            im1: circular(tp_s).map(|wp| wp / p),
            im2: wm.map(|wm| wm / p),
            im3: (pgv_m_s > 0.0).then(|| pga_m_s2 / (p * pgv_m_s)),
            im4: pga_m_s2 / uplift,
            im5: p * pgv_m_s / uplift,
            im6: wm.map(|wm| wm * pgv_m_s / uplift),
        }
    }
}
