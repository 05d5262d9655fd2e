//! Constants that tie units together.

/// Acceleration of gravity, m/s2.
pub const G_M_S2: f64 = 9.81;

/// Its inverse: what makes an acceleration in m/s2 one over g.
pub const PER_G: f64 = 1.0 / G_M_S2;

/// Centimetres in a metre: the published ground-motion relations are in cm/s and cm/s2.
pub const CM_PER_M: f64 = 100.0;
