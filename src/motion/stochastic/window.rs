/// Where the window peaks, as a share of its duration.
pub const PEAK_SHARE: f64 = 0.2;
/// What is left of it at its end.
const END_VALUE: f64 = 0.05;

/// The exponential window w = a (t/te)^b exp(-c t/te) of Saragoni & Hart as used by Boore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Scale that makes the peak 1.
    pub a: f64,
    /// Power of the rise.
    pub b: f64,
    /// Rate of the decay.
    pub c: f64,
    /// te: twice the duration of the source, s.
    pub duration_s: f64,
}

impl Window {
    /// For a motion whose source lasts `source_duration_s`.
    pub fn new(source_duration_s: f64) -> Window {
        let b = -PEAK_SHARE * END_VALUE.ln() / (1.0 + PEAK_SHARE * (PEAK_SHARE.ln() - 1.0));
        let c = b / PEAK_SHARE;
        let a = (std::f64::consts::E / PEAK_SHARE).powf(b);
        Window { a, b, c, duration_s: 2.0 * source_duration_s }
    }

    /// Value at a time from its beginning, s: 0 outside, 1 at its peak.
    pub fn value(&self, time_s: f64) -> f64 {
        let x = time_s / self.duration_s;
        if x <= 0.0 || x > 1.0 {
            return 0.0;
        }
        self.a * libm::exp(self.b * libm::log(x) - self.c * x)
    }
}
