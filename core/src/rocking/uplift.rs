use crate::units::G_PER_M_S2;

/// When a structure at rest leaves its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uplift {
    /// Index of the sample before uplift.
    pub index: usize,
    /// Fraction of the time from that sample, or from the current time, to the next sample.
    pub fraction: f64,
    /// Ground acceleration over g at uplift.
    pub ground: f64,
}

impl Uplift {
    /// Finds the uplift, |a| = g tan(alpha) (Eq. 5), while the ground acceleration over g goes linearly from
    /// `start` to `end`; `tan` is tan(alpha).
    pub fn between(start: f64, end: f64, tan: f64) -> Option<Uplift> {
        if start.abs() > tan {
            return Some(Uplift { index: 0, fraction: 0.0, ground: start });
        }
        (end.abs() > tan).then(|| {
            let ground = tan.copysign(end);
            Uplift { index: 0, fraction: (ground - start) / (end - start), ground }
        })
    }

    /// Finds the first uplift from sample `from` on; `samples` are in m/s2.
    pub fn next(samples: &[f64], from: usize, tan: f64) -> Option<Uplift> {
        let loud = from + samples[from..].iter().position(|a| a.abs() * G_PER_M_S2 > tan)?;
        let index = loud.saturating_sub(1).max(from);
        let uplift = Uplift::between(samples[index] * G_PER_M_S2, samples.get(index + 1)? * G_PER_M_S2, tan)?;
        Some(Uplift { index, ..uplift })
    }
}
