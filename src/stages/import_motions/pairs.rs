//! Which horizontal components belong together: those of one event and station at right angles.

use std::collections::HashMap;
use std::path::PathBuf;

use rayon::prelude::*;

use super::inputs::{Found, Input, Names, groups, motions};
use super::options::Reading;
use super::refusals::Refusal;
use crate::motion::processing::HorizontalPair;

/// Files that are read at once.
const FILES_AT_ONCE: usize = 64;

/// A component: its file, which of the file's motions it is, and its azimuth, degrees.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    file: PathBuf,
    index: usize,
    azimuth_deg: f64,
}

/// What the search for pairs finds.
#[derive(Default)]
pub struct Pairs {
    /// The pairs, in the order of their first components.
    pub pairs: Vec<[Member; 2]>,
    /// Motions that are in none.
    pub left_out: Vec<String>,
    /// Files that cannot be read.
    pub refused: Vec<Refusal>,
}

/// What counts of a motion for its pair.
struct Label {
    motion_id: String,
    member: Option<Member>,
    place: Place,
}

/// Event, station, and the bits of the time step.
type Place = (Option<String>, Option<String>, u64);

impl Pairs {
    /// Among the motions of these files. Only text files say where a component points.
    pub fn among(files: &[PathBuf], names: &Names, reading: &Reading) -> Pairs {
        let mut search = Search::default();
        for group in groups(files, FILES_AT_ONCE) {
            let labels: Vec<Vec<_>> =
                group.into_par_iter().map(|input| labels(input, names, reading)).collect();
            labels.into_iter().flatten().for_each(|label| search.add(label));
        }
        search.finish()
    }
}

/// Components that wait for their partners, by where they are from, each with its place in the order of all.
#[derive(Default)]
struct Search {
    seen: usize,
    waiting: HashMap<Place, Vec<(usize, String, Member)>>,
    pairs: Vec<(usize, [Member; 2])>,
    found: Pairs,
}

impl Search {
    fn add(&mut self, label: Result<Label, Refusal>) {
        self.seen += 1;
        let (motion_id, place, member) = match label {
            Err(refusal) => return self.found.refused.push(refusal),
            Ok(Label { motion_id, member: None, .. }) => return self.found.left_out.push(motion_id),
            Ok(Label { motion_id, place, member: Some(member) }) => (motion_id, place, member),
        };
        let others = self.waiting.entry(place).or_default();
        let is_right = |other: &Member| HorizontalPair::is_right_angle(other.azimuth_deg, member.azimuth_deg);
        match others.iter().position(|(_, _, other)| is_right(other)) {
            Some(at) => {
                let (first, _, other) = others.remove(at);
                self.pairs.push((first, [other, member]));
            }
            None => others.push((self.seen, motion_id, member)),
        }
    }

    fn finish(mut self) -> Pairs {
        self.pairs.sort_by_key(|(first, _)| *first);
        self.found.pairs = self.pairs.into_iter().map(|(_, pair)| pair).collect();
        let mut alone: Vec<_> = self.waiting.into_values().flatten().collect();
        alone.sort_by_key(|(order, ..)| *order);
        self.found.left_out.extend(alone.into_iter().map(|(_, motion_id, _)| motion_id));
        self.found
    }
}

fn labels(input: Input, names: &Names, reading: &Reading) -> Vec<Result<Label, Refusal>> {
    let file = match &input {
        Input::Text(file) => Some(file.clone()),
        Input::Motion(..) | Input::Refused(_) => None,
    };
    let label = |(index, Found { motion_id, motion, .. }): (usize, Found)| {
        let known = motion.event.is_some() || motion.station.is_some();
        let azimuth_deg = motion.azimuth_deg.filter(|_| known);
        let member =
            file.clone().zip(azimuth_deg).map(|(file, azimuth_deg)| Member { file, index, azimuth_deg });
        Label { motion_id, member, place: (motion.event, motion.station, motion.dt_s.to_bits()) }
    };
    let found = motions(input, names, reading).into_iter().enumerate();
    found.map(|(index, found)| Ok(label((index, found?)))).collect()
}

/// The two motions of a pair, read again: that takes less memory than keeping all of them.
///
/// # Errors
/// If a file has changed in between.
pub fn read_pair(pair: &[Member; 2], names: &Names, reading: &Reading) -> Result<[(Found, f64); 2], Refusal> {
    let member = |member: &Member| {
        let found = motions(Input::Text(member.file.clone()), names, reading).into_iter().nth(member.index);
        let changed = || Refusal {
            file: member.file.display().to_string(),
            reason: "the file changed while it was read; run again".to_string(),
        };
        Ok((found.unwrap_or_else(|| Err(changed()))?, member.azimuth_deg))
    };
    let [first, second] = pair;
    Ok([member(first)?, member(second)?])
}
