//! What a ranking file says, for reading: its chosen rows as a table, and a sentence on each structure.

use std::fmt::Write;
use std::path::Path;

use polars::prelude::{ChunkCompareEq, DataFrame};

use crate::keyword::Keyword;
use crate::statistics::FitStatus;
use crate::studies::Target;
use crate::table::ranking::{RANKING, RankingRow};
use crate::table::row::ReadRow;
use crate::table::schema::{self, Column};
use crate::table::store::frame::{names, read_frame};
use crate::table::store::text;

/// A difference beyond so many standard errors is called clear.
const CLEAR: f64 = 2.0;

/// A ranking file as a table and a verdict to read.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let mut chosen = RankingRow::read(path)?;
    chosen.retain(|row| row.choice.is_some() || row.terms == 0);
    let mut text = text::aligned(&shown(path)?.select(names(&SHOWN))?);
    text += "\n";
    let of = |row: &RankingRow| (row.suite.clone(), row.structure.clone(), row.target);
    for group in chosen.chunk_by(|a, b| of(a) == of(b)) {
        text += &verdict(group)?;
    }
    Ok(text)
}

/// The rows that were chosen, and those without measures, which every structure has.
///
/// # Errors
/// If the file is no ranking.
pub fn shown(path: &Path) -> anyhow::Result<DataFrame> {
    let frame = read_frame(path, &RANKING)?;
    let shown =
        frame.column(schema::choice.name)?.is_not_null() | frame.column(schema::terms.name)?.i64()?.equal(0);
    Ok(frame.filter(&shown)?)
}

/// What a reader looks at first; the file holds the rest.
const SHOWN: [Column; 15] = [
    schema::suite,
    schema::structure,
    schema::target,
    schema::choice,
    schema::measures,
    schema::form,
    schema::rank_log_score,
    schema::over_paper,
    schema::se_over_paper,
    schema::over_step,
    schema::se_over_step,
    schema::auc_unseen,
    schema::brier_unseen,
    schema::calibration_slope,
    schema::beta,
];

/// One structure under one suite, in words.
fn verdict(group: &[RankingRow]) -> Result<String, std::fmt::Error> {
    let has = |row: &RankingRow, choice: &str| {
        row.choice.as_deref().unwrap_or_default().split(", ").any(|word| word == choice)
    };
    let find = |choice: &str, terms: Option<usize>| {
        group.iter().find(|row| has(row, choice) && terms.is_none_or(|terms| row.terms == terms))
    };
    let RankingRow { suite, structure, target, n, n_events, .. } = &group[0];
    let suite = suite.as_deref().unwrap_or_default();
    let mut line = [target.as_str(), suite, structure.as_str()].join(" ").replace("  ", " ");
    write!(line, " ({n_events} events in {n} cases):")?;
    let Some(paper) = find("paper", None) else {
        return Ok(line + " no predictions by the model of the paper to compare others with\n");
    };
    let none = group.iter().filter(|row| row.terms == 0).find_map(|row| row.log_score);
    let against = |row: &RankingRow| match (row.over_paper, row.log_score, none) {
        (None, Some(score), Some(none)) => format!("of log score {score:.4}, {none:.4} without a measure"),
        _ => comparison(row.over_paper, row.se_over_paper),
    };
    write!(line, " the paper takes {} ({})", paper.measures, paper.form.as_str())?;
    if paper.log_score.is_none() {
        let why = match paper.status {
            FitStatus::Ok => "too few cells or earthquakes to leave some out",
            status => status.as_str(),
        };
        write!(line, ", which has no score to compare others with ({why})")?;
    }
    let best = group.iter().filter(|row| row.terms > 0).filter_map(|row| row.log_score).reduce(f64::max);
    if let Some((best, none)) = best.zip(none).filter(|(best, none)| best <= none) {
        let alone = match target {
            Target::Demand => "the mean demand",
            Target::Overturning => "the frequency",
        };
        return Ok(line
            + &format!(
                "\n    no measure predicts better than {alone} alone (log score {none:.4}, of the best model {best:.4})\n"
            ));
    }
    if let Some(best) = find("best", Some(1)) {
        write!(
            line,
            "\n    the best scalar, {} ({}), is {}",
            best.measures,
            best.form.as_str(),
            against(best)
        )?;
        if let Some(scalar) = find("scalar of paper", None).filter(|row| !has(row, "best")) {
            let against = comparison(scalar.over_best, scalar.se_over_best);
            write!(
                line,
                "\n    the best of the six of Eq. 13 as one power law, {}, is {against} compared with it",
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
                    best.form.as_str(),
                    against(best)
                )?;
            }
        }
    }
    Ok(line + "\n")
}

/// A difference of log scores in words.
fn comparison(value: Option<f64>, error: Option<f64>) -> String {
    let (Some(value), Some(error)) = (value, error) else { return "not comparable".to_string() };
    let word = match value {
        value if value > CLEAR * error => "clearly better",
        value if value < -CLEAR * error => "clearly worse",
        _ => "not clearly different",
    };
    format!("{word} ({value:+.4} +- {error:.4})")
}
