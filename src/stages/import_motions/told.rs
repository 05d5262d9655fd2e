//! What is told of an import: what the motions are like, and what was refused.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::motion::Suite;
use crate::records::processing::{ImportedMotion, Refusal, SourceFile};
use crate::records::pulses::Verdict;
use crate::records::{SaidUnit, Teller};
use crate::stages::shared::reasons::{Case, Reasons, listed};
use crate::units::G_M_S2;

/// Different time steps that are named one by one.
const STEPS: usize = 5;

/// Files of equal content that are named.
const PAIRS: usize = 10;

/// What the motions so far are like.
#[derive(Default)]
pub struct Told {
    records: usize,
    formats: BTreeMap<&'static str, usize>,
    units: BTreeMap<SaidUnit, usize>,
    /// By time steps in whole nanoseconds.
    steps: BTreeMap<u64, usize>,
    pga_m_s2: Range,
    /// The motion of the largest PGA.
    strongest: String,
    pgv_m_s: Range,
    /// Records in which a pulse was looked for, and those that hold one.
    searched: usize,
    pulses: usize,
    /// Why some that are imported may be no records.
    pub doubts: Reasons,
    /// The file that first held a content, by its hash.
    sources: HashMap<String, String>,
    /// Files that hold what another holds too, with the other.
    same: BTreeSet<(String, String)>,
}

#[derive(Default)]
struct Range(Option<(f64, f64)>);

impl Range {
    fn add(&mut self, value: f64) {
        let (least, largest) = self.0.unwrap_or((value, value));
        self.0 = Some((least.min(value), largest.max(value)));
    }

    fn text(&self, unit_size: f64, unit: &str) -> String {
        let (least, largest) = self.0.unwrap_or_default();
        let [least, largest] = [least, largest].map(|value| format!("{:.2e}", value / unit_size));
        let plain = |text: String| text.parse::<f64>().map_or(text, |value| value.to_string());
        let (least, largest) = (plain(least), plain(largest));
        if least == largest { format!("{least} {unit}") } else { format!("{least} to {largest} {unit}") }
    }
}

impl Told {
    /// Adds the motions that are made of one record.
    pub fn add(&mut self, motions: &[ImportedMotion]) {
        let Some(first) = motions.first() else { return };
        self.records += 1;
        *self.formats.entry(first.format).or_default() += 1;
        if let Some(unit) = first.unit {
            *self.units.entry(unit).or_default() += 1;
        }
        *self.steps.entry((first.dt_s * 1e9).round() as u64).or_default() += 1;
        if let Some(indicator) = first.indicator {
            self.searched += 1;
            self.pulses += usize::from(indicator.verdict == Verdict::Pulse);
        }
        if let Some(doubt) = &first.doubt {
            self.doubts.add(Case::of_doubt(first.motion_id.clone(), doubt));
        }
        let SourceFile { path, blake3 } = &first.source;
        let known = self.sources.entry(blake3.clone()).or_insert_with(|| path.clone());
        if known != path {
            self.same.insert((path.clone(), known.clone()));
        }
        for motion in motions.iter().filter(|motion| motion.suite == Suite::Record) {
            let pga_m_s2 = motion.measured.measures.pga_m_s2;
            if self.pga_m_s2.0.is_none_or(|(_, largest)| pga_m_s2 > largest) {
                self.strongest.clone_from(&motion.motion_id);
            }
            self.pga_m_s2.add(pga_m_s2);
            self.pgv_m_s.add(motion.measured.measures.pgv_m_s);
        }
    }

    /// What all of them are like, in two lines.
    pub fn lines(&self) -> [String; 2] {
        let joined = |parts: Vec<String>| parts.join(", ");
        let formats = self.formats.iter().map(|(format, count)| format!("{format} ({count})")).collect();
        let records = if self.records == 1 { "record" } else { "records" };
        let unit = |(said, count): (&SaidUnit, &usize)| {
            let by = if said.by == Teller::File { "by the file" } else { "by --unit" };
            format!("{} ({count} {by})", said.unit)
        };
        let seconds = |step: &u64| *step as f64 / 1e9;
        let steps: Vec<String> = match self.steps.len() {
            0..=STEPS => self.steps.iter().map(|(step, n)| format!("{} s ({n})", seconds(step))).collect(),
            _ => {
                let ends = [self.steps.first_key_value(), self.steps.last_key_value()];
                let ends = ends.map(|end| end.map_or(0.0, |(step, _)| seconds(step)));
                vec![format!("{} to {} s", ends[0], ends[1])]
            }
        };
        let pulses = match self.searched {
            0 => String::new(),
            searched => format!("; a velocity pulse in {} of {searched}", self.pulses),
        };
        [
            format!(
                "{} {records}: {}; unit {}; dt {}",
                self.records,
                joined(formats),
                joined(self.units.iter().map(unit).collect()),
                joined(steps)
            ),
            format!(
                "PGA {} ({}), PGV {}{pulses}",
                self.pga_m_s2.text(G_M_S2, "g"),
                self.strongest,
                self.pgv_m_s.text(1.0, "m/s")
            ),
        ]
    }

    /// Which files hold the same, if any do.
    pub fn same_files(&self) -> Option<String> {
        let named = self.same.iter().take(PAIRS).map(|(file, known)| format!("{file} is {known}"));
        let named: Vec<String> = named.collect();
        let listed = listed(&named, self.same.len());
        (!named.is_empty())
            .then(|| format!("the same file under two names counts twice; leave one out: {listed}"))
    }
}

/// Sums up which of so many files are refused, whole or in part.
pub fn summary(refused: &[Refusal], files: usize) -> String {
    let distinct: HashSet<&str> = refused.iter().map(|refusal| refusal.file.as_str()).collect();
    let mut reasons = Reasons::default();
    for Refusal { file, found, reason } in refused {
        reasons.add(Case { name: file.clone(), found: found.clone(), reason: reason.clone() });
    }
    // A file of several motions may be refused several times.
    let things = if distinct.len() == refused.len() { "files" } else { "motions" };
    let lines = reasons.lines(things).map(|line| format!("\n  {line}"));
    format!("{} of {files} files refused:{}", distinct.len(), lines.collect::<String>())
}
