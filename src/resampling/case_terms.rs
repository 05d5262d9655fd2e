//! Sums over cases for many resamples at once: a matrix of counts times one of terms.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::bootstrap::{Resamples, TOGETHER};
use crate::wide::widest_registers;

/// How many terms are summed together: at most as many as sums stay in registers. A line or plane has 6 or 10; most
/// polynomials have multiples of the last.
const WIDTHS: [usize; 3] = [6, 10, 14];
/// Cases whose counts stay in the nearest cache.
const NEAR: usize = 256;

/// The terms of each case, to be summed over the cases of resamples.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseTerms {
    /// Which of all rows the cases are.
    rows: Vec<usize>,
    /// How many terms a case has.
    terms: usize,
    blocks: Vec<Block>,
}

/// Some terms of each case.
#[derive(Debug, Clone, PartialEq)]
struct Block {
    /// How many, one of [`WIDTHS`].
    width: usize,
    /// Those of the first case, of the second and so on, filled up with zeros.
    terms: Vec<f64>,
}

impl CaseTerms {
    /// Of the cases in these rows, of which `of_cases` gives `terms` terms one after the other.
    pub fn new(rows: &[usize], terms: usize, of_cases: impl Iterator<Item = Vec<f64>>) -> CaseTerms {
        let [.., widest] = WIDTHS;
        let block = |first: usize| {
            let width = WIDTHS.into_iter().find(|&width| first + width >= terms).unwrap_or(widest);
            Block { width, terms: Vec::with_capacity(rows.len() * width) }
        };
        let mut blocks: Vec<Block> = (0..terms).step_by(widest).map(block).collect();
        for of_case in of_cases {
            for (block, of_case) in blocks.iter_mut().zip(of_case.chunks(widest)) {
                let filled = block.terms.len() + block.width;
                block.terms.extend(of_case);
                block.terms.resize(filled, 0.0);
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
        let mut sums = widest_registers(Sums { of: self, cases, resamples });
        sums.truncate(self.terms);
        sums
    }
}

/// The sums over some cases, with those of the zeros that fill up.
struct Sums<'a> {
    of: &'a CaseTerms,
    cases: Range<usize>,
    resamples: &'a Resamples,
}

impl WithSimd for Sums<'_> {
    type Output = Vec<[f64; TOGETHER]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let blocks = &self.of.blocks;
        let mut sums = vec![[0.0; TOGETHER]; blocks.iter().map(|block| block.width).sum()];
        for from in self.cases.clone().step_by(NEAR) {
            let near = from..self.cases.end.min(from + NEAR);
            let mut left = &mut sums[..];
            for Block { width, terms } in blocks {
                let (sums, others) = left.split_at_mut(*width);
                match width {
                    6 => self.add::<S, 6>(simd, sums, &near, terms),
                    10 => self.add::<S, 10>(simd, sums, &near, terms),
                    _ => self.add::<S, 14>(simd, sums, &near, terms),
                }
                left = others;
            }
        }
        sums
    }
}

impl Sums<'_> {
    /// Adds some terms of some cases, in as many resamples at once as a register holds.
    #[inline(always)]
    fn add<S: Simd, const WIDTH: usize>(
        &self,
        simd: S,
        sums: &mut [[f64; TOGETHER]],
        cases: &Range<usize>,
        terms: &[f64],
    ) {
        let (terms, rows) = (&terms.as_chunks::<WIDTH>().0[cases.clone()], &self.of.rows[cases.clone()]);
        for register in 0..TOGETHER / S::F64_LANES {
            let mut totals: [S::f64s; WIDTH] =
                std::array::from_fn(|term| S::as_simd_f64s(&sums[term]).0[register]);
            for (&row, terms) in rows.iter().zip(terms) {
                let counts = S::as_simd_f64s(&self.resamples.counts[row]).0[register];
                for (total, &term) in totals.iter_mut().zip(terms) {
                    *total = simd.mul_add_f64s(simd.splat_f64s(term), counts, *total);
                }
            }
            for (sums, total) in sums.iter_mut().zip(totals) {
                S::as_mut_simd_f64s(sums).0[register] = total;
            }
        }
    }
}
