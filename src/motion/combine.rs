//! High frequencies and pulse into one motion (section 2.1.3).

use super::fourier::Complex64;

use crate::keyword::keywords;
use crate::wide::widest_on;

/// What becomes of the difference D = |H| - |P| of the Fourier amplitudes of high frequencies and pulse. The literature
/// leaves it open where the pulse is the larger one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Difference {
    /// |D|.
    Absolute,
    /// D, whose sign turns the phase by half a cycle.
    Signed,
    /// D where positive, else nothing.
    Clamp,
    /// No difference: the plain sum of both.
    None,
}

/// The moment of the high-frequency motion at which the pulse peaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Epoch {
    /// The peak of the window.
    EnvelopePeak,
    /// The peak ground acceleration of the high frequencies.
    Pga,
    /// Their peak ground velocity.
    Pgv,
}

keywords!(Difference { Absolute = "absolute", Signed = "signed", Clamp = "clamp", None = "none" });
keywords!(Epoch { EnvelopePeak = "envelope-peak", Pga = "pga", Pgv = "pgv" });

impl Difference {
    /// Computes what the high frequencies keep of their amplitude, D' / |H|, where the pulse is `ratio` = |P| / |H| times as large.
    #[inline(always)]
    pub fn kept(self, ratio: f64) -> f64 {
        match self {
            Difference::Absolute => (1.0 - ratio).abs(),
            Difference::Signed => 1.0 - ratio,
            Difference::Clamp => (1.0 - ratio).max(0.0),
            Difference::None => 1.0,
        }
    }
}

/// Makes the spectrum of the combined motion, D' exp(i arg H) + P, of that of the high frequencies, H: steps 4 to 6 of section
/// 2.1.3 on Fourier coefficients. The mean stays 0, so that the ground comes to rest.
pub fn combine(high_frequency: &mut [Complex64], pulse: &[Complex64], difference: Difference) {
    // Steps 4 and 5: D' of D = |H| - |P| takes the phase of H; step 6 adds P.
    // One loop for each: a choice within it would keep it out of wide registers.
    match difference {
        Difference::Absolute => add(high_frequency, pulse, |ratio| Difference::Absolute.kept(ratio)),
        Difference::Signed => add(high_frequency, pulse, |ratio| Difference::Signed.kept(ratio)),
        Difference::Clamp => add(high_frequency, pulse, |ratio| Difference::Clamp.kept(ratio)),
        Difference::None => add(high_frequency, pulse, |ratio| Difference::None.kept(ratio)),
    }
    if let Some(mean) = high_frequency.first_mut() {
        *mean = Complex64::ZERO;
    }
}

/// Adds the pulse to what is kept of the high frequencies.
fn add(high_frequency: &mut [Complex64], pulse: &[Complex64], kept: impl Fn(f64) -> f64) {
    widest_on(
        high_frequency,
        #[inline(always)]
        |high_frequency| {
            for (h, p) in high_frequency.iter_mut().zip(pulse) {
                let power = h.norm_sqr();
                let kept = kept((p.norm_sqr() / power).sqrt());
                // Where there is no high frequency there is no phase either.
                *h = *h * if power > 0.0 { kept } else { 1.0 } + p;
            }
        },
    );
}
