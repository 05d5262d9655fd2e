//! How many motions overturn each structure, and which, where they are few.

use crate::rocking::{Outcome, Record, Response, Structure};
use crate::stages::shared::motions::in_g;
use crate::stages::shared::reasons::listed;
use crate::table::motions::Motion;

/// Motions of a file that are named.
const MOST_MOTIONS: u64 = 20;
/// Structures that are told one by one.
const MOST_STRUCTURES: usize = 8;

/// The motions that overturn each structure, and whether any rocks at all.
#[derive(Default)]
pub struct Overturned {
    /// In the order of the structures.
    each: Vec<Of>,
    any_rocks: bool,
    largest_pga_m_s2: f64,
}

#[derive(Default, Clone)]
struct Of {
    count: u64,
    /// Of the first few.
    motions: Vec<String>,
}

impl Overturned {
    pub fn new(structures: &[Structure]) -> Overturned {
        Overturned { each: vec![Of::default(); structures.len()], ..Overturned::default() }
    }

    /// Adds what came of the structure at this place.
    pub fn add(&mut self, structure: usize, motion: &Motion, record: &Record, response: &Response) {
        self.any_rocks |= response.outcome != Outcome::NoRocking;
        self.largest_pga_m_s2 = self.largest_pga_m_s2.max(record.peak_m_s2());
        if response.outcome == Outcome::Overturning {
            self.merge(structure, 1, std::iter::once_with(|| motion.motion_id.to_string()));
        }
    }

    pub fn append(&mut self, more: Overturned) {
        self.any_rocks |= more.any_rocks;
        self.largest_pga_m_s2 = self.largest_pga_m_s2.max(more.largest_pga_m_s2);
        for (structure, Of { count, motions }) in more.each.into_iter().enumerate() {
            self.merge(structure, count, motions);
        }
    }

    /// Asks for the unit where nothing rocks and the motions are as weak as if they were in g.
    pub fn question(&self) -> Option<String> {
        let weak = !self.any_rocks && self.largest_pga_m_s2 > 0.0;
        weak.then(|| in_g("motion", "acceleration_m_s2", self.largest_pga_m_s2)).flatten()
    }

    fn merge(&mut self, structure: usize, count: u64, motions: impl IntoIterator<Item = String>) {
        let of = &mut self.each[structure];
        of.count += count;
        let space = MOST_MOTIONS as usize - of.motions.len();
        of.motions.extend(motions.into_iter().take(space));
    }

    /// In words, of so many motions.
    pub fn words(&self, structures: &[Structure], total: u64) -> String {
        let each = |(structure, Of { count, motions }): (&Structure, &Of)| {
            let which = match total <= MOST_MOTIONS && *count > 0 {
                true => format!(" ({})", motions.join(", ")),
                false => String::new(),
            };
            format!("{} by {count}{which}", structure.name)
        };
        let told: Vec<String> = structures.iter().zip(&self.each).take(MOST_STRUCTURES).map(each).collect();
        format!("overturned, of {total} motions: {}", listed(&told, structures.len()))
    }
}
