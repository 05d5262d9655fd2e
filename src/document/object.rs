//! The document of one object.

use std::iter;

use rockfrag_core::hazard::Fragility;
use rockfrag_core::statistics::Interval;

use super::phrases::{facts, intensity, intensity_cells};
use super::{Document, Table, Tile};
use crate::answer::{Answer, AnswerTable, FragilityColumns, over_all};
use crate::chart::text::literal;
use crate::figures::answers;
use crate::number::{PERCENT, RATE};

pub fn document(table: &AnswerTable, answer: &Answer) -> Document {
    let when = answer.when().unwrap_or_default();
    let (variants, hazard) = (&table.variants[..], table.hazard.as_ref());
    let is_rocking = answer.tree.p_nr.filter(|p_nr| *p_nr < 1.0);
    let uplift = is_rocking.map(|_| format!("It {}.", answer.uplift()));
    Document {
        title: answer.object.title(),
        place: format!("Stands {}{}", answer.object.place_in_building(), table.conditions()),
        lead: iter::once(format!("It {}.", answer.how_often())).chain(answer.about_target("")).collect(),
        tiles: tiles(&when, variants, table),
        facts: uplift.into_iter().chain(facts(&[answer], hazard)).collect(),
        notes: answer.uncertainty.warnings.iter().map(|doubts| literal(doubts)).collect(),
        tables: answer.is_answered().then(|| numbers(&when, answer, variants)).into_iter().collect(),
        figures: match answer.fragility.over {
            Some(_) => answers::fragilities(&[answer]),
            None => vec![answers::object(answer, variants, table.at_site.as_ref())],
        },
        ..Document::default()
    }
}

/// The object as it is; the change that helps most, nothing that is only measured; another floor; and the
/// motion that overturns it.
fn tiles(when: &str, variants: &[Answer], table: &AnswerTable) -> Vec<Tile> {
    let mut tiles = Vec::new();
    if let [as_it_is, others @ ..] = variants {
        let p = |one: &Answer| one.p.p_overturning.value.unwrap_or(1.0);
        let is_moved = |one: &Answer| one.object.floor_level != as_it_is.object.floor_level;
        // Where its angle stays it is only known better.
        let is_leaner = |one: &Answer| one.object.alpha_rad != as_it_is.object.alpha_rad;
        let changed = others.iter().filter(|one| is_leaner(one) || is_moved(one));
        let best = changed.clone().min_by(|a, b| p(a).total_cmp(&p(b)));
        let best = best.filter(|best| p(best) < p(as_it_is));
        let moved = changed.clone().find(|one| is_moved(one) && best.is_none_or(|best| !is_moved(best)));
        for Answer { variant, p, .. } in [Some(as_it_is), best, moved].into_iter().flatten() {
            let limits = PERCENT.limits(p.p_overturning, "95 % limits ");
            let words = format!("overturns {when}: {}{limits}", variant.as_deref().unwrap_or_default());
            tiles.push(Tile::new(PERCENT.value(p.p_overturning), words));
        }
    }
    let drawn = table.at_site.as_ref().and_then(|drawn| drawn.fragility.as_ref());
    if let Some(Fragility { over, overturning, .. }) = drawn {
        let (what, unit, _) = over.name_and_unit();
        let half = intensity(*over, overturning.theta.value.map(|theta| theta / unit));
        tiles.push(Tile::new(half, format!("{what} at which half of the motions overturn it")));
    }
    tiles
}

/// The answer, and what it is with one thing changed; under one motion there are no rates, over a peak
/// intensities.
fn numbers(when: &str, answer: &Answer, variants: &[Answer]) -> Table {
    let Answer { object, p, rates, .. } = answer;
    let (too_far, overturns) = (object.too_far(), "overturns".to_string());
    let (mut over, mut rows) = (Vec::new(), Vec::new());
    for FragilityColumns { over: peak, failure, overturning } in over_all([answer]).map(|of| &of.fragility) {
        let Some(peak) = *peak else { continue };
        over.push(peak.name_and_unit().0);
        rows.extend(
            [(&too_far, failure), (&overturns, overturning)]
                .map(|(name, of)| [vec![name.clone()], intensity_cells(peak, of).into()].concat()),
        );
    }
    if !over.is_empty() {
        let half = format!("half at a {} of", over.join(" or "));
        return Table::new(&["", &half, "95 % limits", "16 %", "84 %", "beta"], rows);
    }
    let row = |name: String, p, per_year| {
        let rate = rates.years.map_or(String::new(), |_| RATE.value(per_year));
        vec![name, PERCENT.value(p), PERCENT.span(p), rate]
    };
    let [p_rocking, rocking_per_year] = [p.p_rocking, rates.rocking_per_year].map(Interval::without_limits);
    let mut rows = vec![
        row("rocks".to_string(), p_rocking, rocking_per_year),
        row(too_far, p.p_failure, rates.failure_per_year),
        row(overturns, p.p_overturning, rates.overturning_per_year),
    ];
    rows.extend(variants.iter().skip(1).map(|Answer { variant, p, rates, .. }| {
        let name = format!("overturns: {}", variant.as_deref().unwrap_or_default());
        row(name, p.p_overturning, rates.overturning_per_year)
    }));
    Table::new(&["", when, "95 % limits", "rate a year"], rows)
}
