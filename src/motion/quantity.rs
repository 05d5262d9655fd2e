use std::f64::consts::PI;

use crate::rocking::Structure;
use crate::units::G_M_S2;

/// What a measure of a motion is. p (1/time) and g tan alpha (an acceleration) make it dimensionless, as Eq. 13 does with the
/// peaks and periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A duration D, s: p D.
    Duration,
    /// A length d, m: p^2 d / (g tan alpha).
    Length,
    /// A velocity v, m/s: p v / (g tan alpha).
    Velocity,
    /// An acceleration a, m/s2: a / (g tan alpha).
    Acceleration,
    /// An Arias intensity pi / (2 g) times the integral of the squared acceleration, m/s: p times that integral / (g tan alpha)^2.
    AriasIntensity,
}

impl Quantity {
    /// A value (in the unit above) as it meets a structure.
    pub fn dimensionless(self, value: f64, structure: &Structure) -> f64 {
        let (p, uplift) = (structure.p_rad_s, structure.uplift_acceleration_m_s2());
        match self {
            Quantity::Duration => p * value,
            Quantity::Length => p * p * value / uplift,
            Quantity::Velocity => p * value / uplift,
            Quantity::Acceleration => value / uplift,
            Quantity::AriasIntensity => p * (2.0 * G_M_S2 / PI * value) / (uplift * uplift),
        }
    }
}
