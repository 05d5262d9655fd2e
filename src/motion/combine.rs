//! High frequencies and pulse into one motion (section 2.1.3).

use super::fourier::Complex64;

use crate::keyword::keywords;

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
    /// Computes D', what the high frequencies keep of their amplitude |H|, from |H| and |P|.
    pub fn kept(self, h: f64, p: f64) -> f64 {
        match self {
            Difference::Absolute => (h - p).abs(),
            Difference::Signed => h - p,
            Difference::Clamp => (h - p).max(0.0),
            Difference::None => h,
        }
    }
}

/// Makes the spectrum of the combined motion, D' exp(i arg H) + P, of that of the high frequencies, H, and that of the pulse, P.
/// The mean stays 0, so that the ground comes to rest.
pub fn combine(high_frequency: &mut [Complex64], pulse: &[Complex64], difference: Difference) {
    for (h, p) in high_frequency.iter_mut().zip(pulse) {
        let (amplitude, pulse_amplitude) = (h.norm_sqr().sqrt(), p.norm_sqr().sqrt());
        // Where there is no high frequency there is no phase either.
        if amplitude > 0.0 {
            *h *= difference.kept(amplitude, pulse_amplitude) / amplitude;
        }
        *h += p;
    }
    if let Some(mean) = high_frequency.first_mut() {
        *mean = Complex64::ZERO;
    }
}
