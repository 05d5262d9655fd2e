//! A kind of file: its columns in order, and the stage that makes it.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_schema::{DataType, Field, Schema, SchemaRef};

use super::column::Column;

/// A kind of file: the columns it has and the stage that makes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Table {
    /// What its rows are called.
    pub name: &'static str,
    /// The subcommand that writes it.
    pub stage: &'static str,
    /// Its columns in order.
    pub columns: &'static [Column],
}

impl Table {
    /// The Arrow schema, units and descriptions in the field metadata.
    pub fn schema(&self) -> SchemaRef {
        self.schema_with_spectrum(&[])
    }

    /// The same with a column of spectral accelerations at each of these periods (s) at its end.
    pub fn schema_with_spectrum(&self, periods_s: &[f64]) -> SchemaRef {
        let spectrum = periods_s.iter().map(|&period_s| spectral_acceleration_field(period_s));
        Arc::new(Schema::new(self.columns.iter().map(Column::field).chain(spectrum).collect::<Vec<_>>()))
    }
}

impl Table {
    /// Whether each of these columns is in one of the tables, while the program is compiled.
    pub const fn have_all(tables: &[Table], columns: &[Column]) -> bool {
        let mut at = 0;
        while at < columns.len() {
            let mut table = 0;
            while table < tables.len() && !tables[table].has(columns[at].name) {
                table += 1;
            }
            if table == tables.len() {
                return false;
            }
            at += 1;
        }
        true
    }

    const fn has(&self, name: &str) -> bool {
        let mut at = 0;
        while at < self.columns.len() {
            if same(self.columns[at].name, name) {
                return true;
            }
            at += 1;
        }
        false
    }
}

/// The columns of two tables, as those of one.
pub const fn joined<const N: usize>(first: &[Column], second: &[Column]) -> [Column; N] {
    assert!(first.len() + second.len() == N);
    let mut all = [if first.is_empty() { second[0] } else { first[0] }; N];
    let mut at = 0;
    while at < N {
        all[at] = if at < first.len() { first[at] } else { second[at - first.len()] };
        at += 1;
    }
    all
}

/// Whether two texts are the same; `==` does not run while the program is compiled.
pub const fn same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut at = 0;
    while at < one.len() && at < other.len() && one[at] == other[at] {
        at += 1;
    }
    at == one.len() && at == other.len()
}

/// The name of the column of spectral accelerations at a period: `sa_0p20_m_s2` at 0.2 s.
pub fn spectral_acceleration_name(period_s: f64) -> String {
    let text = format!("{period_s:.4}");
    let short = text.strip_suffix("00").or(text.strip_suffix('0')).unwrap_or(&text);
    format!("sa_{}_m_s2", short.replace('.', "p"))
}

/// Whether a column holds spectral accelerations.
pub fn is_spectral_acceleration(name: &str) -> bool {
    name.starts_with("sa_") && name.ends_with("_m_s2")
}

fn spectral_acceleration_field(period_s: f64) -> Field {
    let description = format!("pseudo-spectral acceleration at {period_s} s and 5 % damping");
    let metadata = [("unit", "m/s2".to_string()), ("description", description)];
    let metadata = metadata.map(|(key, value)| (key.to_string(), value));
    Field::new(spectral_acceleration_name(period_s), DataType::Float64, false)
        .with_metadata(HashMap::from(metadata))
}
