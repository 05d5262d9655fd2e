//! What was imported, in words.

use std::collections::{BTreeMap, HashMap, HashSet};

use anyhow::bail;

use crate::number::listed;
use crate::number::{count, counted, fixed};
use crate::records::processing::ImportedMotion;
use crate::units::G_M_S2;

/// Kinds of files that the summary names.
const NAMED: usize = 10;

/// Why a component is not imported: what it is, or in words what is wrong with it.
pub enum NotImported {
    LeftOut(&'static str),
    Refused(String),
}

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
    /// How many components of each kind were left out.
    left_out: BTreeMap<&'static str, usize>,
    /// What is wrong with others.
    pub refused: Vec<String>,
}

impl Summary {
    /// Adds motions, which must differ from those before in their names and files.
    pub fn add(&mut self, imported: &[ImportedMotion]) -> anyhow::Result<()> {
        for motion in imported {
            let ImportedMotion { motion_id: id, source_file: path, source_blake3, measures, .. } = motion;
            let first = self.files.entry(source_blake3.clone()).or_insert_with(|| path.clone());
            if first != path {
                bail!("{path}: the same record as {first}; leave out one");
            }
            if !self.ids.insert(id.clone()) {
                bail!("{path}: two motions are called '{id}'; rename the file");
            }
            self.pulses += usize::from(motion.pulse.tp_s.is_some());
            self.magnitudes += usize::from(motion.origin.mw.is_some());
            *self.kinds.entry(motion.kind.clone()).or_default() += 1;
            self.pga_g.push(measures.pga_m_s2 / G_M_S2);
            self.pgv_m_s.push(measures.pgv_m_s);
        }
        Ok(())
    }

    pub fn leave_out(&mut self, why: NotImported) {
        match why {
            NotImported::LeftOut(what) => *self.left_out.entry(what).or_default() += 1,
            NotImported::Refused(why) => self.refused.push(why),
        }
    }

    /// Refuses a call without motions, or one that does not keep going beside what is wrong.
    pub fn expect_motions(&self, keep_going: bool) -> anyhow::Result<()> {
        let (is_empty, left_out) = (self.pga_g.is_empty(), self.left_out());
        if is_empty && self.refused.is_empty() {
            let found = if left_out.is_empty() { "no component" } else { &left_out };
            bail!("{found}; expected horizontal ones at the surface (--vertical imports vertical ones)");
        }
        if is_empty || !self.refused.is_empty() && !keep_going {
            let others = if is_empty { "" } else { "\n--keep-going imports the others" };
            let records = counted(self.refused.len(), "record");
            bail!("{records} cannot be imported:\n{}{others}", self.refused.join("\n"));
        }
        Ok(())
    }

    /// Counts the components that were left out, in words.
    fn left_out(&self) -> String {
        self.left_out.iter().map(|(what, n)| counted(*n, what)).collect::<Vec<_>>().join(" and ")
    }

    pub fn text(&self) -> String {
        let kinds: Vec<String> = self.kinds.iter().map(|(kind, n)| format!("{} {kind}", count(*n))).collect();
        let left_out = self.left_out();
        let left_out = if left_out.is_empty() { String::new() } else { format!("; {left_out} left out") };
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
