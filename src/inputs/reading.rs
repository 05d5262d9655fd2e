//! How a file of a person was read: one role for each of its columns, rows and remarks.

use std::borrow::Cow;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::words::means;
use crate::number::listed;

/// Columns that a sentence names.
const NAMED: usize = 12;

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    pub file: String,
    pub rows: usize,
    pub columns: Vec<ColumnReading>,
    /// Remarks on what decides, which are not used.
    #[serde(default)]
    pub unread: Vec<String>,
    /// Lines that are no data, and what they were taken for: `line 4: section 'Level 2'`.
    pub others: Vec<String>,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ColumnReading {
    pub heading: String,
    pub meaning: Meaning,
    /// Of the numbers below, as the heading has it.
    pub unit: Option<String>,
    /// Number of cells that say something.
    pub filled: usize,
    /// The first and the last of them; numbers of a known meaning in m, s, rad, m/s or m/s2.
    pub first: String,
    pub last: String,
}

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, strum::Display)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "lowercase")]
pub enum Meaning {
    /// A text of the file's own: tags, rooms, notes.
    Kept,
    #[default]
    #[strum(to_string = "not understood")]
    NotUnderstood,
    /// Left out by the user.
    Ignored,
    /// By the name of its column or option: width.
    #[serde(untagged)]
    #[strum(to_string = "{0}")]
    Known(String),
}

impl Reading {
    pub fn name(&self) -> Cow<'_, str> {
        Path::new(&self.file).file_name().unwrap_or(self.file.as_ref()).to_string_lossy()
    }

    /// Names the columns and remarks that are not understood, if there are any.
    pub fn gaps(&self) -> Option<String> {
        let kind = |of: &ColumnReading| match of.meaning {
            Meaning::NotUnderstood => Some("column"),
            Meaning::Kept if of.filled > 0 && means(&of.heading, "remark") => Some("the texts of column"),
            _ => None,
        };
        let columns = self.columns.iter().filter_map(|of| Some((kind(of)?, &of.heading)));
        let all: Vec<_> = columns.chain(self.unread.iter().map(|remark| ("remark", remark))).collect();
        let told = ["column", "the texts of column", "remark"].map(|kind| {
            let names = all.iter().filter(|(of, _)| *of == kind).map(|(_, name)| format!("'{name}'"));
            let names: Vec<String> = names.collect();
            let plural = if names.len() == 1 { "" } else { "s" };
            (!names.is_empty()).then(|| format!("{kind}{plural} {}", listed(&names, NAMED)))
        });
        let told: Vec<String> = told.into_iter().flatten().collect();
        (!told.is_empty()).then(|| format!("Not understood in {}: {}.", self.name(), told.join("; ")))
    }
}
