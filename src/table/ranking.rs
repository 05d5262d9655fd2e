//! The ranking file of rank-ims, one row a candidate; and the reliability of their forecasts, one row a group of cases.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::schema::{RANKING, RANKING_RELIABILITY};
use crate::keyword::Keyword;
use crate::statistics::FitStatus;
use crate::studies::{OfPaper, Ranked, Rating, ReliabilityGroup, Target, Unseen, wilson_limits};

/// One candidate.
#[derive(Debug, Clone, PartialEq)]
pub struct RankingRow {
    /// Of which suite.
    pub suite: Option<String>,
    /// Of which structure.
    pub structure: String,
    /// What is predicted.
    pub target: Target,
    /// In so many cases.
    pub n: usize,
    /// The event happened in so many of them.
    pub events: usize,
    /// What the cases of a cluster share.
    pub clustered_by: &'static str,
    /// How it does.
    pub ranked: Ranked,
}

impl RankingRow {
    fn rating(&self) -> Option<&Rating> {
        self.ranked.rating.as_ref().ok()
    }

    fn unseen(&self) -> Option<&Unseen> {
        self.rating()?.unseen.as_ref()
    }

    /// Of forecasts that are not one constant, which differs from fold to fold by what is left out alone.
    fn told_apart(&self) -> Option<&Unseen> {
        self.unseen().filter(|_| !self.ranked.measures.is_empty())
    }

    fn status(&self) -> FitStatus {
        self.ranked.rating.as_ref().err().copied().unwrap_or(FitStatus::Ok)
    }

    fn choice(&self) -> Option<String> {
        let of_paper = self.ranked.of_paper.map(|of_paper| match of_paper {
            OfPaper::Model => "paper".to_string(),
            OfPaper::Scalar => "scalar of paper".to_string(),
        });
        let is_best = self.ranked.rank == Some(1) && self.ranked.same_as.is_none();
        let best = (is_best && !self.ranked.measures.is_empty()).then(|| "best".to_string());
        let step = self.ranked.step.map(|step| format!("step {step}"));
        let choices: Vec<String> = [of_paper, best, step].into_iter().flatten().collect();
        (!choices.is_empty()).then(|| choices.join(", "))
    }
}

/// Measures as options name them: `im4:im3_inv`; of none, `none`.
fn words(measures: &[String]) -> String {
    if measures.is_empty() { "none".to_string() } else { measures.join(":") }
}

/// The rows of the ranking file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[RankingRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&RankingRow) -> Option<f64>| -> ArrayRef {
        let finite = |row| value(row).filter(|number| number.is_finite());
        Arc::new(Float64Array::from_iter(rows.iter().map(finite)))
    };
    let count = |value: fn(&RankingRow) -> Option<usize>| -> ArrayRef {
        Arc::new(Int64Array::from_iter(rows.iter().map(|row| value(row).map(|count| count as i64))))
    };
    let text = |value: fn(&RankingRow) -> Option<String>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let coefficient = |k: usize| number(&move |row| row.rating()?.coefficients.get(k).copied());
    let columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.clone()),
        text(|row| Some(row.structure.clone())),
        text(|row| Some(row.target.as_str().to_string())),
        text(|row| Some(words(&row.ranked.measures))),
        count(|row| Some(row.ranked.measures.len())),
        text(|row| Some(row.ranked.form.as_str().to_string())),
        text(RankingRow::choice),
        count(|row| row.ranked.rank),
        text(|row| row.ranked.same_as.as_deref().map(words)),
        number(&|row| Some(row.unseen()?.log_score())),
        number(&|row| Some(row.ranked.over_paper?.value)),
        number(&|row| Some(row.ranked.over_paper?.standard_error)),
        number(&|row| Some(row.ranked.over_best?.value)),
        number(&|row| Some(row.ranked.over_best?.standard_error)),
        count(|row| row.ranked.step),
        number(&|row| Some(row.ranked.over_step?.value)),
        number(&|row| Some(row.ranked.over_step?.standard_error)),
        number(&|row| Some(row.unseen()?.event_log_score)),
        number(&|row| Some(row.told_apart()?.skill.auc)),
        number(&|row| Some(row.unseen()?.skill.brier)),
        number(&|row| Some(row.told_apart()?.calibration?[0])),
        number(&|row| Some(row.told_apart()?.calibration?[1])),
        number(&|row| Some(row.rating()?.log_likelihood)),
        number(&|row| Some(row.rating()?.aic)),
        number(&|row| Some(row.rating()?.bic)),
        number(&|row| Some(row.rating()?.fitted.auc)),
        number(&|row| Some(row.rating()?.fitted.brier)),
        number(&|row| Some(row.rating()?.beta).filter(|beta| *beta > 0.0)),
        number(&|row| row.rating()?.zeta),
        coefficient(0),
        coefficient(1),
        coefficient(2),
        coefficient(3),
        count(|row| Some(row.n)),
        count(|row| Some(row.events)),
        text(|row| Some(row.clustered_by.to_string())),
        text(|row| Some(row.status().as_str().to_string())),
    ];
    RecordBatch::try_new(RANKING.schema(), columns)
}

/// The rows of the reliability file.
///
/// # Errors
/// As [`batch`].
pub fn reliability_batch(rows: &[RankingRow]) -> Result<RecordBatch, ArrowError> {
    let groups = |row| {
        let groups = RankingRow::unseen(row).map_or(&[][..], |unseen| &unseen.reliability);
        groups.iter().zip(1..).map(move |(group, number)| (row, group, number))
    };
    let all: Vec<(&RankingRow, &ReliabilityGroup, i64)> = rows.iter().flat_map(groups).collect();
    let number = |value: fn(&ReliabilityGroup) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(all.iter().map(|(_, group, _)| value(group))))
    };
    let count = |value: fn(&ReliabilityGroup) -> usize| -> ArrayRef {
        Arc::new(Int64Array::from_iter_values(all.iter().map(|(_, group, _)| value(group) as i64)))
    };
    let text = |value: fn(&RankingRow) -> Option<String>| -> ArrayRef {
        Arc::new(all.iter().map(|(row, ..)| value(row)).collect::<StringArray>())
    };
    let columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.clone()),
        text(|row| Some(row.structure.clone())),
        text(|row| Some(row.target.as_str().to_string())),
        text(|row| Some(words(&row.ranked.measures))),
        text(|row| Some(row.ranked.form.as_str().to_string())),
        Arc::new(Int64Array::from_iter_values(all.iter().map(|(.., number)| *number))),
        number(|group| group.forecast),
        count(|group| group.n),
        count(|group| group.seen),
        number(|group| group.seen as f64 / group.n as f64),
        number(|group| wilson_limits(group.seen, group.n).low),
        number(|group| wilson_limits(group.seen, group.n).high),
    ];
    RecordBatch::try_new(RANKING_RELIABILITY.schema(), columns)
}
