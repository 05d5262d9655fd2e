//! What evaluate answers: probabilities at one intensity or at many, and annual rates.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::schema::{ANSWER, EVALUATED, RATES};
use crate::fragility::{GivenRocking, LimitState, Measure, Probabilities, Probability};
use crate::keyword::Keyword;

/// Probabilities of one structure at one intensity, as a row among many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvaluatedRow {
    /// Frequency parameter, rad/s.
    pub p_rad_s: f64,
    /// Slenderness, rad.
    pub alpha_rad: f64,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// The probabilities.
    pub probabilities: Probabilities,
    /// A measure outside of the range of the data.
    pub out_of_range: Option<Measure>,
}

/// Rows of probabilities.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[EvaluatedRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&EvaluatedRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let given = |which: fn(&GivenRocking) -> Probability, part: fn(Probability) -> f64| -> ArrayRef {
        let value = |row: &EvaluatedRow| {
            Some(part(which(row.probabilities.given_rocking.as_ref()?))).filter(|value| !value.is_nan())
        };
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let failure = |row: &EvaluatedRow| row.probabilities.limit_states().map(|[_, failure, _]| failure.value);
    let mut columns = vec![
        number(|row| row.p_rad_s),
        number(|row| row.alpha_rad),
        number(|row| row.pga_m_s2),
        number(|row| row.pgv_m_s),
        number(|row| row.probabilities.p_nr),
    ];
    let branches: [fn(&GivenRocking) -> Probability; 3] = [|g| g.p_ex, |g| g.p_ro, |g| g.p_failure];
    let parts: [fn(Probability) -> f64; 3] = [|p| p.value, |p| p.low, |p| p.high];
    columns.extend(branches.into_iter().flat_map(|branch| parts.map(|part| given(branch, part))));
    columns.push(Arc::new(Float64Array::from_iter(rows.iter().map(failure))));
    let out_of_range = rows.iter().map(|row| row.out_of_range.map(Keyword::as_str));
    columns.push(Arc::new(out_of_range.collect::<StringArray>()));
    RecordBatch::try_new(EVALUATED.schema(), columns)
}

/// A quantity with limits, if it has them.
#[derive(Debug, Clone, PartialEq)]
pub struct AnswerRow {
    /// What it is called.
    pub quantity: &'static str,
    /// Its value, if there is one.
    pub value: Option<f64>,
    /// Its limits, if it is uncertain.
    pub limits: Option<(f64, f64)>,
    /// What it means.
    pub meaning: String,
}

/// The rows of an answer.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn answer(rows: &[AnswerRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&AnswerRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.quantity))),
        number(|row| row.value),
        number(|row| row.limits.map(|limits| limits.0)),
        number(|row| row.limits.map(|limits| limits.1)),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.meaning))),
    ];
    RecordBatch::try_new(ANSWER.schema(), columns)
}

/// The annual rate of a limit state, and what it means over years; value, lower and upper limit of both.
#[derive(Debug, Clone, PartialEq)]
pub struct RateRow {
    /// Which limit state.
    pub state: LimitState,
    /// Mean annual rate.
    pub annual_rate: [f64; 3],
    /// Time of exposure.
    pub years: f64,
    /// Probability in this time.
    pub probability: [f64; 3],
    /// What the limit state is.
    pub meaning: String,
}

/// The rows of annual rates.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn rates(rows: &[RateRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&RateRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let mut columns: Vec<ArrayRef> =
        vec![Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.state.as_str())))];
    columns.extend((0..3).map(|part| number(&|row| row.annual_rate[part])));
    columns.push(number(&|row| row.years));
    columns.extend((0..3).map(|part| number(&|row| row.probability[part])));
    columns.push(Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.meaning))));
    RecordBatch::try_new(RATES.schema(), columns)
}
