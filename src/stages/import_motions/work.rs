//! Files, or pairs of components, in groups that are done at once.

use super::ImportMotions;
use super::inputs::{Input, groups, motions};
use super::pairs::{Member, Pairs, read_pair};
use super::processing::Scratch;
use super::refusals::Refusal;
use crate::pipeline::console::Console;
use crate::pipeline::stream::Pool;
use crate::table::records::RecordRow;

/// Motions that are held at once, or a few more.
const MOTIONS_AT_ONCE: usize = 64;
/// The least number of files that are read at once, to keep threads busy.
const LEAST_AT_ONCE: usize = 8;
/// Motions that a message names.
const NAMED: usize = 10;

/// What one thread turns into rows.
pub enum Work {
    /// A file, or a motion of one.
    Input(Input),
    /// Two components.
    Pair([Member; 2]),
}

/// All work in order, in groups, and what is refused already.
pub struct Plan<'a> {
    /// The groups.
    pub work: Box<dyn Iterator<Item = Vec<Work>> + Send + 'a>,
    /// Files that could not be read in the search for pairs.
    pub refused: Vec<Refusal>,
}

impl ImportMotions {
    /// What is to be done; motions that are in no pair, where pairs are asked for, are named on the console.
    pub(super) fn plan(&self, console: &Console) -> Plan<'_> {
        let at_once = (MOTIONS_AT_ONCE / self.processing.scaling.count().max(1)).max(LEAST_AT_ONCE);
        if self.processing.direction.is_none() {
            let work = groups(&self.files, at_once).map(|group| group.into_iter().map(Work::Input).collect());
            return Plan { work: Box::new(work), refused: Vec::new() };
        }
        let Pairs { pairs, left_out, refused } = Pairs::among(&self.files, &self.names, &self.reading);
        if !left_out.is_empty() {
            let more = if left_out.len() > NAMED { ", ..." } else { "" };
            let named: Vec<&str> = left_out.iter().take(NAMED).map(String::as_str).collect();
            console.note(&format!(
                "{} motions are vertical or without a partner at right angles, and are left out: {}{more}",
                left_out.len(),
                named.join(", ")
            ));
        }
        let mut pairs = pairs.into_iter();
        let work = std::iter::from_fn(move || {
            let group: Vec<Work> = pairs.by_ref().take(at_once).map(Work::Pair).collect();
            (!group.is_empty()).then_some(group)
        });
        Plan { work: Box::new(work), refused }
    }

    /// The rows of a piece of work, and what is refused of it.
    pub(super) fn rows_of(&self, work: Work, pool: &Pool<Scratch>) -> Vec<Result<Vec<RecordRow>, Refusal>> {
        match work {
            Work::Pair(pair) => {
                let pair = read_pair(&pair, &self.names, &self.reading);
                vec![pair.and_then(|pair| pool.lend(|scratch| self.processing.rows_of_pair(pair, scratch)))]
            }
            Work::Input(input) => {
                let rows = |found| pool.lend(|scratch| self.processing.rows(found, scratch));
                let found = motions(input, &self.names, &self.reading);
                found.into_iter().map(|found| found.and_then(rows)).collect()
            }
        }
    }
}
