//! What speaks against a result: a doubt is a value, worded once.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::keyword::keywords;

/// A doubt that changes what one would decide, the weightiest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Doubt {
    ImplausibleRow,
    ImplausibleRecord,
    OtherPeak,
    ImplausibleSize,
    LowRestitution,
    ImplausibleHazard,
    HazardEndsEarly,
    HazardExtrapolated,
    HazardStartsLate,
    NotFitted,
    Extrapolated,
    UnusualStructure,
    PoorFit,
    NoEvents,
    FewEvents,
    FewClusters,
    ScanEndsEarly,
    UnreadableFile,
    NoPartner,
}

keywords!(Doubt {
    ImplausibleRow = "implausible_row",
    ImplausibleRecord = "implausible_record",
    OtherPeak = "other_peak",
    ImplausibleSize = "implausible_size",
    LowRestitution = "low_restitution",
    ImplausibleHazard = "implausible_hazard",
    HazardEndsEarly = "hazard_ends_early",
    HazardExtrapolated = "hazard_extrapolated",
    HazardStartsLate = "hazard_starts_late",
    NotFitted = "not_fitted",
    Extrapolated = "extrapolated",
    UnusualStructure = "unusual_structure",
    PoorFit = "poor_fit",
    NoEvents = "no_events",
    FewEvents = "few_events",
    FewClusters = "few_clusters",
    ScanEndsEarly = "scan_ends_early",
    UnreadableFile = "unreadable_file",
    NoPartner = "no_partner",
});

impl Doubt {
    /// In at most 15 words.
    pub fn text(self) -> &'static str {
        match self {
            Doubt::ImplausibleRow => "this row cannot be right; it has no result",
            Doubt::ImplausibleRecord => "this is no plausible record of an earthquake",
            Doubt::OtherPeak => "pga_m_s2 is not the peak of the samples: another unit or component?",
            Doubt::ImplausibleSize => "no solid block is as high: are its dimensions in cm?",
            Doubt::LowRestitution => "eta is below 0.5: a typing error?",
            Doubt::ImplausibleHazard => "such strong motion is never so frequent: wrong unit or column?",
            Doubt::HazardEndsEarly => "the hazard curve ends too early: bounds in place of a value",
            Doubt::HazardExtrapolated => "the hazard curve is extrapolated beyond its last point",
            Doubt::HazardStartsLate => {
                "the hazard curve starts above the intensity that uplifts it: rates are too low"
            }
            Doubt::NotFitted => "not among the fitted structures: the universal surface is used",
            Doubt::Extrapolated => "outside of the motions that the model was fitted to",
            Doubt::UnusualStructure => "outside of the structures that the universal surface was fitted to",
            Doubt::PoorFit => "the paper's curve or planes do not fit these responses",
            Doubt::NoEvents => {
                "no response or every response overturned: the level comes from other structures"
            }
            Doubt::FewEvents => "fewer than ten responses with the event, or without: the level is uncertain",
            Doubt::FewClusters => {
                "fewer than ten earthquakes or cells: limits assume the usual differences between them"
            }
            Doubt::ScanEndsEarly => "too few motions overturn it for a median; raise --to",
            Doubt::UnreadableFile => "not imported",
            Doubt::NoPartner => "vertical, or no partner at right angles: left out",
        }
    }
}

/// Doubts, each with what it is about.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Doubts(BTreeMap<Doubt, Subjects>);

/// What a doubt is about.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Subjects {
    /// The names of the first ones.
    named: Vec<String>,
    /// The number of all.
    count: usize,
}

/// Subjects that a line names.
const NAMED: usize = 3;
/// The name of a structure that has none.
const UNNAMED: &str = "structure";

impl Doubts {
    /// Returns a line a doubt, the weightiest first, with the first of what it is about.
    pub fn lines(&self) -> Vec<String> {
        let line = |(doubt, Subjects { named, count }): (&Doubt, &Subjects)| {
            let named = named.join(", ");
            match count.saturating_sub(NAMED) {
                0 if named == UNNAMED => doubt.text().to_string(),
                0 => format!("{named}: {}", doubt.text()),
                more => format!("{named} and {more} more: {}", doubt.text()),
            }
        };
        self.0.iter().map(line).collect()
    }

    /// Adds doubts about other subjects.
    pub fn extend(&mut self, others: Doubts) {
        for (doubt, others) in others.0 {
            let subjects = self.0.entry(doubt).or_default();
            subjects.count += others.count;
            subjects.named.extend(others.named);
            subjects.named.truncate(NAMED);
        }
    }

    /// Joins the doubts of another stage about the same subjects: the one about more of them stays.
    pub fn join(&mut self, others: &Doubts) {
        for (doubt, others) in &others.0 {
            let subjects = self.0.entry(*doubt).or_default();
            if others.count >= subjects.count {
                *subjects = others.clone();
            }
        }
    }
}

impl FromIterator<(Doubt, String)> for Doubts {
    fn from_iter<I: IntoIterator<Item = (Doubt, String)>>(doubts: I) -> Doubts {
        let mut all = Doubts::default();
        for (doubt, about) in doubts {
            all.extend(Doubts([(doubt, Subjects { named: vec![about], count: 1 })].into()));
        }
        all
    }
}
