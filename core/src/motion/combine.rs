use std::f64::consts::PI;

use super::fourier::Complex64;
use crate::spelling::unknown_word;

/// Treatment of the difference D = |H| - |P| of the Fourier amplitudes of high frequencies and pulse. The
/// literature leaves open what to do where the pulse is larger. Neither |D| nor D with its phase shifted by
/// half a cycle is offered: a wave as long as the pulse, with the phases of the high frequencies, never comes
/// to rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Difference>)]
pub enum Difference {
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
            Difference::Clamp => (h - p).max(0.0),
            Difference::None => h,
        }
    }
}

/// Computes the spectrum of the combined motion, (1 - K) D' exp(i arg H) + P, in place, from the spectra of
/// the high frequencies, H, and of the pulse, P. K is the moving mean over the duration of the pulse, in
/// `periods` of the first frequency: without waves slower than the pulse, the high frequencies move the
/// ground little further than it does.
pub fn combine(high_frequency: &mut [Complex64], pulse: &[Complex64], difference: Difference, periods: f64) {
    for (k, (h, p)) in high_frequency.iter_mut().zip(pulse).enumerate() {
        let (amplitude, pulse_amplitude) = (h.norm_sqr().sqrt(), p.norm_sqr().sqrt());
        // Without amplitude, H has no phase.
        if amplitude > 0.0 {
            *h *= (1.0 - moving_mean(k as f64 * periods)) * difference.kept(amplitude, pulse_amplitude)
                / amplitude;
        }
        *h += p;
    }
}

/// Computes the share of a wave that its mean under a raised cosine of so many periods leaves:
/// sin(pi x) / (pi x (1 - x^2)), 1 at 0 and 1/2 at 1.
fn moving_mean(periods: f64) -> f64 {
    match periods {
        ..1e-8 => 1.0,
        x if (x - 1.0).abs() < 1e-8 => 0.5,
        x => (PI * x).sin() / (PI * x * (1.0 - x * x)),
    }
}
