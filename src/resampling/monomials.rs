//! Polynomials of several variables, as sums of monomials.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};
use pulp::NullaryFnOnce;

use crate::statistics::derivatives::NEAR;
use crate::statistics::design::sum_of_products;
use crate::wide::widest;

/// All products of powers of some variables up to a degree, those of a lower degree first, from 1 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Monomials {
    /// The degree of each.
    degrees: Vec<usize>,
    /// The multinomial coefficient of each: how often it stands in a power of the sum of all variables.
    ways: Vec<f64>,
    /// A monomial is this variable times that earlier one.
    factors: Vec<(usize, usize)>,
    /// With respect to each variable.
    first: Vec<Vec<Derivative>>,
    /// With respect to each pair of variables, those of which the first is not before the second.
    second: Vec<Vec<Derivative>>,
}

/// The derivative of a monomial: a factor times an earlier one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Derivative {
    of: usize,
    factor: f64,
    earlier: usize,
}

impl Monomials {
    /// Of `variables` variables up to degree `order`.
    pub fn new(variables: usize, order: usize) -> Monomials {
        let powers: Vec<Vec<usize>> =
            (0..=order).flat_map(|degree| powers_of_degree(variables, degree)).collect();
        let place = |wanted: &[usize]| powers.iter().position(|powers| powers == wanted);
        let without = |powers: &[usize], variable: usize| {
            let mut fewer = powers.to_vec();
            fewer[variable] = fewer[variable].checked_sub(1)?;
            Some(fewer)
        };
        let factor = |powers: &Vec<usize>| {
            (0..variables).find_map(|k| Some((k, place(&without(powers, k)?)?))).unwrap_or((0, 0))
        };
        let derivative = |variables: &[usize]| -> Vec<Derivative> {
            let of = |(of, powers): (usize, &Vec<usize>)| {
                let (mut factor, mut left) = (1.0, powers.clone());
                for &variable in variables {
                    factor *= left[variable] as f64;
                    left = without(&left, variable)?;
                }
                Some(Derivative { of, factor, earlier: place(&left)? })
            };
            powers.iter().enumerate().filter_map(of).collect()
        };
        let degree = |powers: &Vec<usize>| powers.iter().sum();
        let ways = |powers: &Vec<usize>| {
            factorial(degree(powers)) / powers.iter().map(|&power| factorial(power)).product::<f64>()
        };
        Monomials {
            degrees: powers.iter().map(degree).collect(),
            ways: powers.iter().map(ways).collect(),
            factors: powers.iter().map(factor).collect(),
            first: (0..variables).map(|i| derivative(&[i])).collect(),
            second: (0..variables)
                .flat_map(|i| (0..=i).map(move |j| [i, j]))
                .map(|ij| derivative(&ij))
                .collect(),
        }
    }

    /// Up to which degree.
    pub fn order(&self) -> usize {
        self.degrees.last().copied().unwrap_or(0)
    }

    /// Of how many variables.
    pub fn variables(&self) -> usize {
        self.first.len()
    }

    /// How many there are, with 1.
    pub fn count(&self) -> usize {
        self.degrees.len()
    }

    /// Those of a degree.
    pub fn of_degree(&self, degree: usize) -> Range<usize> {
        let below = |degree: usize| self.degrees.partition_point(|&lower| lower < degree);
        below(degree)..below(degree + 1)
    }

    /// The value of each, at several places at once.
    #[inline(always)]
    pub fn values<const N: usize>(&self, at: &[[f64; N]]) -> Vec<[f64; N]> {
        let mut values = Vec::with_capacity(self.count());
        values.push([1.0; N]);
        for &(variable, earlier) in &self.factors[1..] {
            let (x, earlier): ([f64; N], [f64; N]) = (at[variable], values[earlier]);
            values.push(std::array::from_fn(|place| x[place] * earlier[place]));
        }
        values
    }

    /// The factors of each in the sum over degrees of a_degree (x1 y1 + x2 y2 + ...)^degree, a polynomial of y.
    pub fn powers_of_sum(&self, x: &[f64], a: &[f64]) -> Vec<f64> {
        let values = self.degrees.iter().zip(&self.ways).zip(self.values::<1>(x.as_chunks().0));
        values.map(|((&degree, ways), [value])| a[degree] * ways * value).collect()
    }

    /// The factors of each in the quadratic function with this gradient and these second derivatives where all variables are 0.
    pub fn quadratic(&self, constant: f64, gradient: &DVector<f64>, curvature: &DMatrix<f64>) -> Vec<f64> {
        let linear = self.of_degree(1).map(|place| gradient[self.factors[place].0]);
        let square = self.of_degree(2).map(|place| {
            let (i, earlier) = self.factors[place];
            let j = self.factors[earlier].0;
            if i == j { 0.5 * curvature[(i, i)] } else { curvature[(i, j)] }
        });
        std::iter::once(constant).chain(linear).chain(square).collect()
    }

    /// The sums over cases of [`Monomials::powers_of_sum`]; `x` are the columns of each variable, `a` those of each case.
    pub fn sums_of_powers<const N: usize>(&self, x: &[Vec<f64>], a: &[[f64; N]]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        for (block, a) in a.chunks(NEAR).enumerate() {
            let of_degree = |degree: usize| a.iter().map(|a| a[degree]).collect::<Vec<f64>>();
            let of_degrees: Vec<Vec<f64>> = (0..N).map(of_degree).collect();
            widest(SumsOfPowers {
                of: self,
                x,
                first: block * NEAR,
                of_degrees: &of_degrees,
                sums: &mut sums,
            });
        }
        sums.iter_mut().zip(&self.ways).for_each(|(sum, ways)| *sum *= ways);
        sums
    }

    /// The gradients of polynomials with these factors, from the values of the monomials; of some of their terms.
    #[inline(always)]
    pub fn gradients<const N: usize>(
        &self,
        factors: &[[f64; N]],
        values: &[[f64; N]],
        terms: Range<usize>,
    ) -> Vec<[f64; N]> {
        let within = |derivatives: &[Derivative]| {
            let from = derivatives.partition_point(|derivative| derivative.of < terms.start);
            let to = derivatives.partition_point(|derivative| derivative.of < terms.end);
            from..to
        };
        let mut gradients = vec![[0.0; N]; self.first.len()];
        for (gradient, all) in gradients.iter_mut().zip(&self.first) {
            add_derivatives(gradient, &all[within(all)], factors, values);
        }
        gradients
    }

    /// Their second derivatives, the rows of the lower triangle one after the other.
    #[inline(always)]
    pub fn second_derivatives<const N: usize>(
        &self,
        factors: &[[f64; N]],
        values: &[[f64; N]],
    ) -> Vec<[f64; N]> {
        let mut curvatures = vec![[0.0; N]; self.second.len()];
        for (curvature, all) in curvatures.iter_mut().zip(&self.second) {
            add_derivatives(curvature, all, factors, values);
        }
        curvatures
    }
}

/// Adds the sums over some cases.
struct SumsOfPowers<'a> {
    of: &'a Monomials,
    x: &'a [Vec<f64>],
    first: usize,
    of_degrees: &'a [Vec<f64>],
    sums: &'a mut [f64],
}

impl NullaryFnOnce for SumsOfPowers<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let cases = self.of_degrees[0].len();
        let mut values = vec![1.0; self.of.count() * NEAR];
        for (k, &(variable, earlier)) in self.of.factors.iter().enumerate() {
            let (before, from) = values.split_at_mut(k * NEAR);
            let value = &mut from[..cases];
            if k > 0 {
                let x = &self.x[variable][self.first..][..cases];
                let earlier = &before[earlier * NEAR..][..cases];
                for ((value, x), earlier) in value.iter_mut().zip(x).zip(earlier) {
                    *value = x * earlier;
                }
            }
            self.sums[k] += sum_of_products(value, &self.of_degrees[self.of.degrees[k]]);
        }
    }
}

/// Adds the derivatives of the terms of polynomials with these factors.
#[inline(always)]
fn add_derivatives<const N: usize>(
    sums: &mut [f64; N],
    terms: &[Derivative],
    factors: &[[f64; N]],
    values: &[[f64; N]],
) {
    for &Derivative { of, factor, earlier } in terms {
        let (of, earlier) = (&factors[of], &values[earlier]);
        for place in 0..N {
            sums[place] = (factor * of[place]).mul_add(earlier[place], sums[place]);
        }
    }
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// The powers of all monomials of a degree.
fn powers_of_degree(variables: usize, degree: usize) -> Vec<Vec<usize>> {
    if variables == 0 {
        return if degree == 0 { vec![Vec::new()] } else { Vec::new() };
    }
    let with_last = |last: usize| {
        let mut others = powers_of_degree(variables - 1, degree - last);
        others.iter_mut().for_each(|powers| powers.push(last));
        others
    };
    (0..=degree).flat_map(with_last).collect()
}
