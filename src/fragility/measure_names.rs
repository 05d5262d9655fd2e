//! The intensity measures that fits are made of.

use std::str::FromStr;

use crate::keyword::keywords;
use crate::motion::IntensityMeasures;

keywords! {
    /// A dimensionless intensity measure (Eq. 13).
    #[derive(Hash)]
    pub enum Measure {
        /// wp / p.
        Im1 = "im1",
        /// wm / p.
        Im2 = "im2",
        /// PGA / (p PGV).
        Im3 = "im3",
        /// PGA / (g tan alpha).
        Im4 = "im4",
        /// p PGV / (g tan alpha).
        Im5 = "im5",
        /// wm PGV / (g tan alpha).
        Im6 = "im6",
        /// p PGV / PGA, the frequency ratio of Figure 12: 1 / IM3.
        Im3Inverse = "im3_inv",
    }
}

impl Measure {
    /// The six of Eq. 13.
    pub const SCALAR: [Measure; 6] =
        [Measure::Im1, Measure::Im2, Measure::Im3, Measure::Im4, Measure::Im5, Measure::Im6];

    /// Returns its value for a motion; none where it is missing.
    pub fn raw_value_of(self, measures: &IntensityMeasures) -> Option<f64> {
        match self {
            Measure::Im1 => measures.im1,
            Measure::Im2 => measures.im2,
            Measure::Im3 => measures.im3,
            Measure::Im4 => Some(measures.im4),
            Measure::Im5 => Some(measures.im5),
            Measure::Im6 => measures.im6,
            Measure::Im3Inverse => measures.im3.map(|im3| 1.0 / im3),
        }
    }

    /// Returns its value for a motion; none where it is missing or not positive, so that it has no logarithm.
    pub fn value_of(self, measures: &IntensityMeasures) -> Option<f64> {
        self.raw_value_of(measures).filter(|value| value.is_finite() && *value > 0.0)
    }
}

/// Returns IMx and, of two measures, IMy; none where one is missing.
pub fn values(im_x: Measure, im_y: Option<Measure>, measures: &IntensityMeasures) -> Option<Vec<f64>> {
    std::iter::once(im_x).chain(im_y).map(|measure| measure.value_of(measures)).collect()
}

/// Returns 1, ln IMx and, of two measures, ln IMy: what the coefficients of a fit multiply.
pub fn design_row(ims: &[f64]) -> Vec<f64> {
    std::iter::once(1.0).chain(ims.iter().map(|im| im.ln())).collect()
}

/// Two measures that make a hybrid one (Eq. 23), written as `im4:im3_inv`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair(pub Measure, pub Measure);

impl serde::Serialize for Pair {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{}:{}", self.0, self.1))
    }
}

impl FromStr for Pair {
    type Err = String;

    fn from_str(text: &str) -> Result<Pair, String> {
        let (x, y) =
            text.split_once(':').ok_or_else(|| format!("'{text}': expected two measures as im4:im3_inv"))?;
        let [x, y] = [x, y].map(|name| name.trim().parse());
        match Pair(x?, y?) {
            Pair(x, y) if x == y => Err(format!("'{text}': expected two different measures")),
            pair => Ok(pair),
        }
    }
}
