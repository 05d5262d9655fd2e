//! The figures of responses, fits and studies that are there, in the order of the page.

use super::tables::{Kind, Tables};
use crate::fragility::Cases;
use crate::report::Figure;
use crate::report::figures::common::{by, name, rocked};
use crate::report::figures::*;

/// The most pairs of suite and structure that are drawn, and structures in one panel.
const MOST_GROUPS: usize = 24;
const MOST_STRUCTURES: usize = 6;

/// Draws all figures; what is too much to draw is left out.
pub fn all(tables: &mut Tables) -> anyhow::Result<Vec<Figure>> {
    let rocking: Vec<&Cases> = tables.groups.iter().filter(|cases| rocked(cases).next().is_some()).collect();
    let groups = &rocking[..rocking.len().min(MOST_GROUPS)];
    if groups.len() < rocking.len() {
        let names: Vec<String> = rocking[groups.len()..].iter().map(|cases| name(cases)).collect();
        let names = names.join(", ");
        tables.left_out.push(format!("Not drawn, as they overturn less than those that are: {names}."));
    }
    let suites: Vec<Vec<&Cases>> = by(groups.iter().copied(), |cases| &cases.suite)
        .iter()
        .flat_map(|suite| suite.chunks(MOST_STRUCTURES).map(<[_]>::to_vec))
        .collect();
    let (motions, fits) = (tables.motions()?, &tables.fits);
    let mut fitted: Vec<&Cases> = groups.to_vec();
    fitted.retain(|cases| power_laws(fits, cases).iter().any(Option::is_some));
    let stripes = tables.rows(Kind::Stripes)?;
    let mut figures = vec![
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
    ];
    figures.extend(fitted.iter().map(|cases| regressions(fits, cases)));
    figures.retain(|figure| !figure.panels.is_empty());
    Ok(figures)
}
