//! High frequencies: Boore's stochastic method, source of Atkinson & Silva (2000) (section 2.1.2).

use std::f64::consts::{E, FRAC_1_SQRT_2, PI};

use super::amplification::SiteAmplification;

// Crust, spreading and attenuation of Atkinson & Silva (2000).
/// Density of the crust, g/cm3.
const DENSITY: f64 = 2.8;
/// Distance (km) at which geometric spreading changes from 1/R to 1/sqrt(R).
const CROSSOVER_KM: f64 = 40.0;
/// Quality factor Q = 180 f^0.45.
const QUALITY: f64 = 180.0;
const QUALITY_EXPONENT: f64 = 0.45;
/// Peak of the window as a fraction of its duration: epsilon of Boore (2003).
pub const PEAK_SHARE: f64 = 0.2;
/// Value of the window at its end: eta of Boore (2003).
const END_VALUE: f64 = 0.05;

/// The stochastic model apart from the scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct StochasticModel {
    pub site: SiteAmplification,
    /// Shear-wave velocity beta of the crust, km/s.
    pub shear_velocity_km_s: f64,
    /// te of the window over the duration T of source and path: 2 (Boore 2003), or 1.
    pub window: f64,
    /// kappa of the near-surface attenuation exp(-pi kappa f), s.
    pub kappa_s: f64,
    /// Corner fmax of the low-pass filter 1/sqrt(1 + (f/fmax)^8), Hz.
    pub fmax_hz: f64,
    /// Corner fc of the high-pass filter 1/(1 + (fc/f)^8), Hz.
    pub low_cut_hz: Option<f64>,
}

impl Default for StochasticModel {
    fn default() -> StochasticModel {
        StochasticModel {
            site: SiteAmplification::rock(),
            shear_velocity_km_s: 3.7,
            window: 1.0,
            kappa_s: 0.035,
            fmax_hz: 15.0,
            low_cut_hz: None,
        }
    }
}

impl StochasticModel {
    /// Computes the Fourier amplitude of the ground acceleration, cm/s, at a frequency f (Hz):
    /// A(f) = C M0 (2 pi f)^2 S(f) G(R) exp(-pi f R / (Q beta)) V(f) exp(-pi kappa f), times the filters.
    pub fn fourier_amplitude_cm_s(&self, source: &Source, f: f64) -> f64 {
        let r = source.distance_km;
        // f / Q with Q = 180 f^0.45.
        let f_per_q = f.powf(1.0 - QUALITY_EXPONENT) / QUALITY;
        constant(self.shear_velocity_km_s)
            * source.moment_dyne_cm
            * (2.0 * PI * f).powi(2)
            * source.shape(f)
            * spreading(r)
            * (-PI * (f_per_q * r / self.shear_velocity_km_s + self.kappa_s * f)).exp()
            * self.site.amplification(f)
            * self.filters(f)
    }

    fn filters(&self, f: f64) -> f64 {
        let fmax = 1.0 / (1.0 + (f / self.fmax_hz).powi(8)).sqrt();
        let low_cut = self.low_cut_hz.map_or(1.0, |corner| 1.0 / (1.0 + (corner / f).powf(8.0)));
        fmax * low_cut
    }
}

/// Computes the constant C of the amplitude: 0.55 (radiation) / sqrt(2) (one of two components) x 2 (free
/// surface) x 1e-20 / (4 pi rho beta^3).
pub fn constant(shear_velocity_km_s: f64) -> f64 {
    0.55 * FRAC_1_SQRT_2 * 2.0 * 1e-20 / (4.0 * PI * DENSITY * shear_velocity_km_s.powi(3))
}

/// The two-corner source of Atkinson & Silva (2000) at a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    pub fa_hz: f64,
    pub fb_hz: f64,
    /// Weight epsilon of the higher corner.
    pub epsilon: f64,
    pub distance_km: f64,
    pub moment_dyne_cm: f64,
}

impl Source {
    pub fn new(mw: f64, re_km: f64) -> Source {
        // The depth h of the equivalent point source: R = sqrt(re^2 + h^2). The magnitude sets depth, corners
        // and weight (Atkinson & Silva 2000).
        let depth_km = 10_f64.powf(-0.05 + 0.15 * mw);
        Source {
            fa_hz: 10_f64.powf(2.181 - 0.496 * mw),
            fb_hz: 10_f64.powf(2.410 - 0.408 * mw),
            epsilon: 10_f64.powf(0.605 - 0.255 * mw),
            distance_km: re_km.hypot(depth_km),
            // Hanks & Kanamori (1979).
            moment_dyne_cm: 10_f64.powf(1.5 * mw + 16.05),
        }
    }

    /// Computes the duration of source and path, s: 0.5/fa + 0.05 R.
    pub fn duration_s(&self) -> f64 {
        0.5 / self.fa_hz + 0.05 * self.distance_km
    }

    /// Computes S(f) = (1 - epsilon) / (1 + (f/fa)^2) + epsilon / (1 + (f/fb)^2).
    fn shape(&self, f: f64) -> f64 {
        let [low, high] = [self.fa_hz, self.fb_hz].map(|corner_hz| 1.0 / (1.0 + (f / corner_hz).powi(2)));
        (1.0 - self.epsilon) * low + self.epsilon * high
    }
}

/// Computes the geometric spreading G(R): 1/R up to 40 km, sqrt(40/R)/40 beyond.
fn spreading(distance_km: f64) -> f64 {
    if distance_km <= CROSSOVER_KM {
        1.0 / distance_km
    } else {
        (CROSSOVER_KM / distance_km).sqrt() / CROSSOVER_KM
    }
}

/// The window w = a (t/te)^b exp(-c t/te) of Saragoni & Hart, with the parameters of Boore (2003).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    /// te, s.
    pub duration_s: f64,
}

impl Window {
    pub fn new(duration_s: f64) -> Window {
        // Boore (2003): b = -epsilon ln eta / (1 + epsilon (ln epsilon - 1)), c = b / epsilon,
        // a = (e / epsilon)^b.
        let b = -PEAK_SHARE * END_VALUE.ln() / (1.0 + PEAK_SHARE * (PEAK_SHARE.ln() - 1.0));
        let c = b / PEAK_SHARE;
        let a = (E / PEAK_SHARE).powf(b);
        Window { a, b, c, duration_s }
    }

    /// Computes the window at a time (s) from its start: at most 1, and 0 outside.
    pub fn value(&self, time_s: f64) -> f64 {
        let x = time_s / self.duration_s;
        if x <= 0.0 || x > 1.0 {
            return 0.0;
        }
        self.a * (self.b * x.ln() - self.c * x).exp()
    }
}
