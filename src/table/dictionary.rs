//! Name, unit and meaning of every column of every file: data/columns.csv.

use std::collections::HashMap;
use std::sync::LazyLock;

use arrow_schema::Field;

static COLUMNS: LazyLock<Vec<[String; 3]>> = LazyLock::new(|| {
    let text = include_str!("../../data/columns.csv");
    let rows = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes()).into_deserialize();
    rows.collect::<Result<_, _>>().expect("data/columns.csv has three columns")
});

pub fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|[name, ..]| name.as_str())
}

/// Unit and meaning of a column; none where the dictionary lacks it.
pub fn entry(column: &str) -> Option<(&'static str, &'static str)> {
    let is_spectral = column.starts_with("sa_") && column.ends_with("_m_s2");
    let name = if is_spectral { "sa_*_m_s2" } else { column };
    let [_, unit, meaning] = COLUMNS.iter().find(|[other, ..]| other == name)?;
    Some((unit, meaning))
}

pub fn meaning(column: &str) -> String {
    match entry(column) {
        Some(("1", meaning)) => meaning.to_string(),
        Some((unit, meaning)) => format!("{meaning} ({unit})"),
        None => "it".to_string(),
    }
}

pub fn with_meaning(field: Field) -> Field {
    let Some((unit, meaning)) = entry(field.name()) else { return field };
    let pairs = [("unit", unit), ("description", meaning)];
    field.with_metadata(HashMap::from(pairs.map(|(key, value)| (key.to_string(), value.to_string()))))
}
