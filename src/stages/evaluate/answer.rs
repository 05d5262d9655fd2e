use arrow_array::RecordBatch;
use serde_json::Value;

use super::{EvaluateOptions, Format};
use crate::pipeline::{UsageError, files};
use crate::table::provenance::{Provenance, content_of};
use crate::table::schema::Table;
use crate::table::source::Source;
use crate::table::writer::TableWriter;
use crate::table::{text, text_file};

/// A short answer, in whatever format.
pub struct Answer {
    /// What its rows are.
    pub table: Table,
    /// The rows.
    pub rows: RecordBatch,
    /// What a reader must know, above the table.
    pub heading: String,
    /// What it depends on besides the fits.
    pub parameters: Value,
    /// A file besides the fits, by the role it plays.
    pub input: Option<(&'static str, Source)>,
}

impl Answer {
    /// Writes it where `--out` says, or gives the text that is to be printed.
    pub fn deliver(&self, options: &EvaluateOptions) -> anyhow::Result<String> {
        let text = match (options.format.0, &options.out) {
            (Format::Table, _) => format!("{}\n{}", self.heading, text::aligned(&self.rows)),
            (Format::Csv, _) => text::csv(&self.rows)?,
            (Format::Json, _) => text::json(&self.rows),
            (Format::Parquet, None) => {
                return Err(UsageError::because("format parquet needs --out FILE"));
            }
            (Format::Parquet, Some(out)) => {
                let mut writer = TableWriter::create(out, &self.table, self.provenance(options)?)?;
                writer.append(&self.rows)?;
                writer.finish()?;
                return Ok(String::new());
            }
        };
        let Some(out) = &options.out else { return Ok(text) };
        text_file::write(out, &text)?;
        Ok(String::new())
    }

    fn provenance(&self, options: &EvaluateOptions) -> anyhow::Result<Provenance> {
        let mut inputs = std::collections::BTreeMap::new();
        for (role, source) in options.limits.0.fit_files(&options.fits)?.into_iter().chain(self.input.clone())
        {
            let content = match role {
                "hazard" => files::hash(source.name())?,
                _ => content_of(&source)?,
            };
            inputs.insert(role.to_string(), content);
        }
        Ok(Provenance::new(self.table.stage, self.parameters.clone(), inputs))
    }
}
