//! Synthetic motions as rows of the motions file.

use std::sync::Arc;

use arrow_array::builder::{Float32Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, DataType, Field, SchemaRef};

use super::measures;
use super::scenarios;
use crate::keyword::Keyword;
use crate::motion::{Measured, Scenario, Suite};

/// A synthetic motion on its way into a file.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticMotion {
    /// Unique in the file.
    pub motion_id: i64,
    /// Its kind.
    pub suite: Suite,
    /// The scenario it belongs to.
    pub scenario: Scenario,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2, as they are written.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: Measured,
}

/// The rows of the motions file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(motions: &[SyntheticMotion], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let mut columns: Vec<ArrayRef> = vec![
        Arc::new(Int64Array::from_iter_values(motions.iter().map(|motion| motion.motion_id))),
        Arc::new(StringArray::from_iter_values(motions.iter().map(|motion| motion.suite.as_str()))),
    ];
    columns.extend(scenarios::columns(&motions.iter().map(|motion| motion.scenario).collect::<Vec<_>>()));
    columns.push(Arc::new(Float64Array::from_iter_values(motions.iter().map(|motion| motion.dt_s))));
    columns.extend(measures::columns(motions.iter().map(|motion| &motion.measured)));
    columns.push(samples(motions.iter().map(|motion| motion.acceleration_m_s2.as_slice())));
    columns.extend(measures::spectrum(motions.iter().map(|motion| &motion.measured)));
    RecordBatch::try_new(schema.clone(), columns)
}

/// The column of samples.
pub(super) fn samples<'a>(motions: impl Iterator<Item = &'a [f32]>) -> ArrayRef {
    let item = Field::new("item", DataType::Float32, false);
    let mut list = ListBuilder::new(Float32Builder::new()).with_field(item);
    for motion in motions {
        list.values().append_slice(motion);
        list.append(true);
    }
    Arc::new(list.finish())
}
