//! What ground motions can be.

/// PGA, g, and PGV, m/s, beyond which nothing was ever recorded.
pub const STRONGEST_PGA_G: f64 = 4.5;
pub const STRONGEST_PGV_M_S: f64 = 5.0;
