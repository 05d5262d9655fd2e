//! The document of fragilities: the intensities of one peak at which half of the motions overturn each
//! object.

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Lognormal, strongest};
use rockfrag_core::statistics::Interval;

use super::list::doubts;
use super::phrases::{ANGLES, facts};
use super::{Document, Table};
use crate::answer::{Answer, AnswerTable};
use crate::figures::answers;
use crate::number::{counted, plain, significant};

/// Sorted, the weakest first.
pub fn document(table: &AnswerTable) -> Document {
    let answered: Vec<&Answer> = table.rows.iter().filter(|answer| answer.is_answered()).collect();
    let Some((weakest, over)) = answered.first().and_then(|first| Some((*first, first.fragility.over?)))
    else {
        return Document::default();
    };
    let (what, of) = (over.name_and_unit().0, &weakest.fragility.overturning);
    let half = format!("half of the motions at a {what} of {}", with_limits(over, of.theta));
    let (title, lead, rows) = match &table.rows[..] {
        [one] => (one.object.title(), format!("It is overturned by {half}."), states(one, over)),
        all => (
            format!("{}: how strong a motion overturns them", counted(all.len(), "object")),
            format!("{} is the weakest: it is overturned by {half}.", weakest.object.called()),
            objects(all, over),
        ),
    };
    let lognormal = of.beta.zip(of.largest_error).filter(|_| table.rows.len() == 1).map(|(beta, error)| {
        let [beta, error] = [beta, error].map(|value| significant(value, 2));
        format!("Overturning is lognormal with beta {beta}, within {error}.")
    });
    let site = if table.hazard_key().is_some() { table.hazards() } else { ", for generic sites".to_string() };
    Document {
        title,
        place: format!("Fragility over {what}{site}"),
        lead: vec![lead],
        facts: lognormal.into_iter().chain(facts(&answered, table.hazard.as_ref())).collect(),
        glossary: ANGLES.to_string(),
        tables: vec![rows],
        notes: doubts(&answered),
        figures: vec![answers::fragilities(&answered, over)],
        ..Document::default()
    }
}

/// An intensity with its unit; beyond all records without a number.
fn written(over: Peak, intensity: Option<f64>) -> String {
    let (_, unit, symbol) = over.name_and_unit();
    match intensity {
        Some(value) => format!("{} {symbol}", significant(value, 2)),
        None => format!("> {} {symbol}", plain(strongest(over) / unit)),
    }
}

fn limits(over: Peak, of: Interval<Option<f64>>) -> String {
    let [low, high] = [of.low, of.high].map(|limit| written(over, limit));
    of.low.map_or(String::new(), |_| format!("{low} to {high}"))
}

fn with_limits(over: Peak, of: Interval<Option<f64>>) -> String {
    let limits = of.low.map_or(String::new(), |_| format!(" (95 % limits {})", limits(over, of)));
    written(over, of.value) + &limits
}

/// The intensity of one half with its limits, those of 16 and 84 %, and the dispersion.
fn cells(over: Peak, Lognormal { at_16, theta, at_84, beta, .. }: &Lognormal) -> [String; 5] {
    let [half, low, high] = [theta, at_16, at_84].map(|at| written(over, at.value));
    [half, limits(over, *theta), low, high, beta.map_or(String::new(), |beta| significant(beta, 2))]
}

fn states(answer: &Answer, over: Peak) -> Table {
    let half = format!("half at a {} of", over.name_and_unit().0);
    let too_far = format!("{}, or overturns", answer.object.too_far());
    let row = |name: &str, of: &Lognormal| [vec![name.to_string()], cells(over, of).to_vec()].concat();
    let rows =
        vec![row(&too_far, &answer.fragility.failure), row("overturns", &answer.fragility.overturning)];
    Table::new(&["", &half, "95 % limits", "16 %", "84 %", "beta"], rows)
}

fn objects(answers: &[Answer], over: Peak) -> Table {
    let half = format!("half overturn at a {} of", over.name_and_unit().0);
    let heads = ["object", &half, "95 % limits", "16 %", "84 %", "beta", "half rock too far, or overturn at"];
    let rows = answers.iter().map(|answer| {
        let mut row = vec![answer.object.name_and_floor()];
        match answer.is_answered() {
            true => {
                row.extend(cells(over, &answer.fragility.overturning));
                row.push(written(over, answer.fragility.failure.theta.value));
            }
            false => row.push(answer.reason()),
        }
        row
    });
    Table::new(&heads, rows.collect())
}
