use std::path::Path;
use std::sync::Arc;

use super::ReportOptions;
use crate::pipeline::UsageError;
use crate::report::data::{Group, ReportResponse, Summary};
use crate::rocking::Outcome;
use crate::statistics::Spread;
use crate::table::responses::{RESPONSES, ResponseCase};
use crate::table::row::Row;
use crate::table::store::reader::Batches;

/// Responses of a suite and structure that the figures show.
const MOST_DRAWN: usize = 1 << 17;

/// The responses of the suites and structures that are to be drawn, what came of all that are asked for, and how many pairs
/// of both are not drawn.
pub fn read(
    path: &Path,
    options: &ReportOptions,
    limit: Option<f64>,
) -> anyhow::Result<(Vec<Group>, Vec<Summary>, usize)> {
    let mut sorted = Sorted { limit, ..Sorted::default() };
    for batch in Batches::open_whole(path, &ResponseCase::TABLE, &[RESPONSES.stage])? {
        for row in ResponseCase::checked(&batch?.columns())? {
            sorted.add(&row, options);
        }
    }
    let Sorted { mut groups, drawn, names, summaries, .. } = sorted;
    for ((group, drawn), summary) in groups.iter_mut().zip(drawn).zip(&summaries) {
        group.not_drawn = drawn.passed_over();
        group.fewer = summary.as_ref().map_or(0, Summary::fewer);
        group.responses = drawn.into_kept();
    }
    if groups.is_empty() {
        let known =
            names.iter().map(|(suite, structure)| format!("{} {structure}", suite.as_deref().unwrap_or("-")));
        return Err(UsageError::because(format!(
            "{}: nothing of the suite and structure asked for; expected one of {}",
            path.display(),
            known.take(20).collect::<Vec<_>>().join(", ")
        )));
    }
    let left_out = names.len() - groups.len();
    // Suites of one structure stand beside each other.
    let structures: Vec<String> = groups.iter().map(|group| group.structure.name.clone()).collect();
    groups.sort_by_key(|group| structures.iter().position(|name| *name == group.structure.name));
    Ok((groups, summaries.into_iter().flatten().collect(), left_out))
}

type Name = (Option<Arc<str>>, Arc<str>);

#[derive(Default)]
struct Sorted {
    groups: Vec<Group>,
    /// The responses of each, to be drawn.
    drawn: Vec<Spread<ReportResponse>>,
    /// Of all groups of the file; those that are shown first, in the same order as `groups`.
    names: Vec<Name>,
    /// What came of them, in the same order; nothing of those that are not asked for.
    summaries: Vec<Option<Summary>>,
    /// The limit state.
    limit: Option<f64>,
}

impl Sorted {
    fn add(&mut self, row: &ResponseCase, options: &ReportOptions) {
        let place = self.place(row, options);
        let case = row.case();
        if let Some(summary) = &mut self.summaries[place] {
            summary.n += 1;
            summary.rocked += usize::from(case.outcome != Outcome::NoRocking);
            summary.overturned += usize::from(case.outcome == Outcome::Overturning);
            let above = |limit: f64| usize::from(case.outcome == Outcome::SafeRocking && case.edp > limit);
            summary.exceeded = self.limit.map(|limit| summary.exceeded.unwrap_or(0) + above(limit));
        }
        let Some(drawn) = self.drawn.get_mut(place) else { return };
        drawn.push(ReportResponse { case, pga_m_s2: row.pga_m_s2, pgv_m_s: row.pgv_m_s, tp_s: row.tp_s });
    }

    /// The place of the suite and structure of a response; those that are drawn come first.
    fn place(&mut self, row: &ResponseCase, options: &ReportOptions) -> usize {
        let is_its = |(suite, structure): &Name| *suite == row.suite && *structure == row.structure;
        if let Some(index) = self.names.iter().position(is_its) {
            return index;
        }
        let name = (row.suite.clone(), row.structure.clone());
        let asked = (options.suite.is_none() || options.suite.as_deref() == name.0.as_deref())
            && options.structure.as_ref().is_none_or(|asked| **asked == *name.1);
        let suite = name.0.as_deref().map(str::to_string);
        let summary = asked.then(|| Summary {
            suite: suite.clone(),
            structure: row.structure(),
            n: 0,
            rocked: 0,
            overturned: 0,
            exceeded: None,
            curve: None,
        });
        if !(asked && self.groups.len() < options.groups) {
            self.names.push(name);
            self.summaries.push(summary);
            return self.names.len() - 1;
        }
        let index = self.groups.len();
        self.groups.push(Group {
            suite,
            structure: row.structure(),
            responses: Vec::new(),
            not_drawn: 0,
            fewer: 0,
            univariate: Vec::new(),
            planes: None,
            curves: Vec::new(),
        });
        self.drawn.push(Spread::new(MOST_DRAWN));
        self.names.insert(index, name);
        self.summaries.insert(index, summary);
        index
    }
}
