//! Headings of a file that another program wrote, and the columns that they stand for: `pga_g=PGA,pgv_m_s=PGV`.

use std::fmt;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, Schema, SchemaRef};

use crate::table::TableError;
use crate::table::schema::Column;

/// Pairs of a column and its heading; a column without a pair has its own name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Headings(Vec<(String, String)>);

/// What spectral accelerations are not for.
pub const NO_SPECTRAL: &str = "the surface and the fits need PGA or PGV";

/// Whether a heading names a spectral acceleration: `SA(1.0)`, `PSA 0.2 s`, `Spectral acceleration`.
pub fn is_spectral(heading: &str) -> bool {
    let is_of_period = |word: &str| {
        let period = ["psa", "sa", "psv", "sv"].iter().find_map(|begin| word.strip_prefix(begin));
        period.is_some_and(|period| period.chars().all(|sign| sign.is_ascii_digit()))
    };
    let lower = heading.to_lowercase();
    lower.split(|c: char| !c.is_alphanumeric()).any(|word| word == "spectral" || is_of_period(word))
}

impl FromStr for Headings {
    type Err = String;

    fn from_str(text: &str) -> Result<Headings, String> {
        let pair = |part: &str| match part
            .split_once('=')
            .map(|(column, heading)| (column.trim(), heading.trim()))
        {
            Some((column, heading)) if !column.is_empty() && !heading.is_empty() => {
                match is_spectral(heading) && column.starts_with("pg") {
                    true => Err(format!("'{heading}' is a spectral acceleration; {NO_SPECTRAL}")),
                    false => Ok((column.to_string(), heading.to_string())),
                }
            }
            _ => Err(format!("'{part}': expected COLUMN=HEADING, as pga_g=PGA")),
        };
        text.split(',').map(pair).collect::<Result<_, _>>().map(Headings)
    }
}

impl fmt::Display for Headings {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let pairs: Vec<String> =
            self.0.iter().map(|(column, heading)| format!("{column}={heading}")).collect();
        f.write_str(&pairs.join(","))
    }
}

impl Headings {
    /// Whether there is no pair.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The columns that have a heading of another name.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(column, _)| column.as_str())
    }

    /// Whether a heading stands for one of the columns.
    pub fn may_be(&self, heading: &str, columns: &[Column]) -> bool {
        let has_other = |column: &Column| self.columns().any(|other| other == column.name);
        self.headings().any(|other| other == heading)
            || columns.iter().any(|column| column.name == heading && !has_other(column))
    }

    /// The headings that stand for columns of another name.
    pub fn headings(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(_, heading)| heading.as_str())
    }

    /// What each of these headings stands for, which is the column of its `plain` name where no pair says otherwise.
    ///
    /// # Errors
    /// With the first pair that has none of these headings.
    pub fn renamed(
        &self,
        headings: &[String],
        plain: impl Fn(&str) -> String,
    ) -> Result<Vec<String>, String> {
        let names: Vec<String> = headings.iter().map(|heading| plain(heading)).collect();
        if let Some((column, heading)) = self.0.iter().find(|(_, heading)| !names.contains(&plain(heading))) {
            return Err(format!(
                "no heading '{heading}' for {column}; expected one of {}",
                headings.join(", ")
            ));
        }
        let renamed = |name: String| match self.0.iter().find(|(_, heading)| plain(heading) == name) {
            Some((column, _)) => column.clone(),
            // Another heading stands for the column of this name.
            None if self.columns().any(|column| column == name) => format!("{name} of the file"),
            None => name,
        };
        Ok(names.into_iter().map(renamed).collect())
    }

    /// The schema of a Parquet file under the names of columns.
    ///
    /// # Errors
    /// As [`Headings::renamed`].
    pub fn schema(&self, path: &Path, schema: &SchemaRef) -> Result<SchemaRef, TableError> {
        if self.is_empty() {
            return Ok(schema.clone());
        }
        let headings: Vec<String> = schema.fields().iter().map(|field| field.name().clone()).collect();
        let names = self.renamed(&headings, str::to_string);
        let names = names.map_err(|message| TableError::Read { path: path.to_path_buf(), message })?;
        let fields = schema.fields().iter().zip(names);
        let fields = fields.map(|(field, name)| field.as_ref().clone().with_name(name)).collect::<Vec<_>>();
        Ok(Arc::new(Schema::new(fields)))
    }

    /// A batch under the names of columns.
    ///
    /// # Errors
    /// As [`Headings::schema`].
    pub fn batch(&self, path: &Path, rows: RecordBatch) -> Result<RecordBatch, TableError> {
        if self.is_empty() {
            return Ok(rows);
        }
        let schema = self.schema(path, rows.schema_ref())?;
        let failed =
            |error: ArrowError| TableError::Read { path: path.to_path_buf(), message: error.to_string() };
        RecordBatch::try_new(schema, rows.columns().to_vec()).map_err(failed)
    }
}
