use arrow_array::RecordBatch;
use serde_json::Value;

use super::options::Format;
use crate::stages::shared::surface::UNIVERSAL;
use crate::table::evaluated::{ANSWER, EVALUATED, RATES};
use crate::table::schema::Table;
use crate::table::store::frame::frame_of;
use crate::table::store::text;

/// How an answer of fits begins.
const FITS_OF: &str = "fits of ";

/// A short answer.
pub struct Answer {
    pub table: Table,
    pub rows: RecordBatch,
    /// What a report shows of the hazard; null without one.
    pub shown: Value,
    /// What a reader must know, above the table.
    pub heading: String,
}

impl Answer {
    /// The answer as text.
    pub fn text(&self, format: Format, warnings: &[String]) -> anyhow::Result<String> {
        match format {
            Format::Csv => text::csv(&frame_of(&self.rows)?),
            Format::Json => Ok(text::json_with_warnings(warnings, &frame_of(&self.rows)?)),
            Format::Table | Format::Parquet => {
                Ok(format!("{}\n{}", self.heading, text::aligned(&frame_of(&self.rows)?)))
            }
        }
    }
}

/// Whether a text that begins like this is an answer in one of the formats.
pub fn is_own(head: &str) -> bool {
    let begins_table = |table: &Table| {
        let names: Vec<&str> = table.columns.iter().map(|column| column.name).collect();
        // Columns that went along stand behind those of probabilities.
        head.strip_prefix(&names.join(",")).is_some_and(|rest| rest.starts_with([',', '\n']))
    };
    [FITS_OF, UNIVERSAL, text::JSON].iter().any(|begin| head.starts_with(begin))
        || [ANSWER, RATES, EVALUATED].iter().any(begins_table)
}
