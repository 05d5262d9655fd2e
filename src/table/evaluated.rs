//! What evaluate answers: probabilities at one intensity or at many, and annual rates.

use arrow_array::RecordBatch;
use arrow_schema::ArrowError;
use serde::{Deserialize, Serialize};

use super::row::{WriteRow, table};
use crate::fragility::{LimitState, Measure, Probabilities};

table! {
    /// Probabilities at many intensities.
    pub struct ProbabilityRow as EVALUATED = "probabilities" by "evaluate" {
        p_rad_s: f64,
        alpha_rad: f64,
        pga_m_s2: f64,
        pgv_m_s: f64,
        p_nr: f64,
        p_ex: Option<f64>,
        p_ex_low: Option<f64>,
        p_ex_high: Option<f64>,
        p_ro: Option<f64>,
        p_ro_low: Option<f64>,
        p_ro_high: Option<f64>,
        p_f_r: Option<f64>,
        p_f_r_low: Option<f64>,
        p_f_r_high: Option<f64>,
        p_f: Option<f64>,
        out_of_range: Option<Measure>,
        distance: Option<f64>,
        p_ro_universal: Option<f64>,
    }
}

table! {
    /// All probabilities at one intensity.
    pub struct QuantityRow<'a> as ANSWER = "probabilities at one intensity" by "evaluate" {
        quantity: &'a str = asked,
        value: Option<f64>,
        low: Option<f64>,
        high: Option<f64>,
        meaning: &'a str,
    }
}

table! {
    /// Annual rates of the limit states.
    pub struct AnnualRate as RATES = "annual rates" by "evaluate" {
        state: LimitState,
        annual_rate: f64,
        annual_rate_low: Option<f64>,
        annual_rate_high: Option<f64>,
        years: f64,
        p: f64,
        p_low: Option<f64>,
        p_high: Option<f64>,
        meaning: String,
    }
}

/// The hazard behind annual rates, as their file holds it for a report.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordedHazard {
    /// Name of its file.
    pub file: String,
    /// How many rows that has.
    pub rows: usize,
    /// One of a hazard curve, two of a joint hazard of PGA and PGV.
    pub curves: Vec<RecordedCurve>,
    /// What a reader of the rates must know, a sentence each.
    #[serde(default)]
    pub notes: Vec<String>,
}

/// How often a peak is exceeded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordedCurve {
    /// `pga` or `pgv`.
    pub peak: String,
    /// The peak, m/s2 or m/s, and the annual rate at which it is exceeded.
    pub points: Vec<(f64, f64)>,
}

/// Probabilities of one structure at one intensity, as a row among many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EvaluatedRow {
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
    pub probabilities: Probabilities,
    /// A measure outside of the range of the data.
    pub out_of_range: Option<Measure>,
    /// How far the question is from the middle of the data, their rim being 1; none without rocking.
    pub distance: Option<f64>,
    /// P_ro by the surface that is shipped, where fits answer.
    pub p_ro_universal: Option<f64>,
}

impl From<&EvaluatedRow> for ProbabilityRow {
    fn from(row: &EvaluatedRow) -> ProbabilityRow {
        let given = row.probabilities.given_rocking;
        let (p_ex, p_ro, p_f_r) = (
            given.map(|given| given.p_ex),
            given.map(|given| given.p_ro),
            given.map(|given| given.p_failure),
        );
        ProbabilityRow {
            p_rad_s: row.p_rad_s,
            alpha_rad: row.alpha_rad,
            pga_m_s2: row.pga_m_s2,
            pgv_m_s: row.pgv_m_s,
            p_nr: row.probabilities.p_nr,
            p_ex: p_ex.map(|p| p.value),
            p_ex_low: p_ex.map(|p| p.low),
            p_ex_high: p_ex.map(|p| p.high),
            p_ro: p_ro.map(|p| p.value),
            p_ro_low: p_ro.map(|p| p.low),
            p_ro_high: p_ro.map(|p| p.high),
            p_f_r: p_f_r.map(|p| p.value),
            p_f_r_low: p_f_r.map(|p| p.low),
            p_f_r_high: p_f_r.map(|p| p.high),
            p_f: row.probabilities.limit_states().map(|[_, failure, _]| failure.value),
            out_of_range: row.out_of_range,
            distance: row.distance,
            p_ro_universal: row.p_ro_universal,
        }
    }
}

/// Rows of probabilities.
///
/// # Errors
/// If memory runs out.
pub fn batch(rows: &[EvaluatedRow]) -> Result<RecordBatch, ArrowError> {
    ProbabilityRow::batch(&rows.iter().map(ProbabilityRow::from).collect::<Vec<_>>())
}

/// A quantity with limits, if it has them.
#[derive(Debug, Clone, PartialEq)]
pub struct AnswerRow {
    pub quantity: &'static str,
    pub value: Option<f64>,
    pub limits: Option<(f64, f64)>,
    pub meaning: String,
}

/// The rows of an answer.
///
/// # Errors
/// If memory runs out.
pub fn answer(rows: &[AnswerRow]) -> Result<RecordBatch, ArrowError> {
    let rows = rows.iter().map(|row| QuantityRow {
        quantity: row.quantity,
        value: row.value,
        low: row.limits.map(|limits| limits.0),
        high: row.limits.map(|limits| limits.1),
        meaning: &row.meaning,
    });
    QuantityRow::batch(&rows.collect::<Vec<_>>())
}

/// The annual rate of a limit state, and what it means over years; value, lower and upper limit of both.
#[derive(Debug, Clone, PartialEq)]
pub struct RateRow {
    pub state: LimitState,
    pub annual_rate: [f64; 3],
    pub years: f64,
    /// Probability in this time.
    pub probability: [f64; 3],
    /// What the limit state is.
    pub meaning: String,
}

/// The rows of annual rates.
///
/// # Errors
/// If memory runs out.
pub fn rates(rows: &[RateRow]) -> Result<RecordBatch, ArrowError> {
    let rows = rows.iter().map(|row| {
        let ([annual_rate, rate_low, rate_high], [p, low, high]) = (row.annual_rate, row.probability);
        // Rocking follows from the hazard alone.
        let limit = |limit: f64| (row.state != LimitState::Rocking).then_some(limit);
        let [annual_rate_low, annual_rate_high, p_low, p_high] = [rate_low, rate_high, low, high].map(limit);
        AnnualRate {
            state: row.state,
            annual_rate,
            annual_rate_low,
            annual_rate_high,
            years: row.years,
            p,
            p_low,
            p_high,
            meaning: row.meaning.clone(),
        }
    });
    AnnualRate::batch(&rows.collect::<Vec<_>>())
}
