//! What is written of an object: who it is, and its probabilities at an intensity.

use serde::{Deserialize, Serialize};

use crate::fragility::{GivenRocking, Kind, Model, Probabilities, Probability};
use crate::rocking::Structure;
use crate::stages::shared::structures::Object;
use crate::table::rows::Row;
use crate::warning::Warning;

/// What is predicted for an object.
pub struct Answer<R> {
    pub object: ObjectRow,
    pub row: R,
    pub warnings: Vec<Warning>,
    /// The model and the measures of the motion, if requested.
    pub explained: String,
}

/// A row of predictions; the default one is that of an object whose row cannot be right.
pub trait Predicted: Row + Default + Send + Sync {
    fn with_warnings(self, warnings: Option<String>) -> Self;

    /// By which objects are sorted, the worst first.
    fn severity(&self) -> f64;
}

/// An object and the model that predicts for it; without parameters where its row cannot be right.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectRow {
    pub structure: String,
    pub width_m: Option<f64>,
    pub height_m: Option<f64>,
    pub p_rad_s: Option<f64>,
    pub alpha_rad: Option<f64>,
    pub eta: Option<f64>,
    /// tan(alpha): with less friction it slides.
    pub friction: Option<f64>,
    pub model: Option<String>,
    pub limit_state: Option<f64>,
}

impl ObjectRow {
    pub fn new(object: &Object, structure: &Structure, model: &Model, limit_state: f64) -> ObjectRow {
        ObjectRow {
            p_rad_s: Some(structure.p_rad_s),
            alpha_rad: Some(structure.alpha_rad),
            eta: Some(structure.eta),
            friction: Some(structure.alpha_rad.tan()),
            model: Some(words_of(model)),
            limit_state: Some(limit_state),
            ..ObjectRow::refused(object)
        }
    }

    /// Of an object whose row cannot be right.
    pub fn refused(object: &Object) -> ObjectRow {
        ObjectRow {
            structure: object.name.clone(),
            width_m: object.size_m.map(|size| size[0]),
            height_m: object.size_m.map(|size| size[1]),
            ..ObjectRow::default()
        }
    }
}

/// What predicts, in words.
pub fn words_of(model: &Model) -> String {
    match model {
        Model::Calibrated { overturning, .. } => {
            let motions = words_of_kind(overturning.kind);
            match overturning.n {
                0 => format!("rockfrag's universal surface for {motions}"),
                n => format!("rockfrag's universal surface, calibrated on {n} responses to {motions}"),
            }
        }
        Model::Paper { overturning, .. } => {
            let suite = overturning.suite.as_deref().and_then(|suite| suite.parse().ok());
            let motions = words_of_kind(Kind::of(suite));
            format!(
                "rockfrag's fit of the paper's curve and planes to {} responses to {motions}",
                overturning.n
            )
        }
    }
}

/// A kind of motion, in words.
pub fn words_of_kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Recorded => "recorded motions",
        Kind::Csgm => "synthetic near-fault motions on rock",
        Kind::Pulse => "synthetic pulses alone",
        Kind::Hfc => "synthetic motions without a pulse",
    }
}

/// The probabilities of the tree at an intensity; none where they are not known.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TreeRow {
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_nr: Option<f64>,
    pub p_ex: Option<f64>,
    pub p_ex_low: Option<f64>,
    pub p_ex_high: Option<f64>,
    pub p_ro: Option<f64>,
    pub p_ro_low: Option<f64>,
    pub p_ro_high: Option<f64>,
    pub p_f_r: Option<f64>,
    pub p_f_r_low: Option<f64>,
    pub p_f_r_high: Option<f64>,
    pub p_f: Option<f64>,
    pub warnings: Option<String>,
}

impl TreeRow {
    /// At a PGA and PGV (m/s2 and m/s).
    pub fn new(peaks: [f64; 2], probabilities: &Probabilities) -> TreeRow {
        let given = probabilities.given_rocking;
        let of = |p: fn(&GivenRocking) -> Probability| {
            let known = given.as_ref().map(p).filter(|p| !p.value.is_nan());
            [known.map(|p| p.value), known.map(|p| p.low), known.map(|p| p.high)]
        };
        let [p_ex, p_ex_low, p_ex_high] = of(|given| given.p_ex);
        let [p_ro, p_ro_low, p_ro_high] = of(|given| given.p_ro);
        let [p_f_r, p_f_r_low, p_f_r_high] = of(|given| given.p_failure);
        TreeRow {
            pga_m_s2: Some(peaks[0]),
            pgv_m_s: Some(peaks[1]),
            p_nr: Some(probabilities.p_nr),
            p_ex,
            p_ex_low,
            p_ex_high,
            p_ro,
            p_ro_low,
            p_ro_high,
            p_f_r,
            p_f_r_low,
            p_f_r_high,
            p_f: probabilities.limit_states().map(|states| states[1].value).filter(|p| !p.is_nan()),
            warnings: None,
        }
    }
}

impl Predicted for TreeRow {
    fn with_warnings(self, warnings: Option<String>) -> TreeRow {
        TreeRow { warnings, ..self }
    }

    fn severity(&self) -> f64 {
        self.p_ro.or(self.p_nr.map(|p_nr| -p_nr)).unwrap_or(f64::NEG_INFINITY)
    }
}

/// Warnings as they stand in a file.
pub fn texts(warnings: &[Warning]) -> Option<String> {
    let texts: Vec<&str> = warnings.iter().map(|warning| warning.text()).collect();
    (!texts.is_empty()).then(|| texts.join("; "))
}
