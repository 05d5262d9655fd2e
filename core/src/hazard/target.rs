use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentRoot;

use super::site::{Hazard, LEAST, Site, strongest};
use crate::object::{Object, RockingObject};
use crate::spelling::unknown_word;
use crate::statistics::Interval;

/// Bases that meet a target, m, by the rate and by its upper limit: the width beside the depth that the
/// object has or, where that depth is what is too small, the least of both sides; none of an object without
/// width and height.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Bases {
    pub target_width_m: Side,
    pub target_sides_m: Side,
    /// Why there is no base that meets it, or none by the upper limit.
    pub target_end: Option<SearchEnd>,
}

/// A side of a base that meets a target by the rate, and by its upper limit.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Side {
    pub value: Option<f64>,
    pub high: Option<f64>,
}

/// What no base changes: the domain of the model, or motions beyond the end of the hazard curve, each of
/// which may overturn the object, so that its upper limit stays above the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<SearchEnd>)]
pub enum SearchEnd {
    Model,
    Hazard,
}

/// Least and largest slenderness, rad: the domain of the surface begins at 0.04, and at eta 0.7, which is
/// Housner's of a solid block at 0.46.
pub const SLENDERNESSES: [f64; 2] = [0.04, 0.46];
/// Accuracy of ln of a side, and of ln of a rate: far within the limits of a rate.
const ACCURACY: f64 = 1e-4;
const RATE_ACCURACY: f64 = 5e-4;
/// ln of a rate falls by about 5 per ln of a side. Steps by this smaller slope go a little too far, and so
/// bracket the root.
const FALL: f64 = 3.0;

impl Site {
    /// The bases with which the annual rate of overturning is a target, at the same height, rule of eta and
    /// relative offset: of another width, else with both sides changed. `rate` is that of the present object,
    /// `with_models` joins an object with its models.
    pub fn bases(
        &self,
        object: &Object,
        with_models: &dyn Fn(&Object) -> Option<RockingObject>,
        rate: Interval<Option<f64>>,
        target: f64,
    ) -> Bases {
        let ln_margin = rate.value.zip(rate.high).map_or(0.0, |(value, high)| (high / value).ln());
        let mut bases = Bases::default();
        // Equal sides stay equal.
        let first = usize::from(object.shape.width == object.shape.depth);
        for base in [Base::Width, Base::Sides].into_iter().skip(first) {
            if bases.target_width_m.high.is_none()
                && let Some([least, most]) = sides(object, base)
            {
                let search = Search { site: self, object, with_models, base, target, least, most };
                let estimate = search.ln_side(least, Site::overturning);
                let by_hazard = estimate.is_some() && self.rate_beyond() >= target;
                let limit = estimate.filter(|_| !by_hazard).and_then(|ln_side| {
                    // The limit is about as far above the rate as for the present object.
                    search.ln_side((ln_side + ln_margin / FALL).clamp(least, most), upper_limit)
                });
                let [value, high] = [estimate, limit].map(|side| side.map(f64::exp));
                let end = if by_hazard { SearchEnd::Hazard } else { SearchEnd::Model };
                bases.target_end = limit.is_none().then_some(end);
                match base {
                    Base::Width => bases.target_width_m = Side { value, high },
                    Base::Sides => {
                        let value = value.filter(|_| bases.target_width_m.value.is_none());
                        bases.target_sides_m = Side { value, high };
                    }
                }
            }
        }
        bases
    }

    /// Annual rate of motions beyond a curve that ends before the strongest motions.
    fn rate_beyond(&self) -> f64 {
        match &self.hazard {
            Hazard::Curve(hazard) => {
                let [_, (last, rate)] = hazard.curve.ends();
                if last < strongest(hazard.peak) { rate } else { 0.0 }
            }
            Hazard::Joint(_) => 0.0,
        }
    }
}

#[derive(Clone, Copy)]
enum Base {
    /// The width, beside the depth as it is.
    Width,
    /// Both sides, where they are smaller.
    Sides,
}

impl Base {
    /// The object with this width or least side, m.
    fn resize(self, object: &Object, side: f64) -> Object {
        let shape = &object.shape;
        match self {
            Base::Width => object.resized(side, shape.depth),
            Base::Sides => object
                .resized(shape.width.unwrap_or(side).max(side), shape.depth.map(|depth| depth.max(side))),
        }
    }
}

/// ln of the present side, or the nearest possible, and of the largest; none of both sides without a depth.
fn sides(object: &Object, base: Base) -> Option<[f64; 2]> {
    let shape = &object.shape;
    let (width, height) = shape.width.zip(shape.height)?;
    let side = match base {
        Base::Width => width,
        Base::Sides => shape.depth?.min(width),
    };
    let centre_height = shape.centre_height.unwrap_or(0.5 * height);
    let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
    let [least, most] = SLENDERNESSES.map(|alpha| (2.0 * centre_height * alpha.tan() / nearer).ln());
    // Never less than it is.
    let least = least.max(side.ln());
    Some([least, most.max(least)])
}

/// A search in ln of the width, or of the smaller side: ln rate is almost linear in it.
struct Search<'a> {
    site: &'a Site,
    object: &'a Object,
    with_models: &'a dyn Fn(&Object) -> Option<RockingObject>,
    base: Base,
    target: f64,
    least: f64,
    most: f64,
}

/// None where the model has no probability.
type RateFunction = fn(&Site, &RockingObject) -> Option<f64>;

fn upper_limit(site: &Site, object: &RockingObject) -> Option<f64> {
    site.rates(object).states.overturning.high
}

impl Search<'_> {
    /// ln of a rate over the target.
    fn excess(&self, ln_side: f64, rate: RateFunction) -> Option<f64> {
        let resized = self.base.resize(self.object, ln_side.exp());
        let rate = rate(self.site, &(self.with_models)(&resized)?)?;
        Some((rate.max(LEAST) / self.target).ln())
    }

    /// ln of the first side, outwards from `start`, at which the rate is the target: by steps, and between
    /// the last two by Brent's method. The least side if the rate is below the target even there.
    fn ln_side(&self, start: f64, rate: RateFunction) -> Option<f64> {
        let (mut side, mut off) = (start, self.excess(start, rate)?);
        let edge = if off > 0.0 { self.most } else { self.least };
        let mut step = off / FALL;
        while off.abs() > RATE_ACCURACY {
            let next = if step.abs() < (edge - side).abs() { side + step } else { edge };
            if next == side {
                return (off <= 0.0).then_some(side);
            }
            let there = self.excess(next, rate)?;
            if (there > 0.0) != (off > 0.0) {
                let solver = BrentRoot::new(side, next, ACCURACY);
                let bracket = Bracket { search: self, rate, ends: [(side, off), (next, there)] };
                let root = Executor::new(bracket, solver).timer(false);
                let root = root.configure(|state| state.target_cost(RATE_ACCURACY));
                return root.run().ok()?.state.take_best_param();
            }
            (side, off, step) = (next, there, 2.0 * step);
        }
        Some(side)
    }
}

struct Bracket<'a> {
    search: &'a Search<'a>,
    rate: RateFunction,
    ends: [(f64, f64); 2],
}

impl CostFunction for Bracket<'_> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, ln_side: &f64) -> Result<f64, Error> {
        let known = self.ends.iter().find(|(end, _)| end == ln_side);
        let excess = known.map(|(_, off)| *off).or_else(|| self.search.excess(*ln_side, self.rate));
        excess.ok_or_else(|| Error::msg("no rate"))
    }
}
