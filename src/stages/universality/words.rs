//! What the files of universality say, in plain words.

use std::fmt::Write;
use std::path::Path;

use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::statistics::{FitStatus, least_squares};
use crate::studies::{PooledTerms, Verdict};
use crate::table::row::ReadRow;
use crate::table::store::source::with_part;
use crate::table::universality::{PooledRow, UniversalityRow};

/// More levels of a parameter than this are gathered in so many ranges.
const MOST_LEVELS: usize = 8;
const RANGES: usize = 4;
/// More names than this are no help.
const MOST_NAMES: usize = 20;
/// A number of each row, under its name.
type Named<T> = (&'static str, fn(&UniversalityRow) -> T);
/// The parameters of a structure, in the order of all tables here.
const PARAMETERS: [Named<f64>; 3] =
    [("p", |row| row.p_rad_s), ("alpha", |row| row.alpha_rad), ("eta", |row| row.eta)];

/// A universality file in words: under each suite and for each event, how many structures the transferred curve does for, where
/// it does, how its loss grows, and what curves of all structures tell.
///
/// # Errors
/// If there is no such file, or none of pooled curves beside it.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let rows = UniversalityRow::read(path)?;
    let pooled = PooledRow::read(with_part(path, "pooled"))?;
    let mut text = String::new();
    let mut suites: Vec<Option<&str>> = Vec::new();
    for row in &rows {
        let suite = row.suite.as_deref();
        if !suites.contains(&suite) {
            suites.push(suite);
        }
    }
    for suite in suites {
        for event in Event::BRANCHES {
            let of = |row: &&UniversalityRow| row.suite.as_deref() == suite && row.event == event;
            let judged = Judged { event, rows: rows.iter().filter(of).collect() };
            let of = |row: &&PooledRow| row.suite.as_deref() == suite && row.event == event;
            let pooled: Vec<&PooledRow> = pooled.iter().filter(of).collect();
            judged.write(suite, &pooled, &mut text)?;
        }
    }
    Ok(text)
}

/// All structures for one event under one suite.
struct Judged<'a> {
    event: Event,
    rows: Vec<&'a UniversalityRow>,
}

impl Judged<'_> {
    fn write(&self, suite: Option<&str>, pooled: &[&PooledRow], text: &mut String) -> anyhow::Result<()> {
        let Some(first) = self.rows.first() else { return Ok(()) };
        let reference = first.reference.as_str();
        let suite = suite.map_or(String::new(), |suite| format!("{suite}, "));
        let all = self.rows.iter().filter(|row| row.structure != reference);
        let others = Judged { event: self.event, rows: all.copied().collect() };
        let [holds, bends, fails, few] = others.counts();
        writeln!(
            text,
            "{suite}{}: the curve of {reference} on {} other structures\n  holds for {holds}, bends for {bends}, fails for {fails}; {few} have too few events for a curve of their own",
            self.event.as_str(),
            others.rows.len(),
        )?;
        let names: Vec<&str> = others.with(Verdict::Holds).map(|row| row.structure.as_str()).collect();
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

    fn with(&self, verdict: Verdict) -> impl Iterator<Item = &&UniversalityRow> {
        self.rows.iter().filter(move |row| row.verdict == verdict)
    }

    /// The verdicts at each level of each parameter.
    fn write_levels(&self, text: &mut String) -> anyhow::Result<()> {
        writeln!(
            text,
            "  {:20} {:>6} {:>6} {:>6} {:>8}  {:>10} {:>10} {:>10}",
            "at", "holds", "bends", "fails", "too few", "mean error", "worst over", "under"
        )?;
        for (name, parameter) in PARAMETERS {
            let mut levels: Vec<f64> = self.rows.iter().map(|row| parameter(row)).collect();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            if levels.len() < 2 {
                continue;
            }
            let ranges = if levels.len() > MOST_LEVELS { RANGES } else { levels.len() };
            let end = |k: usize| k * levels.len() / ranges;
            for (low, high) in (0..ranges).map(|k| (levels[end(k)], levels[end(k + 1) - 1])) {
                let at = |row: &&&UniversalityRow| (low..=high).contains(&parameter(row));
                let here = Judged { event: self.event, rows: self.rows.iter().filter(at).copied().collect() };
                let [holds, bends, fails, few] = here.counts();
                let largest = |number: fn(&UniversalityRow) -> Option<f64>| {
                    here.rows.iter().filter_map(|row| number(row)).fold(f64::NAN, f64::max)
                };
                let errors: Vec<f64> = here.rows.iter().filter_map(|row| row.mean_error).collect();
                let mean = errors.iter().sum::<f64>() / errors.len() as f64;
                let cells = [mean, largest(|row| row.worst_over), largest(|row| row.worst_under)];
                let [mean, over, under] =
                    cells.map(|cell| if cell.is_nan() { "-".to_string() } else { format!("{cell:.3}") });
                let [from, to] = [low, high].map(|level| (level * 1e5).round() / 1e5);
                let at =
                    if low == high { format!("{name} {from}") } else { format!("{name} {from} to {to}") };
                writeln!(
                    text,
                    "  {at:20} {holds:>6} {bends:>6} {fails:>6} {few:>8}  {mean:>10} {over:>10} {under:>10}"
                )?;
            }
        }
        Ok(())
    }

    /// How the loss grows with the distance from the reference.
    fn write_growth(&self, reference: &str, text: &mut String) -> anyhow::Result<()> {
        let Some(origin) = self.rows.iter().find(|row| row.structure == reference) else { return Ok(()) };
        let octaves = |one: f64, other: f64| libm::log2(one / other).abs();
        // A loss may be missing only where a structure has no curve of its own.
        let known = self.rows.iter().filter(|row| row.status == FitStatus::Ok);
        let known: Vec<(&UniversalityRow, f64)> = known.filter_map(|row| Some((*row, row.loss?))).collect();
        let distance = |of: &dyn Fn(&UniversalityRow) -> f64| -> Vec<f64> {
            known.iter().map(|(row, _)| of(row)).collect()
        };
        let distances = [
            distance(&|row| octaves(row.p_rad_s, origin.p_rad_s)),
            distance(&|row| octaves(row.alpha_rad, origin.alpha_rad)),
            distance(&|row| 10.0 * (row.eta - origin.eta).abs()),
        ];
        let losses: Vec<f64> = known.iter().map(|(_, loss)| *loss).collect();
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
    fn write_pooled(&self, pooled: &[&PooledRow], text: &mut String) -> anyhow::Result<()> {
        let told = |of: fn(&UniversalityRow) -> Option<f64>| -> Option<f64> {
            let (mut theirs, mut own) = (0.0, 0.0);
            for row in self.rows.iter().filter(|row| row.share_lost.is_some()) {
                let n = row.n as f64;
                theirs += n * (of(row)? - row.log_score_share);
                own += n * (row.log_score_own? - row.log_score_share);
            }
            (own > 0.0).then_some(theirs / own)
        };
        writeln!(text, "  gain in log score over the plain share of events, with own curves as 100 %:")?;
        let curves: [Named<Option<f64>>; 5] = [
            ("the transferred curve", |row| row.log_score_transferred),
            ("one line for all structures", |row| row.log_score_line),
            ("one curved surface for all", |row| row.log_score_curved),
            ("the same with eta", |row| row.log_score_restitution),
            ("the same with eta, p and alpha", |row| row.log_score_structure),
        ];
        for (what, log_score) in curves {
            if let Some(share) = told(log_score) {
                writeln!(text, "    {what:32} {:>7.0} %", 100.0 * share)?;
            }
        }
        for row in pooled.iter().filter(|row| row.terms == PooledTerms::Structure) {
            let PooledRow { term, coefficient: b, standard_error: error, .. } = row;
            if ["eta", "ln p", "ln alpha"].contains(&term.as_str()) {
                let range = row.range_high.map_or("", |_| " below the transition");
                writeln!(text, "    coefficient of {term:10} {b:+.3} (+- {error:.3}){range}")?;
            }
        }
        Ok(())
    }
}
