//! Answers as people open them in a workbook: the list's own columns, then what was asked, with units.

use polars_core::prelude::{Column, DataFrame};
use rockfrag_core::statistics::Interval;

use super::list::{base, place};
use crate::answer::Answer;
use crate::chart::text::words;

/// A column: numbers, or texts.
enum Cells {
    Numbers(fn(&Answer) -> Option<f64>),
    Counts(fn(&Answer) -> Option<f64>),
    Percent(fn(&Answer) -> Option<f64>),
    Texts(fn(&Answer) -> String),
}

/// The columns; of those in the time of exposure, or under the motion, there is an @.
const COLUMNS: [(&str, Cells); 14] = [
    ("width (m)", Cells::Numbers(|answer| answer.object.width_m)),
    ("depth (m)", Cells::Numbers(|answer| answer.object.depth_m)),
    ("height (m)", Cells::Numbers(|answer| answer.object.height_m)),
    ("centre of mass (m)", Cells::Numbers(|answer| answer.object.centre_height_m)),
    ("number", Cells::Counts(|answer| answer.object.count)),
    ("place", Cells::Texts(|answer| plain(&place(answer)))),
    ("overturns @ (%)", Cells::Percent(|answer| overturning(answer).value)),
    ("lower 95 % limit (%)", Cells::Percent(|answer| overturning(answer).low)),
    ("upper 95 % limit (%)", Cells::Percent(|answer| overturning(answer).high)),
    ("once in (years)", Cells::Numbers(|answer| answer.rates.return_period_years.map(two_digits))),
    ("rocks too far @ (%)", Cells::Percent(|answer| answer.p.p_failure.value)),
    ("base that meets the target (m)", Cells::Texts(|answer| plain(&base(answer)).replace(" m", ""))),
    ("friction needed", Cells::Numbers(|answer| answer.object.friction_needed().map(two_digits))),
    (NOTES, Cells::Texts(|answer| answer.uncertainty.warnings.clone().unwrap_or_default())),
];

const NOTES: &str = "doubts, or why it is not assessed";

/// A row an object, without columns in which nothing stands; results to two digits.
pub fn sheet(rows: &[Answer]) -> anyhow::Result<DataFrame> {
    let when = rows.first().and_then(Answer::when).unwrap_or_default();
    let name = |answer: &Answer| {
        answer.object.name().map_or_else(|| words(&answer.object.called()), |name| name.to_string())
    };
    let mut columns = vec![texts("object", rows, &name)];
    for (heading, _) in rows.iter().flat_map(|answer| &answer.labels) {
        if columns.iter().all(|column| *column.name() != *heading) {
            columns
                .push(texts(heading, rows, &|answer| answer.label(heading).unwrap_or_default().to_string()));
        }
    }
    for (name, cells) in &COLUMNS {
        let head = name.replace('@', &when);
        let numbers = |number: &dyn Fn(&Answer) -> Option<f64>| {
            Column::new(head.as_str().into(), rows.iter().map(number).collect::<Vec<_>>())
        };
        columns.push(match cells {
            Cells::Numbers(number) => numbers(number),
            Cells::Counts(number) => {
                let counts = rows.iter().map(|answer| number(answer).map(|count| count as i64));
                Column::new(head.as_str().into(), counts.collect::<Vec<_>>())
            }
            Cells::Percent(p) => numbers(&|answer| p(answer).map(|p| two_digits(100.0 * p))),
            Cells::Texts(cell) => texts(&head, rows, cell),
        });
    }
    let mut seen = std::collections::HashSet::new();
    columns.retain(|column| column.null_count() < rows.len() && seen.insert(column.name().clone()));
    Ok(DataFrame::new(rows.len(), columns)?)
}

fn texts(head: &str, rows: &[Answer], cell: &dyn Fn(&Answer) -> String) -> Column {
    let cells = rows.iter().map(|answer| Some(cell(answer)).filter(|cell| !cell.is_empty()));
    Column::new(head.into(), cells.collect::<Vec<_>>())
}

fn plain(marked: &str) -> String {
    words(marked).replace('\u{a0}', " ")
}

fn overturning(answer: &Answer) -> Interval<Option<f64>> {
    answer.p.p_overturning
}

/// What is written with two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
