//! The motions file that import-motions writes: one row a recorded motion.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, SchemaRef};

use super::{measures, synthetic_motions};
use crate::keyword::Keyword;
use crate::motion::processing::RotD;
use crate::motion::pulse::largest_velocity;
use crate::motion::pulse_fit::FittedPulse;
use crate::motion::pulse_indicator::PulseIndicator;
use crate::motion::{Measured, Suite};

/// A recorded motion on its way into a file.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordRow {
    /// Unique in the file.
    pub motion_id: String,
    /// Its kind.
    pub suite: Suite,
    /// The earthquake in the words of the file.
    pub event: Option<String>,
    /// The station in the words of the file.
    pub station: Option<String>,
    /// The component in the words of the file.
    pub component: Option<String>,
    /// Direction of positive acceleration, degrees clockwise from north.
    pub azimuth_deg: Option<f64>,
    /// The file it comes from.
    pub source: Source,
    /// The factor by which it is scaled.
    pub scale: f64,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2, as they are written.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: Measured,
    /// Peaks over all directions of the pair it is rotated from.
    pub rotd: Option<RotD>,
    /// Whether it holds a pulse, if that was looked for.
    pub indicator: Option<PulseIndicator>,
    /// The pulse that it holds.
    pub pulse: Option<FittedPulse>,
}

/// A file, and the hash of what it holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Its path as given.
    pub file: String,
    /// BLAKE3, in hexadecimal digits.
    pub blake3: String,
}

impl RecordRow {
    fn name(&self) -> Option<String> {
        let parts: Vec<&str> =
            [&self.event, &self.station, &self.component].into_iter().flatten().map(String::as_str).collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }
}

/// The rows of the file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[RecordRow], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&RecordRow) -> &str| -> ArrayRef {
        Arc::new(StringArray::from_iter_values(rows.iter().map(value)))
    };
    let optional_text = |value: fn(&RecordRow) -> Option<String>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let number = |value: fn(&RecordRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let optional = |value: fn(&RecordRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let mut columns = vec![
        text(|row| &row.motion_id),
        text(|row| row.suite.as_str()),
        optional_text(RecordRow::name),
        optional_text(|row| row.event.clone()),
        optional_text(|row| row.station.clone()),
        optional_text(|row| row.component.clone()),
        optional(|row| row.azimuth_deg),
        text(|row| &row.source.file),
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
