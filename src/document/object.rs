//! The document of one object.

use std::iter;

use rockfrag_core::hazard::Fragility;
use rockfrag_core::statistics::Interval;

use super::phrases::{assumptions, facts, intensity, intensity_cells};
use super::{Document, Table, Tile};
use crate::answer::{Answer, AnswerTable, Detail, FragilityColumns, over_all};
use crate::chart::text::literal;
use crate::figures::answers;
use crate::number::{PERCENT, RATE};

pub fn document(table: &AnswerTable, answer: &Answer, detail: &Detail) -> Document {
    let when = answer.when().unwrap_or_default();
    let is_under_motion = answer.tree.pga_m_s2.or(answer.tree.pgv_m_s).is_some();
    let is_rocking = is_under_motion && answer.p.p_rocking > Some(0.0);
    let uplift = is_rocking.then(|| format!("It {}.", answer.uplift()));
    Document {
        title: answer.object.title(),
        place: format!("Stands {}{}", answer.object.place_in_building(), table.conditions()),
        lead: iter::once(format!("It {}.", answer.how_often())).chain(answer.about_target("")).collect(),
        tiles: tiles(&when, detail),
        facts: uplift.into_iter().chain(facts(&[answer], table.hazard.as_ref())).collect(),
        assumptions: assumptions(&[answer]),
        notes: answer.uncertainty.warnings.iter().map(|doubts| literal(doubts)).collect(),
        tables: answer.is_answered().then(|| numbers(&when, answer, &detail.variants)).into_iter().collect(),
        figures: vec![match answer.fragility.over {
            Some(_) => answers::fragilities(&[answer]),
            None => answers::object(answer, &detail.variants, detail.at_site.as_ref()),
        }],
        ..Document::default()
    }
}

/// The object as it is; the change that helps most, none that is only measured; the motion that overturns it.
fn tiles(when: &str, detail: &Detail) -> Vec<Tile> {
    let p = |one: &Answer| one.p.p_overturning.value.unwrap_or(1.0);
    let as_it_is = detail.variants.first();
    let best = detail.remedies().min_by(|a, b| p(a).total_cmp(&p(b)));
    let best = best.filter(|best| as_it_is.is_some_and(|as_it_is| p(best) < p(as_it_is)));
    let mut tiles = Vec::new();
    for Answer { variant, p, .. } in as_it_is.into_iter().chain(best) {
        let limits = PERCENT.limits(p.p_overturning, "95 % limits ");
        let words = format!("overturns {when}: {}{limits}", variant.as_deref().unwrap_or_default());
        tiles.push(Tile { number: PERCENT.value(p.p_overturning), words });
    }
    let drawn = detail.at_site.as_ref().and_then(|drawn| drawn.fragility.as_ref());
    if let Some(Fragility { over, overturning, .. }) = drawn {
        let (what, unit, _) = over.name_and_unit();
        let number = intensity(*over, overturning.theta.value.map(|theta| theta / unit));
        tiles.push(Tile { number, words: format!("{what} at which half of the motions overturn it") });
    }
    tiles
}

/// The answer, and what it is with one thing changed; over a peak, intensities.
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
    rows.extend(variants.iter().skip(1).map(|Answer { variant, object: changed, p, rates, .. }| {
        let size = if changed.size() == object.size() { "" } else { &format!(" ({})", changed.size()) };
        let name = format!("overturns: {}{size}", variant.as_deref().unwrap_or_default());
        row(name, p.p_overturning, rates.overturning_per_year)
    }));
    Table::new(&["", when, "95 % limits", "rate a year"], rows)
}
