//! The responses file: one row a motion and structure.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int32Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::motions::{MotionId, id_column, schema_of};
use super::schema::{self, Column, RESPONSES};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::rocking::{Response, Structure};

/// The response of a structure to a motion, with the measures that the fits need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseRow<'a> {
    /// Which motion.
    pub motion_id: &'a MotionId,
    /// Its kind, if known.
    pub suite: Option<&'a str>,
    /// Which structure.
    pub structure: &'a Structure,
    /// What came of it.
    pub response: Response,
    /// Moment magnitude, if known.
    pub mw: Option<f64>,
    /// Distance, km, if known.
    pub re_km: Option<f64>,
    /// The earthquake, if known.
    pub event: Option<&'a str>,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Period of the pulse, s, if known.
    pub tp_s: Option<f64>,
    /// Mean period, s, if there is one.
    pub tm_s: Option<f64>,
    /// Eq. 13.
    pub measures: IntensityMeasures,
}

/// The rows of the responses file; `by_name` says whether motions go by name.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ResponseRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&ResponseRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let optional = |value: fn(&ResponseRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        id_column(rows.iter().map(|row| row.motion_id), by_name),
        Arc::new(rows.iter().map(|row| row.suite).collect::<StringArray>()),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.structure.name))),
        number(|row| row.structure.p_rad_s),
        number(|row| row.structure.alpha_rad),
        number(|row| row.structure.eta),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.response.outcome.as_str()))),
        number(|row| row.response.edp),
        Arc::new(Int32Array::from_iter_values(
            rows.iter().map(|row| i32::try_from(row.response.impacts).unwrap_or(i32::MAX)),
        )),
        optional(|row| row.mw),
        optional(|row| row.re_km),
        Arc::new(rows.iter().map(|row| row.event).collect::<StringArray>()),
        number(|row| row.pga_m_s2),
        number(|row| row.pgv_m_s),
        optional(|row| row.tp_s),
        optional(|row| row.tm_s),
        optional(|row| row.measures.im1),
        optional(|row| row.measures.im2),
        optional(|row| row.measures.im3),
        number(|row| row.measures.im4),
        number(|row| row.measures.im5),
        optional(|row| row.measures.im6),
    ];
    RecordBatch::try_new(schema_of(&RESPONSES, by_name), columns)
}

/// The columns of Eq. 13 in a file of responses.
pub struct MeasureColumns {
    im1: Vec<Option<f64>>,
    im2: Vec<Option<f64>>,
    im3: Vec<Option<f64>>,
    im4: Vec<f64>,
    im5: Vec<f64>,
    im6: Vec<Option<f64>>,
}

impl MeasureColumns {
    /// Read by `optional` where a measure may be missing, and by `number` where none may.
    ///
    /// # Errors
    /// Those of the two.
    pub fn read<E>(
        optional: impl Fn(Column) -> Result<Vec<Option<f64>>, E>,
        number: impl Fn(Column) -> Result<Vec<f64>, E>,
    ) -> Result<MeasureColumns, E> {
        Ok(MeasureColumns {
            im1: optional(schema::IM1)?,
            im2: optional(schema::IM2)?,
            im3: optional(schema::IM3)?,
            im4: number(schema::IM4)?,
            im5: number(schema::IM5)?,
            im6: optional(schema::IM6)?,
        })
    }

    /// The measures of a row.
    pub fn of_row(&self, row: usize) -> IntensityMeasures {
        IntensityMeasures {
            im1: self.im1[row],
            im2: self.im2[row],
            im3: self.im3[row],
            im4: self.im4[row],
            im5: self.im5[row],
            im6: self.im6[row],
        }
    }
}
