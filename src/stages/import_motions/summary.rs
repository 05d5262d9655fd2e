//! What was imported, in words.

use std::collections::BTreeMap;

use crate::motion::MotionMeasures;
use crate::number::{count, counted, fixed};
use crate::pipeline::options::listed;
use crate::records::processing::ImportedMotion;
use crate::units::G_M_S2;

/// Kinds of files that the summary names.
const NAMED: usize = 10;

/// What was read, so that a wrong unit is seen.
#[derive(Default)]
pub struct Summary {
    pulses: usize,
    magnitudes: usize,
    /// How many motions came of each format and unit.
    kinds: BTreeMap<String, usize>,
    /// PGA (g) and PGV (m/s) of each.
    peaks: Vec<[f64; 2]>,
}

impl Summary {
    pub fn add(&mut self, imported: &[ImportedMotion]) {
        for motion in imported {
            self.pulses += usize::from(motion.pulse.is_some());
            self.magnitudes += usize::from(motion.record.mw.is_some());
            let kind = format!("{} in {}", motion.record.format, motion.record.unit.name);
            *self.kinds.entry(kind).or_default() += 1;
            let MotionMeasures { pga_m_s2, pgv_m_s, .. } = motion.measured.measures;
            self.peaks.push([pga_m_s2 / G_M_S2, pgv_m_s]);
        }
    }

    pub fn text(&self, verticals: usize) -> String {
        let kinds: Vec<String> = self.kinds.iter().map(|(kind, n)| format!("{} {kind}", count(*n))).collect();
        let range = |peak: usize| {
            let values = self.peaks.iter().map(|peaks| peaks[peak]);
            let (low, high) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max));
            format!("{} to {}", fixed(low, 3), fixed(high, 3))
        };
        let left_out = match verticals {
            0 => String::new(),
            n => format!("; {} left out", counted(n, "vertical component")),
        };
        format!(
            "{} ({}), {} with a pulse, {} with a magnitude{left_out}\nPGA {} g, PGV {} m/s\n",
            counted(self.peaks.len(), "motion"),
            listed(&kinds, NAMED),
            count(self.pulses),
            count(self.magnitudes),
            range(0),
            range(1)
        )
    }
}
