//! How many motions overturn each structure, and which, where they are few.

use crate::rocking::{Outcome, Response, Structure};
use crate::stages::shared::reasons::listed;
use crate::table::motions::Motion;

/// Motions of a file that are named.
const MOST_MOTIONS: u64 = 20;
/// Structures that are told one by one.
const MOST_STRUCTURES: usize = 8;

/// The motions that overturn each structure, in the order of these.
#[derive(Default)]
pub struct Overturned(Vec<Of>);

#[derive(Default, Clone)]
struct Of {
    count: u64,
    /// Of the first few.
    motions: Vec<String>,
}

impl Overturned {
    pub fn new(structures: &[Structure]) -> Overturned {
        Overturned(vec![Of::default(); structures.len()])
    }

    /// Adds what came of the structure at this place.
    pub fn add(&mut self, structure: usize, motion: &Motion, response: &Response) {
        if response.outcome == Outcome::Overturning {
            self.merge(structure, 1, std::iter::once_with(|| motion.motion_id.to_string()));
        }
    }

    pub fn append(&mut self, more: Overturned) {
        for (structure, Of { count, motions }) in more.0.into_iter().enumerate() {
            self.merge(structure, count, motions);
        }
    }

    fn merge(&mut self, structure: usize, count: u64, motions: impl IntoIterator<Item = String>) {
        let of = &mut self.0[structure];
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
        let told: Vec<String> = structures.iter().zip(&self.0).take(MOST_STRUCTURES).map(each).collect();
        format!("overturned, of {total} motions: {}", listed(&told, structures.len()))
    }
}
