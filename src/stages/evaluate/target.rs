//! The width of a base that meets a target: all else of the object the same.

use std::str::FromStr;

use super::object::Subject;
use crate::hazard::{Site, probability_in_years};
use crate::number::Limited;
use crate::stages::shared::model_args::Models;
use crate::stages::shared::objects::Object;

/// A probability of overturning in the time of exposure, such as 1%.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target(pub f64);

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Target, String> {
        match text.strip_suffix('%').map(|percent| percent.trim_end().parse::<f64>()) {
            Some(Ok(percent)) if percent > 0.0 && percent < 100.0 => Ok(Target(0.01 * percent)),
            _ => Err("expected a probability in --years with its percent sign, such as 1%".to_string()),
        }
    }
}

/// Slendernesses of the structures that the surface knows, rad: eta of a wider solid block is below 0.7.
const SLENDERNESSES: [f64; 2] = [0.04, 0.46];
/// Halvings of the widths that may meet a target, and to the end of the hazard.
const HALVINGS: [i32; 2] = [12, 8];

/// The ends of an interval in which a condition begins to hold, after so many halvings.
fn halved([before, after]: [f64; 2], halvings: i32, holds: impl Fn(f64) -> bool) -> [f64; 2] {
    let halve = |[before, after]: [f64; 2], _| {
        let middle = 0.5 * (before + after);
        if holds(middle) { [before, middle] } else { [middle, after] }
    };
    (0..halvings).fold([before, after], halve)
}

/// Widths (m) that meet a target by the estimate and by its upper limit: at the same height, depth, rule of
/// eta and relative offset; none where none within the domain of the surface does.
pub fn widths(object: &Object, models: &Models, site: &Site, years: f64, target: Target) -> [Option<f64>; 2] {
    let shape = &object.spec.shape;
    let Some((width, height)) = shape.width.zip(shape.height) else { return [None; 2] };
    let centre_height = shape.centre_height.unwrap_or(0.5 * height);
    let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
    let [least, end] = SLENDERNESSES.map(|alpha| 2.0 * centre_height * alpha.tan() / nearer);
    // What is not known does not matter to an estimate, and takes most of the time.
    let in_years = |width_m: f64, with_unknowns: bool| -> Option<Limited> {
        let resized = Object::new(object.spec.resized(width_m / width));
        let (subject, _) = Subject::of(&resized, resized.directions.as_ref().ok()?, models).ok()?;
        let unknowns = if with_unknowns { &subject.unknowns[..] } else { &[] };
        let rates = site.rates(&subject.directions, unknowns).overturning;
        Some(rates.map(|rate| Some(probability_in_years(rate?, years))))
    };
    // The hazard of a wide object may end too early for a rate.
    let is_known = |width_m: f64| in_years(width_m, false).is_some_and(|p| p[0].is_some());
    let most = match is_known(end) {
        true => end,
        false => halved([least, end], HALVINGS[1], |width_m| !is_known(width_m))[0],
    };
    [0, 2].map(|which| {
        let p = |width_m: f64| in_years(width_m, which == 2)?[which];
        let meets = |width_m: f64| p(width_m).is_some_and(|p| p <= target.0);
        meets(most).then(|| halved([least, most], HALVINGS[0], meets)[1])
    })
}
