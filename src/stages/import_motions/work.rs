//! Files, or pairs of components, in groups that are processed at once.

use std::path::PathBuf;

use rayon::prelude::*;

use super::inputs::{Input, Names, Reading, groups, motions};
use crate::pipeline::console::Console;
use crate::pipeline::stream::Pool;
use crate::records::RecordedMotion;
use crate::records::pairs::{PairSearch, Pairs};
use crate::records::processing::{ImportedMotion, NamedRecord, Processing, Refusal, Scratch};

/// Motions that are held at once, or a few more.
const MOTIONS_AT_ONCE: usize = 64;
/// The least number of files that are read at once, to keep threads busy.
const LEAST_AT_ONCE: usize = 8;
/// Files that are read at once in the search for pairs.
const FILES_AT_ONCE: usize = 64;
/// Motions that a message names.
const NAMED: usize = 10;

/// The files of a run, and what is done to them.
pub struct Importer {
    pub files: Vec<PathBuf>,
    pub names: Names,
    pub reading: Reading,
    pub processing: Processing,
}

/// What one thread imports.
pub enum Work {
    Input(Input),
    Pair([Member; 2]),
}

/// A component of a pair: its file, which of the file's motions it is, and its azimuth.
pub struct Member {
    motion_id: String,
    file: PathBuf,
    index: usize,
    azimuth_deg: f64,
}

/// All work in order, in groups, and what is refused already.
pub struct Plan<'a> {
    pub work: Box<dyn Iterator<Item = Vec<Work>> + Send + 'a>,
    /// Files that could not be read in the search for pairs.
    pub refused: Vec<Refusal>,
}

impl Importer {
    /// Plans the work; motions that are in no pair, where pairs are asked for, are named on the console.
    pub fn plan(&self, console: &Console) -> Plan<'_> {
        let at_once = (MOTIONS_AT_ONCE / self.processing.scaling.count().max(1)).max(LEAST_AT_ONCE);
        if self.processing.direction.is_none() {
            let work = groups(&self.files, at_once).map(|group| group.into_iter().map(Work::Input).collect());
            return Plan { work: Box::new(work), refused: Vec::new() };
        }
        let (Pairs { pairs, left_out }, refused) = self.pairs();
        if !left_out.is_empty() {
            let more = if left_out.len() > NAMED { ", ..." } else { "" };
            let named: Vec<&str> =
                left_out.iter().take(NAMED).map(|member| member.motion_id.as_str()).collect();
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

    /// Reads all files for their pairs, and keeps of each motion only where it is.
    fn pairs(&self) -> (Pairs<Member>, Vec<Refusal>) {
        let (mut search, mut refused) = (PairSearch::default(), Vec::new());
        for group in groups(&self.files, FILES_AT_ONCE) {
            let components: Vec<Vec<_>> = group.into_par_iter().map(|input| self.components(input)).collect();
            for component in components.into_iter().flatten() {
                match component {
                    Ok((motion, member)) => search.add(motion, member),
                    Err(refusal) => refused.push(refusal),
                }
            }
        }
        (search.finish(), refused)
    }

    fn components(&self, input: Input) -> Vec<Result<(RecordedMotion, Member), Refusal>> {
        let file = match &input {
            Input::Text(file) => file.clone(),
            Input::Motion(source, _) => PathBuf::from(&source.path),
            Input::Refused(refusal) => PathBuf::from(&refusal.file),
        };
        let component = |(index, NamedRecord { motion_id, motion, .. }): (usize, NamedRecord)| {
            let azimuth_deg = motion.azimuth_deg.unwrap_or_default();
            // The samples are read again once a pair is found: that takes less memory than keeping all of them.
            let without_samples = RecordedMotion { acceleration_m_s2: Vec::new(), ..motion };
            (without_samples, Member { motion_id, file: file.clone(), index, azimuth_deg })
        };
        let found = motions(input, &self.names, &self.reading).into_iter().enumerate();
        found.map(|(index, found)| Ok(component((index, found?)))).collect()
    }

    /// Reads the two motions of a pair again.
    ///
    /// # Errors
    /// If a file has changed in between.
    fn read_pair(&self, pair: &[Member; 2]) -> Result<[(NamedRecord, f64); 2], Refusal> {
        let member = |member: &Member| {
            let input = Input::Text(member.file.clone());
            let found = motions(input, &self.names, &self.reading).into_iter().nth(member.index);
            let changed = || Refusal::of(&member.file, &"the file changed while it was read; run again");
            Ok((found.unwrap_or_else(|| Err(changed()))?, member.azimuth_deg))
        };
        let [first, second] = pair;
        Ok([member(first)?, member(second)?])
    }

    /// Imports a piece of work: its motions, and what is refused of it.
    pub fn import(&self, work: Work, pool: &Pool<Scratch>) -> Vec<Result<Vec<ImportedMotion>, Refusal>> {
        match work {
            Work::Pair(pair) => {
                let import = |pair| pool.lend(|scratch| self.processing.import_pair(pair, scratch));
                vec![self.read_pair(&pair).and_then(import)]
            }
            Work::Input(input) => {
                let import = |record| pool.lend(|scratch| self.processing.import(record, scratch));
                let found = motions(input, &self.names, &self.reading);
                found.into_iter().map(|record| record.and_then(import)).collect()
            }
        }
    }
}
