//! How a file of a person was read: one role for each of its columns, rows and remarks.

use serde::{Deserialize, Serialize};

/// How a table was read.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Reading {
    pub file: String,
    /// Number of rows of data.
    pub rows: usize,
    pub columns: Vec<ColumnReading>,
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

/// What a column says.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub enum Meaning {
    /// By the name of its column or option: width.
    Known(String),
    /// A text of the file's own: tags, rooms, notes.
    Kept,
    #[default]
    NotUnderstood,
    /// Left out by the user.
    Ignored,
}

impl Reading {
    /// The headings that are not understood.
    pub fn not_understood(&self) -> Vec<&str> {
        let columns = self.columns.iter().filter(|column| column.meaning == Meaning::NotUnderstood);
        columns.map(|column| column.heading.as_str()).collect()
    }
}
