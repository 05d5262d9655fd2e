//! What was imported, in words.

use std::collections::{BTreeMap, HashMap, HashSet};

use anyhow::bail;

use crate::motion::MotionMeasures;
use crate::number::listed;
use crate::number::{count, counted, fixed};
use crate::records::processing::{ImportedMotion, SourceFile};
use crate::units::G_M_S2;

/// Kinds of files that the summary names.
const NAMED: usize = 10;

/// What was read, so that a wrong unit is seen.
#[derive(Default)]
pub struct Summary {
    ids: HashSet<String>,
    /// By the hashes of their contents.
    files: HashMap<String, String>,
    pulses: usize,
    magnitudes: usize,
    /// How many motions came of each format and unit.
    kinds: BTreeMap<String, usize>,
    pga_g: Vec<f64>,
    pgv_m_s: Vec<f64>,
}

impl Summary {
    /// Adds motions, which must differ from those before in their names and files.
    pub fn add(&mut self, imported: &[ImportedMotion]) -> anyhow::Result<()> {
        for motion in imported {
            let SourceFile { path, blake3 } = &motion.source;
            let first = self.files.entry(blake3.clone()).or_insert_with(|| path.clone());
            if first != path {
                bail!("{path}: the same record as {first}; leave out one");
            }
            let id = &motion.motion_id;
            if !self.ids.insert(id.clone()) {
                bail!("{path}: two motions are called '{id}'; rename the file");
            }
            self.pulses += usize::from(motion.pulse.is_some());
            self.magnitudes += usize::from(motion.record.mw.is_some());
            let kind = format!("{} in {}", motion.record.format, motion.record.unit.name);
            *self.kinds.entry(kind).or_default() += 1;
            let MotionMeasures { pga_m_s2, pgv_m_s, .. } = motion.measured.measures;
            self.pga_g.push(pga_m_s2 / G_M_S2);
            self.pgv_m_s.push(pgv_m_s);
        }
        Ok(())
    }

    pub fn is_empty(&self) -> bool {
        self.pga_g.is_empty()
    }

    pub fn text(&self, left_out: Option<String>) -> String {
        let kinds: Vec<String> = self.kinds.iter().map(|(kind, n)| format!("{} {kind}", count(*n))).collect();
        let left_out = left_out.map_or(String::new(), |components| format!("; {components} left out"));
        format!(
            "{} ({}), {} with a pulse, {} with a magnitude{left_out}\nPGA {} g, PGV {} m/s\n",
            counted(self.pga_g.len(), "motion"),
            listed(&kinds, NAMED),
            count(self.pulses),
            count(self.magnitudes),
            range(&self.pga_g),
            range(&self.pgv_m_s)
        )
    }
}

fn range(values: &[f64]) -> String {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    format!("{} to {}", fixed(low, 3), fixed(values.iter().copied().fold(0.0, f64::max), 3))
}
