use crate::motion::intensity::{peak, velocity};

/// By how much a record is scaled.
#[derive(Debug, Clone, PartialEq)]
pub enum Scaling {
    /// By each of these factors: as many motions.
    Factors(Vec<f64>),
    /// To this peak acceleration, m/s2.
    Pga(f64),
    /// To this peak velocity, m/s.
    Pgv(f64),
}

impl Scaling {
    /// How many motions it makes of one record.
    pub fn count(&self) -> usize {
        match self {
            Scaling::Factors(factors) => factors.len(),
            Scaling::Pga(_) | Scaling::Pgv(_) => 1,
        }
    }

    /// The factors for an acceleration (m/s2) of this time step (s); none if it has no peak that could be scaled.
    pub fn factors(&self, acceleration: &[f64], dt_s: f64) -> Vec<f64> {
        let to = |target: f64, peak: f64| Some(target / peak).filter(|factor| factor.is_finite());
        match self {
            Scaling::Factors(factors) => factors.clone(),
            Scaling::Pga(target) => Vec::from_iter(to(*target, peak(acceleration))),
            Scaling::Pgv(target) => Vec::from_iter(to(*target, peak(&velocity(acceleration, dt_s)))),
        }
    }
}
