//! What was imported, in words.

use std::collections::{BTreeMap, HashMap};

use anyhow::{bail, ensure};
use rockfrag_core::motion::MotionMeasures;
use rockfrag_core::records::processing::ImportedMotion;
use rockfrag_core::statistics::Range;
use rockfrag_core::units::G_M_S2;

use crate::number::{count, counted, fixed};
use crate::pipeline::options::SeveralErrors;

/// Why a component is not imported: what it is, or in words what is wrong with it.
pub enum NotImported {
    LeftOut(&'static str),
    Refused(String),
}

/// What was read, so that a wrong unit is seen.
#[derive(Default)]
pub struct Summary {
    /// Without their samples.
    motions: Vec<ImportedMotion>,
    /// How many components of each kind were left out.
    left_out: BTreeMap<&'static str, usize>,
    pub refused: Vec<String>,
}

impl Summary {
    pub fn add(&mut self, imported: Vec<ImportedMotion>) {
        let without = |motion| ImportedMotion { acceleration_m_s2: Vec::new(), ..motion };
        self.motions.extend(imported.into_iter().map(without));
    }

    pub fn leave_out(&mut self, why: NotImported) {
        match why {
            NotImported::LeftOut(what) => *self.left_out.entry(what).or_default() += 1,
            NotImported::Refused(why) => self.refused.push(why),
        }
    }

    /// Refuses a call without motions, or of which two are one record, or one that does not keep going beside
    /// what is wrong.
    pub fn expect_motions(&self, keep_going: bool) -> anyhow::Result<()> {
        let mut files = HashMap::new();
        for ImportedMotion { source_file: path, source_blake3, .. } in &self.motions {
            let first = *files.entry(source_blake3).or_insert(path);
            ensure!(first == path, "{path}: the same record as {first}; leave out one");
        }
        let (is_empty, left_out) = (self.motions.is_empty(), self.left_out());
        if is_empty && self.refused.is_empty() {
            let found = if left_out.is_empty() { "no component" } else { &left_out };
            bail!("{found}; expected horizontal ones at the surface");
        }
        if is_empty || !self.refused.is_empty() && !keep_going {
            let others = if is_empty { "" } else { " (--keep-going imports the others)" };
            let records = counted(self.refused.len(), "record");
            let first = format!("{records} cannot be imported{others}:");
            bail!(SeveralErrors([vec![first], self.refused.clone()].concat()));
        }
        Ok(())
    }

    fn left_out(&self) -> String {
        self.left_out.iter().map(|(what, n)| counted(*n, what)).collect::<Vec<_>>().join(" and ")
    }

    pub fn text(&self) -> String {
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        self.motions.iter().for_each(|motion| *kinds.entry(&motion.kind).or_default() += 1);
        let kinds: Vec<String> = kinds.iter().map(|(kind, n)| format!("{} {kind}", count(*n))).collect();
        let range = |of: fn(&MotionMeasures) -> f64| {
            let Range { low, high } = Range::over(self.motions.iter().map(|motion| of(&motion.measures)));
            format!("{} to {}", fixed(low, 3), fixed(high, 3))
        };
        let left_out = self.left_out();
        let left_out = if left_out.is_empty() { String::new() } else { format!("; {left_out} left out") };
        format!(
            "{} ({}), {} with a pulse, {} with a magnitude{left_out}\nPGA {} g, PGV {} m/s\n",
            counted(self.motions.len(), "motion"),
            kinds.join(", "),
            count(self.motions.iter().filter(|motion| motion.pulse.tp_s.is_some()).count()),
            count(self.motions.iter().filter(|motion| motion.origin.mw.is_some()).count()),
            range(|measures| measures.pga_m_s2 / G_M_S2),
            range(|measures| measures.pgv_m_s)
        )
    }
}
