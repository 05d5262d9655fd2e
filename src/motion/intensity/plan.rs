use super::{IntensityScratch, Measures, housner_intensity, measures, spectral_acceleration};

/// Damping ratio of the spectral accelerations that become columns.
const SPECTRAL_DAMPING: f64 = 0.05;

/// Which measures are taken besides the usual ones.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeasurePlan {
    /// Whether the Housner intensity, which takes as long as all others together.
    pub housner: bool,
    /// Periods of the spectral accelerations, s.
    pub sa_periods_s: Vec<f64>,
}

/// All measures of one motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// The usual ones.
    pub measures: Measures,
    /// Housner intensity, m, if asked for.
    pub housner_m: Option<f64>,
    /// Pseudo-spectral accelerations at the periods of the plan, 5 % damping, m/s2.
    pub sa_m_s2: Vec<f64>,
}

impl MeasurePlan {
    /// The measures of a motion of these samples (m/s2), `dt_s` apart.
    pub fn measure(&self, acceleration: &[f64], dt_s: f64, scratch: &mut IntensityScratch) -> Measured {
        let sa = |period_s: &f64| spectral_acceleration(acceleration, dt_s, *period_s, SPECTRAL_DAMPING);
        Measured {
            measures: measures(acceleration, dt_s, scratch),
            housner_m: self.housner.then(|| housner_intensity(acceleration, dt_s)),
            sa_m_s2: self.sa_periods_s.iter().map(sa).collect(),
        }
    }
}
