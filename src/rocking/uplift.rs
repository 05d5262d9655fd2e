//! Where a structure at rest leaves its base.

use crate::units::{G_M_S2, PER_G};

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
    /// Finds the uplift, |a| = g tan(alpha), while the ground acceleration over g goes linearly from `start` to `end` (section 2.2).
    pub fn between(start: f64, end: f64, tan: f64) -> Option<Uplift> {
        if start.abs() > tan {
            return Some(Uplift { index: 0, fraction: 0.0, ground: start });
        }
        let threshold = tan.copysign(end);
        let fraction = (threshold - start) / (end - start);
        (end.abs() > tan).then_some(Uplift { index: 0, fraction, ground: threshold })
    }

    /// Finds the first uplift from sample `from` on of a structure that rests there, in `samples` of m/s2.
    pub fn next(samples: &[f64], from: usize, tan: f64) -> Option<Uplift> {
        // Rounding may let a sample pass here that is no larger than the threshold over g.
        let threshold = G_M_S2 * tan * (1.0 - f64::EPSILON);
        let mut index = from;
        loop {
            index += first_as_large(samples.get(index..)?, threshold)?;
            let before = index.saturating_sub(1).max(from);
            for index in before..=index {
                let start = samples[index] * PER_G;
                let end = samples.get(index + 1)? * PER_G;
                if let Some(uplift) = Uplift::between(start, end, tan) {
                    return Some(Uplift { index, ..uplift });
                }
            }
            index += 1;
        }
    }
}

/// Finds the first value of at least this size: by blocks, whose comparisons the compiler puts into vector registers.
fn first_as_large(values: &[f64], size: f64) -> Option<usize> {
    const BLOCK: usize = 16;
    let loud = |block: &[f64]| block.iter().fold(false, |loud, value| loud | (value.abs() >= size));
    let quiet = values.chunks(BLOCK).take_while(|block| !loud(block)).count() * BLOCK;
    let rest = values.get(quiet..)?;
    rest.iter().position(|value| value.abs() >= size).map(|at| quiet + at)
}
