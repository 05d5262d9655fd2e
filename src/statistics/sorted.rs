//! Numbers in order, however many there are: those of some ranks without sorting, pairs sorted in runs, which are then merged.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::sync::Arc;

use super::columns::{Columns, Scratch};

/// Pairs that are sorted at once: 2 MiB.
const RUN: usize = 1 << 17;
/// Pairs of a run that are read at once: there may be many runs.
const READ: usize = 512;
/// Bits of a number that a pass of [`at_ranks`] finds.
const DIGIT: u32 = 11;

/// The numbers of a column that have these ranks among all, 0 the least: bit by bit, from how many begin alike.
pub fn at_ranks(columns: &Columns, place: usize, ranks: &[usize]) -> Vec<f64> {
    // The first bits of each, and its rank among the numbers that begin so.
    let mut found: Vec<(u64, usize)> = ranks.iter().map(|&rank| (0, rank)).collect();
    for shift in (0..u64::BITS.next_multiple_of(DIGIT)).step_by(DIGIT as usize).rev() {
        let mut counts: BTreeMap<u64, Vec<usize>> =
            found.iter().map(|(first, _)| (*first, vec![0; 1 << DIGIT])).collect();
        let keys =
            |_: usize, columns: &[&[f64]]| columns[place].iter().map(|key| order(*key)).collect::<Vec<u64>>();
        columns.each(place + 1, keys, |keys| {
            for key in keys {
                if let Some(counts) = counts.get_mut(&key.unbounded_shr(shift + DIGIT)) {
                    counts[(key >> shift) as usize % (1 << DIGIT)] += 1;
                }
            }
        });
        for (first, rank) in &mut found {
            let (counts, mut digit) = (&counts[first], 0);
            while *rank >= counts[digit] {
                *rank -= counts[digit];
                digit += 1;
            }
            *first = *first << DIGIT | digit as u64;
        }
    }
    found.into_iter().map(|(bits, _)| number(bits)).collect()
}

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
        let mut run = Columns::in_blocks(READ, 2, &self.scratch);
        self.open.drain(..).for_each(|(key, value)| run.push(&[key, value]));
        self.runs.push(run);
    }

    /// All of them in order.
    pub fn sorted(mut self) -> impl Iterator<Item = (f64, f64)> {
        self.close();
        let mut runs: Vec<Run> = self.runs.into_iter().map(Run::new).collect();
        let mut heads: BinaryHeap<Reverse<(u64, usize)>> =
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
fn order(key: f64) -> u64 {
    folded(key.to_bits()) ^ SIGN
}

/// The number of this order.
fn number(order: u64) -> f64 {
    f64::from_bits(folded(order ^ SIGN))
}

const SIGN: u64 = 1 << 63;

/// Negative numbers with their other bits the other way round; twice is none.
fn folded(bits: u64) -> u64 {
    if bits & SIGN == 0 { bits } else { bits ^ !SIGN }
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
