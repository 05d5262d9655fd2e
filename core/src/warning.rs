//! Warnings about results.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::number::shown;
use crate::spelling::unknown_word;

/// A warning that could change a decision, the most important first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[derive(PartialOrd, Ord)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Warning>)]
pub enum Warning {
    UnusualScenario,
    ImplausibleRecord,
    OtherPeak,
    AtRim,
    LoweredPeak,
    ImplausibleSize,
    LowRestitution,
    RoundBase,
    HazardEndsEarly,
    HazardStartsLate,
    MedianHazard,
    UnusualMagnitude,
    UnusualGround,
    OwnPeriod,
    HardRock,
    NotFitted,
    OtherStructure,
    Extrapolated,
    UnusualStructure,
    PoorFit,
    NoEvents,
    FewEvents,
    FewClusters,
    ScanEndsEarly,
    ScanStartsLate,
    UnreadableFile,
    NoPartner,
    LeftOut,
    NoAnswer,
    OneDirection,
    NotGiven,
    Repeated,
}

impl Warning {
    /// At most 15 words.
    pub fn text(self) -> &'static str {
        use Warning::*;
        match self {
            UnusualScenario => "outside the paper's earthquakes: magnitude 5.5 to 7.5, distance up to 20 km",
            ImplausibleRecord => "this is not a plausible earthquake record",
            AtRim => "beyond 4.5 g, 5 m/s or PGV/PGA 0.005 to 3 s: answered at that limit",
            OtherPeak => "pga_m_s2 or pgv_m_s differs from the peak of the samples: unit or component?",
            LoweredPeak => "PGA after resampling: a smaller --resample keeps the peak",
            ImplausibleSize => "taller or more slender than all but a few monuments: a wrong unit?",
            LowRestitution => "eta is below 0.5, lower than tests of rocking blocks show",
            RoundBase => "a round base: it overturns more often than this square one",
            HazardEndsEarly => {
                "the hazard curve ends too early: its last slope is continued, with wide limits"
            }
            HazardStartsLate => "the hazard curve starts above the uplift intensity: rates are too low",
            MedianHazard => "a median hazard curve, usually below the mean: rates are too low",
            UnusualMagnitude => {
                "above 7.9, the largest magnitude of the records that the surface was fitted to"
            }
            UnusualGround => "Vs30 outside 200 to 1,500 m/s, for which PGV/PGA by Vs30 was fitted",
            OwnPeriod => "SA(1.0 s)/PGA as on ground with a period of its own: add the PGV curve",
            HardRock => "SA(1.0 s)/PGA as on hard rock of a stable continent: add the PGV curve",
            NotFitted => "not among the fitted structures: the universal surface is used",
            OtherStructure => "calibrated on responses of a different structure (--name)",
            Extrapolated => "outside the range of motions that the model was fitted to",
            UnusualStructure => {
                "less certain: the surface was fitted to p 0.4 to 8 rad/s, alpha to 0.50, eta from 0.70"
            }
            PoorFit => "the paper's curve or planes differ from the observed shares by more than 0.15",
            NoEvents => "all or no responses overturned: the estimate rests on other structures",
            FewEvents => "fewer than ten events or ten non-events: the fitted rate is uncertain",
            FewClusters => "fewer than ten earthquakes or cells: limits use a typical spread between them",
            ScanEndsEarly => "too few motions overturn the structure to give a median; raise --to",
            ScanStartsLate => "most motions overturn the structure at the first intensity; lower --from",
            UnreadableFile => "not imported",
            LeftOut => "left out: held, sliding, at a wall, or on a floor, whose motions these are not",
            NoAnswer => "left out: it has no answer; evaluate says why",
            OneDirection => "in the weaker direction alone: no motion has a pair in the other",
            Repeated => "the same object again, counted as another",
            NotGiven => "no value: answered as if nothing were known of it",
            NoPartner => "no perpendicular component: left out",
        }
    }
}

/// Warnings, each with its subjects.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Warnings(BTreeMap<Warning, Subjects>);

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Subjects {
    /// The first few.
    named: Vec<String>,
    count: usize,
}

const NAMED: usize = 3;
/// Letters of a subject that a line shows.
const LONGEST_SUBJECT: usize = 300;
/// The name of a structure that has none.
pub const UNNAMED: &str = "structure";

impl Warnings {
    /// One line for each warning, the most important first, with its first subjects.
    pub fn lines(&self) -> Vec<String> {
        let line = |(warning, Subjects { named, count }): (&Warning, &Subjects)| {
            let named = named.iter().map(|name| shown(name, LONGEST_SUBJECT)).collect::<Vec<_>>().join(", ");
            match count.saturating_sub(NAMED) {
                0 if named == UNNAMED => warning.text().to_string(),
                0 => format!("{named}: {}", warning.text()),
                more => format!("{named} and {more} more: {}", warning.text()),
            }
        };
        self.0.iter().map(line).collect()
    }

    pub fn add(&mut self, warning: Warning, about: String) {
        let subjects = self.0.entry(warning).or_default();
        subjects.count += 1;
        if subjects.named.len() < NAMED {
            subjects.named.push(about);
        }
    }

    /// Adds warnings about other subjects.
    pub fn extend(&mut self, others: Warnings) {
        for (warning, others) in others.0 {
            let subjects = self.0.entry(warning).or_default();
            subjects.count += others.count;
            subjects.named.extend(others.named);
            subjects.named.truncate(NAMED);
        }
    }

    pub fn remove(&mut self, warning: Warning) {
        self.0.remove(&warning);
    }

    /// Adds the warnings of another stage, which may be about the same subjects.
    pub fn join(&mut self, others: &Warnings) {
        for (warning, others) in &others.0 {
            let subjects = self.0.entry(*warning).or_default();
            let new = others.named.iter().filter(|name| !subjects.named.contains(name));
            let named = [subjects.named.clone(), new.cloned().collect()].concat();
            // Subjects without a name may be the same or others.
            subjects.count = subjects.count.max(others.count).max(named.len());
            subjects.named = named;
            subjects.named.truncate(NAMED);
        }
    }
}

impl FromIterator<(Warning, String)> for Warnings {
    fn from_iter<I: IntoIterator<Item = (Warning, String)>>(warnings: I) -> Warnings {
        let mut all = Warnings::default();
        warnings.into_iter().for_each(|(warning, about)| all.add(warning, about));
        all
    }
}
