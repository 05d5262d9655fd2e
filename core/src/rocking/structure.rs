//! Rocking structures: p, alpha and eta, given or computed from dimensions (section 2.2.1).

use crate::plausibility::range_of_column;
use crate::units::G_M_S2;

/// A rigid rocking structure: the three parameters of its response.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Structure {
    #[serde(rename = "structure")]
    pub name: String,
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    /// Coefficient of restitution eta: the ratio of the angular velocities after and before impact.
    pub eta: f64,
    /// Rebound from a wall behind it, the ratio of the angular velocities after and before the impact: of the
    /// surface's probabilities alone, since solvers rock it to both sides.
    #[serde(skip)]
    pub rebound: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("structure '{structure}': {parameter} is {value}; expected {expected}")]
pub struct StructureError {
    pub structure: String,
    pub parameter: &'static str,
    pub value: f64,
    pub expected: &'static str,
}

impl Structure {
    /// # Errors
    /// If `p` is not in [0.001, 100] rad/s, `alpha` not in [1e-6, pi/2) rad or `eta` not in (0, 1].
    pub fn new(name: &str, p_rad_s: f64, alpha_rad: f64, eta: f64) -> Result<Structure, StructureError> {
        let given = [("p", "p_rad_s", p_rad_s), ("alpha", "alpha_rad", alpha_rad), ("eta", "eta", eta)];
        for (parameter, column, value) in given {
            let (range, expected) = range_of_column(column);
            if !range.contains(&value) {
                return Err(StructureError { structure: name.to_string(), parameter, value, expected });
            }
        }
        Ok(Structure { name: name.to_string(), p_rad_s, alpha_rad, eta, rebound: None })
    }

    /// Makes a solid rectangular block of full width and height (m); `eta` as given, or [`housner_eta`].
    ///
    /// # Errors
    /// If a dimension is not positive and finite, or `eta` is out of range (of a very stocky block).
    pub fn rectangular_block(
        name: &str,
        width_m: f64,
        height_m: f64,
        eta: Option<f64>,
    ) -> Result<Structure, StructureError> {
        for (parameter, value) in [("width", width_m), ("height", height_m)] {
            if !(value > 0.0 && value.is_finite()) {
                let expected = "a length above 0 m";
                return Err(StructureError { structure: name.to_string(), parameter, value, expected });
            }
        }
        let alpha_rad = (width_m / height_m).atan();
        let eta = eta.unwrap_or_else(|| housner_eta(alpha_rad));
        Structure::new(name, rectangular_p(0.5 * width_m.hypot(height_m)), alpha_rad, eta)
    }

    /// Makes a frame of rocking columns (solid rectangles of full width and height, m) with a rigid beam;
    /// `beam_mass_ratio` is the mass of the beam over that of all columns, `eta` as given, or [`frame_eta`].
    ///
    /// # Errors
    /// As for [`Structure::rectangular_block`], or if the mass ratio is negative or not finite.
    pub fn frame(
        name: &str,
        width_m: f64,
        height_m: f64,
        beam_mass_ratio: f64,
        eta: Option<f64>,
    ) -> Result<Structure, StructureError> {
        if !(beam_mass_ratio >= 0.0 && beam_mass_ratio.is_finite()) {
            let (parameter, expected) = ("beam-mass-ratio", "a mass ratio of 0 or more");
            let structure = name.to_string();
            return Err(StructureError { structure, parameter, value: beam_mass_ratio, expected });
        }
        let column = Structure::rectangular_block(name, width_m, height_m, Some(1.0))?;
        let eta = eta.unwrap_or_else(|| frame_eta(column.alpha_rad, beam_mass_ratio));
        Structure::new(name, frame_p(column.p_rad_s, beam_mass_ratio), column.alpha_rad, eta)
    }

    /// Whether p, alpha and eta are those of another structure, each within 1 %.
    pub fn is_like(&self, other: &Structure) -> bool {
        let mut both = self.parameters().into_iter().zip(other.parameters());
        both.all(|(a, b)| (a - b).abs() <= 0.01 * b.abs())
    }

    /// p, alpha and eta.
    pub fn parameters(&self) -> [f64; 3] {
        [self.p_rad_s, self.alpha_rad, self.eta]
    }

    /// Returns the diagonal (m) of the solid rectangular block that has this p.
    pub fn block_diagonal_m(&self) -> f64 {
        1.5 * G_M_S2 / (self.p_rad_s * self.p_rad_s)
    }

    /// Computes the uplift acceleration g tan(alpha), m/s2 (Eq. 5): the unit of IM4 to IM6.
    pub fn uplift_acceleration_m_s2(&self) -> f64 {
        G_M_S2 * self.alpha_rad.tan()
    }
}

/// Computes the frequency parameter of a solid rectangular block, rad/s, from its semi-diagonal R (m):
/// p = sqrt(3 g / (4 R)).
pub fn rectangular_p(semi_diagonal_m: f64) -> f64 {
    (3.0 * G_M_S2 / (4.0 * semi_diagonal_m)).sqrt()
}

/// Computes the frequency parameter of a rocking frame, rad/s, from that of one column, pb, and the ratio y
/// of beam to column mass: p = pb sqrt((1 + 2 y)/(1 + 3 y)) (Makris & Vassiliou 2013).
pub fn frame_p(column_p_rad_s: f64, beam_mass_ratio: f64) -> f64 {
    column_p_rad_s * ((1.0 + 2.0 * beam_mass_ratio) / (1.0 + 3.0 * beam_mass_ratio)).sqrt()
}

/// Computes Housner's (1963) coefficient of restitution of a rectangular block: eta = 1 - 1.5 sin^2(alpha).
pub fn housner_eta(alpha_rad: f64) -> f64 {
    1.0 - 1.5 * alpha_rad.sin().powi(2)
}

/// Computes the coefficient of restitution of a rocking frame with the ratio y of beam to column mass:
/// eta = (1 - 1.5 sin^2(alpha) + 3 y cos(2 alpha)) / (1 + 3 y) (Makris & Vassiliou 2013).
pub fn frame_eta(alpha_rad: f64, beam_mass_ratio: f64) -> f64 {
    (housner_eta(alpha_rad) + 3.0 * beam_mass_ratio * (2.0 * alpha_rad).cos()) / (1.0 + 3.0 * beam_mass_ratio)
}
