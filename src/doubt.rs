//! What speaks against a result: a doubt is a value, worded once.

use std::collections::BTreeMap;

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
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Doubts(BTreeMap<Doubt, Vec<String>>);

/// Subjects that a line names.
const NAMED: usize = 3;
/// The name of a structure that has none.
const UNNAMED: &str = "structure";

impl Doubts {
    /// A line a doubt, with the first of what it is about.
    pub fn lines(&self) -> Vec<String> {
        let line = |(doubt, about): (&Doubt, &Vec<String>)| {
            let named = about.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
            match about.len().saturating_sub(NAMED) {
                0 if named == UNNAMED => doubt.text().to_string(),
                0 => format!("{named}: {}", doubt.text()),
                more => format!("{named} and {more} more: {}", doubt.text()),
            }
        };
        self.0.iter().map(line).collect()
    }

    /// Adds others.
    pub fn extend(&mut self, others: Doubts) {
        for (doubt, about) in others.0 {
            self.0.entry(doubt).or_default().extend(about);
        }
    }
}

impl FromIterator<(Doubt, String)> for Doubts {
    fn from_iter<I: IntoIterator<Item = (Doubt, String)>>(doubts: I) -> Doubts {
        let mut all = Doubts::default();
        doubts.into_iter().for_each(|(doubt, about)| all.0.entry(doubt).or_default().push(about));
        all
    }
}
