use std::path::Path;
use std::sync::Arc;

use super::ReportOptions;
use crate::pipeline::UsageError;
use crate::report::data::{Group, ReportResponse};
use crate::table::responses::{RESPONSES, ResponseCase};
use crate::table::row::Row;
use crate::table::store::reader::Batches;

/// The responses of the suites and structures that are to be shown, and how many others there are.
pub fn read(path: &Path, options: &ReportOptions) -> anyhow::Result<(Vec<Group>, usize)> {
    let mut sorted = Sorted::default();
    for batch in Batches::open_whole(path, &ResponseCase::TABLE, &[RESPONSES.stage])? {
        for row in ResponseCase::checked(&batch?.columns())? {
            sorted.add(&row, options);
        }
    }
    let Sorted { mut groups, names } = sorted;
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
    Ok((groups, left_out))
}

type Name = (Option<Arc<str>>, Arc<str>);

#[derive(Default)]
struct Sorted {
    groups: Vec<Group>,
    /// Of all groups of the file; those that are shown first, in the same order as `groups`.
    names: Vec<Name>,
}

impl Sorted {
    fn add(&mut self, row: &ResponseCase, options: &ReportOptions) {
        let Some(group) = self.group(row, options) else { return };
        group.responses.push(ReportResponse {
            case: row.case(),
            pga_m_s2: row.pga_m_s2,
            pgv_m_s: row.pgv_m_s,
            tp_s: row.tp_s,
        });
    }

    /// The group of a response, if it is to be shown.
    fn group(&mut self, row: &ResponseCase, options: &ReportOptions) -> Option<&mut Group> {
        let is_its = |(suite, structure): &Name| *suite == row.suite && *structure == row.structure;
        let known = self.names.iter().position(is_its);
        if let Some(index) = known {
            return self.groups.get_mut(index);
        }
        let name = (row.suite.clone(), row.structure.clone());
        let wanted = (options.suite.is_none() || options.suite.as_deref() == name.0.as_deref())
            && options.structure.as_ref().is_none_or(|wanted| **wanted == *name.1);
        if !(wanted && self.groups.len() < options.groups) {
            self.names.push(name);
            return None;
        }
        let index = self.groups.len();
        self.groups.push(Group {
            suite: name.0.as_deref().map(str::to_string),
            structure: row.structure(),
            responses: Vec::new(),
            univariate: Vec::new(),
            planes: None,
            curves: Vec::new(),
        });
        self.names.insert(index, name);
        self.groups.last_mut()
    }
}
