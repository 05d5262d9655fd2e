//! Least squares in many resamples at once.

use pulp::NullaryFnOnce;

use super::bootstrap::TOGETHER;
use crate::statistics::design::{triangle_count, triangle_place};
use crate::wide::widest;

/// A pivot smaller than this beside its diagonal is nothing but rounding.
const ROUNDING: f64 = 1e-12;

/// The lower triangle, row by row, of the sums of products of (1, x1, x2 ..., y) in each resample.
#[derive(Debug, Clone, PartialEq)]
pub struct NormalEquations {
    /// The sums; the first is how many cases there are.
    pub products: Vec<[f64; TOGETHER]>,
}

/// What follows from them, NaN where they do not determine it.
#[derive(Debug, Clone, PartialEq)]
pub struct LeastSquares {
    /// Intercept first.
    pub coefficients: Vec<[f64; TOGETHER]>,
    /// Residual sum of squares.
    pub rss: [f64; TOGETHER],
}

impl NormalEquations {
    /// Of no cases, with so many coefficients.
    pub fn empty(coefficients: usize) -> NormalEquations {
        NormalEquations { products: vec![[0.0; TOGETHER]; triangle_count(coefficients + 1)] }
    }

    /// Adds those of further cases.
    pub fn add(&mut self, other: &NormalEquations) {
        for (sum, other) in self.products.iter_mut().flatten().zip(other.products.iter().flatten()) {
            *sum += other;
        }
    }

    /// Takes over those of one resample.
    pub fn copy(&mut self, other: &NormalEquations, resample: usize) {
        for (product, other) in self.products.iter_mut().zip(&other.products) {
            product[resample] = other[resample];
        }
    }

    /// The residual sums of squares alone, by symmetric elimination.
    pub fn rss(&self, coefficients: usize) -> [f64; TOGETHER] {
        self.eliminated(coefficients)[triangle_place(coefficients, coefficients)]
    }

    /// Coefficients and residuals.
    pub fn solve(&self, coefficients: usize) -> LeastSquares {
        let k = coefficients;
        let triangle = self.eliminated(k);
        let mut b = vec![[0.0; TOGETHER]; k];
        for p in (0..k).rev() {
            for resample in 0..TOGETHER {
                let later = (p + 1..k)
                    .map(|q| triangle[triangle_place(q, p)][resample] * b[q][resample])
                    .sum::<f64>();
                b[p][resample] = (triangle[triangle_place(k, p)][resample] - later)
                    / triangle[triangle_place(p, p)][resample];
            }
        }
        LeastSquares { coefficients: b, rss: triangle[triangle_place(k, k)] }
    }

    fn eliminated(&self, k: usize) -> Vec<[f64; TOGETHER]> {
        widest(Elimination { triangle: self.products.clone(), coefficients: k })
    }
}

/// Symmetric elimination of all rows but the last.
struct Elimination {
    triangle: Vec<[f64; TOGETHER]>,
    coefficients: usize,
}

impl NullaryFnOnce for Elimination {
    type Output = Vec<[f64; TOGETHER]>;

    #[inline(always)]
    fn call(self) -> Vec<[f64; TOGETHER]> {
        let Elimination { mut triangle, coefficients: k } = self;
        let diagonals: Vec<[f64; TOGETHER]> = (0..k).map(|p| triangle[triangle_place(p, p)]).collect();
        for (p, diagonal) in diagonals.iter().enumerate() {
            for (pivot, diagonal) in triangle[triangle_place(p, p)].iter_mut().zip(diagonal) {
                if *pivot <= ROUNDING * diagonal {
                    *pivot = f64::NAN;
                }
            }
            for i in p + 1..=k {
                let [pivot, row] = [(p, p), (i, p)].map(|(i, j)| triangle[triangle_place(i, j)]);
                let share: [f64; TOGETHER] = std::array::from_fn(|resample| row[resample] / pivot[resample]);
                for j in p + 1..=i {
                    let [column, here] = [(j, p), (i, j)].map(|(i, j)| triangle[triangle_place(i, j)]);
                    triangle[triangle_place(i, j)] =
                        std::array::from_fn(|resample| here[resample] - share[resample] * column[resample]);
                }
            }
        }
        triangle
    }
}
