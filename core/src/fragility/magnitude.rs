//! The magnitude of the earthquakes that an answer is for.

use crate::spelling::unknown_word;

/// The magnitude that an answer assumes: its median and, where it was not given, its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AssumedMagnitude {
    pub mw: f64,
    pub sd: f64,
    pub source: MagnitudeSource,
}

impl AssumedMagnitude {
    pub fn given(mw: f64) -> AssumedMagnitude {
        AssumedMagnitude { mw, sd: 0.0, source: MagnitudeSource::Given }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<MagnitudeSource>)]
pub enum MagnitudeSource {
    Given,
    /// That of the motions that overturn, at all sites.
    Usual,
    /// Inferred from PGV / PGA of each motion; its median is that of the motion of the answer.
    Inferred,
}
