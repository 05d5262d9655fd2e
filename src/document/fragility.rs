//! The page of fragilities: the intensities of one peak at which half of the motions overturn each object.

use rockfrag_core::fragility::{LimitState, Peak};
use rockfrag_core::hazard::{Fragility, Lognormal, format_intensity};

use super::answers::Outline;
use super::list::doubts;
use super::object::{HEIGHT, averaged, curve, curves_panel, fragility_panel, model_in_words, sketch};
use super::page::{Page, Table};
use crate::chart::text::{literal, words};
use crate::chart::{Figure, Ink, Layer};
use crate::number::{self, significant};
use crate::table::answers::{Answer, FragilityRow, ObjectRow};

/// The most objects whose curves are drawn in one panel, each in a colour.
const DRAWN: usize = 6;

/// The fragility of one object with all its limit states, or overturning of several.
pub fn figure(all: &[Answer<FragilityRow>], outline: Option<Outline>) -> Figure {
    let known: Vec<(&ObjectRow, &Fragility)> =
        all.iter().filter_map(|one| Some((&one.object, one.row.curve.as_ref()?))).collect();
    let Some((object, first)) = known.first() else { return Figure::default() };
    if known.len() == 1 {
        let sketch = outline.map(|outline| sketch(&outline, object));
        let panels = sketch.into_iter().chain([fragility_panel(first, object, None)]).collect();
        return Figure::new("fragility", &object.marked_title(), 2, HEIGHT, panels);
    }
    let mut layers = Vec::new();
    for (number, (object, fragility)) in known.iter().take(DRAWN).enumerate() {
        let marks = curve(fragility, LimitState::Overturning, known.len() < 3);
        layers.push(Layer::line(&object.name_and_floor(), Ink::Data(number), marks));
    }
    let rest = match known.len().saturating_sub(DRAWN) {
        0 => String::new(),
        rest => format!(" Not drawn: {} that take a stronger motion.", number::counted(rest, "object")),
    };
    let (what, averaged) = (first.over.name_and_unit().0, averaged(first.over));
    let caption = format!("Probability of overturning under a motion of this {what}, {averaged}.{rest}");
    let panel = curves_panel(first.over, layers);
    let title = "How strong a motion overturns each object";
    Figure::new("fragility", title, 1, 1.6 * HEIGHT, vec![panel]).explained(caption)
}

/// The page of fragilities, those that need least first; at a site, with its hazard in words.
pub fn page(all: &[Answer<FragilityRow>], outline: Option<Outline>, hazard: Option<&str>) -> Page {
    let notes = doubts(&all.iter().collect::<Vec<_>>());
    let known = all.iter().find_map(|one| Some((&one.object, one.row.curve.as_ref()?)));
    let Some((weakest, fragility)) = known else {
        return Page { title: "No object has an answer".to_string(), notes, ..Page::default() };
    };
    let what = fragility.over.name_and_unit().0;
    let (title, half) = match all {
        [one] => (words(&one.object.marked_title()), "Half".to_string()),
        _ => (
            format!("{}: how strong a motion overturns them", number::counted(all.len(), "object")),
            format!("{} is the weakest: half", weakest.marked_name()),
        ),
    };
    Page {
        title,
        place: match hazard {
            Some(hazard) => format!("Fragility over {what}; hazard: {}", literal(hazard)),
            None => format!("Fragility over {what}, for generic sites"),
        },
        sentence: format!(
            "{half} of the motions overturn it at a {}.",
            half_in_words(fragility.over, &fragility.overturning)
        ),
        facts: model_in_words(weakest).into_iter().collect(),
        tables: vec![table(all, what)],
        notes,
        figures: vec![figure(all, outline)],
        ..Page::default()
    }
}

/// The intensity at which half of the motions overturn an object: `PGA of 0.83 g`.
pub fn half_in_words(over: Peak, Lognormal { theta, .. }: &Lognormal) -> String {
    let of = if theta.value.is_some() { "of " } else { "" };
    format!("{} {of}{}", over.name_and_unit().0, format_intensity(over, theta.value))
}

/// The intensity of one half, its limits after words, and those of 16 and 84 %.
pub fn cells(over: Peak, Lognormal { at_16, theta, at_84, .. }: &Lognormal, words: &str) -> Vec<String> {
    let [low, high] = [theta.low, theta.high].map(|limit| format_intensity(over, limit));
    let limits = theta.low.map_or(String::new(), |_| format!("({words}{low} to {high})"));
    let [theta, at_16, at_84] = [theta, at_16, at_84].map(|at| format_intensity(over, at.value));
    vec![theta, limits, at_16, at_84]
}

fn table(all: &[Answer<FragilityRow>], what: &str) -> Table {
    let half = format!("half overturn at a {what} of");
    let heads = ["object", &half, "95 % limits", "16 %", "84 %", "beta", "half rock too far, or overturn at"];
    let mut rows = Vec::new();
    for one in all {
        let mut row = vec![one.object.name_and_floor()];
        match &one.row.curve {
            None => row.extend(["", "not assessed"].map(str::to_string)),
            Some(Fragility { over, overturning, failure, .. }) => {
                row.extend(cells(*over, overturning, "").iter().map(|cell| cell.replace(['(', ')'], "")));
                row.push(overturning.beta.map_or(String::new(), |beta| significant(beta, 2)));
                row.push(format_intensity(*over, failure.theta.value));
            }
        }
        rows.push(row);
    }
    Table::new(&heads, rows)
}
