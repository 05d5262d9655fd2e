//! The width of a base that meets a target: all else of the object the same.

use argmin::core::{CostFunction, Error, Executor};
use argmin::solver::brent::BrentRoot;

use super::object::Subject;
use crate::hazard::{Site, probability_in_years};
use crate::number::Limited;
use crate::stages::shared::model_args::Models;
use crate::stages::shared::objects::Object;

/// Parses a probability of overturning in the time of exposure, such as 1%.
pub fn parse(text: &str) -> Result<f64, String> {
    match text.strip_suffix('%').map(|percent| percent.trim_end().parse::<f64>()) {
        Some(Ok(percent)) if percent > 0.0 && percent < 100.0 => Ok(0.01 * percent),
        _ => Err("expected a probability in --years with its percent sign, such as 1%".to_string()),
    }
}

/// Slendernesses of the structures that the surface knows, rad: eta of a wider solid block is below 0.7.
const SLENDERNESSES: [f64; 2] = [0.04, 0.46];
/// Relative accuracy of a width, and largest number of steps.
const ACCURACY: f64 = 1e-4;
const MOST_STEPS: u64 = 60;
/// Halvings of the widths to the end of the hazard.
const HALVINGS: usize = 8;
/// Probabilities count as no less.
const LEAST: f64 = 1e-12;

/// A function of the width, where it has a value.
struct OfWidth<F>(F);

impl<F: Fn(f64) -> Option<f64>> CostFunction for OfWidth<F> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, width: &f64) -> Result<f64, Error> {
        (self.0)(*width).ok_or_else(|| Error::msg("no rate"))
    }
}

/// Widths (m) that meet a target by the estimate and by its upper limit: at the same height, depth, rule of
/// eta and relative offset; none where none within the domain of the surface does.
pub fn widths(object: &Object, models: &Models, site: &Site, years: f64, target: f64) -> [Option<f64>; 2] {
    let shape = &object.spec.shape;
    let Some((width, height)) = shape.width.zip(shape.height) else { return [None; 2] };
    let centre_height = shape.centre_height.unwrap_or(0.5 * height);
    let nearer = 1.0 - shape.centre_offset.map_or(0.0, |offset| 2.0 * offset.abs() / width);
    let [least, end] = SLENDERNESSES.map(|alpha| 2.0 * centre_height * alpha.tan() / nearer);
    // What is not known does not matter to an estimate, and takes most of the time.
    let in_years = |width_m: f64, with_unknowns: bool| -> Option<Limited> {
        let resized = Object::new(object.spec.resized(width_m / width));
        let (subject, _) = Subject::of(&resized, models).ok()?;
        let unknowns = if with_unknowns { &subject.unknowns[..] } else { &[] };
        let rates = site.rates(&subject.directions, unknowns).overturning;
        Some(rates.map(|rate| Some(probability_in_years(rate?, years))))
    };
    // The hazard of a wide object may end too early for a rate.
    let is_known = |width_m: f64| in_years(width_m, false).is_some_and(|p| p[0].is_some());
    let halve = |(known, unknown): (f64, f64), _| {
        let middle = 0.5 * (known + unknown);
        if is_known(middle) { (middle, unknown) } else { (known, middle) }
    };
    let most = if is_known(end) { end } else { (0..HALVINGS).fold((least, end), halve).0 };
    [0, 2].map(|which| {
        // ln of the probability by its estimate or upper limit over the target.
        let excess = |width_m: f64| {
            let p = in_years(width_m, which == 2)?[which]?;
            Some((p.max(LEAST) / target).ln())
        };
        if excess(most)? > 0.0 {
            return None;
        }
        if excess(least)? <= 0.0 {
            return Some(least);
        }
        let search = Executor::new(OfWidth(excess), BrentRoot::new(least, most, ACCURACY)).timer(false);
        let search = search.configure(|state| state.param(0.5 * (least + most)).max_iters(MOST_STEPS));
        search.run().ok()?.state.best_param
    })
}
