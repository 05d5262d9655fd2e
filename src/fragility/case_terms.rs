//! Sums over cases for many resamples at once: a matrix of counts times one of terms.

use std::ops::Range;

use pulp::NullaryFnOnce;

use super::bootstrap::{Resamples, TOGETHER};
use crate::wide::widest;

/// Terms that are summed together: as many sums as stay in registers.
const BLOCK: usize = 8;

/// The terms of each case, to be summed over the cases of resamples.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseTerms {
    /// Which of all rows the cases are.
    rows: Vec<usize>,
    /// How many terms a case has.
    terms: usize,
    /// Some terms of each case, filled up with zeros.
    blocks: Vec<Vec<[f64; BLOCK]>>,
}

impl CaseTerms {
    /// Of the cases in these rows, of which `of_cases` gives `terms` terms one after the other.
    pub fn new(rows: &[usize], terms: usize, of_cases: impl Iterator<Item = Vec<f64>>) -> CaseTerms {
        let mut blocks = vec![Vec::with_capacity(rows.len()); terms.div_ceil(BLOCK)];
        for of_case in of_cases {
            for (block, of_case) in blocks.iter_mut().zip(of_case.chunks(BLOCK)) {
                block.push(std::array::from_fn(|k| of_case.get(k).copied().unwrap_or(0.0)));
            }
        }
        CaseTerms { rows: rows.to_vec(), terms, blocks }
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.rows.len()
    }

    /// The sum of each term in each resample.
    pub fn sums(&self, resamples: &Resamples) -> Vec<[f64; TOGETHER]> {
        self.sums_of(0..self.rows.len(), resamples)
    }

    /// The same over some of the cases.
    pub fn sums_of(&self, cases: Range<usize>, resamples: &Resamples) -> Vec<[f64; TOGETHER]> {
        let rows = &self.rows[cases.clone()];
        let block = |block: &Vec<_>| widest(BlockSums { rows, terms: &block[cases.clone()], resamples });
        self.blocks.iter().flat_map(block).take(self.terms).collect()
    }
}

/// The sums of some terms.
struct BlockSums<'a> {
    rows: &'a [usize],
    terms: &'a [[f64; BLOCK]],
    resamples: &'a Resamples,
}

impl NullaryFnOnce for BlockSums<'_> {
    type Output = [[f64; TOGETHER]; BLOCK];

    #[inline(always)]
    fn call(self) -> Self::Output {
        let mut sums = [[0.0; TOGETHER]; BLOCK];
        for (&row, terms) in self.rows.iter().zip(self.terms) {
            let counts = &self.resamples.counts[row];
            for (sum, term) in sums.iter_mut().zip(terms) {
                *sum = std::array::from_fn(|resample| sum[resample] + term * counts[resample]);
            }
        }
        sums
    }
}
