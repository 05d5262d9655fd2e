//! The motions file that import-motions writes: one row a recorded motion.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, SchemaRef};

use super::{measures, synthetic_motions};
use crate::keyword::Keyword;
use crate::motion::pulse::largest_velocity;
use crate::records::processing::ImportedMotion;
use crate::records::pulses::{FittedPulse, PulseIndicator};
use crate::records::rotation::RotD;

/// The rows of the file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ImportedMotion], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&ImportedMotion) -> &str| -> ArrayRef {
        Arc::new(StringArray::from_iter_values(rows.iter().map(value)))
    };
    let optional_text = |value: fn(&ImportedMotion) -> Option<String>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let number = |value: fn(&ImportedMotion) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let optional = |value: fn(&ImportedMotion) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let mut columns = vec![
        text(|row| &row.motion_id),
        text(|row| row.suite.as_str()),
        optional_text(ImportedMotion::name),
        optional_text(|row| row.event.clone()),
        optional_text(|row| row.station.clone()),
        optional_text(|row| row.component.clone()),
        optional(|row| row.azimuth_deg),
        text(|row| &row.source.path),
        text(|row| &row.source.blake3),
        number(|row| row.scale),
        number(|row| row.dt_s),
    ];
    columns.extend(measures::columns(rows.iter().map(|row| &row.measured)));
    let rotd = |value: fn(&RotD) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| row.rotd.as_ref().map(value))))
    };
    let indicator = |value: fn(&PulseIndicator) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| row.indicator.as_ref().map(value))))
    };
    let fitted = |value: fn(&FittedPulse) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| row.pulse.as_ref().map(value))))
    };
    columns.extend([
        rotd(|rotd| rotd.pga50_m_s2),
        rotd(|rotd| rotd.pga100_m_s2),
        rotd(|rotd| rotd.pgv50_m_s),
        rotd(|rotd| rotd.pgv100_m_s),
        indicator(|found| found.indicator),
        optional_text(|row| row.indicator.map(|found| found.verdict.as_str().to_string())),
        indicator(|found| found.period_s),
        fitted(|fit| fit.pulse.amplitude_m_s),
        fitted(|fit| fit.pulse.amplitude_m_s * largest_velocity(fit.pulse.gamma, fit.pulse.nu_rad)),
        fitted(|fit| fit.pulse.tp_s),
        fitted(|fit| fit.pulse.gamma),
        fitted(|fit| fit.pulse.nu_rad),
        fitted(|fit| fit.t0_s),
        fitted(|fit| fit.r2),
    ]);
    columns.push(synthetic_motions::samples(rows.iter().map(|row| row.acceleration_m_s2.as_slice())));
    columns.extend(measures::spectrum(rows.iter().map(|row| &row.measured)));
    RecordBatch::try_new(schema.clone(), columns)
}
