//! Sums over cases for many resamples at once: a matrix of counts times one of terms.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::bootstrap::{Resamples, TOGETHER};
use crate::wide::widest_registers;

/// Terms that are summed together: as many sums as stay in registers, and a divisor of the numbers of terms up to the sixth
/// degree (28, 84, 210).
const BLOCK: usize = 14;
/// Cases whose counts stay in the nearest cache.
const NEAR: usize = 256;

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
        let CaseTerms { rows, blocks, .. } = self.of;
        let mut sums = vec![[[0.0; TOGETHER]; BLOCK]; blocks.len()];
        for from in self.cases.clone().step_by(NEAR) {
            let near = from..self.cases.end.min(from + NEAR);
            for (sums, terms) in sums.iter_mut().zip(blocks) {
                for register in 0..TOGETHER / S::F64_LANES {
                    self.add(simd, sums, register, &rows[near.clone()], &terms[near.clone()]);
                }
            }
        }
        sums.into_flattened()
    }
}

impl Sums<'_> {
    /// Adds some terms of some cases in as many resamples as a register holds.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        simd: S,
        sums: &mut [[f64; TOGETHER]; BLOCK],
        register: usize,
        rows: &[usize],
        terms: &[[f64; BLOCK]],
    ) {
        let mut total: [S::f64s; BLOCK] =
            std::array::from_fn(|term| S::as_simd_f64s(&sums[term]).0[register]);
        for (&row, terms) in rows.iter().zip(terms) {
            let counts = S::as_simd_f64s(&self.resamples.counts[row]).0[register];
            for (total, &term) in total.iter_mut().zip(terms) {
                *total = simd.mul_add_f64s(simd.splat_f64s(term), counts, *total);
            }
        }
        for (sums, total) in sums.iter_mut().zip(total) {
            S::as_mut_simd_f64s(sums).0[register] = total;
        }
    }
}
