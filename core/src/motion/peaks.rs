//! The peaks of a ground motion, and checks that one motion can have both.

use std::ops::RangeInclusive;

use crate::number::{plain, significant};
use crate::plausibility::{PGV_PGA_S, STRONGEST_PGA_G, STRONGEST_PGV_M_S, median};
use crate::units::G_M_S2;

/// Peak ground acceleration (m/s2) and velocity (m/s) of one motion.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Peaks {
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
}

impl Peaks {
    /// Limits the peaks to the range of records, which the tails of ground-motion models exceed.
    pub fn clamp_to_recorded(self) -> Peaks {
        let pga_m_s2 = self.pga_m_s2.min(STRONGEST_PGA_G * G_M_S2);
        let pgv_m_s = self.pgv_m_s.min(STRONGEST_PGV_M_S);
        let is_possible = pga_m_s2 == 0.0 || PGV_PGA_S.contains(&(pgv_m_s / pga_m_s2));
        let [least, most] = [PGV_PGA_S.start(), PGV_PGA_S.end()].map(|ratio_s| ratio_s * pga_m_s2);
        Peaks { pga_m_s2, pgv_m_s: if is_possible { pgv_m_s } else { pgv_m_s.clamp(least, most) } }
    }

    /// Fails, with the reason, where no motion has both peaks.
    pub fn validate(self) -> Result<(), String> {
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

/// Limits of the medians of a table of motions: of PGA (g) and of PGV (m/s), and the range of PGV/PGA (s).
const STRONGEST_MEDIAN: f64 = 3.0;
const MEDIAN_PGV_PGA_S: RangeInclusive<f64> = 0.015..=0.6;

/// Fails, with the reason, where the medians of the peaks of a table of motions show a wrong unit.
pub fn validate_medians(motions: impl Iterator<Item = Peaks> + Clone) -> Result<(), String> {
    let pga_g = median(motions.clone().map(|peaks| peaks.pga_m_s2 / G_M_S2));
    let pgv = median(motions.clone().map(|peaks| peaks.pgv_m_s));
    let ratio_s = median(motions.map(|peaks| peaks.pgv_m_s / peaks.pga_m_s2));
    let refuse = |name: &str, value: f64, expected: &str| {
        let value = significant(value, 3);
        Err(format!("the median {name} is {value}; {expected}"))
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
