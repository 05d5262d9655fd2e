//! An object on a pedestal: fixed to it, both are one body; loose, it rocks by itself if the pedestal stays.

use super::given::{Object, ObjectError, Place, Shape};
use crate::number::rounded;
use crate::rocking::Body;

/// A body on another, `lower_height_m` high, as one; `share` is the mass of the upper over that of both. The
/// centre of mass is at share (H2 + h1) + (1 - share) h2 and, by the parallel-axis theorem, I/m is
/// share I1/m1 + (1 - share) I2/m2 + share (1 - share) d^2 with the distance d of both centres.
pub fn stacked(upper: &Body, lower: &Body, lower_height_m: f64, share: f64) -> Body {
    let mean = |of_upper: f64, of_lower: f64| share * of_upper + (1.0 - share) * of_lower;
    let upper_height_m = lower_height_m + upper.centre_height_m;
    let aside_m = upper.centre_offset_m - lower.centre_offset_m;
    let apart_m = (upper_height_m - lower.centre_height_m).hypot(aside_m);
    Body {
        width_m: lower.width_m,
        centre_height_m: mean(upper_height_m, lower.centre_height_m),
        centre_offset_m: mean(upper.centre_offset_m, lower.centre_offset_m),
        inertia_m2: mean(upper.inertia_m2, lower.inertia_m2) + share * (1.0 - share) * apart_m * apart_m,
    }
}

impl Object {
    /// With the pedestal that it is fixed to as one body; loose, alone.
    pub fn on_pedestal(self) -> Object {
        let Place { pedestal_width, pedestal_depth, pedestal_height, pedestal_mass, .. } = self.place;
        let sizes = [pedestal_width, pedestal_depth, pedestal_height, pedestal_mass];
        let has_none = self.place.fixed_to_pedestal.is_none() && sizes.iter().all(Option::is_none);
        if has_none || self.refused.is_some() {
            return self;
        }
        self.with_pedestal().unwrap_or_else(|reason| Object { refused: Some(reason), ..self })
    }

    fn with_pedestal(&self) -> Result<Object, ObjectError> {
        let (shape, place) = (self.shape, self.place);
        // One has a depth if the other has.
        let [depth, lower_depth] = [(shape.depth, place.pedestal_depth), (place.pedestal_depth, shape.depth)]
            .map(|(depth, other)| depth.or(other.xor(Some(0.0))));
        let needed = [
            ("width", shape.width),
            ("depth", depth),
            ("height", shape.height),
            ("mass", place.mass),
            ("pedestal-width", place.pedestal_width),
            ("pedestal-depth", lower_depth),
            ("pedestal-height", place.pedestal_height),
            ("pedestal-mass", place.pedestal_mass),
            ("fixed-to-pedestal", place.fixed_to_pedestal.map(|_| 0.0)),
        ];
        let missing: Vec<&str> = needed.iter().filter(|of| of.1.is_none()).map(|of| of.0).collect();
        let [width, _, height, mass, _, _, lower_height, lower_mass, _] =
            needed.map(|(_, value)| value.unwrap_or_default());
        if !missing.is_empty() {
            let problem = format!("on a pedestal; missing: {}", missing.join(", "));
            return Err(ObjectError::Implausible(problem));
        }
        self.check_dimensions(width, height)?;
        let share = mass / (mass + lower_mass);
        let lower = Shape {
            width: place.pedestal_width,
            depth: place.pedestal_depth,
            height: place.pedestal_height,
            ..Shape::default()
        };
        let (upper, lowers) = (shape.bodies(), lower.bodies());
        let both: Vec<Body> =
            upper.iter().zip(&lowers).map(|(a, b)| stacked(a, b, lower_height, share)).collect();
        if place.fixed_to_pedestal == Some(false) {
            let stays = both.iter().zip(&upper).all(|(both, upper)| both.alpha_rad() >= upper.alpha_rad());
            let reason = || ObjectError::NotRocking("loose on a pedestal that uplifts before it".to_string());
            return stays.then(|| self.clone()).ok_or_else(reason);
        }
        let shape = Shape {
            height: Some(rounded(lower_height + height)),
            centre_height: Some(both[0].centre_height_m),
            centre_offset: shape.centre_offset.map(|_| both[0].centre_offset_m),
            inertia: Some(both[0].inertia_m2),
            inertia_across: both.get(1).map(|body| body.inertia_m2),
            eta: shape.eta,
            ..lower
        };
        let place = Place {
            centre_height_sd: place.centre_height_sd.map(|sd| share * sd),
            centre_offset_sd: place.centre_offset_sd.map(|sd| share * sd),
            ..place
        };
        Ok(Object { shape, place, ..self.clone() })
    }
}
