//! The figures of what a folder holds, numbered as in the paper where they are of the paper's. Of nothing to
//! draw, a figure has no panels.

pub mod common;
mod demand;
mod map;
mod motion;
mod planes;
mod probability;
mod studies;

use super::tables::Tables;
use crate::fragility::Cases;
use crate::report::Figure;
use common::{by, rocked};
use demand::fits;

pub use demand::{demand, quality, regressions};
pub use map::maps;
pub use motion::{motion, similarity};
pub use planes::planes;
pub use probability::{exceedance, hybrids, overturning};
pub use studies::{Stripe, annual, ida, ranking, validation};

/// The most pairs of suite and structure that are drawn, and structures in one panel.
const MOST_GROUPS: usize = 4;
const MOST_STRUCTURES: usize = 6;

/// Draws all figures of the tables that are there, in the order of the page.
pub fn all(tables: &Tables) -> anyhow::Result<Vec<Figure>> {
    let rocking: Vec<&Cases> = tables.groups.iter().filter(|cases| rocked(cases).next().is_some()).collect();
    let groups = &rocking[..rocking.len().min(MOST_GROUPS)];
    let mut suites: Vec<Vec<&Cases>> = by(rocking.iter().copied(), |cases| &cases.suite);
    suites.truncate(MOST_GROUPS);
    suites.iter_mut().for_each(|groups| groups.truncate(MOST_STRUCTURES));
    let has_fits = |cases: &&Cases| fits(tables, cases).iter().any(Option::is_some);
    let fitted: Vec<&Cases> = groups.iter().copied().filter(has_fits).collect();
    let motions = tables.motions()?;
    let mut figures = vec![
        annual(&tables.objects),
        ida(&tables.rows("ida.fragility")?, &tables.rows("ida")?, &tables.rows("ida.stripes")?),
        hybrids(tables, &suites),
        maps(tables, &suites),
        validation(&tables.rows("validation.reliability")?),
        ranking(&tables.rows("ranking")?),
        motion(&motions),
        similarity(&tables.groups, &motions)?,
        planes(tables, groups),
        exceedance(tables, &suites),
        overturning(tables, &suites),
        demand(groups),
        quality(tables, &fitted),
    ];
    figures.extend(fitted.iter().map(|cases| regressions(tables, cases)));
    figures.retain(|figure| !figure.panels.is_empty());
    Ok(figures)
}
