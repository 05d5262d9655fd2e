//! The columns of a regression: the design matrix, whether its predictors can be told apart, and splines that bend a line.

use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use pulp::NullaryFnOnce;

use crate::statistics::columns::Columns;
use crate::statistics::sorted::at_ranks;
use crate::wide::{widest, widest_on};

/// Predictors that follow from those in the columns, block by block.
pub type Further<'a> = &'a (dyn Fn(&[&[f64]]) -> Vec<Vec<f64>> + Sync);

/// The design of a regression: an intercept, the predictors in the first columns, and others that follow from them. After the
/// predictors comes what was observed, then labels.
#[derive(Clone, Copy)]
pub struct Design<'a> {
    columns: &'a Columns,
    predictors: usize,
    further: Option<(usize, Further<'a>)>,
}

/// Some rows of a design.
pub struct Rows<'a> {
    /// The number of the first one.
    pub first: usize,
    /// Ones for the intercept, then each predictor.
    pub x: Vec<&'a [f64]>,
    /// What was observed.
    pub y: &'a [f64],
    /// As many columns of labels as were asked for.
    pub labels: &'a [&'a [f64]],
}

impl Rows<'_> {
    /// How many.
    pub fn count(&self) -> usize {
        self.y.len()
    }

    /// The predictors of each row, the one of the intercept first.
    pub fn each(&self) -> impl Iterator<Item = DVector<f64>> {
        (0..self.count()).map(|row| DVector::from_fn(self.x.len(), |k, _| self.x[k][row]))
    }

    /// b0 + b1 x1 + ... of each.
    pub fn indices(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut indices = vec![0.0; self.count()];
        for (column, b) in self.x.iter().zip(coefficients) {
            indices.iter_mut().zip(*column).for_each(|(index, x)| *index += b * x);
        }
        indices
    }
}

impl<'a> Design<'a> {
    /// Of the first `predictors` columns.
    pub fn new(columns: &'a Columns, predictors: usize) -> Design<'a> {
        Design { columns, predictors, further: None }
    }

    /// With so many predictors more.
    pub fn with(self, count: usize, further: Further<'a>) -> Design<'a> {
        Design { further: Some((count, further)), ..self }
    }

    /// The same of other rows.
    pub fn of<'b>(&self, columns: &'b Columns) -> Design<'b>
    where
        'a: 'b,
    {
        Design { columns, predictors: self.predictors, further: self.further }
    }

    /// Some rows from all over, where there are many: those of a search that ends in all of them.
    pub fn spread(&self) -> Option<Columns> {
        self.columns.spread()
    }

    /// Whether there are so many rows that passes over them take time.
    pub fn is_many(&self) -> bool {
        self.columns.is_many()
    }

    /// How many rows there are.
    pub fn cases(&self) -> usize {
        self.columns.rows()
    }

    /// How many coefficients, with the intercept.
    pub fn coefficients(&self) -> usize {
        1 + self.predictors + self.further.map_or(0, |(count, _)| count)
    }

    /// Calls `take` with what `work` makes of each block of rows with so many columns of labels, in order.
    pub fn each<S: Send>(&self, labels: usize, work: impl Fn(&Rows) -> S + Sync, take: impl FnMut(S)) {
        let of_block = |first: usize, columns: &[&[f64]]| self.with_rows(first, columns, &work);
        self.columns.each(self.predictors + 1 + labels, of_block, take);
    }

    /// What `work` makes of all of them, joined in order by `add`.
    pub fn fold<S: Send>(
        &self,
        labels: usize,
        work: impl Fn(&Rows) -> S + Sync,
        add: impl FnMut(&mut S, S),
    ) -> S {
        let of_block = |first: usize, columns: &[&[f64]]| self.with_rows(first, columns, &work);
        self.columns.fold(self.predictors + 1 + labels, of_block, add)
    }

    fn with_rows<S>(&self, first: usize, columns: &[&[f64]], work: impl Fn(&Rows) -> S) -> S {
        let (predictors, others) = columns.split_at(self.predictors);
        let (y, labels) = (others[0], &others[1..]);
        let ones = vec![1.0; y.len()];
        let further = self.further.map_or(Vec::new(), |(_, of)| of(predictors));
        let x = std::iter::once(&ones[..]).chain(predictors.iter().copied());
        work(&Rows { first, x: x.chain(further.iter().map(Vec::as_slice)).collect(), y, labels })
    }

    /// b0 + b1 x1 + ... of each case.
    pub fn indices(&self, coefficients: &[f64]) -> Vec<f64> {
        self.fold(0, |rows| rows.indices(coefficients), |all, part| all.extend(part))
    }

    /// The different numbers that cases have as a label.
    pub fn distinct(&self, label: usize) -> BTreeSet<usize> {
        let of_block =
            |rows: &Rows| rows.labels[label].iter().map(|number| *number as usize).collect::<BTreeSet<_>>();
        self.fold(label + 1, of_block, |all, part| all.extend(part))
    }

    /// The least and the largest value of a predictor.
    pub fn range(&self, predictor: usize) -> [f64; 2] {
        self.fold(0, |rows| range(rows.x[1 + predictor]), widen)
    }
}

/// The least and the largest value.
pub fn range(values: &[f64]) -> [f64; 2] {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    [least, values.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
}

/// Makes a range hold another one.
pub fn widen(range: &mut [f64; 2], other: [f64; 2]) {
    *range = [range[0].min(other[0]), range[1].max(other[1])];
}

/// The columns of slices and of what was observed, in memory.
pub fn columns_of(predictors: &[&[f64]], observed: Vec<f64>) -> Columns {
    let mut columns = Columns::new(predictors.len() + 1, &Arc::default());
    let predictors = predictors.iter().map(|values| values[..observed.len()].to_vec());
    columns.append(&predictors.chain([observed.clone()]).collect::<Vec<_>>());
    columns
}

/// Means and ranges of predictors and of what was observed, and the sums of products of their deviations from the means.
pub struct Moments {
    /// Of each predictor, then of what was observed.
    pub means: Vec<f64>,
    ranges: Vec<[f64; 2]>,
    /// The lower triangle, row by row.
    products: Vec<f64>,
}

impl Moments {
    /// In two passes.
    pub fn of(design: &Design) -> Moments {
        let all = |rows: &Rows| -> Vec<Vec<f64>> {
            rows.x[1..].iter().chain([&rows.y]).map(|values| values.to_vec()).collect()
        };
        let of_block = |rows: &Rows| -> Vec<(f64, [f64; 2])> {
            all(rows).iter().map(|values| (values.iter().sum(), range(values))).collect()
        };
        let sums = design.fold(0, of_block, |all, part| {
            for ((sum, range), (other, wider)) in all.iter_mut().zip(part) {
                *sum += other;
                widen(range, wider);
            }
        });
        let (sums, ranges): (Vec<f64>, Vec<[f64; 2]>) = sums.into_iter().unzip();
        let n = design.cases();
        let means: Vec<f64> = sums.iter().map(|sum| sum / n as f64).collect();
        let of_block = |rows: &Rows| -> Vec<f64> {
            let mut centred = all(rows);
            for (values, mean) in centred.iter_mut().zip(&means) {
                values.iter_mut().for_each(|value| *value -= mean);
            }
            widest(Products { columns: &centred })
        };
        let add = |sums: &mut Vec<f64>, part: Vec<f64>| sums.iter_mut().zip(part).for_each(|(a, b)| *a += b);
        let products = design.fold(0, of_block, add);
        Moments { means, ranges, products }
    }

    /// The sum of products of two of them.
    pub fn product(&self, i: usize, j: usize) -> f64 {
        self.products[triangle_place(i, j)]
    }

    /// Whether all values are the same, but for rounding.
    pub fn is_constant(&self, of: usize) -> bool {
        is_constant(self.ranges[of])
    }

    /// How the predictors depend on the intercept or on each other; none if they do not.
    pub fn dependence(&self) -> Option<Dependence> {
        let k = self.means.len() - 1;
        let mut left = DMatrix::from_fn(k, k, |i, j| self.product(i, j));
        for pivot in 0..k {
            if self.is_constant(pivot) {
                return Some(Dependence::Constant);
            }
            let at = left[(pivot, pivot)];
            if at <= LEAST_SHARE * LEAST_SHARE * self.product(pivot, pivot) {
                return Some(Dependence::Collinear);
            }
            for i in pivot + 1..k {
                let share = left[(i, pivot)] / at;
                for j in pivot + 1..k {
                    left[(i, j)] -= share * left[(pivot, j)];
                }
            }
        }
        None
    }
}

/// The sums of products of columns.
struct Products<'a> {
    columns: &'a [Vec<f64>],
}

impl NullaryFnOnce for Products<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn call(self) -> Vec<f64> {
        let mut products = Vec::with_capacity(triangle_count(self.columns.len()));
        for (i, a) in self.columns.iter().enumerate() {
            for b in &self.columns[..=i] {
                products.push(sum_of_products(a, b));
            }
        }
        products
    }
}

/// In as many parts as the widest register has numbers: the same on any processor.
#[inline(always)]
pub fn sum_of_products(a: &[f64], b: &[f64]) -> f64 {
    let ((a, rest_a), (b, rest_b)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for part in 0..8 {
            sums[part] = a[part].mul_add(b[part], sums[part]);
        }
    }
    sums.iter().sum::<f64>() + dot(rest_a, rest_b)
}

/// Where row `i` and column `j` of a symmetric matrix stand among the rows of its lower triangle, in either order.
#[inline(always)]
pub fn triangle_place(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

/// How many numbers the lower triangle of a matrix with so many rows has.
pub fn triangle_count(rows: usize) -> usize {
    triangle_place(rows, 0)
}

/// The sum of products of two vectors.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A predictor of which less than this share is left, once the intercept and the others have explained what they can, is
/// taken for a combination of them: its square is about the rounding of the normal equations.
const LEAST_SHARE: f64 = 1e-7;
/// Values that differ by less than this share of their size do not differ.
const ROUNDING: f64 = 1e-12;

/// How predictors fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dependence {
    /// One does not vary.
    Constant,
    /// One is a combination of others.
    Collinear,
}

/// Whether values in this range are all the same, but for rounding.
pub fn is_constant([low, high]: [f64; 2]) -> bool {
    high - low <= ROUNDING * low.abs().max(high.abs())
}

/// Shares of the values below each knot (Harrell 2015, Regression modeling strategies, Table 2.3).
const KNOTS: [f64; 4] = [0.05, 0.35, 0.65, 0.95];

/// Four knots of a natural cubic spline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spline([f64; 4]);

impl Spline {
    /// With knots at quantiles of the first predictor.
    pub fn of(design: &Design) -> Spline {
        Spline(quantiles(design, 0, KNOTS))
    }

    /// The columns that make a straight line in `values` a natural cubic spline with four knots: two (Hastie, Tibshirani &
    /// Friedman 2009, The elements of statistical learning, Eqs. 5.4 and 5.5).
    pub fn columns(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let column = |k: usize| {
            let mut column = values.to_vec();
            widest_on(
                &mut column,
                #[inline(always)]
                |column| {
                    for x in column {
                        *x = self.bend(k, *x);
                    }
                },
            );
            column
        };
        [0, 1].map(column).into()
    }

    #[inline(always)]
    fn bend(&self, k: usize, x: f64) -> f64 {
        let knots = &self.0;
        let scale = knots[3] - knots[0];
        let cube = |x: f64| (x / scale).max(0.0).powi(3);
        let d = |k: usize| (cube(x - knots[k]) - cube(x - knots[3])) * scale / (knots[3] - knots[k]);
        d(k) - d(2)
    }
}

/// The cubic functions that let a line in one value bend: cubic between the knots, linear outside of them, one less than there are
/// gaps between knots; none of fewer than three (Harrell 2015, Regression modeling strategies, section 2.4.5).
pub fn restricted_splines(u: f64, knots: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let ends = match *knots {
        [first, .., before, last] => Some((first, before, last)),
        _ => None,
    };
    ends.into_iter().flat_map(move |(first, before, last)| {
        let cube = move |knot: f64| (u - knot).max(0.0).powi(3);
        let width = (last - first) * (last - first);
        knots[..knots.len() - 2].iter().map(move |&knot| {
            let (a, b) = ((last - knot) / (last - before), (before - knot) / (last - before));
            (cube(knot) - a * cube(before) + b * cube(last)) / width
        })
    })
}

/// The values of a predictor with these shares of all below them.
fn quantiles<const N: usize>(design: &Design, predictor: usize, shares: [f64; N]) -> [f64; N] {
    let last = (design.cases() - 1) as f64;
    let places = shares.map(|share| share * last);
    let ranks: Vec<usize> =
        places.iter().flat_map(|place| [place.floor() as usize, place.ceil() as usize]).collect();
    let values = at_ranks(design.columns, predictor, &ranks);
    std::array::from_fn(|k| {
        let [below, above] = [values[2 * k], values[2 * k + 1]];
        below + (places[k] - places[k].floor()) * (above - below)
    })
}

/// Knots with these shares of the values of a predictor below them; none where two of them coincide.
pub fn quantile_knots<const N: usize>(
    design: &Design,
    predictor: usize,
    shares: [f64; N],
) -> Option<[f64; N]> {
    let knots = quantiles(design, predictor, shares);
    knots.windows(2).all(|pair| pair[1] - pair[0] > 1e-6).then_some(knots)
}
