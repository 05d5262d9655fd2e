//! An object, its model and the warnings about its answer, in words.

use std::path::Path;

use rockfrag_core::object::UncertaintySource;
use rockfrag_core::warning::Warning;

use crate::number;
use crate::table::answers::{Answer, ObjectRow};

/// The answer for all objects, the worst of which is the first.
pub fn text<R>(
    all: &[Answer<R>],
    tell: impl FnOnce(&Answer<R>) -> String,
    tell_list: impl FnOnce() -> String,
) -> String {
    match all {
        _ if all.iter().all(|answer| answer.object.p_rad_s.is_none()) => {
            all.iter().map(|answer| format!("{}: {}\n", answer.object.title(), brief(answer))).collect()
        }
        [answer] => tell(answer),
        _ => tell_list(),
    }
}

pub fn model(object: &ObjectRow) -> &str {
    object.model.as_deref().unwrap_or("no model")
}

/// Sentences that are there, in a line.
pub fn line(sentences: impl IntoIterator<Item = Option<String>>) -> String {
    let sentences: Vec<String> = sentences.into_iter().flatten().collect();
    if sentences.is_empty() { String::new() } else { sentences.join(" ") + "\n" }
}

/// What is taken of the buildings, if an object stands on a floor.
pub fn about_buildings<R>(all: &[Answer<R>]) -> Option<String> {
    let is_any = all.iter().any(|answer| answer.object.floor_level.is_some());
    is_any.then(|| "The building is taken as linear.".to_string())
}

/// What the answer for an object takes as given.
pub fn validity<R>(answer: &Answer<R>) -> String {
    let friction = friction(&answer.object);
    let friction = (!answer.object.is_friction_known)
        .then(|| format!("Valid if friction is above {friction}; else it slides."));
    line([friction, about_buildings(std::slice::from_ref(answer))])
}

pub fn friction(object: &ObjectRow) -> String {
    object.friction.map_or("-".to_string(), |friction| number::fixed(friction, 2))
}

/// The largest part of the error, and what would narrow it: of PGV / PGA this advice.
pub fn mostly_unknown<R>(answer: &Answer<R>, about_velocity: &str) -> Option<String> {
    let part = answer.doubts.error_largest?;
    let advice = match part {
        UncertaintySource::Fit if answer.responses > 0 => "",
        UncertaintySource::Fit => "Calibrate it with records of the site (--fits).",
        UncertaintySource::Magnitude => "Add --magnitude.",
        UncertaintySource::Velocity => about_velocity,
        UncertaintySource::Eta => "Measure it (--eta, --eta-sd).",
        UncertaintySource::Object => "Measure its centre of mass.",
        UncertaintySource::Floor => "Measure its period (--period, --period-sd).",
        UncertaintySource::Hazard => "",
    };
    Some(format!("Largest uncertainty: {}. {advice}", part.description()).trim_end().to_string())
}

/// The warnings of an object in a few words, or in full why it has no answer.
fn brief<R>(answer: &Answer<R>) -> String {
    match &answer.doubts.warnings {
        Some(reason) if answer.object.p_rad_s.is_none() => reason.clone(),
        _ => answer.warnings.iter().map(Warning::to_string).collect::<Vec<_>>().join(", ").replace('_', " "),
    }
}

/// Rows of a list that are printed, of one that goes to a file or is longer than the second number.
const PRINTED: [usize; 2] = [20, 40];

/// A table of a list: of each object its size, these cells and the warnings; at its end the responses to
/// which each was fitted, if these are not the same for all. Of a long list, or one that goes to a file, the
/// worst.
pub fn table<R>(
    headings: &[&str],
    all: &[Answer<R>],
    out: Option<&Path>,
    cells: impl Fn(&Answer<R>) -> Vec<String>,
) -> String {
    let is_fitted_each = is_fitted_each(all);
    let mut head = [&["object", "size"], headings, &["warning"]].concat();
    head.extend(is_fitted_each.then_some("responses"));
    let mut rows = vec![head.into_iter().map(str::to_string).collect()];
    let most = if out.is_some() || all.len() > PRINTED[1] { PRINTED[0] } else { all.len() };
    let (printed, others) = all.split_at(most.min(all.len()));
    for answer in printed {
        let size = answer.object.size() + &answer.object.floor_after(", ");
        let mut row = vec![answer.object.structure.clone(), size];
        row.extend(cells(answer));
        row.push(brief(answer));
        row.extend(is_fitted_each.then(|| number::count(answer.responses as usize)));
        rows.push(row);
    }
    number::aligned(&rows, |_| false) + &where_others_are(others, out)
}

/// How many of all have no answer, for a line that says that nothing happens.
pub fn where_silent<R>(all: &[Answer<R>]) -> String {
    let silent = all.iter().filter(|answer| answer.object.p_rad_s.is_none()).count();
    match silent {
        0 => String::new(),
        _ => format!(". For {} of {} there is no answer.", number::count(silent), number::count(all.len())),
    }
}

/// How many objects are not printed, and where they are.
fn where_others_are<R>(others: &[Answer<R>], out: Option<&Path>) -> String {
    let place = match out {
        _ if others.is_empty() => return String::new(),
        Some(out) => format!("in {}", out.display()),
        None => "by --out or --format csv".to_string(),
    };
    let without = others.iter().filter(|answer| answer.object.p_rad_s.is_none()).count();
    let without = if without > 0 { format!(" ({without} without an answer)") } else { String::new() };
    format!("and {} more{without}, {place}\n", number::count(others.len()))
}

fn is_fitted_each<R>(all: &[Answer<R>]) -> bool {
    let objects = all.iter().map(|answer| &answer.object);
    let mut models = objects.filter(|object| object.p_rad_s.is_some()).map(|object| &object.model);
    models.next().is_some_and(|first| models.any(|other| other != first))
}

/// What predicts for all objects, the worst of which is the first.
pub fn model_of_all<R>(all: &[Answer<R>]) -> String {
    let worst = &all[0].object;
    match worst.motions.filter(|_| is_fitted_each(all)) {
        Some(kind) if model(worst).contains("surface") => {
            format!(
                "rockfrag's universal surface, calibrated to the simulated responses ({})",
                kind.description()
            )
        }
        _ => model(worst).to_string(),
    }
}
