/// Every so many angles the sine and cosine are computed afresh.
pub const STRIDE: usize = 32;

/// Sines and cosines of [`STRIDE`] angles.
pub struct SinCos {
    /// Sines.
    pub sin: [f64; STRIDE],
    /// Cosines.
    pub cos: [f64; STRIDE],
}

/// Equal steps along a circle.
pub struct EqualSteps {
    start: f64,
    step: f64,
    /// Those from the first angle of a stride to each of it.
    between: SinCos,
}

impl EqualSteps {
    /// The angles `start`, `start + step`, `start + 2 step` ..., rad.
    pub fn new(start: f64, step: f64) -> EqualSteps {
        let mut between = SinCos { sin: [0.0; STRIDE], cos: [0.0; STRIDE] };
        for k in 0..STRIDE {
            (between.sin[k], between.cos[k]) = libm::sincos(k as f64 * step);
        }
        EqualSteps { start, step, between }
    }

    /// Of the angles of a stride, the first of which is number [`STRIDE`] times `stride`: by the addition theorem.
    #[inline(always)]
    pub fn stride(&self, stride: usize) -> SinCos {
        let (sin, cos) = libm::sincos(self.start + stride as f64 * STRIDE as f64 * self.step);
        let between = &self.between;
        let mut angles = SinCos { sin: [0.0; STRIDE], cos: [0.0; STRIDE] };
        for k in 0..STRIDE {
            angles.sin[k] = sin * between.cos[k] + cos * between.sin[k];
            angles.cos[k] = cos * between.cos[k] - sin * between.sin[k];
        }
        angles
    }
}
