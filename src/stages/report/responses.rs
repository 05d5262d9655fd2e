use std::path::Path;

use super::ReportOptions;
use crate::fragility::Case;
use crate::keyword;
use crate::pipeline::UsageError;
use crate::report::material::{Group, Seen};
use crate::rocking::Structure;
use crate::table::columns::Columns;
use crate::table::reader::Batches;
use crate::table::responses::MeasureColumns;
use crate::table::schema::{self, RESPONSES};

/// The responses of the suites and structures that are to be shown, and how many others there are.
pub fn read(path: &Path, options: &ReportOptions) -> anyhow::Result<(Vec<Group>, usize)> {
    let mut sorted = Sorted::default();
    for batch in Batches::open_whole(path, &RESPONSES, &[RESPONSES.stage])? {
        sorted.add(&batch?.columns(), options)?;
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

type Name = (Option<String>, String);

#[derive(Default)]
struct Sorted {
    groups: Vec<Group>,
    /// Of all groups of the file; those that are shown first, in the same order as `groups`.
    names: Vec<Name>,
}

impl Sorted {
    fn add(&mut self, columns: &Columns, options: &ReportOptions) -> anyhow::Result<()> {
        let (suites, structures) =
            (columns.optional_text(&schema::SUITE)?, columns.text(&schema::STRUCTURE)?);
        let outcomes = columns.text(&schema::OUTCOME)?;
        let number = |column| columns.numbers(column);
        let (p, alpha, eta) = (number(&schema::P_RAD_S)?, number(&schema::ALPHA_RAD)?, number(&schema::ETA)?);
        let (edp, pga, pgv) = (number(&schema::EDP)?, number(&schema::PGA_M_S2)?, number(&schema::PGV_M_S)?);
        let tp = columns.optional_numbers(&schema::TP_S)?;
        let measures = MeasureColumns::read(
            |column| columns.optional_numbers(&column),
            |column| columns.numbers(&column),
        )?;
        let names = suites.into_iter().zip(structures);
        for (row, (name, outcome)) in names.zip(outcomes).enumerate() {
            let structure =
                || Structure { name: name.1.clone(), p_rad_s: p[row], alpha_rad: alpha[row], eta: eta[row] };
            let Some(group) = self.group(&name, structure, options) else { continue };
            let outcome = keyword::parse(&outcome)
                .map_err(|unknown| columns.value_error(row, &schema::OUTCOME, &unknown.to_string()))?;
            let case = Case { outcome, edp: edp[row], measures: measures.of_row(row) };
            group.responses.push(Seen { case, pga_m_s2: pga[row], pgv_m_s: pgv[row], tp_s: tp[row] });
        }
        Ok(())
    }

    /// The group of this name, if it is to be shown.
    fn group(
        &mut self,
        name: &Name,
        structure: impl Fn() -> Structure,
        options: &ReportOptions,
    ) -> Option<&mut Group> {
        let known = self.names.iter().position(|known| known == name);
        if let Some(index) = known {
            return self.groups.get_mut(index);
        }
        let wanted = (options.suite.is_none() || options.suite == name.0)
            && options.structure.as_ref().is_none_or(|wanted| *wanted == name.1);
        if !(wanted && self.groups.len() < options.groups) {
            self.names.push(name.clone());
            return None;
        }
        let index = self.groups.len();
        self.names.insert(index, name.clone());
        self.groups.push(Group {
            suite: name.0.clone(),
            structure: structure(),
            responses: Vec::new(),
            univariate: Vec::new(),
            planes: None,
            curves: Vec::new(),
        });
        self.groups.last_mut()
    }
}
