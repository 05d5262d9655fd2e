use arrow_array::RecordBatch;

use super::options::Format;
use crate::table::schema::Table;
use crate::table::store::frame::frame_of;
use crate::table::store::text;

/// A short answer.
pub struct Answer {
    pub table: Table,
    pub rows: RecordBatch,
    /// What a reader must know, above the table.
    pub heading: String,
}

impl Answer {
    /// The answer as text.
    pub fn text(&self, format: Format, warnings: &[String]) -> anyhow::Result<String> {
        match format {
            Format::Csv => text::csv(&frame_of(&self.rows)?),
            Format::Json => Ok(format!(
                "{{\n\"warnings\": {},\n\"rows\": {}}}\n",
                serde_json::json!(warnings),
                text::json(&frame_of(&self.rows)?)
            )),
            Format::Table | Format::Parquet => {
                Ok(format!("{}\n{}", self.heading, text::aligned(&frame_of(&self.rows)?)))
            }
        }
    }
}
