use std::f64::consts::{FRAC_1_SQRT_2, PI};

use super::site::Site;

/// Density of the crust, g/cm3.
const DENSITY: f64 = 2.8;
/// Shear-wave velocity of the crust, km/s.
const SHEAR_VELOCITY_KM_S: f64 = 3.5;
/// Distance beyond which waves spread in two dimensions, km.
const CROSSOVER_KM: f64 = 40.0;
/// Quality factor Q = 180 f^0.45.
const QUALITY: f64 = 180.0;
const QUALITY_EXPONENT: f64 = 0.45;

/// C of the Fourier amplitude: 0.55 (radiation) / sqrt(2) (one of two components) x 2 (free surface) x 1e-20 / (4 pi rho
/// beta^3).
pub const CONSTANT: f64 = 0.55 * FRAC_1_SQRT_2 * 2.0 * 1e-20
    / (4.0 * PI * DENSITY * SHEAR_VELOCITY_KM_S * SHEAR_VELOCITY_KM_S * SHEAR_VELOCITY_KM_S);

/// The parts of the model that do not depend on the scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct StochasticModel {
    /// Site amplification V(f).
    pub site: Site,
    /// Attenuation near the surface, exp(-pi kappa f), s.
    pub kappa_s: f64,
    /// Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz.
    pub fmax_hz: Option<f64>,
    /// High-pass filter 1/(1 + (fc/f)^(2n)).
    pub low_cut: Option<LowCut>,
}

/// The high-pass filter 1/(1 + (fc/f)^(2n)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowCut {
    /// fc, Hz.
    pub corner_hz: f64,
    /// n.
    pub order: u32,
}

impl Default for StochasticModel {
    fn default() -> StochasticModel {
        StochasticModel { site: Site::Rock, kappa_s: 0.030, fmax_hz: None, low_cut: None }
    }
}

impl StochasticModel {
    /// What every scenario shares at a frequency (Hz): the step from displacement to acceleration (2 pi f)^2, the site
    /// and the filters.
    pub fn common_factor(&self, f: f64) -> f64 {
        let fmax = self.fmax_hz.map_or(1.0, |fmax| 1.0 / (1.0 + libm::pow(f / fmax, 8.0)).sqrt());
        let low_cut = self.low_cut.map_or(1.0, |LowCut { corner_hz, order }| {
            1.0 / (1.0 + libm::pow(corner_hz / f, 2.0 * f64::from(order)))
        });
        (2.0 * PI * f).powi(2)
            * self.site.amplification(f)
            * libm::exp(-PI * self.kappa_s * f)
            * fmax
            * low_cut
    }

    /// Fourier amplitude of the acceleration at a frequency (Hz), cm/s.
    pub fn fourier_amplitude_cm_s(&self, source: &Source, f: f64) -> f64 {
        source.amplitude(f, quality_exponent(f)) * self.common_factor(f)
    }
}

/// f / f^0.45 of f / Q(f), f in Hz: the frequency dependence of anelastic attenuation.
pub fn quality_exponent(f: f64) -> f64 {
    libm::pow(f, 1.0 - QUALITY_EXPONENT)
}

/// Source and path of an earthquake: two corner frequencies, spreading and anelastic attenuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// Lower corner fa, Hz.
    pub fa_hz: f64,
    /// Higher corner fb, Hz.
    pub fb_hz: f64,
    /// Weight of the higher corner.
    pub epsilon: f64,
    /// Effective distance R, km.
    pub distance_km: f64,
    /// C M0 G(R).
    scale: f64,
    /// pi R / (180 beta), s^0.55.
    attenuation: f64,
}

impl Source {
    /// Of an earthquake of moment magnitude `mw` at `re_km`.
    pub fn new(mw: f64, re_km: f64) -> Source {
        let depth_km = libm::exp10(-0.05 + 0.15 * mw);
        let distance_km = re_km.hypot(depth_km);
        let moment_dyne_cm = libm::exp10(1.5 * mw + 16.05);
        Source {
            fa_hz: libm::exp10(2.181 - 0.496 * mw),
            fb_hz: libm::exp10(2.410 - 0.408 * mw),
            epsilon: libm::exp10(0.605 - 0.255 * mw),
            distance_km,
            scale: CONSTANT * moment_dyne_cm * spreading(distance_km),
            attenuation: PI * distance_km / (QUALITY * SHEAR_VELOCITY_KM_S),
        }
    }

    /// Duration of the source and the path: 0.5/fa + 0.05 R, s.
    pub fn duration_s(&self) -> f64 {
        0.5 / self.fa_hz + 0.05 * self.distance_km
    }

    /// C M0 S(f) G(R) exp(-pi f R / (Q beta)), of the frequency (Hz) and its [`quality_exponent`].
    pub fn amplitude(&self, f: f64, quality: f64) -> f64 {
        let corner = |corner_hz: f64| 1.0 / (1.0 + (f / corner_hz) * (f / corner_hz));
        let shape = (1.0 - self.epsilon) * corner(self.fa_hz) + self.epsilon * corner(self.fb_hz);
        self.scale * shape * libm::exp(-self.attenuation * quality)
    }
}

/// G(R): 1/R to 40 km, then 1/40 sqrt(40/R).
fn spreading(distance_km: f64) -> f64 {
    if distance_km <= CROSSOVER_KM {
        1.0 / distance_km
    } else {
        (CROSSOVER_KM / distance_km).sqrt() / CROSSOVER_KM
    }
}
