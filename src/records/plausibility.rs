//! Whether an acceleration can be that of an earthquake: a wrong unit, a wrong time step and damaged samples
//! give motions that no instrument has ever recorded.

use crate::motion::intensity::{peak, velocity};
use crate::units::G_M_S2;

/// Time steps of records, s: from 200 to 500 samples a second to film digitised by hand, with a margin.
const STEPS_S: (f64, f64) = (1e-4, 0.1);
/// The fewest samples of a motion that rises, peaks and dies away: half a second at the longest steps.
const FEWEST_SAMPLES: usize = 25;
/// The largest recorded PGA is that of Iwate-Miyagi 2008, IWTH25: 4278 cm/s2 as the vector of all three
/// components (Yamada, Mori & Heaton 2009, The slapdown phase in high-acceleration records of large
/// earthquakes, Seismological Research Letters 80), and so less of one; with a margin.
const LARGEST_PGA_G: f64 = 5.0;
/// Chi-Chi 1999 reached a PGV of 3.18 m/s (Wikipedia, "1999 Jiji earthquake"; no source was found that none
/// was larger); with a margin.
const LARGEST_PGV_M_S: f64 = 5.0;
/// Above these a motion is rare enough to ask for its unit: one in m/s2 under a heading that says g is ten
/// times too strong, and PGV/PGA does not show it.
const RARE_PGA_G: f64 = 2.0;
const RARE_PGV_M_S: f64 = 2.5;
/// The range of PGV/PGA, s: sines of 30 Hz have 0.005; the records of FEMA P695 have 0.06 to 0.47, and
/// records with the longest pulses about 0.9 (from memory, without a source).
const PGV_PGA_S: (f64, f64) = (0.005, 1.0);
/// The highest mean frequency, Hz: the ground damps what is faster, on the hardest rock above some 20 Hz; the
/// records of FEMA P695 have 1.5 to 14.
const HIGHEST_FREQUENCY_HZ: f64 = 30.0;
/// A spike: one sample that holds this share of the sum of squares, while its neighbours are below this share
/// of it. In the records of FEMA P695 the largest sample holds 0.044 at most, and its neighbours reach 0.79
/// of it at least.
const SPIKE: (f64, f64) = (0.02, 0.25);
/// The ground is at rest when a record ends: a velocity above this, m/s, that is also above this share of PGV
/// is a drift. The records of FEMA P695 end at 0.015 m/s and 0.025 of PGV at most.
const DRIFT: (f64, f64) = (0.1, 0.5);
/// Accelerographs resolve some 1e-4 g, and a motion of 1e-3 g rocks nothing that stands.
const WEAKEST_PGA_G: f64 = 1e-3;

/// Why a motion can hardly be one of an earthquake: what was found; what records have, and the likely slip.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Doubt {
    #[error("dt {} s; expected 0.0001 to 0.1 s: milliseconds, or sample numbers?", rounded(*.dt_s))]
    TimeStep { dt_s: f64 },
    #[error("{samples} samples; expected 25 or more: a part of a record, or another table?")]
    FewSamples { samples: usize },
    #[error("0 throughout; expected a motion: another column?")]
    Still,
    #[error("sample {sample} of {} g; those beside it are below a quarter: a spike?", rounded(*.pga_g))]
    Spike { sample: usize, pga_g: f64 },
    #[error("PGA {} g; the largest ever recorded is 4 g: another unit, such as cm/s2?", rounded(*.pga_g))]
    Pga { pga_g: f64 },
    #[error("velocity {} m/s at the end; expected rest: try --baseline linear", rounded(*.velocity_m_s))]
    Drift { velocity_m_s: f64 },
    #[error("PGV {} m/s; records reach 3 m/s: another unit or time step?", rounded(*.pgv_m_s))]
    Pgv { pgv_m_s: f64 },
    #[error("PGV/PGA {} s; records reach 0.9 s: velocity, or another time step?", rounded(*.ratio_s))]
    Slow { ratio_s: f64 },
    #[error("mean frequency {} Hz; records reach 20 Hz: another time step?", rounded(*.frequency_hz))]
    Fast { frequency_hz: f64 },
    #[error("PGA {} g; too weak to rock anything: g in place of cm/s2?", rounded(*.pga_g))]
    WeakPga { pga_g: f64 },
    #[error("PGA {} g; few records exceed 2 g: is it in m/s2, and called g?", rounded(*.pga_g))]
    RarePga { pga_g: f64 },
    #[error("PGV {} m/s; few records exceed 2.5 m/s: is it in m/s2, and called g?", rounded(*.pgv_m_s))]
    RarePgv { pgv_m_s: f64 },
}

impl Doubt {
    /// Tells whether no record was ever like this, rather than few that matter.
    pub fn is_impossible(&self) -> bool {
        !matches!(self, Doubt::WeakPga { .. } | Doubt::RarePga { .. } | Doubt::RarePgv { .. })
    }
}

/// Judges an acceleration (m/s2) at steps of `dt_s`; gives the first doubt.
pub fn doubt(acceleration: &[f64], dt_s: f64) -> Option<Doubt> {
    let samples = acceleration.len();
    let velocity = velocity(acceleration, dt_s);
    let (pga_m_s2, pgv_m_s) = (peak(acceleration), peak(&velocity));
    let (pga_g, ratio_s) = (pga_m_s2 / G_M_S2, pgv_m_s / pga_m_s2);
    let velocity_m_s = velocity.last().map_or(0.0, |last| last.abs());
    let frequency_hz = mean_frequency_hz(acceleration, dt_s);
    let spike = spike(acceleration, pga_m_s2);
    let doubts = [
        (!(STEPS_S.0..=STEPS_S.1).contains(&dt_s), Doubt::TimeStep { dt_s }),
        (samples < FEWEST_SAMPLES, Doubt::FewSamples { samples }),
        (pga_m_s2 == 0.0, Doubt::Still),
        (spike.is_some(), Doubt::Spike { sample: spike.map_or(0, |at| at + 1), pga_g }),
        (pga_g > LARGEST_PGA_G, Doubt::Pga { pga_g }),
        (velocity_m_s > DRIFT.0.max(DRIFT.1 * pgv_m_s), Doubt::Drift { velocity_m_s }),
        (pgv_m_s > LARGEST_PGV_M_S, Doubt::Pgv { pgv_m_s }),
        (ratio_s > PGV_PGA_S.1, Doubt::Slow { ratio_s }),
        (frequency_hz > HIGHEST_FREQUENCY_HZ || ratio_s < PGV_PGA_S.0, Doubt::Fast { frequency_hz }),
        (pga_g < WEAKEST_PGA_G, Doubt::WeakPga { pga_g }),
        (pga_g > RARE_PGA_G, Doubt::RarePga { pga_g }),
        (pgv_m_s > RARE_PGV_M_S, Doubt::RarePgv { pgv_m_s }),
    ];
    doubts.into_iter().find_map(|(is_so, doubt)| is_so.then_some(doubt))
}

/// The place of the largest sample, if it stands alone.
fn spike(acceleration: &[f64], pga: f64) -> Option<usize> {
    let at = acceleration.iter().position(|a| a.abs() == pga)?;
    let mut neighbours =
        [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|k| acceleration.get(k));
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    (neighbours.all(|a| a.abs() < SPIKE.1 * pga) && pga * pga > SPIKE.0 * squares).then_some(at)
}

/// The root of the mean square of frequencies, Hz: that of the sine whose steps are as large.
fn mean_frequency_hz(acceleration: &[f64], dt_s: f64) -> f64 {
    let steps: f64 = acceleration.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    (steps / squares).sqrt() / (std::f64::consts::TAU * dt_s)
}

/// To three digits.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.2e}");
    let plain = digits.parse::<f64>().ok().filter(|value| (1e-6..1e6).contains(&value.abs()));
    plain.map_or(digits, |value| value.to_string())
}
