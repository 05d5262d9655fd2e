//! What the files of universality say, in plain words.

use std::fmt::Write;
use std::path::Path;

use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::statistics::{FitStatus, least_squares};
use crate::studies::{PooledTerms, Verdict};
use crate::table::fits::{self, FitRow};
use crate::table::schema::{self, Column, POOLED, UNIVERSALITY};
use crate::table::source::with_part;

/// More levels of a parameter than this are no grid.
const MOST_LEVELS: usize = 8;
/// More names than this are no help.
const MOST_NAMES: usize = 20;
/// The parameters of a structure, in the order of all tables here.
const PARAMETERS: [(&str, Column); 3] =
    [("p", schema::P_RAD_S), ("alpha", schema::ALPHA_RAD), ("eta", schema::ETA)];

/// A universality file in words: under each suite and for each event, how many structures the transferred curve does for, where
/// it does, how its loss grows, and what curves of all structures tell.
///
/// # Errors
/// If there is no such file, or none of pooled curves beside it.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let rows = fits::rows(path, &UNIVERSALITY)?;
    let pooled = fits::rows(with_part(path, "pooled"), &POOLED)?;
    let mut text = String::new();
    let mut suites: Vec<Option<&str>> = Vec::new();
    for row in &rows {
        let suite = row.text(&schema::SUITE);
        if !suites.contains(&suite) {
            suites.push(suite);
        }
    }
    for suite in suites {
        for event in Event::BRANCHES {
            let of = |row: &&FitRow| {
                row.text(&schema::SUITE) == suite && row.text(&schema::FORETOLD) == Some(event.as_str())
            };
            let judged = Judged { event, rows: rows.iter().filter(of).collect() };
            let pooled: Vec<&FitRow> = pooled.iter().filter(of).collect();
            judged.write(suite, &pooled, &mut text)?;
        }
    }
    Ok(text)
}

/// All structures for one event under one suite.
struct Judged<'a> {
    event: Event,
    rows: Vec<&'a FitRow>,
}

impl Judged<'_> {
    fn write(&self, suite: Option<&str>, pooled: &[&FitRow], text: &mut String) -> anyhow::Result<()> {
        let Some(first) = self.rows.first() else { return Ok(()) };
        let reference = first.text(&schema::REFERENCE).unwrap_or_default();
        let suite = suite.map_or(String::new(), |suite| format!("{suite}, "));
        let all = self.rows.iter().filter(|row| row.text(&schema::STRUCTURE) != Some(reference));
        let others = Judged { event: self.event, rows: all.copied().collect() };
        let [holds, bends, fails, few] = others.counts();
        writeln!(
            text,
            "{suite}{}: the curve of {reference} on {} other structures\n  holds for {holds}, bends for {bends}, fails for {fails}; {few} have too few events for a curve of their own",
            self.event.as_str(),
            others.rows.len(),
        )?;
        let names: Vec<&str> =
            others.with(Verdict::Holds).filter_map(|row| row.text(&schema::STRUCTURE)).collect();
        if (1..=MOST_NAMES).contains(&names.len()) {
            writeln!(text, "  it holds for {}", names.join(", "))?;
        }
        others.write_levels(text)?;
        self.write_growth(reference, text)?;
        self.write_pooled(pooled, text)?;
        writeln!(text)?;
        Ok(())
    }

    /// Structures for which the curve holds, bends, fails, and those with too few events.
    fn counts(&self) -> [usize; 4] {
        [Verdict::Holds, Verdict::Bends, Verdict::Fails, Verdict::TooFewEvents]
            .map(|verdict| self.with(verdict).count())
    }

    fn with(&self, verdict: Verdict) -> impl Iterator<Item = &&FitRow> {
        self.rows.iter().filter(move |row| row.text(&schema::VERDICT) == Some(verdict.as_str()))
    }

    /// The verdicts at each level of each parameter.
    fn write_levels(&self, text: &mut String) -> anyhow::Result<()> {
        writeln!(
            text,
            "  {:12} {:>6} {:>6} {:>6} {:>8}  {:>10} {:>10} {:>10}",
            "at", "holds", "bends", "fails", "too few", "mean error", "worst over", "under"
        )?;
        for (name, column) in PARAMETERS {
            let mut levels: Vec<f64> =
                self.rows.iter().filter_map(|row| row.optional_number(&column)).collect();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            if levels.len() < 2 || levels.len() > MOST_LEVELS {
                continue;
            }
            for level in levels {
                let at = |row: &&&FitRow| row.optional_number(&column) == Some(level);
                let here = Judged { event: self.event, rows: self.rows.iter().filter(at).copied().collect() };
                let [holds, bends, fails, few] = here.counts();
                let largest = |column| here.numbers(column).fold(f64::NAN, f64::max);
                let errors: Vec<f64> = here.numbers(schema::MEAN_ERROR).collect();
                let mean = errors.iter().sum::<f64>() / errors.len() as f64;
                let cells = [mean, largest(schema::WORST_OVER), largest(schema::WORST_UNDER)];
                let [mean, over, under] =
                    cells.map(|cell| if cell.is_nan() { "-".to_string() } else { format!("{cell:.3}") });
                let at = format!("{name} {level}");
                writeln!(
                    text,
                    "  {at:12} {holds:>6} {bends:>6} {fails:>6} {few:>8}  {mean:>10} {over:>10} {under:>10}"
                )?;
            }
        }
        Ok(())
    }

    fn numbers(&self, column: Column) -> impl Iterator<Item = f64> {
        self.rows.iter().filter_map(move |row| row.optional_number(&column))
    }

    /// How the loss grows with the distance from the reference.
    fn write_growth(&self, reference: &str, text: &mut String) -> anyhow::Result<()> {
        let Some(origin) = self.rows.iter().find(|row| row.text(&schema::STRUCTURE) == Some(reference))
        else {
            return Ok(());
        };
        let at = |row: &FitRow| -> anyhow::Result<[f64; 3]> {
            let value = |column: &Column| anyhow::Ok((row.number(column)?, origin.number(column)?));
            let ((p, p0), (alpha, alpha0)) = (value(&schema::P_RAD_S)?, value(&schema::ALPHA_RAD)?);
            let (eta, eta0) = value(&schema::ETA)?;
            Ok([(p / p0).log2().abs(), (alpha / alpha0).log2().abs(), 10.0 * (eta - eta0).abs()])
        };
        let known: Vec<&&FitRow> = self
            .rows
            .iter()
            .filter(|row| row.text(&schema::STATUS) == Some(FitStatus::Ok.as_str()))
            .collect();
        let places = known.iter().map(|row| at(row)).collect::<anyhow::Result<Vec<_>>>()?;
        let distances = [0, 1, 2].map(|k: usize| places.iter().map(|place| place[k]).collect::<Vec<f64>>());
        let losses = known.iter().map(|row| row.number(&schema::LOSS)).collect::<Result<Vec<_>, _>>()?;
        let Ok(fit) = least_squares(&[&distances[0], &distances[1], &distances[2]], &losses) else {
            return Ok(());
        };
        let grows = |k: usize| {
            let b = fit.coefficients[k];
            format!("{:+.3} (+- {:.3})", b.value, b.standard_error)
        };
        writeln!(
            text,
            "  loss of log score: {} for each doubling or halving of p, {} of alpha, {} for each 0.1 of eta (R2 {:.2})",
            grows(1),
            grows(2),
            grows(3),
            fit.r2
        )?;
        Ok(())
    }

    /// What curves of all structures tell of those that they have not seen.
    fn write_pooled(&self, pooled: &[&FitRow], text: &mut String) -> anyhow::Result<()> {
        let known = || self.rows.iter().filter(|row| row.optional_number(&schema::SHARE_LOST).is_some());
        let told = |column: &Column| -> Option<f64> {
            let (mut theirs, mut own) = (0.0, 0.0);
            for row in known() {
                let n = row.optional_number(&schema::N_FORETOLD)?;
                let share = row.optional_number(&schema::LOG_SCORE_SHARE)?;
                theirs += n * (row.optional_number(column)? - share);
                own += n * (row.optional_number(&schema::LOG_SCORE_OWN)? - share);
            }
            (own > 0.0).then_some(theirs / own)
        };
        writeln!(text, "  of what own curves tell beyond the share of events, over all cases:")?;
        let columns = [
            ("the transferred curve", schema::LOG_SCORE_TRANSFERRED),
            ("one line for all structures", schema::LOG_SCORE_LINE),
            ("one curved surface for all", schema::LOG_SCORE_CURVED),
            ("the same with eta", schema::LOG_SCORE_RESTITUTION),
            ("the same with eta, p and alpha", schema::LOG_SCORE_STRUCTURE),
        ];
        for (what, column) in columns {
            if let Some(share) = told(&column) {
                writeln!(text, "    {what:32} {:>7.0} %", 100.0 * share)?;
            }
        }
        for row in pooled
            .iter()
            .filter(|row| row.text(&schema::POOLED_TERMS) == Some(PooledTerms::Structure.as_str()))
        {
            let term = row.text(&schema::TERM).unwrap_or_default();
            if ["eta", "ln p", "ln alpha"].contains(&term) {
                let range = row.optional_number(&schema::RANGE_HIGH).map_or("", |_| " below the transition");
                let (b, error) = (row.number(&schema::COEFFICIENT)?, row.number(&schema::STANDARD_ERROR)?);
                writeln!(text, "    coefficient of {term:10} {b:+.3} (+- {error:.3}){range}")?;
            }
        }
        Ok(())
    }
}
