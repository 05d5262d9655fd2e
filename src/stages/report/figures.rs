//! The figures of the tables that are there, in the order of the page.

use super::tables::{Kind, Tables};
use crate::fragility::Cases;
use crate::report::figures::common::{by, rocked};
use crate::report::figures::*;
use crate::report::{Figure, compare, list, object, response};

/// The most pairs of suite and structure that are drawn, and structures in one panel.
const MOST_GROUPS: usize = 24;
const MOST_STRUCTURES: usize = 6;

/// Draws all figures; what is too much to draw is noted.
pub fn all(tables: &Tables, notes: &mut Vec<String>) -> anyhow::Result<Vec<Figure>> {
    let rocking: Vec<&Cases> = tables.groups.iter().filter(|cases| rocked(cases).next().is_some()).collect();
    let groups = &rocking[..rocking.len().min(MOST_GROUPS)];
    if groups.len() < rocking.len() {
        let names: Vec<String> = rocking[groups.len()..].iter().map(|cases| common::name(cases)).collect();
        notes.push(format!("Not drawn, as they overturn less than those that are: {}.", names.join(", ")));
    }
    let suites: Vec<Vec<&Cases>> = by(groups.iter().copied(), |cases| &cases.suite)
        .iter()
        .flat_map(|suite| suite.chunks(MOST_STRUCTURES).map(<[_]>::to_vec))
        .collect();
    let has_fits = |cases: &&Cases| power_laws(&tables.fits, cases).iter().any(Option::is_some);
    let fitted: Vec<&Cases> = groups.iter().copied().filter(has_fits).collect();
    let (motions, fits) = (tables.motions()?, &tables.fits);
    let stripes = tables.rows(Kind::Stripes)?;
    let mut figures = of_evaluations(tables);
    figures.extend(tables.traces.iter().map(response::figure));
    figures.extend([
        ida(&tables.rows(Kind::CapacityFits)?, &tables.rows(Kind::Capacities)?, &stripes),
        hybrids(fits, &suites),
        maps(fits, &suites),
        validation(&tables.rows(Kind::Reliability)?),
        ranking(&tables.rows(Kind::Ranking)?),
        motion(&motions),
        similarity(&tables.groups, &motions)?,
        planes(fits, groups),
        exceedance(fits, &suites),
        overturning(fits, &suites),
        demand(groups),
        quality(fits, &fitted),
    ]);
    figures.extend(fitted.iter().map(|cases| regressions(fits, cases)));
    figures.retain(|figure| !figure.panels.is_empty());
    Ok(figures)
}

/// The main figure of the evaluations: of one object, of two files that have objects in common, or of a list.
fn of_evaluations(tables: &Tables) -> Vec<Figure> {
    if let Some([before, after]) = tables.comparison() {
        let target = before.target.or(after.target);
        return vec![compare::figure(&compare::pairs(before, after), &before.when, target)];
    }
    match &tables.evaluations[..] {
        [] => Vec::new(),
        [one] if one.rows.len() == 1 => vec![object::figure(one, &one.rows[0])],
        several => vec![list::figure(several)],
    }
}
