//! Checks that an acceleration can be of an earthquake: wrong units, wrong time steps and damaged samples
//! give motions that no instrument has recorded.

use crate::motion::measures::{peak, velocity};
use crate::number::significant;
use crate::plausibility::{
    PGV_PGA_RECORDED_S, RARE_PGA_G, RARE_PGV_M_S, RECORDED_STEPS_S, STRONGEST_PGA_G, STRONGEST_PGV_M_S,
    WEAKEST_PGA_G,
};
use crate::units::G_M_S2;

/// Least number of samples: half a second at a step of 0.02 s, enough to rise, peak and decay.
const FEWEST_SAMPLES: usize = 25;
/// Highest mean frequency, Hz: the ground damps frequencies above some 20 Hz even on the hardest rock; the
/// records of FEMA P695 have 1.5 to 14.
const HIGHEST_FREQUENCY_HZ: f64 = 30.0;
/// A spike has more than the first share of the sum of squares, and neighbours below the second share of it.
/// The largest samples of FEMA P695 have at most 0.044 of the sum, and neighbours of at least 0.79.
const SPIKE: (f64, f64) = (0.02, 0.25);
/// A drift is a final velocity above the first value, m/s, and the second, as a fraction of PGV: the ground
/// is at rest at the end of a record. The records of FEMA P695 end at 0.015 m/s and 0.025 of PGV at most.
const DRIFT: (f64, f64) = (0.1, 0.5);
/// The end of a record (share of its samples), its beginning (s), and the share of the PGA that neither
/// reaches: of 607 components (PEER, FEMA P695) the loudest end has 0.21, the loudest beginning 0.06.
const LAST: f64 = 0.05;
const FIRST_S: f64 = 0.1;
const QUIET: f64 = 0.3;
/// So many samples at the positive and at the negative peak show that both are cut.
const AT_PEAK: usize = 3;

fn digits(value: &f64) -> String {
    significant(*value, 3)
}

/// Why a motion is implausible: value found, value expected, likely mistake.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Implausibility {
    #[error("dt {} s; expected 0.0001 to 0.1 s: milliseconds, or sample numbers?", digits(.dt_s))]
    TimeStep { dt_s: f64 },
    #[error("{samples} samples; expected 25 or more: a part of a record, or another table?")]
    FewSamples { samples: usize },
    #[error("0 throughout; expected a motion: another column?")]
    Still,
    #[error("sample {sample} of {} g; those beside it are below a quarter: a spike?", digits(.pga_g))]
    Spike { sample: usize, pga_g: f64 },
    #[error("PGA {} g; the largest ever recorded is 4 g: another unit, such as cm/s2?", digits(.pga_g))]
    Pga { pga_g: f64 },
    #[error("no sample below 0; expected both signs: a spectrum, or absolute values?")]
    OneSided,
    #[error(
        "velocity {} m/s at the end; expected rest: an uncorrected baseline (import-motions --baseline linear)?",
        digits(.velocity_m_s)
    )]
    Drift { velocity_m_s: f64 },
    #[error("PGV {} m/s; records reach 3 m/s: another unit or time step?", digits(.pgv_m_s))]
    Pgv { pgv_m_s: f64 },
    #[error("PGV/PGA {} s; FEMA P695 has up to 0.5 s: velocity, or another time step?", digits(.ratio_s))]
    Slow { ratio_s: f64 },
    #[error("mean frequency {} Hz; records reach 20 Hz: another time step?", digits(.frequency_hz))]
    Fast { frequency_hz: f64 },
    #[error("PGA {} g; too weak to rock anything: g in place of cm/s2?", digits(.pga_g))]
    WeakPga { pga_g: f64 },
    #[error("{} % of its PGA in {part}; expected rest: cut off?", digits(&(100.0 * .share)))]
    CutOff { share: f64, part: &'static str },
    #[error("several samples at PGA {} g of both signs; expected one: clipped?", digits(.pga_g))]
    Clipped { pga_g: f64 },
    #[error("PGA {} g; few records exceed 2 g: is it in m/s2?", digits(.pga_g))]
    RarePga { pga_g: f64 },
    #[error("PGV {} m/s; few records exceed 2.5 m/s: is it in another unit?", digits(.pgv_m_s))]
    RarePgv { pgv_m_s: f64 },
}

impl Implausibility {
    /// Returns whether no record was ever like this; a few are weak, strong, cut off or clipped.
    pub fn is_impossible(&self) -> bool {
        use Implausibility::{Clipped, CutOff, RarePga, RarePgv, WeakPga};
        !matches!(self, WeakPga { .. } | CutOff { .. } | Clipped { .. } | RarePga { .. } | RarePgv { .. })
    }
}

/// Returns the reason why peaks (m/s2 and m/s, either may be unknown) are rare, if they are.
pub fn rarity(pga_m_s2: Option<f64>, pgv_m_s: Option<f64>) -> Option<Implausibility> {
    let pga_g = pga_m_s2.map(|pga| pga / G_M_S2).filter(|pga| *pga > RARE_PGA_G);
    let pgv_m_s = pgv_m_s.filter(|pgv| *pgv > RARE_PGV_M_S);
    let rare_pgv = pgv_m_s.map(|pgv_m_s| Implausibility::RarePgv { pgv_m_s });
    pga_g.map(|pga_g| Implausibility::RarePga { pga_g }).or(rare_pgv)
}

/// Checks an acceleration (m/s2) at steps of `dt_s`. Returns the first warning.
pub fn implausibility(acceleration: &[f64], dt_s: f64) -> Option<Implausibility> {
    let samples = acceleration.len();
    let velocity = velocity(acceleration, dt_s);
    let (pga_m_s2, pgv_m_s) = (peak(acceleration), peak(&velocity));
    let (pga_g, ratio_s) = (pga_m_s2 / G_M_S2, pgv_m_s / pga_m_s2);
    let velocity_m_s = velocity.last().map_or(0.0, |last| last.abs());
    let frequency_hz = mean_frequency_hz(acceleration, dt_s);
    let spike = spike(acceleration, pga_m_s2);
    let warnings = [
        (!RECORDED_STEPS_S.contains(&dt_s), Implausibility::TimeStep { dt_s }),
        (samples < FEWEST_SAMPLES, Implausibility::FewSamples { samples }),
        (pga_m_s2 == 0.0, Implausibility::Still),
        (spike.is_some(), Implausibility::Spike { sample: spike.map_or(0, |at| at + 1), pga_g }),
        (pga_g > STRONGEST_PGA_G, Implausibility::Pga { pga_g }),
        (acceleration.iter().all(|a| *a >= 0.0), Implausibility::OneSided),
        (velocity_m_s > DRIFT.0.max(DRIFT.1 * pgv_m_s), Implausibility::Drift { velocity_m_s }),
        (pgv_m_s > STRONGEST_PGV_M_S, Implausibility::Pgv { pgv_m_s }),
        (ratio_s > *PGV_PGA_RECORDED_S.end(), Implausibility::Slow { ratio_s }),
        (
            frequency_hz > HIGHEST_FREQUENCY_HZ || ratio_s < *PGV_PGA_RECORDED_S.start(),
            Implausibility::Fast { frequency_hz },
        ),
        (pga_g < WEAKEST_PGA_G, Implausibility::WeakPga { pga_g }),
        (pga_g > RARE_PGA_G, Implausibility::RarePga { pga_g }),
        (pgv_m_s > RARE_PGV_M_S, Implausibility::RarePgv { pgv_m_s }),
    ];
    warnings.into_iter().find_map(|(is_so, warning)| is_so.then_some(warning))
}

/// Checks that an acceleration (m/s2) at steps of `dt_s` is a whole record: quiet at both ends, not clipped.
pub fn incompleteness(acceleration: &[f64], dt_s: f64) -> Option<Implausibility> {
    let (samples, pga_m_s2) = (acceleration.len(), peak(acceleration));
    let (start, end) = ((FIRST_S / dt_s) as usize, ((1.0 - LAST) * samples as f64) as usize);
    let ends =
        [(&acceleration[..start.min(samples)], "its first 0.1 s"), (&acceleration[end..], "its last 5 %")];
    let mut shares = ends.into_iter().map(|(end, part)| (peak(end) / pga_m_s2, part));
    let cut = shares.find(|(share, _)| *share > QUIET);
    let count_at = |top: f64| acceleration.iter().filter(|a| **a == top).count();
    let is_clipped = count_at(pga_m_s2).min(count_at(-pga_m_s2)) >= AT_PEAK;
    let clipped = Implausibility::Clipped { pga_g: pga_m_s2 / G_M_S2 };
    cut.map(|(share, part)| Implausibility::CutOff { share, part }).or(is_clipped.then_some(clipped))
}

fn spike(acceleration: &[f64], pga: f64) -> Option<usize> {
    let at = acceleration.iter().position(|a| a.abs() == pga)?;
    let mut neighbours =
        [at.checked_sub(1), Some(at + 1)].into_iter().flatten().filter_map(|k| acceleration.get(k));
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    (neighbours.all(|a| a.abs() < SPIKE.1 * pga) && pga * pga > SPIKE.0 * squares).then_some(at)
}

/// Computes the root mean square frequency, Hz.
fn mean_frequency_hz(acceleration: &[f64], dt_s: f64) -> f64 {
    let steps: f64 = acceleration.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    (steps / squares).sqrt() / (std::f64::consts::TAU * dt_s)
}
