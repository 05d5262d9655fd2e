//! What would change an object, one thing at a time.

use rockfrag_core::hazard::{Site, probability_in_years};
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::statistics::Interval;
use serde::{Deserialize, Serialize};

use super::ModelsOf;

/// An object with one thing changed, and how likely it overturns then: as it is first; with a wider base, a
/// lower centre of mass, on another floor; and several rows of the same name where a test may find a
/// property low or high.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Variant {
    pub structure: String,
    pub variant: String,
    pub width_m: Option<f64>,
    pub depth_m: Option<f64>,
    pub height_m: Option<f64>,
    pub centre_height_m: Option<f64>,
    pub floor_period_s: Option<f64>,
    pub floor_level: Option<f64>,
    pub eta: Option<f64>,
    pub overturning_per_year: Interval<Option<f64>>,
    pub p_overturning: Interval<Option<f64>>,
}

/// The variants of an object at a site; none of one without an answer. What would not rock, or lies outside
/// the model, has no row.
pub fn variants(object: &Object, site: &Site, years: f64, models: ModelsOf) -> Vec<Variant> {
    let Ok((as_it_is, _)) = models(object) else { return Vec::new() };
    let mut all = vec![Variant::new("as it is".to_string(), object, &as_it_is, site, years)];
    for changed in object.changes() {
        let Ok((rocking, _)) = models(&changed.object) else { continue };
        all.push(Variant::new(changed.words, &changed.object, &rocking, site, years));
    }
    all
}

impl Variant {
    fn new(words: String, object: &Object, rocking: &RockingObject, site: &Site, years: f64) -> Variant {
        let (shape, floor) = (&object.shape, object.place.floor().ok().flatten());
        let rate = site.rates(rocking).states.overturning;
        Variant {
            structure: object.name.clone(),
            variant: words,
            width_m: shape.width,
            depth_m: shape.depth,
            height_m: shape.height,
            centre_height_m: shape.centre_height,
            floor_period_s: floor.map(|floor| floor.period_s),
            floor_level: floor.map(|floor| floor.level),
            eta: Some(rocking.directions[0].structure.eta),
            overturning_per_year: rate,
            p_overturning: rate.map(|rate| probability_in_years(rate, years)),
        }
    }
}
