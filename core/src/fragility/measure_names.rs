//! The intensity measures that fits are made of.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::motion::IntensityMeasures;
use crate::statistics::FitStatus;

/// A dimensionless intensity measure.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub enum Measure {
    /// wp / p (Eq. 13).
    Im1,
    /// wm / p.
    Im2,
    /// PGA / (p PGV).
    Im3,
    /// PGA / (g tan alpha).
    Im4,
    /// p PGV / (g tan alpha).
    Im5,
    /// wm PGV / (g tan alpha).
    Im6,
    /// p PGV / PGA, the frequency ratio of Figure 12: 1 / IM3.
    Im3Inverse,
    /// A further measure, by the name of its column of the motions.
    Column(String),
}

impl Measure {
    /// The six of Eq. 13.
    pub const SCALAR: [Measure; 6] =
        [Measure::Im1, Measure::Im2, Measure::Im3, Measure::Im4, Measure::Im5, Measure::Im6];

    /// The name in options and files.
    pub fn as_str(&self) -> &str {
        match self {
            Measure::Im1 => "im1",
            Measure::Im2 => "im2",
            Measure::Im3 => "im3",
            Measure::Im4 => "im4",
            Measure::Im5 => "im5",
            Measure::Im6 => "im6",
            Measure::Im3Inverse => "im3_inv",
            Measure::Column(name) => name,
        }
    }

    /// The status of a fit that falls with a measure, or with two.
    pub(super) fn falling(&self, other: Option<&Measure>) -> FitStatus {
        match (self, other) {
            (Measure::Im1 | Measure::Im2 | Measure::Im3, None) => FitStatus::Inverse,
            _ => FitStatus::WrongSign,
        }
    }

    /// None where the measure is missing, as a further measure is, or has no logarithm.
    pub fn value_of(&self, measures: &IntensityMeasures) -> Option<f64> {
        let value = match self {
            Measure::Im1 => measures.im1,
            Measure::Im2 => measures.im2,
            Measure::Im3 => measures.im3,
            Measure::Im4 => Some(measures.im4),
            Measure::Im5 => Some(measures.im5),
            Measure::Im6 => measures.im6,
            Measure::Im3Inverse => measures.im3.map(|im3| 1.0 / im3),
            Measure::Column(_) => None,
        };
        value.filter(has_logarithm)
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl From<String> for Measure {
    fn from(name: String) -> Measure {
        let known = Measure::SCALAR.into_iter().chain([Measure::Im3Inverse]).find(|one| one.as_str() == name);
        known.unwrap_or(Measure::Column(name))
    }
}

impl From<Measure> for String {
    fn from(measure: Measure) -> String {
        measure.as_str().to_string()
    }
}

pub(super) fn has_logarithm(value: &f64) -> bool {
    value.is_finite() && *value > 0.0
}

/// IMx and, of two measures, IMy; none where one is missing.
pub fn values(im_x: &Measure, im_y: Option<&Measure>, measures: &IntensityMeasures) -> Option<Vec<f64>> {
    std::iter::once(im_x).chain(im_y).map(|measure| measure.value_of(measures)).collect()
}

/// 1, ln IMx and, of two measures, ln IMy: the factors of the coefficients of a fit.
pub fn design_row(ims: &[f64]) -> Vec<f64> {
    std::iter::once(1.0).chain(ims.iter().map(|im| im.ln())).collect()
}

/// One measure, or two that make a plane or a hybrid one (Eq. 23), written as `im5` or `im4:im3_inv`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Predictors {
    pub im_x: Measure,
    pub im_y: Option<Measure>,
}

impl Predictors {
    pub fn one(im_x: Measure) -> Predictors {
        Predictors { im_x, im_y: None }
    }

    pub fn two([im_x, im_y]: [Measure; 2]) -> Predictors {
        Predictors { im_x, im_y: Some(im_y) }
    }

    /// Appends what is asked for, each once.
    pub(super) fn without_repeats(mut all: Vec<Predictors>, asked: &[Predictors]) -> Vec<Predictors> {
        for predictors in asked {
            if !all.contains(predictors) {
                all.push(predictors.clone());
            }
        }
        all
    }

    pub fn measures(&self) -> impl Iterator<Item = &Measure> {
        std::iter::once(&self.im_x).chain(&self.im_y)
    }
}

impl fmt::Display for Predictors {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let names: Vec<&str> = self.measures().map(Measure::as_str).collect();
        f.pad(&names.join(":"))
    }
}

impl Serialize for Predictors {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> serde::Deserialize<'de> for Predictors {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Predictors, D::Error> {
        <String as serde::Deserialize>::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl FromStr for Predictors {
    type Err = String;

    fn from_str(text: &str) -> Result<Predictors, String> {
        let names: Vec<&str> = text.split(':').map(str::trim).collect();
        let measure = |name: &str| Measure::from(name.to_string());
        match names[..] {
            [x] if !x.is_empty() => Ok(Predictors::one(measure(x))),
            [x, y] if x != y && !names.contains(&"") => Ok(Predictors::two([x, y].map(measure))),
            _ => Err("expected a measure as im5, or two different ones as im4:im3_inv".to_string()),
        }
    }
}
