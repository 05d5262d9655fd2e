//! What a motion is scaled to.

use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::stages::shared::motions::Peaks;
use crate::units::G_M_S2;

/// A measure that grows with a motion in proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScaledMeasure {
    /// The factor itself.
    Scale,
    /// Peak ground acceleration, g.
    Pga,
    /// Peak ground velocity, m/s.
    Pgv,
    /// PGA / (g tan alpha).
    Im4,
    /// p PGV / (g tan alpha).
    Im5,
    /// wm PGV / (g tan alpha).
    Im6,
}

keywords!(ScaledMeasure {
    Scale = "scale",
    Pga = "pga",
    Pgv = "pgv",
    Im4 = "im4",
    Im5 = "im5",
    Im6 = "im6",
});

impl ScaledMeasure {
    /// Of a motion with these peaks and measures as it is; none where it has none, or the ground does not move.
    pub fn unscaled(self, peaks: &Peaks, measures: &IntensityMeasures) -> Option<f64> {
        let value = match self {
            ScaledMeasure::Scale => Some(1.0),
            ScaledMeasure::Pga => Some(peaks.pga_m_s2 / G_M_S2),
            ScaledMeasure::Pgv => Some(peaks.pgv_m_s),
            ScaledMeasure::Im4 => Some(measures.im4),
            ScaledMeasure::Im5 => Some(measures.im5),
            ScaledMeasure::Im6 => measures.im6,
        };
        value.filter(|&value| value > 0.0)
    }
}
