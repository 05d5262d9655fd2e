//! Derivatives of a sum over cases with respect to the coefficients, from those with respect to the index of each case.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use pulp::NullaryFnOnce;

use super::design::{Design, Rows, triangle_count, triangle_place};
use super::newton::Objective;
use crate::wide::widest;

/// Cases that are worked on together, so that they stay in the nearest cache.
pub const NEAR: usize = 256;
/// Partial sums, as many as the widest register has numbers: the same on any processor, and so the sums.
const PARTS: usize = 8;

/// The scores of some cases.
pub struct Scores<'a> {
    /// First derivatives.
    pub slope: &'a mut [f64],
    /// The negative of the second ones.
    pub curvature: &'a mut [f64],
}

impl Scores<'_> {
    /// The same, to be used again afterwards.
    #[inline(always)]
    pub fn reborrow(&mut self) -> Scores<'_> {
        Scores { slope: self.slope, curvature: self.curvature }
    }

    /// Each slope and curvature.
    #[inline(always)]
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (&mut f64, &mut f64)> {
        self.slope.iter_mut().zip(self.curvature.iter_mut())
    }
}

/// First derivatives and the negative second ones of a case with respect to its index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    pub slope: f64,
    /// The negative of the second.
    pub curvature: f64,
}

/// The derivatives with respect to the coefficients, without the value. `score` is given a block of rows, the place of some
/// neighbouring ones in it, and [`Scores`] with their indices b0 + b1 x1 + ... for slopes, to be replaced; what it calls must be inlined
/// to be fast.
pub fn derivatives(
    design: &Design,
    coefficients: &[f64],
    score: impl Fn(&Rows, Range<usize>, Scores) + Sync,
) -> Objective {
    let of_block = |rows: &Rows| widest(Pass { rows, coefficients, score: &score });
    design.fold(0, of_block, |sum, part| {
        sum.gradient += part.gradient;
        sum.information += part.information;
    })
}

/// The sum of a value of each case. `value` is given a block of rows, the place of some neighbouring ones in it, and their indices
/// b0 + b1 x1 + ..., to be replaced by their values; what it calls must be inlined to be fast.
pub fn sum(
    design: &Design,
    coefficients: &[f64],
    value: impl Fn(&Rows, Range<usize>, &mut [f64]) + Sync,
) -> f64 {
    let of_block = |rows: &Rows| widest(Sum { rows, coefficients, value: &value });
    design.fold(0, of_block, |sum, part| *sum += part)
}

/// A pass over a block for the values of its cases.
struct Sum<'a, F> {
    rows: &'a Rows<'a>,
    coefficients: &'a [f64],
    value: &'a F,
}

impl<F: Fn(&Rows, Range<usize>, &mut [f64])> NullaryFnOnce for Sum<'_, F> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let (mut sums, mut values) = ([0.0; PARTS], [0.0; NEAR]);
        for from in (0..self.rows.count()).step_by(NEAR) {
            let cases = from..self.rows.count().min(from + NEAR);
            let values = &mut values[..cases.len()];
            indices(self.rows, self.coefficients, cases.clone(), values);
            (self.value)(self.rows, cases, values);
            let (whole, rest) = values.as_chunks::<PARTS>();
            for values in whole {
                sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
            }
            sums.iter_mut().zip(rest).for_each(|(sum, value)| *sum += value);
        }
        sums.iter().sum()
    }
}

/// A pass over a block.
struct Pass<'a, F> {
    rows: &'a Rows<'a>,
    coefficients: &'a [f64],
    score: &'a F,
}

impl<F: Fn(&Rows, Range<usize>, Scores)> NullaryFnOnce for Pass<'_, F> {
    type Output = Objective;

    #[inline(always)]
    fn call(self) -> Objective {
        let columns = &self.rows.x;
        let k = columns.len();
        let (mut gradient, mut information) = (vec![[0.0; PARTS]; k], vec![[0.0; PARTS]; triangle_count(k)]);
        let (mut slope, mut curvature) = ([0.0; NEAR], [0.0; NEAR]);
        for from in (0..self.rows.count()).step_by(NEAR) {
            let to = self.rows.count().min(from + NEAR);
            let (slope, curvature) = (&mut slope[..to - from], &mut curvature[..to - from]);
            indices(self.rows, self.coefficients, from..to, slope);
            (self.score)(self.rows, from..to, Scores { slope, curvature });
            for i in 0..k {
                let x = &columns[i][from..to];
                add_products(&mut gradient[i], slope, x, &columns[0][from..to]);
                for j in 0..=i {
                    add_products(&mut information[triangle_place(i, j)], curvature, x, &columns[j][from..to]);
                }
            }
        }
        let total = |sums: &[f64; PARTS]| sums.iter().sum::<f64>();
        Objective {
            value: 0.0,
            gradient: DVector::from_iterator(k, gradient.iter().map(total)),
            information: DMatrix::from_fn(k, k, |i, j| total(&information[triangle_place(i, j)])),
        }
    }
}

/// b0 + b1 x1 + ... of some cases.
#[inline(always)]
fn indices(rows: &Rows, coefficients: &[f64], cases: Range<usize>, indices: &mut [f64]) {
    indices.fill(0.0);
    for (column, &b) in rows.x.iter().zip(coefficients) {
        indices.iter_mut().zip(&column[cases.clone()]).for_each(|(index, x)| *index = b.mul_add(*x, *index));
    }
}

/// Adds a b c of number 0, 8, 16 ... to the first sum, of 1, 9, 17 ... to the second and so on.
#[inline(always)]
fn add_products(sums: &mut [f64; PARTS], a: &[f64], b: &[f64], c: &[f64]) {
    let ((a, rest_a), (b, rest_b)) = (a.as_chunks::<PARTS>(), b.as_chunks::<PARTS>());
    let (c, rest_c) = c.as_chunks::<PARTS>();
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        for part in 0..PARTS {
            sums[part] = (a[part] * b[part]).mul_add(c[part], sums[part]);
        }
    }
    for (part, sum) in sums.iter_mut().enumerate().take(rest_a.len()) {
        *sum = (rest_a[part] * rest_b[part]).mul_add(rest_c[part], *sum);
    }
}
