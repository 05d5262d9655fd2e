//! Which responses may depend on each other.

use std::collections::HashMap;

use crate::keyword::keywords;

/// What the responses of a cluster share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharedBy {
    Earthquake,
    /// Magnitude and distance.
    Cell,
    /// Nothing: each response is a cluster of its own.
    Nothing,
}

keywords!(SharedBy { Earthquake = "earthquake", Cell = "cell", Nothing = "nothing" });

/// The numbers of clusters and of cells, given to responses as they come.
#[derive(Debug, Default)]
pub struct Clusters {
    earthquakes: HashMap<String, usize>,
    /// By the bits of magnitude and distance: these are positive, so that their bits are in the order of their values.
    cells: HashMap<(u64, u64), usize>,
    cells_of_bootstrap: HashMap<(Option<u64>, Option<u64>), usize>,
}

/// Where the numbers of clusters begin that consist of one motion.
const OF_MOTIONS: usize = 1 << 48;

impl Clusters {
    /// The number of the cluster of a response to a motion of this name: by the earthquake where it is known, or else by magnitude and
    /// distance. Of neither, by the hash of the name: an order that means nothing.
    pub fn cluster(
        &mut self,
        earthquake: Option<&str>,
        mw: Option<f64>,
        re_km: Option<f64>,
        name: impl FnOnce() -> String,
    ) -> usize {
        let next = self.earthquakes.len() + self.cells.len();
        match (earthquake, mw, re_km) {
            (Some(earthquake), _, _) => match self.earthquakes.get(earthquake) {
                Some(&known) => known,
                None => *self.earthquakes.entry(earthquake.to_string()).or_insert(next),
            },
            (None, Some(mw), Some(re_km)) => {
                *self.cells.entry((mw.to_bits(), re_km.to_bits())).or_insert(next)
            }
            _ => {
                let [a, b, c, d, e, f, ..] = *blake3::hash(name().as_bytes()).as_bytes();
                OF_MOTIONS + u64::from_be_bytes([0, 0, a, b, c, d, e, f]) as usize
            }
        }
    }

    /// The number of the cell of magnitude and distance, in the order in which they first appear; responses that have neither are in
    /// one cell.
    pub fn cell(&mut self, mw: Option<f64>, re_km: Option<f64>) -> usize {
        let next = self.cells_of_bootstrap.len();
        *self.cells_of_bootstrap.entry((mw.map(f64::to_bits), re_km.map(f64::to_bits))).or_insert(next)
    }

    /// By the number of a cluster of several motions one that does not depend on the order in which they came.
    pub fn in_order(&self) -> Vec<usize> {
        let mut earthquakes: Vec<(&String, usize)> = self.earthquakes.iter().map(|(k, &n)| (k, n)).collect();
        let mut cells: Vec<(&(u64, u64), usize)> = self.cells.iter().map(|(k, &n)| (k, n)).collect();
        earthquakes.sort();
        cells.sort();
        let given = earthquakes.into_iter().map(|(_, n)| n).chain(cells.into_iter().map(|(_, n)| n));
        let mut numbers = vec![0; self.earthquakes.len() + self.cells.len()];
        given.enumerate().for_each(|(number, given)| numbers[given] = number);
        numbers
    }

    /// What those of a cluster share.
    pub fn shared(&self) -> SharedBy {
        match (self.earthquakes.is_empty(), self.cells.is_empty()) {
            (false, _) => SharedBy::Earthquake,
            (true, false) => SharedBy::Cell,
            (true, true) => SharedBy::Nothing,
        }
    }
}
