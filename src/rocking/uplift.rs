//! Where a structure at rest leaves its base.

use crate::units::PER_G;

/// The moment at which a structure at rest leaves its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uplift {
    /// Index of the sample before it.
    pub index: usize,
    /// Fraction that has passed of the time from that sample, or from where the structure stands, to the next.
    pub fraction: f64,
    /// Ground acceleration over g.
    pub ground: f64,
}

impl Uplift {
    /// Finds the uplift, |a| = g tan(alpha) (Eq. 5), while the ground acceleration over g goes linearly from `start` to `end`.
    pub fn between(start: f64, end: f64, tan: f64) -> Option<Uplift> {
        if start.abs() > tan {
            return Some(Uplift { index: 0, fraction: 0.0, ground: start });
        }
        (end.abs() > tan).then(|| {
            let ground = tan.copysign(end);
            Uplift { index: 0, fraction: (ground - start) / (end - start), ground }
        })
    }

    /// Finds the first uplift from sample `from` on of a structure that rests there, in `samples` of m/s2.
    pub fn next(samples: &[f64], from: usize, tan: f64) -> Option<Uplift> {
        let loud = from + samples[from..].iter().position(|a| a.abs() * PER_G > tan)?;
        let index = loud.saturating_sub(1).max(from);
        let uplift = Uplift::between(samples[index] * PER_G, samples.get(index + 1)? * PER_G, tan)?;
        Some(Uplift { index, ..uplift })
    }
}
