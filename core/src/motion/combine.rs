use super::fourier::Complex64;
use crate::spelling::unknown_word;

/// Treatment of the difference D = |H| - |P| of the Fourier amplitudes of high frequencies and pulse. The
/// literature leaves open what to do where the pulse is larger.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Difference>)]
pub enum Difference {
    /// |D|.
    Absolute,
    /// D; a negative one shifts the phase by half a cycle.
    Signed,
    /// max(D, 0).
    Clamp,
    /// |H|: the sum of both motions.
    None,
}

/// When the pulse peaks in the high-frequency motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case", parse_err_ty = String, parse_err_fn = unknown_word::<Epoch>)]
pub enum Epoch {
    /// At the peak of the window.
    EnvelopePeak,
    /// At the peak ground acceleration of the high frequencies.
    Pga,
    /// At the peak ground velocity of the high frequencies.
    Pgv,
}

impl Difference {
    /// Computes D', the amplitude of the high frequencies in the combined motion, from |H| and |P|.
    pub fn kept(self, h: f64, p: f64) -> f64 {
        match self {
            Difference::Absolute => (h - p).abs(),
            Difference::Signed => h - p,
            Difference::Clamp => (h - p).max(0.0),
            Difference::None => h,
        }
    }
}

/// Computes the spectrum of the combined motion, D' exp(i arg H) + P, in place, from the spectra of the high
/// frequencies, H, and of the pulse, P. Its mean is 0, so that the ground comes to rest.
pub fn combine(high_frequency: &mut [Complex64], pulse: &[Complex64], difference: Difference) {
    for (h, p) in high_frequency.iter_mut().zip(pulse) {
        let (amplitude, pulse_amplitude) = (h.norm_sqr().sqrt(), p.norm_sqr().sqrt());
        // Without amplitude, H has no phase.
        if amplitude > 0.0 {
            *h *= difference.kept(amplitude, pulse_amplitude) / amplitude;
        }
        *h += p;
    }
    if let Some(mean) = high_frequency.first_mut() {
        *mean = Complex64::ZERO;
    }
}
