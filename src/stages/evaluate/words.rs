//! An object, its model and what speaks against its answer, in words.

use super::object::{Answer, ObjectRow};
use crate::hazard::{Budget, Part};
use crate::number;
use crate::rocking::rectangular_p;
use crate::warning::UNNAMED;

/// An object that has a name by it, others by what they are.
pub fn title(object: &ObjectRow) -> String {
    let size = size(object);
    match (object.structure.as_str(), object.width_m, object.height_m, object.p_rad_s) {
        (UNNAMED, Some(width), Some(height), Some(p)) => {
            let is_block = (rectangular_p(0.5 * width.hypot(height)) / p - 1.0).abs() < 1e-9;
            let is_upright = object.friction.is_some_and(|tan| (tan * height / width - 1.0).abs() < 1e-9);
            let what = match (is_block, is_upright && object.depth_m.is_none()) {
                (true, _) => "Block",
                (_, true) => "Frame of columns",
                _ => "Body",
            };
            format!("{what} of {size}")
        }
        (UNNAMED, ..) => format!("Structure of {size}"),
        (name, ..) => format!("{name}, {size}"),
    }
}

/// Width and height, else p and alpha.
pub fn size(object: &ObjectRow) -> String {
    size_alone(object) + &floor(object)
}

/// The floor that it stands on.
fn floor(object: &ObjectRow) -> String {
    object.floor_level.zip(object.floor_period_s).map_or(String::new(), |(level, period)| {
        let [level, period] = [level, period].map(number::plain);
        format!(" at level {level} of a {period} s building")
    })
}

/// What is taken of the buildings, if an object stands on a floor.
pub fn linear<'a>(mut objects: impl Iterator<Item = &'a ObjectRow>) -> &'static str {
    let is_any = objects.any(|object| object.floor_level.is_some());
    if is_any { " The building is taken as linear." } else { "" }
}

fn size_alone(object: &ObjectRow) -> String {
    let depth = object.depth_m.map_or(String::new(), |depth| format!(" x {}", number::length(depth)));
    match (object.width_m, object.height_m, object.p_rad_s, object.alpha_rad) {
        (Some(width), Some(height), ..) => {
            format!("{}{depth} x {} m", number::length(width), number::length(height))
        }
        (.., Some(p), Some(alpha)) => {
            let [p, alpha] = [p, alpha].map(|value| number::significant(value, 3));
            format!("p {p} rad/s, alpha {alpha}")
        }
        _ => "-".to_string(),
    }
}

pub fn model(object: &ObjectRow) -> &str {
    object.model.as_deref().unwrap_or("no model")
}

pub fn validity(object: &ObjectRow) -> String {
    let linear = linear(std::iter::once(object));
    format!("Valid if friction is above {}; else it slides.{linear}", friction(object))
}

pub fn friction(object: &ObjectRow) -> String {
    object.friction.map_or("-".to_string(), |friction| number::fixed(friction, 2))
}

pub fn too_far(object: &ObjectRow) -> String {
    let limit_state = object.limit_state.unwrap_or(f64::NAN);
    format!("rocks beyond {} of its slenderness", number::PERCENT.one(limit_state))
}

/// The largest part of the error, and what would narrow it: of PGV / PGA this advice.
pub fn mostly_unknown(budget: &Budget, of_velocity: &str) -> Option<String> {
    let part = budget.largest()?;
    let advice = match part {
        Part::Fit => "Calibrate it (--fits).",
        Part::Magnitude => "Add --magnitude.",
        Part::Velocity => of_velocity,
        Part::Eta => "Measure it (--eta, --eta-sd).",
        Part::Object => "Measure its centre of mass.",
        Part::Floor => "Measure its period (--period, --period-sd).",
        Part::Hazard => "",
    };
    Some(format!("Largest uncertainty: {}. {advice}", part.words()).trim_end().to_string())
}

/// Why an object has no answer.
pub fn unanswered<R>(answer: &Answer<R>, reason: &Option<String>) -> String {
    format!("{}: {}\n", title(&answer.object), reason.as_deref().unwrap_or("no answer"))
}

/// The warnings of a row in a few words; the reason in full if the row cannot be right.
pub fn brief<R>(answer: &Answer<R>, reason: &Option<String>) -> String {
    match reason {
        Some(reason) if answer.object.p_rad_s.is_none() => reason.clone(),
        _ => {
            let words = answer.warnings.iter().map(|warning| warning.to_string().replace('_', " "));
            words.collect::<Vec<_>>().join(", ")
        }
    }
}

/// A table of a list: a heading, and a row per object; at its end the responses to which each was fitted, if these
/// are not the same for all.
pub fn table<R>(heading: &[&str], all: &[Answer<R>], row: impl Fn(&Answer<R>) -> Vec<String>) -> String {
    let differ = is_fitted_each(all);
    let responses = |answer: &Answer<R>| differ.then(|| number::count(answer.responses as usize));
    let heading = heading.iter().copied().chain(differ.then_some("responses")).map(str::to_string).collect();
    let row = |answer: &Answer<R>| row(answer).into_iter().chain(responses(answer)).collect();
    let rows: Vec<Vec<String>> = std::iter::once(heading).chain(all.iter().map(row)).collect();
    number::aligned(&rows, |_| false)
}

fn is_fitted_each<R>(all: &[Answer<R>]) -> bool {
    let known = || all.iter().filter(|answer| answer.object.p_rad_s.is_some());
    known().zip(known().skip(1)).any(|(a, b)| a.object.model != b.object.model)
}

/// What predicts for all objects, the worst of which is the first.
pub fn model_of_all<R>(all: &[Answer<R>]) -> String {
    let Some(worst) = all.first() else { return String::new() };
    let is_of_surface = worst.object.model.as_deref().is_some_and(|model| model.contains("surface"));
    match is_of_surface && is_fitted_each(all) {
        true => "rockfrag's universal surface, calibrated where there are responses".to_string(),
        false => model(&worst.object).to_string(),
    }
}

/// Adds the sentences for a report, if requested, and the explanations. A sentence goes on after the name.
pub fn with_sentences<R>(
    mut text: String,
    all: &[Answer<R>],
    requested: bool,
    sentence: impl Fn(&ObjectRow, &R) -> String,
) -> String {
    for Answer { object, row, .. } in all {
        if requested && object.p_rad_s.is_some() {
            let title = title(object);
            let comma = if title.contains(", ") { "," } else { "" };
            let (sentence, friction) = (sentence(object, row), friction(object));
            text += &format!("\n{title}{comma} {sentence}, if its friction is above {friction}.\n");
        }
    }
    for answer in all {
        text += &answer.explained;
    }
    text
}
