//! The peaks of a ground motion, and whether they can be those of one.

use std::ops::RangeInclusive;

use crate::number::{plain, significant};
use crate::plausibility::{PGV_PGA_S, STRONGEST_PGA_G, STRONGEST_PGV_M_S, median};
use crate::units::G_M_S2;

/// The peaks of a ground motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Peaks {
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
}

impl Peaks {
    /// Moves peaks beyond any record to the rim of what was recorded: tails of ground-motion models have such
    /// motions.
    pub fn at_rim(self) -> Peaks {
        let pga_m_s2 = self.pga_m_s2.min(STRONGEST_PGA_G * G_M_S2);
        let pgv_m_s = self.pgv_m_s.min(STRONGEST_PGV_M_S);
        let is_possible = pga_m_s2 == 0.0 || PGV_PGA_S.contains(&(pgv_m_s / pga_m_s2));
        let [least, most] = [PGV_PGA_S.start(), PGV_PGA_S.end()].map(|ratio_s| ratio_s * pga_m_s2);
        Peaks { pga_m_s2, pgv_m_s: if is_possible { pgv_m_s } else { pgv_m_s.clamp(least, most) } }
    }

    /// Why they cannot be of one motion.
    #[doc(hidden)]
    pub fn judge(self) -> Result<(), String> {
        let ratio_s = self.pgv_m_s / self.pga_m_s2;
        match ratio_s.is_nan() || PGV_PGA_S.contains(&ratio_s) {
            true => Ok(()),
            false => Err(format!(
                "PGA is {} g and PGV {} m/s; expected PGV/PGA of 0.005 to 3 s (PGA in m/s2): a wrong unit?",
                plain(self.pga_m_s2 / G_M_S2),
                plain(self.pgv_m_s)
            )),
        }
    }
}

/// Peaks, g and m/s, that the typical motion of a table does not reach, and its PGV/PGA, s.
const STRONGEST_MEDIAN: f64 = 3.0;
const MEDIAN_PGV_PGA_S: RangeInclusive<f64> = 0.015..=0.6;

/// Judges the motions of a table by the medians of their peaks, which show a wrong unit.
#[doc(hidden)]
pub fn judge_medians(motions: impl Iterator<Item = Peaks> + Clone) -> Result<(), String> {
    let pga_g = median(motions.clone().map(|peaks| peaks.pga_m_s2 / G_M_S2));
    let pgv = median(motions.clone().map(|peaks| peaks.pgv_m_s));
    let ratio_s = median(motions.map(|peaks| peaks.pgv_m_s / peaks.pga_m_s2));
    let refuse = |name: &str, value: f64, expected: &str| {
        let value = significant(value, 3);
        Err(format!("half of the rows have {name} above {value}; {expected}"))
    };
    match (pga_g, pgv, ratio_s) {
        (Some(pga), ..) if pga > STRONGEST_MEDIAN => {
            refuse("PGA in g", pga, "expected up to 3 g: is it in m/s2?")
        }
        (_, Some(pgv), _) if pgv > STRONGEST_MEDIAN => {
            refuse("PGV in m/s", pgv, "expected up to 3 m/s: is it in cm/s?")
        }
        (.., Some(ratio)) if !MEDIAN_PGV_PGA_S.contains(&ratio) => refuse(
            "PGV/PGA in s",
            ratio,
            "expected 0.015 to 0.6 s, of PGA in m/s2 and PGV in m/s: a wrong unit?",
        ),
        _ => Ok(()),
    }
}
