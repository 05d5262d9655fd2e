use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array};

use crate::motion::Measured;

/// The columns of intensity measures from `pga_m_s2` to `housner_m`.
pub(super) fn columns<'a>(motions: impl Iterator<Item = &'a Measured> + Clone) -> Vec<ArrayRef> {
    let number = |value: fn(&Measured) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(motions.clone().map(value)))
    };
    let optional = |value: fn(&Measured) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(motions.clone().map(value)))
    };
    vec![
        number(|motion| motion.measures.pga_m_s2),
        number(|motion| motion.measures.pgv_m_s),
        number(|motion| motion.measures.pgd_m),
        optional(|motion| motion.measures.tm_s),
        number(|motion| motion.measures.arias_m_s),
        number(|motion| motion.measures.cav_m_s),
        number(|motion| motion.measures.d5_75_s),
        number(|motion| motion.measures.d5_95_s),
        optional(|motion| motion.housner_m),
    ]
}

/// The columns of spectral accelerations, as many as all motions have.
pub(super) fn spectrum<'a>(motions: impl Iterator<Item = &'a Measured> + Clone) -> Vec<ArrayRef> {
    let periods = motions.clone().map(|motion| motion.sa_m_s2.len()).min().unwrap_or(0);
    let column = |period: usize| -> ArrayRef {
        Arc::new(Float64Array::from_iter(motions.clone().map(|motion| motion.sa_m_s2.get(period).copied())))
    };
    (0..periods).map(column).collect()
}
