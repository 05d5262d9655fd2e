//! A column: its name, type, unit and words.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_schema::{DataType, Field};

/// The type of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// 64-bit integers.
    Int64,
    /// 32-bit integers.
    Int32,
    /// 64-bit floating-point numbers.
    Float64,
    /// UTF-8 text.
    Text,
    /// A list of 32-bit floating-point samples in each row.
    Samples,
    /// A list of 64-bit floating-point numbers in each row, as long in each.
    Numbers,
}

impl Kind {
    /// The Arrow type that is written.
    pub fn data_type(self) -> DataType {
        match self {
            Kind::Int64 => DataType::Int64,
            Kind::Int32 => DataType::Int32,
            Kind::Float64 => DataType::Float64,
            Kind::Text => DataType::Utf8,
            Kind::Samples => DataType::List(Arc::new(Field::new("item", DataType::Float32, false))),
            Kind::Numbers => DataType::List(Arc::new(Field::new("item", DataType::Float64, false))),
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Kind::Int64 => "64-bit integers",
            Kind::Int32 => "32-bit integers",
            Kind::Float64 => "64-bit floating-point numbers",
            Kind::Text => "text",
            Kind::Samples | Kind::Numbers => "lists of floating-point numbers",
        }
    }
}

/// A column: what it is called, what it holds, in which unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Lower snake case with the unit as suffix.
    pub name: &'static str,
    pub kind: Kind,
    /// Whether values may be null.
    pub nullable: bool,
    /// Its unit; "1" where it has none.
    pub unit: &'static str,
    /// What it means.
    pub description: &'static str,
}

impl Column {
    pub(in crate::table) const fn new(
        name: &'static str,
        kind: Kind,
        unit: &'static str,
        description: &'static str,
    ) -> Column {
        Column { name, kind, nullable: false, unit, description }
    }

    /// The same column where values may be missing.
    pub const fn or_null(self) -> Column {
        Column { nullable: true, ..self }
    }

    /// Type and meaning, for a message to the user.
    pub fn words(&self) -> String {
        let unit = if self.unit == "1" { String::new() } else { format!(" in {}", self.unit) };
        format!("{}{unit} ({})", self.kind.words(), self.description)
    }

    pub(super) fn field(&self) -> Field {
        let metadata = [("unit", self.unit), ("description", self.description)]
            .map(|(key, value)| (key.to_string(), value.to_string()));
        Field::new(self.name, self.kind.data_type(), self.nullable).with_metadata(HashMap::from(metadata))
    }
}

/// Columns as constants, named as in files or, where several columns have one name, otherwise: `name: type, unit, meaning` or
/// `constant = "name": type, unit, meaning`.
macro_rules! columns {
    ($($constant:ident $(= $name:literal)?: $kind:ident, $unit:literal, $description:literal;)*) => {
        $(
            #[doc = $description]
            #[allow(non_upper_case_globals, reason = "the fields of rows name their columns")]
            pub const $constant: Column =
                Column::new(columns!(@name $constant $($name)?), Kind::$kind, $unit, $description);
        )*
    };
    (@name $constant:ident) => { stringify!($constant) };
    (@name $constant:ident $name:literal) => { $name };
}

pub(super) use columns;
