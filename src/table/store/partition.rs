//! One of the equal parts into which a table is cut, so that many processes share a stage.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use serde_json::Value;

/// The option that has a stage do a part of its work only, and the parameter under which a file says which partition it is.
pub const PARAMETER: &str = "partition";

/// Part `index`, counted from 0, of `of` parts of a table: a run of its rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Partition {
    /// From 0.
    pub index: u64,
    /// How many there are.
    pub of: u64,
}

impl Partition {
    /// The rows of a table of so many that belong to this partition: all partitions together are the table, and none is
    /// larger than another by more than a row.
    pub fn rows(self, total: u64) -> Range<u64> {
        let (index, of, total) = (u128::from(self.index), u128::from(self.of), u128::from(total));
        // No quotient exceeds `total`.
        let bound = |k: u128| (k * total / of) as u64;
        bound(index)..bound(index + 1)
    }

    /// What its file is called in a folder, so that names stand in the order of rows.
    pub fn file_name(self) -> String {
        let digits = (self.of - 1).to_string().len().max(5);
        format!("part-{:0digits$}.parquet", self.index)
    }

    /// With this partition among `parameters`.
    pub fn add_to(partition: Option<Partition>, mut parameters: Value) -> Value {
        if let (Some(partition), Value::Object(parameters)) = (partition, &mut parameters) {
            parameters.insert(PARAMETER.to_string(), partition.to_string().into());
        }
        parameters
    }

    /// The parameters that all partitions of a table have in common.
    pub fn without(mut parameters: Value) -> Value {
        if let Value::Object(parameters) = &mut parameters {
            parameters.remove(PARAMETER);
        }
        parameters
    }

    /// That which `parameters` name.
    pub fn among(parameters: &Value) -> Option<Partition> {
        parameters.get(PARAMETER)?.as_str()?.parse().ok()
    }
}

impl FromStr for Partition {
    type Err = String;

    fn from_str(text: &str) -> Result<Partition, String> {
        let parts =
            text.split_once('/').and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
        match parts {
            Some((index, of)) if index < of => Ok(Partition { index, of }),
            _ => Err(format!("'{text}': expected i/n, such as 17/100, with i from 0 to n - 1")),
        }
    }
}

impl fmt::Display for Partition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}
