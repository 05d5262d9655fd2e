//! Answers as people open them in a workbook: the list's own columns, then what was asked, with units.

use polars_core::prelude::{AnyValue, Column, DataFrame};

use super::list::{base, headings, place};
use crate::answer::Answer;
use crate::chart::text::words;

type Cell = fn(&Answer) -> AnyValue<'static>;

/// The columns; of those in the time of exposure, or under the motion, there is an @.
const COLUMNS: [(&str, Cell); 14] = [
    ("width (m)", |answer| answer.object.width_m.into()),
    ("depth (m)", |answer| answer.object.depth_m.into()),
    ("height (m)", |answer| answer.object.height_m.into()),
    ("centre of mass (m)", |answer| answer.object.centre_height_m.into()),
    ("number", |answer| answer.object.count.map(|count| count as i64).into()),
    ("place", |answer| plain(place(answer))),
    ("overturns @ (%)", |answer| percent(answer.p.p_overturning.value)),
    ("lower 95 % limit (%)", |answer| percent(answer.p.p_overturning.low)),
    ("upper 95 % limit (%)", |answer| percent(answer.p.p_overturning.high)),
    ("once in (years)", |answer| two_digits(answer.rates.return_period_years)),
    ("rocks too far @ (%)", |answer| percent(answer.p.p_failure.value)),
    ("base that meets the target (m)", |answer| plain(base(answer).replace("\u{a0}m", ""))),
    ("friction needed", |answer| two_digits(answer.object.friction_needed())),
    ("doubts, or why it is not assessed", |answer| {
        text(answer.uncertainty.warnings.as_deref().unwrap_or(""))
    }),
];

/// A row an object, without columns in which nothing stands; results to two digits.
pub fn sheet(rows: &[Answer]) -> anyhow::Result<DataFrame> {
    let when = rows.first().and_then(Answer::when).unwrap_or_default();
    let column = |head: &str, cell: &dyn Fn(&Answer) -> AnyValue<'static>| {
        Column::new(head.into(), rows.iter().map(cell).collect::<Vec<_>>())
    };
    let name = |answer: &Answer| answer.object.name().map_or_else(|| plain(answer.object.called()), text);
    let mut columns = vec![column("object", &name)];
    for heading in headings(rows) {
        columns.push(column(heading, &|answer| text(answer.label(heading).unwrap_or_default())));
    }
    columns.extend(COLUMNS.iter().map(|(name, cell)| column(&name.replace('@', &when), cell)));
    let mut seen = std::collections::HashSet::new();
    columns.retain(|column| column.null_count() < rows.len() && seen.insert(column.name().clone()));
    Ok(DataFrame::new(rows.len(), columns)?)
}

fn text(cell: &str) -> AnyValue<'static> {
    Some(cell)
        .filter(|cell| !cell.is_empty())
        .map_or(AnyValue::Null, |cell| AnyValue::StringOwned(cell.into()))
}

fn plain(marked: String) -> AnyValue<'static> {
    text(&words(&marked).replace('\u{a0}', " "))
}

fn percent(p: Option<f64>) -> AnyValue<'static> {
    two_digits(p.map(|p| 100.0 * p))
}

fn two_digits(value: Option<f64>) -> AnyValue<'static> {
    value.map(|value| format!("{value:.1e}").parse().unwrap_or(value)).into()
}
