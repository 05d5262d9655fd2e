//! What is printed and written.

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::{Args, ValueHint};

use crate::keyword;
use crate::pipeline::UsageError;
use crate::pipeline::context::Context;
use crate::table::frame::{self, Format};
use crate::table::writer::write_file;

/// How results are printed, and where they are written.
#[derive(Debug, Args)]
pub struct Output {
    /// text, csv or json
    #[arg(long, default_value = "text")]
    format: Format,
    /// File to write: .parquet, .csv or .json [default: none; with --in, evaluated.parquet beside it]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
}

impl Output {
    /// The file to write; without one, of a table a file beside it.
    pub fn path(&self, table: Option<&Path>) -> Option<PathBuf> {
        self.out.clone().or(table.map(|table| table.with_file_name("evaluated.parquet")))
    }

    /// Checks that the file's name has an ending that is known.
    pub fn check(&self) -> anyhow::Result<()> {
        self.out.as_deref().map_or(Ok(None), file_format).map(|_| ())
    }

    /// Writes rows of one schema, if they go to a file, and returns what to print; `table` is what was read.
    pub fn write(
        &self,
        rows: &[RecordBatch],
        text: String,
        table: Option<&Path>,
        context: &Context,
    ) -> anyhow::Result<String> {
        let show = |format: Format| -> anyhow::Result<String> {
            let mut whole = frame::of_batch(&rows[0])?;
            for more in &rows[1..] {
                whole.vstack_mut(&frame::of_batch(more)?)?;
            }
            frame::show(&whole, format)
        };
        let printed = if self.format == Format::Text { text } else { show(self.format)? };
        let Some(out) = self.path(table) else { return Ok(printed) };
        match file_format(&out)? {
            Some(format) => write_file(&out, show(format)?.as_bytes())?,
            None => {
                let mut writer = context.create(&out, &rows[0].schema())?;
                rows.iter().try_for_each(|rows| writer.append(rows))?;
                context.finish(writer, &printed)?;
            }
        }
        Ok(printed)
    }
}

/// How a file is written, by how its name ends; none as Parquet.
fn file_format(out: &Path) -> anyhow::Result<Option<Format>> {
    match out.extension().and_then(|ending| ending.to_str()) {
        Some("parquet") => Ok(None),
        Some(ending @ ("csv" | "json")) => Ok(Some(keyword::parse(ending)?)),
        _ => {
            let out = out.display();
            Err(UsageError::because(format!(
                "out is {out}; expected a name that ends in .parquet, .csv or .json"
            )))
        }
    }
}
