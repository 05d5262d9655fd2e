//! What speaks against a result: a doubt is a value, worded once.

use std::collections::BTreeMap;

use crate::keyword::keywords;

/// A doubt that changes what one would decide, the weightiest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Doubt {
    ImplausibleRecord,
    OtherPeak,
    ImplausibleSize,
    ScanEndsEarly,
    UnreadableFile,
    NoPartner,
}

keywords!(Doubt {
    ImplausibleRecord = "implausible_record",
    OtherPeak = "other_peak",
    ImplausibleSize = "implausible_size",
    ScanEndsEarly = "scan_ends_early",
    UnreadableFile = "unreadable_file",
    NoPartner = "no_partner",
});

impl Doubt {
    /// In at most 15 words.
    pub fn text(self) -> &'static str {
        match self {
            Doubt::ImplausibleRecord => "this is no plausible record of an earthquake",
            Doubt::OtherPeak => "pga_m_s2 is not the peak of the samples: another unit or component?",
            Doubt::ImplausibleSize => "no solid block is as high: are its dimensions in cm?",
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

impl Doubts {
    /// A line a doubt, with the first of what it is about.
    pub fn lines(&self) -> Vec<String> {
        let line = |(doubt, about): (&Doubt, &Vec<String>)| {
            let named = about.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
            match about.len().saturating_sub(NAMED) {
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
