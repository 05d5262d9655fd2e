//! What a ranking file says, for reading: its chosen rows as a table, and a sentence on each structure.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};

use super::TableError;
use super::reader::Batches;
use super::schema::{self, Column, RANKING};
use super::text;

/// A difference beyond so many standard errors is called clear.
const CLEAR: f64 = 2.0;

/// The numbers that a reader looks at first; the file holds the rest.
const SHOWN: [Column; 8] = [
    schema::RANK_LOG_SCORE,
    schema::OVER_PAPER,
    schema::SE_OVER_PAPER,
    schema::OVER_STEP,
    schema::SE_OVER_STEP,
    schema::AUC_UNSEEN,
    schema::BRIER_UNSEEN,
    schema::CALIBRATION_SLOPE,
];

/// A row that was chosen, or that without measures, which every structure has.
struct Chosen {
    /// Suite, structure, target.
    of: [String; 3],
    choice: String,
    measures: String,
    form: String,
    terms: usize,
    /// Events and cases.
    counts: [i64; 2],
    beta: Option<f64>,
    over_best: [Option<f64>; 2],
    shown: Vec<Option<f64>>,
}

/// A ranking file as a table and a verdict to read.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let chosen = chosen(path)?;
    let mut shown = text::aligned(&table(&chosen)?);
    shown += "\n";
    for group in chosen.chunk_by(|a, b| a.of == b.of) {
        shown += &verdict(group)?;
    }
    Ok(shown)
}

fn chosen(path: &Path) -> Result<Vec<Chosen>, TableError> {
    let mut rows = Vec::new();
    for batch in Batches::open_whole(path, &RANKING, &[RANKING.stage])? {
        let batch = batch?;
        let columns = batch.columns();
        let suites = columns.optional_text(&schema::SUITE)?;
        let [structures, targets, measures, forms] =
            [schema::STRUCTURE, schema::TARGET, schema::MEASURES, schema::FORM]
                .map(|column| columns.text(&column));
        let (structures, targets, measures, forms) = (structures?, targets?, measures?, forms?);
        let (choices, terms) = (columns.optional_text(&schema::CHOICE)?, columns.integers(&schema::TERMS)?);
        let counts = [columns.integers(&schema::N_EVENTS)?, columns.integers(&schema::N)?];
        let number = |column: &Column| columns.optional_numbers(column);
        let (beta, over_best) = (number(&schema::BETA)?, number(&schema::OVER_BEST)?);
        let se_over_best = number(&schema::SE_OVER_BEST)?;
        let shown = SHOWN.iter().map(number).collect::<Result<Vec<_>, _>>()?;
        let row = |row: usize| {
            Some(Chosen {
                of: [suites[row].clone().unwrap_or_default(), structures[row].clone(), targets[row].clone()],
                choice: choices[row].clone().or((terms[row] == 0).then(String::new))?,
                measures: measures[row].clone(),
                form: forms[row].clone(),
                terms: terms[row].unsigned_abs() as usize,
                counts: [counts[0][row], counts[1][row]],
                beta: beta[row],
                over_best: [over_best[row], se_over_best[row]],
                shown: shown.iter().map(|column| column[row]).collect(),
            })
        };
        rows.extend((0..columns.rows()).filter_map(row));
    }
    Ok(rows)
}

fn table(chosen: &[Chosen]) -> anyhow::Result<RecordBatch> {
    let text = |value: fn(&Chosen) -> &String| -> ArrayRef {
        Arc::new(StringArray::from_iter_values(chosen.iter().map(value)))
    };
    let number = |value: &dyn Fn(&Chosen) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(chosen.iter().map(value)))
    };
    let mut columns = vec![
        (schema::SUITE, text(|row| &row.of[0])),
        (schema::STRUCTURE, text(|row| &row.of[1])),
        (schema::TARGET, text(|row| &row.of[2])),
        (schema::CHOICE, text(|row| &row.choice)),
        (schema::MEASURES, text(|row| &row.measures)),
        (schema::FORM, text(|row| &row.form)),
    ];
    columns.extend(SHOWN.iter().enumerate().map(|(k, column)| (*column, number(&move |row| row.shown[k]))));
    columns.push((schema::BETA, number(&|row| row.beta)));
    Ok(RecordBatch::try_from_iter(columns.into_iter().map(|(column, array)| (column.name, array)))?)
}

/// One structure under one suite, in words.
fn verdict(group: &[Chosen]) -> Result<String, std::fmt::Error> {
    let has = |row: &Chosen, choice: &str| row.choice.split(", ").any(|word| word == choice);
    let find = |choice: &str, terms: Option<usize>| {
        group.iter().find(|row| has(row, choice) && terms.is_none_or(|terms| row.terms == terms))
    };
    let [suite, structure, target] = &group[0].of;
    let mut line = [target, suite, structure].map(String::as_str).join(" ").replace("  ", " ");
    let [events, cases] = group[0].counts;
    write!(line, " ({events} events in {cases} cases):")?;
    let Some(paper) = find("paper", None) else {
        return Ok(line + " no forecasts by the model of the paper to hold others against\n");
    };
    let against = |row: &Chosen| comparison(row.shown[1], row.shown[2]);
    write!(line, " the paper takes {} ({})", paper.measures, paper.form)?;
    if let Some(best) = find("best", Some(1)) {
        write!(line, "\n    the best scalar, {} ({}), is {}", best.measures, best.form, against(best))?;
        if let Some(scalar) = find("scalar of paper", None).filter(|row| !has(row, "best")) {
            let [value, error] = scalar.over_best;
            let against = comparison(value, error);
            write!(
                line,
                "\n    the best of the six of Eq. 13 as one power law, {}, is {against} beside it",
                scalar.measures
            )?;
        }
    }
    for (terms, name) in [(2, "pair"), (3, "triple")] {
        if let Some(best) = find("best", Some(terms)) {
            if has(best, "paper") {
                write!(line, "\n    no {name} is better than the paper's")?;
            } else {
                write!(
                    line,
                    "\n    the best {name}, {} ({}), is {}",
                    best.measures,
                    best.form,
                    against(best)
                )?;
            }
        }
    }
    Ok(line + "\n")
}

/// A difference of log scores in words.
fn comparison(value: Option<f64>, error: Option<f64>) -> String {
    let (Some(value), Some(error)) = (value, error) else { return "of unknown worth".to_string() };
    let word = match value {
        value if value > CLEAR * error => "clearly better",
        value if value < -CLEAR * error => "clearly worse",
        _ => "not clearly different",
    };
    format!("{word} ({value:+.4} +- {error:.4})")
}
