//! Ground motions without a model: noise that rises and decays.

use std::f64::consts::PI;

/// Returns `length` samples of up to 6 m/s2, reproducible by seed.
pub fn synthetic_motion(seed: u64, length: usize) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    (0..length).map(|k| 12.0 * next() * (PI * k as f64 / length as f64).sin()).collect()
}
