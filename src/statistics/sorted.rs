//! Pairs of numbers in the order of the first, however many there are: sorted in runs, which are then merged.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::sync::Arc;

use super::columns::{BLOCK, Columns, Scratch};

/// Pairs that are sorted at once: 2 MiB.
const RUN: usize = 16 * BLOCK;

/// Pairs to be sorted by the first number; those with the same one stay in order.
#[derive(Default)]
pub struct Sorter {
    open: Vec<(f64, f64)>,
    runs: Vec<Columns>,
    scratch: Arc<Scratch>,
}

impl Sorter {
    /// Adds a pair.
    pub fn push(&mut self, pair: (f64, f64)) {
        self.open.push(pair);
        if self.open.len() == RUN {
            self.close();
        }
    }

    fn close(&mut self) {
        self.open.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut run = Columns::new(2, &self.scratch);
        self.open.drain(..).for_each(|(key, value)| run.push(&[key, value]));
        self.runs.push(run);
    }

    /// All of them in order.
    pub fn sorted(mut self) -> impl Iterator<Item = (f64, f64)> {
        self.close();
        let mut runs: Vec<Run> = self.runs.into_iter().map(Run::new).collect();
        let mut heads: BinaryHeap<Reverse<(i64, usize)>> =
            (0..runs.len()).filter_map(|k| Some(Reverse((order(runs[k].head()?), k)))).collect();
        std::iter::from_fn(move || {
            let mut least = heads.peek_mut()?;
            let k = least.0.1;
            let next = runs[k].next();
            match runs[k].head() {
                Some(head) => *least = Reverse((order(head), k)),
                None => drop(std::collections::binary_heap::PeekMut::pop(least)),
            }
            next
        })
    }
}

/// An integer that is in the order of the number.
fn order(key: f64) -> i64 {
    let bits = key.to_bits() as i64;
    bits ^ (((bits >> 63) as u64) >> 1) as i64
}

/// A run that is read from its start.
struct Run {
    columns: Columns,
    block: usize,
    pairs: std::vec::IntoIter<(f64, f64)>,
}

impl Run {
    fn new(columns: Columns) -> Run {
        let mut run = Run { columns, block: 0, pairs: Vec::new().into_iter() };
        run.read();
        run
    }

    fn read(&mut self) {
        if self.pairs.len() == 0 && self.block < self.columns.blocks() {
            let pairs = self.columns.with_block(self.block, 2, |_, columns| {
                columns[0].iter().copied().zip(columns[1].iter().copied()).collect::<Vec<_>>()
            });
            (self.block, self.pairs) = (self.block + 1, pairs.into_iter());
        }
    }

    fn head(&self) -> Option<f64> {
        self.pairs.as_slice().first().map(|(key, _)| *key)
    }

    fn next(&mut self) -> Option<(f64, f64)> {
        let next = self.pairs.next();
        self.read();
        next
    }
}
