//! Answers as pages show them, and what the page of one object shows besides.

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Hazard, HazardCurve, Site, exceedance, probability_in_years};
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::statistics::Interval;
use serde_json::Value;

use super::point::{self, TreeRow};
use crate::document::answers::{Change, Evaluation, Outline, Portrait, Rated, SiteHazard, in_years};
use crate::document::{Page, list, object};
use crate::stages::shared::model_args::Models;
use crate::table::answers::Answer;
use crate::table::provenance::Provenance;

/// Answers over a hazard, and what their call tells.
pub fn over_hazard(rows: Vec<Rated>, made: &Provenance) -> Evaluation {
    Evaluation {
        when: rows.iter().find_map(|answer| answer.row.years).map_or(String::new(), in_years),
        target: made.arguments.get("target").and_then(Value::as_f64),
        hazard: format!("hazard: {}", made.names("hazard").unwrap_or("of another program".to_string())),
        hazard_key: made.input("hazard").unwrap_or_default(),
        rows,
        ..Evaluation::default()
    }
}

/// Answers under one motion.
pub fn under_motion(answers: &[Answer<TreeRow>]) -> Evaluation {
    let rows = answers.iter().map(|answer| Answer {
        object: answer.object.clone(),
        row: answer.row.without_rates(),
        doubts: answer.doubts.clone(),
        ..Answer::default()
    });
    Evaluation {
        when: answers.first().map_or(String::new(), |answer| point::words_of_peaks(&answer.row)),
        hazard: "under one motion".to_string(),
        rows: rows.collect(),
        ..Evaluation::default()
    }
}

/// Bins of intensity.
const BINS: usize = 60;

/// The page of answers: of one object its portrait, of several a list.
pub fn page(evaluation: &Evaluation) -> Page {
    match &evaluation.rows[..] {
        [one] => object::page(evaluation, one),
        _ => list::page(evaluation),
    }
}

/// What the page shows besides the row of an object that is alone; without a site its outline.
pub fn portrait(
    objects: &[Object],
    models: &Models,
    site: Option<&Site>,
    years: f64,
) -> anyhow::Result<Portrait> {
    let [object] = objects else { return Ok(Portrait::default()) };
    if object.sides().is_err() {
        return Ok(Portrait::default());
    }
    let rocking_object = models.rocking_object(object)?.0;
    let outline = outline(object, &rocking_object);
    let Some(site) = site else { return Ok(Portrait { outline, ..Portrait::default() }) };
    let p = vec![overturning(&rocking_object, site, years)];
    let mut changes = vec![Change { words: "as it is".to_string(), is_moved: false, p }];
    for changed in object.changes() {
        // What would not rock, or lies outside the model, has no row.
        let Ok((rocking_object, _)) = models.rocking_object(&changed.object) else { continue };
        let p = overturning(&rocking_object, site, years);
        match changes.last_mut().filter(|last| last.words == changed.words) {
            Some(same) => same.p.push(p),
            None => {
                let is_moved = changed.object.place.level != object.place.level;
                changes.push(Change { words: changed.words, is_moved, p: vec![p] });
            }
        }
    }
    let (peak, curve) = match &site.hazard {
        Hazard::Curve(hazard) => (hazard.peak, Ok(hazard.curve.clone())),
        Hazard::Joint(pairs) => (Peak::Pga, HazardCurve::new(exceedance(pairs, |pair| pair.peaks.pga_m_s2))),
    };
    let parts = site.rate_by_intensity(&rocking_object, BINS);
    let hazard = curve.ok().map(|curve| SiteHazard { peak, curve, parts });
    Ok(Portrait { outline, fragility: site.fragility(&rocking_object), hazard, changes })
}

/// The object over the side to which it falls first.
fn outline(object: &Object, rocking_object: &RockingObject) -> Option<Outline> {
    let shape = &object.shape;
    let (width, height) = shape.width.zip(shape.height)?;
    let centre_height = shape.centre_height.unwrap_or(0.5 * height);
    let alpha_rad = rocking_object.directions[0].structure.alpha_rad;
    let weaker = shape.depth.filter(|depth| ((0.5 * depth / centre_height).atan() - alpha_rad).abs() < 1e-9);
    let (width, centre_offset) = match weaker {
        Some(depth) => (depth, 0.0),
        None => (width, shape.centre_offset.unwrap_or(0.0)),
    };
    Some(Outline { width, height, centre_height, centre_offset, alpha_rad })
}

fn overturning(rocking_object: &RockingObject, site: &Site, years: f64) -> Interval<Option<f64>> {
    site.rates(rocking_object).states.overturning.map(|rate| probability_in_years(rate, years))
}
