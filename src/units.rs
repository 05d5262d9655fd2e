//! Constants that tie units together.

/// Acceleration of gravity, m/s2.
pub const G_M_S2: f64 = 9.81;

/// Inverse of [`G_M_S2`]: turns an acceleration in m/s2 into a fraction of g.
pub const PER_G: f64 = 1.0 / G_M_S2;

/// Centimetres in a metre: the published ground-motion relations are in cm/s and cm/s2.
pub const CM_PER_M: f64 = 100.0;
