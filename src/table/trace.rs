//! The trace file: one row a moment of a traced response.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::motions::{MotionId, id_column, schema_of};
use super::schema::TRACE;
use crate::keyword::Keyword;
use crate::rocking::TracePoint;

/// A moment of the response of a structure to a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceRow {
    /// Which motion.
    pub motion_id: MotionId,
    /// Which structure.
    pub structure: String,
    /// Its slenderness, rad.
    pub alpha_rad: f64,
    /// Its state and what happens.
    pub point: TracePoint,
    /// The ground acceleration at this moment, m/s2.
    pub ground_m_s2: f64,
}

/// The rows of the trace file; `by_name` says whether motions go by name.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[TraceRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&TraceRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        id_column(rows.iter().map(|row| &row.motion_id), by_name),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.structure))),
        number(|row| row.point.time_s),
        number(|row| row.point.theta_rad),
        number(|row| row.point.theta_dot_rad_s),
        number(|row| row.point.theta_rad / row.alpha_rad),
        number(|row| row.ground_m_s2),
        Arc::new(rows.iter().map(|row| row.point.event.map(Keyword::as_str)).collect::<StringArray>()),
    ];
    RecordBatch::try_new(schema_of(&TRACE, by_name), columns)
}
