//! The data of the figures of lists, incremental dynamic analyses, validations and rankings.

use super::figures::title;
use super::tables::Tables;
use crate::fragility::{Z_95, p_overturning};
use crate::report::Estimate;
use crate::report::figures::{Curve, Ida, NamedEstimates, ObjectRate};
use crate::rocking::CapacityStatus;
use crate::stages::ida::{CapacityFitRow, CapacityRow, ScaledMeasure};
use crate::studies::{RankedSet, ReliabilityBin, Target, wilson_limits};
use crate::table::TableError;

/// The most panels, levels of an analysis, points of its curve, and objects of a list.
const PANELS: usize = 6;
const LEVELS: usize = 15;
const STEPS: usize = 100;
const OBJECTS: usize = 60;
/// The most sets of measures that are drawn, besides those of the paper.
const SETS: i64 = 6;
const PAPER: [&str; 2] = ["im3:im4", "im5"];

/// The annual rates of a list of objects, or of the limit states of one.
pub fn objects(tables: &Tables) -> Vec<ObjectRate> {
    let rate = |name: &str, value: Option<f64>, low: Option<f64>, high: Option<f64>| {
        let [rate, low, high] = [value, low, high].map(|rate| rate.unwrap_or(f64::NAN));
        ObjectRate { name: name.to_string(), rate, low, high }
    };
    match &tables.objects[..] {
        [one] => vec![
            rate("rocks", one.rocking_per_year, None, None),
            rate("rocks too far", one.failure_per_year, one.failure_per_year_low, one.failure_per_year_high),
            rate(
                "overturns",
                one.overturning_per_year,
                one.overturning_per_year_low,
                one.overturning_per_year_high,
            ),
        ],
        all => {
            let of = |object: &super::tables::ObjectRates| {
                let [low, high] = [object.overturning_per_year_low, object.overturning_per_year_high];
                rate(&object.structure, object.overturning_per_year, low, high)
            };
            all.iter().take(OBJECTS).map(of).collect()
        }
    }
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

/// Incremental dynamic analyses.
pub fn analyses(tables: &Tables) -> Result<Vec<Ida>, TableError> {
    let fits: Vec<CapacityFitRow> = tables.rows("ida.fragility")?;
    let (rows, stripes) = (tables.rows::<CapacityRow>("ida")?, tables.stripes()?);
    let analysis = |fit: &CapacityFitRow| {
        let counts = stripes.get(&(fit.suite.clone(), fit.structure.clone()));
        let share = |(bits, &[n, events]): (&u64, &[usize; 2])| {
            let limits = wilson_limits(events, n);
            let [x, y] = [f64::from_bits(*bits), events as f64 / n as f64];
            Estimate { x, y, low: limits.low, high: limits.high, n: n as f64 }
        };
        let shares: Vec<Estimate> = counts.into_iter().flatten().map(share).collect();
        let [low, high] = [shares.first(), shares.last()].map(|end| end.map_or(f64::NAN, |end| end.x));
        let its = rows.iter().filter(|row| row.suite == fit.suite && row.structure == fit.structure);
        let below = |row: &CapacityRow| Some(low).filter(|_| row.capacity == CapacityStatus::Below);
        let mut capacities: Vec<f64> =
            its.filter_map(|row| row.overturning_intensity.or(below(row))).collect();
        capacities.sort_unstable_by(f64::total_cmp);
        let at = |k: usize| low * (high / low).powf(k as f64 / STEPS as f64);
        let curve = fit.theta.zip(fit.beta).map(|(theta, beta)| Curve {
            points: (0..=STEPS).map(|k| [at(k), p_overturning(at(k), theta.ln(), beta)]).collect(),
            ..Curve::default()
        });
        Ida {
            name: title(&fit.structure, fit.suite.as_deref()),
            intensity: words(fit.measure).to_string(),
            capacities,
            motions: fit.n as usize,
            shares: shares.iter().step_by(shares.len().div_ceil(LEVELS).max(1)).copied().collect(),
            curve: curve.unwrap_or_default(),
        }
    };
    Ok(fits.iter().take(PANELS).map(analysis).collect())
}

/// Adds an estimate to a series of a panel, which are made where they are not there.
fn add(panels: &mut Vec<NamedEstimates>, title: String, series: String, estimate: Estimate) {
    if panels.iter().all(|panel| panel.title != title) {
        panels.push(NamedEstimates { title: title.clone(), series: Vec::new() });
    }
    let Some(panel) = panels.iter_mut().find(|panel| panel.title == title) else { return };
    match panel.series.iter_mut().find(|(known, _)| *known == series) {
        Some((_, estimates)) => estimates.push(estimate),
        None => panel.series.push((series, vec![estimate])),
    }
}

/// Validations: a panel a structure and suite, a series an event and model.
pub fn tests(tables: &Tables) -> Result<Vec<NamedEstimates>, TableError> {
    let mut panels = Vec::new();
    for bin in tables.rows::<ReliabilityBin>("validation.reliability")? {
        let ReliabilityBin { predicted: x, share: y, share_low: low, share_high: high, n, .. } = bin;
        let series = format!("{}, {}", bin.event, bin.model);
        let estimate = Estimate { x, y, low, high, n: n as f64 };
        add(&mut panels, title(&bin.structure, bin.suite.as_deref()), series, estimate);
    }
    panels.truncate(PANELS);
    Ok(panels)
}

/// Rankings: a panel a structure, suite and target, a row a set of measures.
pub fn targets(tables: &Tables) -> Result<Vec<NamedEstimates>, TableError> {
    let mut panels = Vec::new();
    for set in tables.rows::<RankedSet>("ranking")? {
        let is_shown = set.rank <= SETS || PAPER.contains(&set.measures.as_str());
        let (Some(loss), Some(error), true) = (set.loss, set.loss_error, is_shown) else { continue };
        let target = if set.target == Target::Demand { "demand" } else { "overturning" };
        let title = format!("{}: {target}", title(&set.structure, set.suite.as_deref()));
        let name = format!("{} ({})", set.measures.to_uppercase().replace(':', ", "), set.form);
        let [low, high] = [loss - Z_95 * error, loss + Z_95 * error];
        add(&mut panels, title, name, Estimate { x: loss, y: 0.0, low, high, n: f64::NAN });
    }
    panels.truncate(PANELS);
    Ok(panels)
}
