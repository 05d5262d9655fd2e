//! The data of the figures of rates, incremental dynamic analyses, validations and rankings.

use serde::{Deserialize, Serialize};

use super::tables::{Tables, title};
use crate::fragility::{Measure, Z_95, grouped, p_overturning};
use crate::report::Estimate;
use crate::report::figures::{AnnualRate, Curve, Ida, NamedEstimates, label, observed_shares};
use crate::rocking::{CapacityStatus, Outcome};
use crate::stages::ida::{CapacityFitRow, CapacityRow, ScaledMeasure};
use crate::studies::{Form, RankedSet, ReliabilityBin, Target, wilson_limits};
use crate::table::TableError;

/// The most objects, panels, levels of an analysis, and points of its curve.
const OBJECTS: usize = 60;
const PANELS: usize = 6;
const LEVELS: usize = 15;
const STEPS: usize = 100;
/// The most sets of measures that are drawn, besides those of the paper.
const SETS: i64 = 6;
const PAPER: [&str; 2] = ["im3:im4", "im5"];

fn rate(name: &str, rates: [Option<f64>; 3]) -> AnnualRate {
    let [rate, low, high] = rates.map(|rate| rate.unwrap_or(f64::NAN));
    AnnualRate { name: name.to_string(), rate, low, high }
}

/// Annual rates of overturning of objects, if there are several.
pub fn objects(tables: &Tables) -> Vec<AnnualRate> {
    let objects = tables.objects.iter().filter(|_| tables.objects.len() > 1).take(OBJECTS);
    objects.map(|(object, row, _)| rate(&object.structure, row.overturning_per_year)).collect()
}

/// Annual rates of the limit states, if there is one object.
pub fn states(tables: &Tables) -> Vec<AnnualRate> {
    let [(_, row, _)] = &tables.objects[..] else { return Vec::new() };
    vec![
        rate("rocks", [row.rocking_per_year, None, None]),
        rate("rocks too far, or overturns", row.failure_per_year),
        rate("overturns", row.overturning_per_year),
    ]
}

/// The measure that is scaled, with its unit.
pub fn words(measure: ScaledMeasure) -> &'static str {
    match measure {
        ScaledMeasure::Scale => "factor on the motion",
        ScaledMeasure::Pga => "PGA (g)",
        ScaledMeasure::Pgv => "PGV (m/s)",
        ScaledMeasure::Im4 => label(Measure::Im4),
        ScaledMeasure::Im5 => label(Measure::Im5),
        ScaledMeasure::Im6 => label(Measure::Im6),
    }
}

/// What is read of a stripe.
#[derive(Serialize, Deserialize)]
struct Stripe {
    suite: Option<String>,
    structure: String,
    intensity: f64,
    outcome: Outcome,
}

grouped!(Stripe);

/// Incremental dynamic analyses.
pub fn analyses(tables: &Tables) -> Result<Vec<Ida>, TableError> {
    let fits: Vec<CapacityFitRow> = tables.rows("ida.fragility")?;
    let (rows, stripes) = (tables.rows::<CapacityRow>("ida")?, tables.rows::<Stripe>("ida.stripes")?);
    let mut levels: Vec<f64> = stripes.iter().map(|stripe| stripe.intensity).collect();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    let [low, high] = [levels.first(), levels.last()].map(|level| level.copied().unwrap_or(f64::NAN));
    let at = |k: usize| low * (high / low).powf(k as f64 / STEPS as f64);
    let analysis = |fit: &CapacityFitRow| {
        let its = stripes.iter().filter(|stripe| stripe.group() == fit.group());
        let cases: Vec<_> =
            its.map(|stripe| (stripe.intensity, stripe.outcome == Outcome::Overturning)).collect();
        let shares = observed_shares(&cases, |x| levels.partition_point(|level| *level < x), wilson);
        let below = |row: &CapacityRow| Some(low).filter(|_| row.capacity == CapacityStatus::Below);
        let its = rows.iter().filter(|row| row.group() == fit.group());
        let mut capacities: Vec<f64> =
            its.filter_map(|row| row.overturning_intensity.or(below(row))).collect();
        capacities.sort_unstable_by(f64::total_cmp);
        let curve = fit.theta[0].zip(fit.beta[0]).map(|(theta, beta)| Curve {
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

/// Wilson's limits of a share.
pub fn wilson(events: usize, n: usize) -> [f64; 2] {
    let limits = wilson_limits(events, n);
    [limits.low, limits.high]
}

/// Adds an estimate to a series of a panel, either of which is made where it is not there.
fn add(panels: &mut Vec<NamedEstimates>, title: String, series: String, estimate: Estimate) {
    let panel = panels.iter().position(|panel| panel.title == title).unwrap_or_else(|| {
        panels.push(NamedEstimates { title, series: Vec::new() });
        panels.len() - 1
    });
    let known = &mut panels[panel].series;
    match known.iter_mut().find(|(name, _)| *name == series) {
        Some((_, estimates)) => estimates.push(estimate),
        None => known.push((series, vec![estimate])),
    }
}

/// Validations: a panel a structure and suite, a series an event and model.
pub fn tests(tables: &Tables) -> Result<Vec<NamedEstimates>, TableError> {
    let mut panels = Vec::new();
    for bin in tables.rows::<ReliabilityBin>("validation.reliability")? {
        let ReliabilityBin { predicted: x, share: y, share_low: low, share_high: high, n, .. } = bin;
        let (title, series) =
            (title(&bin.structure, bin.suite.as_deref()), format!("{}, {}", bin.event, bin.model));
        add(&mut panels, title, series, Estimate { x, y, low, high, n: n as f64 });
    }
    panels.truncate(PANELS);
    Ok(panels)
}

/// Rankings: a panel a structure, suite and target, a row a set of measures.
pub fn targets(tables: &Tables) -> Result<Vec<NamedEstimates>, TableError> {
    let mut panels = Vec::new();
    for set in tables.rows::<RankedSet>("ranking")? {
        let is_shown = set.rank <= SETS || PAPER.contains(&set.measures.as_str());
        let (Some(x), Some(error), true) = (set.loss, set.loss_error, is_shown) else { continue };
        let target = if set.target == Target::Demand { "demand" } else { "overturning" };
        let title = format!("{}: {target}", title(&set.structure, set.suite.as_deref()));
        let planes = if set.form == Form::Biplanar { ", two planes" } else { "" };
        let name = format!("{}{planes}", set.measures.to_uppercase().replace(':', ", "));
        let [low, high] = [x - Z_95 * error, x + Z_95 * error];
        add(&mut panels, title, name, Estimate { x, y: 0.0, low, high, n: f64::NAN });
    }
    panels.truncate(PANELS);
    Ok(panels)
}
