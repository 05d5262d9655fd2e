//! A line through the plane of PGA and PGV along which a fragility depends on one peak alone.

use std::ops::RangeInclusive;

use super::case::Measure;
use super::model::FragilityModel;
use super::predictor::Predictor;
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::normal;
use crate::rocking::{Bound, Structure};
use crate::units::G_M_S2;

/// The peak that measures the intensity along a slice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peak {
    /// Peak ground acceleration, m/s2.
    Pga,
    /// Peak ground velocity, m/s.
    Pgv,
}

keywords!(Peak { Pga = "pga", Pgv = "pgv" });

/// The largest PGA (g) or PGV (m/s) that can be meant: several times what has been recorded.
const LARGEST_PEAK: f64 = 20.0;

/// PGV over PGA, s, above which they are likely exchanged or of other units: that of a record hardly passes 0.5 s,
/// that of a pulse of 12 s alone reaches 2 s.
const LARGEST_PEAKS_RATIO_S: f64 = 2.0;

/// PGA, m/s2, above all that was recorded: 4.36 g as a vector of three components (`records/plausibility.rs`).
pub const STRONGEST_PGA_M_S2: f64 = 4.5 * G_M_S2;

impl Peak {
    /// The unit in which it is usually stated, and its size in m/s2 or m/s.
    pub fn usual_unit(self) -> (&'static str, f64) {
        match self {
            Peak::Pga => ("g", G_M_S2),
            Peak::Pgv => ("m/s", 1.0),
        }
    }

    /// Where it can lie in its usual unit.
    pub const fn bound(self) -> Bound {
        let range = (0.0, LARGEST_PEAK);
        match self {
            Peak::Pga => {
                let slip = "is it in m/s2, cm/s2 or percent of g?";
                Bound { parameter: "pga", range, expected: "0 g or more, up to 20", slip }
            }
            Peak::Pgv => {
                Bound { parameter: "pgv", range, expected: "0 m/s or more, up to 20", slip: "is it in cm/s?" }
            }
        }
    }
}

/// PGV over PGA, s, below which a unit is likely wrong: a sine of 10 Hz has 0.016; of the 72 records of FEMA P695 the least has 0.06.
const LEAST_PEAKS_RATIO_S: f64 = 0.015;

/// What makes peaks doubtful.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PeaksDoubt {
    /// Too much PGV for the PGA.
    MuchVelocity,
    /// Too little.
    LittleVelocity,
    /// More PGA than was ever recorded.
    StrongestEver,
}

impl PeaksDoubt {
    /// All of them.
    pub const ALL: [PeaksDoubt; 3] =
        [PeaksDoubt::MuchVelocity, PeaksDoubt::LittleVelocity, PeaksDoubt::StrongestEver];

    /// What it is, and which slip it may be.
    pub const fn words(self) -> &'static str {
        match self {
            PeaksDoubt::MuchVelocity => {
                "a PGV (m/s) more than twice the PGA (m/s2): are they exchanged, or in other units?"
            }
            PeaksDoubt::LittleVelocity => {
                "a PGV less than 0.015 s times the PGA, as no earthquake that rocks anything: is the PGA in m/s2 in place of g, or the PGV in other units?"
            }
            PeaksDoubt::StrongestEver => {
                "a PGA above 4.5 g, more than was ever recorded: is it in m/s2 in place of g?"
            }
        }
    }

    /// The PGV / PGA, s, above which there is this doubt, and below which; and the PGA, m/s2, above which there is.
    pub const fn bounds(self) -> [Option<f64>; 3] {
        match self {
            PeaksDoubt::MuchVelocity => [Some(LARGEST_PEAKS_RATIO_S), None, None],
            PeaksDoubt::LittleVelocity => [None, Some(LEAST_PEAKS_RATIO_S), None],
            PeaksDoubt::StrongestEver => [None, None, Some(STRONGEST_PGA_M_S2)],
        }
    }

    fn holds(self, pga_m_s2: f64, pgv_m_s: f64) -> bool {
        let [above, below, pga] = self.bounds();
        above.is_none_or(|ratio| pgv_m_s > ratio * pga_m_s2)
            && below.is_none_or(|ratio| pgv_m_s > 0.0 && pgv_m_s < ratio * pga_m_s2)
            && pga.is_none_or(|pga| pga_m_s2 > pga)
    }
}

/// Why hardly any motion has these peaks (m/s2 and m/s), if so.
pub fn doubt_of_peaks(pga_m_s2: f64, pgv_m_s: f64) -> Option<PeaksDoubt> {
    PeaksDoubt::ALL.into_iter().find(|doubt| doubt.holds(pga_m_s2, pgv_m_s))
}

/// Where p PGV / PGA (rad/s, m/s and m/s2) of motions that rock a structure lies, far out.
const USUAL_RATIOS: RangeInclusive<f64> = 0.05..=1.0;

/// Why hardly any motions have this p PGV / PGA, if so.
pub fn doubt_of_ratio(ratio: f64) -> Option<String> {
    (!USUAL_RATIOS.contains(&ratio)).then(|| {
        format!(
            "ratio is {ratio}, but p PGV / PGA (p in rad/s, PGV in m/s, PGA in m/s2) is usually 0.1 to 0.6: is the PGA in g, or the PGV in cm/s?"
        )
    })
}

/// All motions whose p PGV / PGA is the same, ordered by one of the two peaks.
#[derive(Debug, Clone, PartialEq)]
pub struct Slice {
    pub structure: Structure,
    /// Which peak is the intensity.
    pub peak: Peak,
    /// p PGV / PGA.
    pub ratio: f64,
}

/// A lognormal distribution of capacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lognormal {
    /// Median.
    pub theta: f64,
    /// Standard deviation of the logarithm.
    pub beta: f64,
}

impl Lognormal {
    /// The probability that the capacity is up to an intensity.
    pub fn p_up_to(&self, intensity: f64) -> f64 {
        normal::cdf(libm::log(intensity / self.theta) / self.beta)
    }

    /// Arithmetic mean: theta exp(beta^2 / 2).
    pub fn mean(&self) -> f64 {
        self.theta * libm::exp(0.5 * self.beta * self.beta)
    }

    /// Arithmetic standard deviation: mean sqrt(exp(beta^2) - 1).
    pub fn standard_deviation(&self) -> f64 {
        self.mean() * libm::expm1(self.beta * self.beta).sqrt()
    }
}

impl Slice {
    /// The measures of Eq. 13 at an intensity (m/s2 or m/s); those that need a period are missing.
    pub fn measures(&self, intensity: f64) -> IntensityMeasures {
        let p = self.structure.p_rad_s;
        let (pga_m_s2, pgv_m_s) = match self.peak {
            Peak::Pga => (intensity, self.ratio * intensity / p),
            Peak::Pgv => (p * intensity / self.ratio, intensity),
        };
        IntensityMeasures::new(&self.structure, pga_m_s2, pgv_m_s, None, None)
    }

    /// The intensity (m/s2 or m/s) at which PGA/(g tan alpha) reaches this value; 1 is uplift.
    pub fn intensity_at_im4(&self, im4: f64) -> f64 {
        let pga_m_s2 = im4 * self.structure.uplift_acceleration_m_s2();
        let mut intensity = match self.peak {
            Peak::Pga => pga_m_s2,
            Peak::Pgv => self.ratio * pga_m_s2 / self.structure.p_rad_s,
        };
        // Rounding must not leave it on the near side of a jump.
        while self.measures(intensity).im4 < im4 {
            intensity = intensity.next_up();
        }
        intensity
    }

    /// The intensity (m/s2 or m/s) at which the PGA is the strongest that was ever recorded.
    pub fn intensity_at_strongest_pga(&self) -> f64 {
        self.intensity_at_im4(STRONGEST_PGA_M_S2 / self.structure.uplift_acceleration_m_s2())
    }

    /// The intensities at which probabilities jump: uplift, and the transition of P_ex.
    pub fn jumps(&self, model: &FragilityModel) -> Vec<f64> {
        std::iter::once(1.0).chain(model.transition_im4()).map(|im4| self.intensity_at_im4(im4)).collect()
    }

    /// P_ro along the slice: of measures that are powers of the intensity, the index is linear in its logarithm, so that
    /// the curve is lognormal in the intensity too. None where the fit bends or needs a period, or does not grow along the slice.
    pub fn overturning(&self, curve: &Predictor) -> Option<Lognormal> {
        if curve.bend.is_some() {
            return None;
        }
        let index = |intensity: f64| curve.at(&self.measures(intensity)).map(|index| index.value);
        let at_one = index(1.0)?;
        let slope = index(std::f64::consts::E)? - at_one;
        (slope > 0.0).then(|| Lognormal { theta: libm::exp(-at_one / slope), beta: 1.0 / slope })
    }

    /// The largest intensity for which there are data. Along a slice only IM4 and IM5 grow, each in proportion.
    pub fn largest_in_data(&self, model: &FragilityModel) -> f64 {
        let at_one = self.measures(1.0);
        let fits = [&model.demand.at_strong_motion().ln_median, &model.overturning];
        let ranges = fits.into_iter().flat_map(|fit| fit.measures().zip(fit.ranges));
        let growing = ranges.filter(|(measure, _)| matches!(measure, Measure::Im4 | Measure::Im5));
        let largest = growing.filter_map(|(measure, range)| Some(range[1] / measure.among(&at_one)?));
        largest.fold(f64::INFINITY, f64::min)
    }
}
