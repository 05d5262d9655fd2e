//! The document of one object.

use rockfrag_core::statistics::Interval;

use super::phrases::{facts, intensity, intensity_cells};
use super::{Document, Table, Tile};
use crate::answer::{Answer, AnswerTable, Usual};
use crate::chart::text::literal;
use crate::figures::answers::{self, years};
use crate::number::{PERCENT, RATE, significant};

pub fn document(table: &AnswerTable, answer: &Answer) -> Document {
    let when = answer.when().unwrap_or_default();
    let (variants, hazard) = (&table.variants[..], table.hazard.as_ref());
    let is_rocking = answer.tree.p_nr.filter(|p_nr| *p_nr < 1.0);
    let uplift = is_rocking.map(|_| format!("It {}.", answer.uplift()));
    Document {
        title: answer.object.title(),
        place: format!("Stands {}{}", answer.object.place_in_building(), table.conditions()),
        lead: [Some(format!("It {}.", answer.how_often(hazard))), answer.about_target("")]
            .into_iter()
            .flatten()
            .collect(),
        tiles: tiles(&when, variants, table),
        facts: uplift.into_iter().chain(facts(&[answer], hazard)).collect(),
        notes: answer.uncertainty.warnings.iter().map(|doubts| literal(doubts)).collect(),
        tables: answer.is_answered().then(|| numbers(&when, answer, variants)).into_iter().collect(),
        figures: vec![match answer.fragility.over {
            Some(over) => answers::fragilities(&[answer], over),
            None => answers::object(answer, variants, table.at_site.as_ref()),
        }],
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
        let changed = others.iter().filter(|one| !one.is_measured(as_it_is));
        let best = changed.clone().min_by(|a, b| p(a).total_cmp(&p(b)));
        let best = best.filter(|best| p(best) < p(as_it_is));
        let moved = changed.clone().find(|one| is_moved(one) && best.is_none_or(|best| !is_moved(best)));
        let more = [format!(", {when}"), ", which helps most".to_string(), String::new()];
        for (change, more) in [Some(as_it_is), best, moved].into_iter().zip(more) {
            let Some(Answer { variant: Some(variant), p, .. }) = change else { continue };
            let limits = PERCENT.limits(p.p_overturning, "95 % limits ");
            let words = format!("overturns: {variant}{more}{limits}");
            tiles.push(Tile::new(PERCENT.value(p.p_overturning), words));
        }
    }
    let drawn = table.at_site.as_ref();
    if let Some((drawn, fragility)) = drawn.and_then(|drawn| Some((drawn, drawn.fragility.as_ref()?))) {
        let usual = drawn.usual().next().map_or(String::new(), |Usual { intensity, years: period }| {
            let (intensity, symbol) = (significant(intensity, 2), drawn.peak.name_and_unit().2);
            format!("; {intensity} {symbol} comes once in {}", years(period))
        });
        let words =
            format!("{} at which half of the motions overturn it{usual}", fragility.over.name_and_unit().0);
        let unit = fragility.over.name_and_unit().1;
        let half = fragility.overturning.theta.value.map(|theta| theta / unit);
        tiles.push(Tile::new(intensity(fragility.over, half), words));
    }
    tiles
}

/// The answer, and what it is with one thing changed; under one motion there are no rates, over a peak
/// intensities.
fn numbers(when: &str, answer: &Answer, variants: &[Answer]) -> Table {
    let Answer { object, p, rates, fragility, .. } = answer;
    let (too_far, overturns) = (object.too_far(), "overturns".to_string());
    if let Some(over) = fragility.over {
        let rows = [(too_far, &fragility.failure), (overturns, &fragility.overturning)];
        let rows = rows.map(|(name, of)| [vec![name], intensity_cells(over, of).into()].concat());
        let half = format!("half at a {} of", over.name_and_unit().0);
        return Table::new(&["", &half, "95 % limits", "16 %", "84 %", "beta"], rows.into());
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
