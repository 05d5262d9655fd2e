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

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Meaning {
    /// A text of the file's own: tags, rooms, notes.
    Kept,
    #[default]
    NotUnderstood,
    /// Left out by the user.
    Ignored,
    /// By the name of its column or option: width.
    #[serde(untagged)]
    Known(String),
}

impl Meaning {
    pub fn words(&self) -> &str {
        match self {
            Meaning::Known(name) => name,
            Meaning::Kept => "kept",
            Meaning::NotUnderstood => "not understood",
            Meaning::Ignored => "ignored",
        }
    }
}

impl Reading {
    pub fn name(&self) -> Cow<'_, str> {
        Path::new(&self.file).file_name().unwrap_or(self.file.as_ref()).to_string_lossy()
    }

    /// Names the columns and remarks that are not understood, if there are any.
    pub fn gaps(&self) -> Option<String> {
        let names = |is_told: &dyn Fn(&ColumnReading) -> bool| -> Vec<String> {
            self.columns
                .iter()
                .filter(|column| is_told(column))
                .map(|of| format!("'{}'", of.heading))
                .collect()
        };
        let columns = names(&|column| column.meaning == Meaning::NotUnderstood);
        let texts = |column: &ColumnReading| column.filled > 0 && means(&column.heading, "remark");
        let texts = names(&|column| column.meaning == Meaning::Kept && texts(column));
        let unread: Vec<String> = self.unread.iter().map(|remark| format!("'{remark}'")).collect();
        let told = [("column", columns), ("the texts of column", texts), ("remark", unread)]
            .into_iter()
            .filter(|(_, names)| !names.is_empty());
        let told = told.map(|(kind, names)| {
            format!("{kind}{} {}", if names.len() == 1 { "" } else { "s" }, listed(&names, NAMED))
        });
        let told: Vec<String> = told.collect();
        (!told.is_empty()).then(|| format!("Not understood in {}: {}.", self.name(), told.join("; ")))
    }
}
