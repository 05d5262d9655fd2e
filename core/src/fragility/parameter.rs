//! The numbers that a reader of the paper looks for in a fit, each with its standard error and limits.

use serde::{Deserialize, Serialize};

use super::measure_names::Measure;
use crate::spelling::unknown_word;
use crate::statistics::distributions::t_quantile;
use crate::statistics::{FitStatus, Interval};

/// Standard errors between a value and its limits; of the normal distribution without degrees of freedom.
pub(super) fn quantile(confidence: f64, degrees: Option<f64>) -> f64 {
    t_quantile(0.5 * (1.0 + confidence), degrees.unwrap_or(f64::INFINITY))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Parameter>)]
pub enum Parameter {
    /// ln a (Eqs. 16 and 17).
    LnA,
    /// Slope on the first measure.
    B1,
    /// Slope on the second measure.
    B2,
    /// Dispersion: the residual standard deviation of ln EDP, or 1/slope of P_ro.
    Beta,
    /// Dispersion of the demand over its slope, beta / |b1|.
    Zeta,
    /// Exponent of the first measure of a hybrid (Eq. 23).
    Lambda,
    /// Logarithm of the median intensity (Eqs. 20 and 24).
    Mu,
    /// Median intensity, exp(mu).
    Theta,
}

/// A parameter of a fit: a row of pex.parameters.parquet or pro.parameters.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterRow {
    pub suite: Option<String>,
    pub structure: String,
    /// The form of a regression of demand, or the event of a curve.
    pub model: String,
    pub im_x: Measure,
    pub im_y: Option<Measure>,
    /// IM4 from which the fit holds.
    pub range_low: Option<f64>,
    pub parameter: Parameter,
    pub value: f64,
    pub standard_error: f64,
    pub low: f64,
    pub high: f64,
    pub confidence: f64,
    /// That of the fit.
    pub status: FitStatus,
}

impl Parameter {
    /// A value with its limits; those of a dispersion are on the scale of its logarithm.
    pub(super) fn around(self, value: f64, half_width: f64) -> Interval {
        match self {
            Parameter::Beta | Parameter::Zeta => {
                Interval::around(value.ln(), half_width / value).map(f64::exp)
            }
            _ => Interval::around(value, half_width),
        }
    }
}

impl ParameterRow {
    pub fn estimate(&self) -> Interval {
        Interval { value: self.value, low: self.low, high: self.high }
    }

    /// theta = exp(mu).
    pub(super) fn exp(&self) -> ParameterRow {
        let [value, low, high] = [self.value, self.low, self.high].map(f64::exp);
        let standard_error = value * self.standard_error;
        ParameterRow { parameter: Parameter::Theta, value, standard_error, low, high, ..self.clone() }
    }
}
