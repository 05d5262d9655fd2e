//! The figures of incremental dynamic analyses, validations and rankings.

use super::figures::title;
use super::tables::{Stripe, Tables};
use crate::fragility::p_overturning;
use crate::report::figures::{Curve, Ida, NamedEstimates, ida, ranking, validation};
use crate::report::{Estimate, Figure};
use crate::rocking::CapacityStatus;
use crate::stages::ida::{CapacityFitRow, CapacityRow, ScaledMeasure};
use crate::studies::{RankedSet, Target, wilson_limits};

/// The most structures and suites that are drawn.
const MOST: usize = 6;
/// The most levels of an analysis that are drawn, and points of its curve.
const LEVELS: usize = 15;
const STEPS: usize = 100;
/// The most sets of measures that are drawn, besides those of the paper.
const SETS: i64 = 8;
const PAPER: [&str; 2] = ["im3:im4", "im5"];
const Z: f64 = crate::fragility::Z_95;

/// Draws those that there are.
pub fn figures(tables: &Tables) -> Vec<Figure> {
    let analyses: Vec<Ida> =
        tables.capacity_fits.iter().take(MOST).map(|fit| analysis(tables, fit)).collect();
    let (tests, targets) = (tests(tables), targets(tables));
    let ida = (!analyses.is_empty()).then(|| ida(&analyses));
    let validation = (!tests.is_empty()).then(|| validation(&tests));
    let ranking = (!targets.is_empty()).then(|| ranking(&targets));
    [ida, validation, ranking].into_iter().flatten().collect()
}

/// The measure that is scaled, with its unit.
pub fn words(measure: ScaledMeasure) -> &'static str {
    match measure {
        ScaledMeasure::Scale => "factor on the motion",
        ScaledMeasure::Pga => "PGA (g)",
        ScaledMeasure::Pgv => "PGV (m/s)",
        ScaledMeasure::Im4 => "PGA / (*g* tan *α*)",
        ScaledMeasure::Im5 => "*p* PGV / (*g* tan *α*)",
        ScaledMeasure::Im6 => "*ω*_{m} PGV / (*g* tan *α*)",
    }
}

fn analysis(tables: &Tables, fit: &CapacityFitRow) -> Ida {
    let is_its = |suite: &Option<String>, structure: &str| *suite == fit.suite && structure == fit.structure;
    let stripes: Vec<&Stripe> =
        tables.stripes.iter().filter(|stripe| is_its(&stripe.suite, &stripe.structure)).collect();
    let its = tables.capacities.iter().filter(|row| is_its(&row.suite, &row.structure));
    let lowest =
        |row: &CapacityRow| (row.capacity == CapacityStatus::Below).then_some(stripes.first()?.intensity);
    let mut capacities: Vec<f64> =
        its.filter_map(|row| row.overturning_intensity.or_else(|| lowest(row))).collect();
    capacities.sort_unstable_by(f64::total_cmp);
    let share = |stripe: &&Stripe| {
        let Stripe { intensity, n, events, .. } = **stripe;
        let limits = wilson_limits(events, n);
        let y = events as f64 / n as f64;
        Estimate { x: intensity, y, low: limits.low, high: limits.high, n: n as f64 }
    };
    let ends = stripes.first().zip(stripes.last()).map(|(first, last)| [first.intensity, last.intensity]);
    let curve = fit.theta.zip(fit.beta).zip(ends).map(|((theta, beta), [low, high])| {
        let at = |k: usize| low * (high / low).powf(k as f64 / STEPS as f64);
        let points = (0..=STEPS).map(|k| [at(k), p_overturning(at(k), theta.ln(), beta)]).collect();
        Curve { label: String::new(), points, band: Vec::new() }
    });
    Ida {
        name: title(&fit.structure, fit.suite.as_deref()),
        intensity: words(fit.measure).to_string(),
        capacities,
        motions: fit.n as usize,
        shares: stripes.iter().step_by(stripes.len().div_ceil(LEVELS).max(1)).map(share).collect(),
        curve: curve.unwrap_or_default(),
    }
}

/// A panel a structure and suite, a series an event and model.
fn tests(tables: &Tables) -> Vec<NamedEstimates> {
    let mut panels: Vec<NamedEstimates> = Vec::new();
    for bin in &tables.bins {
        let title = title(&bin.structure, bin.suite.as_deref());
        let panel = panels.iter().position(|panel| panel.title == title).unwrap_or_else(|| {
            panels.push(NamedEstimates { title, series: Vec::new() });
            panels.len() - 1
        });
        let (series, name) = (&mut panels[panel].series, format!("{}, {}", bin.event, bin.model));
        let estimate = Estimate {
            x: bin.predicted,
            y: bin.share,
            low: bin.share_low,
            high: bin.share_high,
            n: bin.n as f64,
        };
        match series.iter_mut().find(|(known, _)| *known == name) {
            Some((_, estimates)) => estimates.push(estimate),
            None => series.push((name, vec![estimate])),
        }
    }
    panels.truncate(MOST);
    panels
}

/// A panel a structure, suite and target, a row a set of measures.
fn targets(tables: &Tables) -> Vec<NamedEstimates> {
    let is_of_paper = |set: &RankedSet| PAPER.contains(&set.measures.as_str());
    let mut panels: Vec<NamedEstimates> = Vec::new();
    for set in tables.ranked.iter().filter(|set| set.rank <= SETS || is_of_paper(set)) {
        let (Some(loss), Some(error)) = (set.loss, set.loss_error) else { continue };
        let what = match set.target {
            Target::Demand => "demand",
            Target::Overturning => "overturning",
        };
        let title = format!("{}: {what}", title(&set.structure, set.suite.as_deref()));
        if panels.last().is_none_or(|panel| panel.title != title) {
            panels.push(NamedEstimates { title, series: Vec::new() });
        }
        let name = format!("{} ({})", set.measures.to_uppercase().replace(':', ", "), set.form);
        let estimate =
            Estimate { x: loss, y: 0.0, low: loss - Z * error, high: loss + Z * error, n: f64::NAN };
        panels.last_mut().into_iter().for_each(|panel| panel.series.push((name.clone(), vec![estimate])));
    }
    panels.truncate(MOST);
    panels
}
