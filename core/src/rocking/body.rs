//! A rigid body on two edges: p, alpha and eta of its weaker side, for any place of the centre of mass.

use super::structure::{Structure, StructureError};
use crate::units::G_M_S2;

/// A rigid body on the edges of a base, in the plane in which it rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Width of the base, m.
    pub width_m: f64,
    /// Height of the centre of mass above the base, m.
    pub centre_height_m: f64,
    /// Distance of the centre of mass from the middle of the base, m.
    pub centre_offset_m: f64,
    /// Moment of inertia about the centre of mass over mass, m2.
    pub inertia_m2: f64,
}

impl Body {
    /// Moment of inertia over mass of a solid rectangle, m2: (w^2 + h^2)/12.
    pub fn solid_inertia_m2(width_m: f64, height_m: f64) -> f64 {
        (width_m * width_m + height_m * height_m) / 12.0
    }

    pub fn solid(width_m: f64, height_m: f64) -> Body {
        let inertia_m2 = Body::solid_inertia_m2(width_m, height_m);
        Body { width_m, centre_height_m: 0.5 * height_m, centre_offset_m: 0.0, inertia_m2 }
    }

    /// Length R (m) and angle alpha from the vertical (rad) of the lines from both edges to the centre of
    /// mass. The weaker side comes first: its edge is nearer to the centre of mass.
    fn sides(&self) -> [(f64, f64); 2] {
        [-1.0, 1.0].map(|sign| {
            let distance = 0.5 * self.width_m + sign * self.centre_offset_m.abs();
            (distance.hypot(self.centre_height_m), (distance / self.centre_height_m).atan())
        })
    }

    /// Slenderness of the weaker side, rad: atan((b - e)/h).
    pub fn alpha_rad(&self) -> f64 {
        self.sides()[0].1
    }

    /// Frequency parameter of the weaker side, rad/s: sqrt(g R/(I/m + R^2)).
    pub fn p_rad_s(&self) -> f64 {
        let radius_m = self.sides()[0].0;
        (G_M_S2 * radius_m / (self.inertia_m2 + radius_m * radius_m)).sqrt()
    }

    /// Coefficient of restitution: the geometric mean of the impacts from either edge to the other, by
    /// conservation of angular momentum about the new one,
    /// (I/m + R_i R_j cos(alpha_i + alpha_j))/(I/m + R_j^2). Not above 0 where an impact stops the body.
    pub fn eta(&self) -> f64 {
        let [(weak_r, weak_alpha), (strong_r, strong_alpha)] = self.sides();
        let common = self.inertia_m2 + weak_r * strong_r * (weak_alpha + strong_alpha).cos();
        common / ((self.inertia_m2 + weak_r * weak_r) * (self.inertia_m2 + strong_r * strong_r)).sqrt()
    }

    /// The structure with p and alpha of the weaker side, and `eta` or else the restitution of the body.
    ///
    /// # Errors
    /// If the centre of mass is not above the base, or eta is out of range (of a squat body).
    pub fn structure(&self, name: &str, eta: Option<f64>) -> Result<Structure, StructureError> {
        Structure::new(name, self.p_rad_s(), self.alpha_rad(), eta.unwrap_or_else(|| self.eta()))
    }
}
