//! Polynomials of several variables, as sums of monomials.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::triangle;

/// All products of powers of some variables up to a degree, those of a lower degree first, from 1 on.
#[derive(Debug, Clone, PartialEq)]
pub struct Monomials {
    variables: usize,
    powers: Vec<Vec<usize>>,
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
        let powers: Vec<Vec<usize>> = (0..=order).flat_map(|degree| of_degree(variables, degree)).collect();
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
        Monomials {
            variables,
            factors: powers.iter().map(factor).collect(),
            first: (0..variables).map(|i| derivative(&[i])).collect(),
            second: (0..variables)
                .flat_map(|i| (0..=i).map(move |j| [i, j]))
                .map(|ij| derivative(&ij))
                .collect(),
            powers,
        }
    }

    /// How many there are, with 1.
    pub fn count(&self) -> usize {
        self.powers.len()
    }

    /// Those of a degree or a higher one.
    pub fn degrees_from(&self, degree: usize) -> Range<usize> {
        self.powers.partition_point(|powers| powers.iter().sum::<usize>() < degree)..self.count()
    }

    /// The value of each.
    pub fn values(&self, at: &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(self.count());
        values.push(1.0);
        for &(variable, earlier) in &self.factors[1..] {
            values.push(at[variable] * values[earlier]);
        }
        values
    }

    /// The factors of each in the sum over degrees of a_degree (x1 y1 + x2 y2 + ...)^degree, a polynomial of y: with
    /// multinomial coefficients.
    pub fn powers_of_sum(&self, x: &[f64], a: &[f64]) -> Vec<f64> {
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        let factor = |(powers, value): (&Vec<usize>, f64)| {
            let degree = powers.iter().sum();
            let ways = factorial(degree) / powers.iter().map(|&power| factorial(power)).product::<f64>();
            a[degree] * ways * value
        };
        self.powers.iter().zip(self.values(x)).map(factor).collect()
    }

    /// The gradient of the polynomial with these factors, from the values of the monomials; of some of its terms.
    pub fn gradient(&self, factors: &[f64], values: &[f64], terms: Range<usize>) -> DVector<f64> {
        let sum = |i: usize| {
            let within = self.first[i].iter().filter(|derivative| terms.contains(&derivative.of));
            within.map(|d| d.factor * factors[d.of] * values[d.earlier]).sum()
        };
        DVector::from_fn(self.variables, |i, _| sum(i))
    }

    /// Its second derivatives.
    pub fn second_derivatives(&self, factors: &[f64], values: &[f64]) -> DMatrix<f64> {
        let sum = |pair: usize| -> f64 {
            self.second[pair].iter().map(|d| d.factor * factors[d.of] * values[d.earlier]).sum()
        };
        DMatrix::from_fn(self.variables, self.variables, |i, j| sum(triangle::place(i, j)))
    }
}

/// The powers of all monomials of a degree.
fn of_degree(variables: usize, degree: usize) -> Vec<Vec<usize>> {
    if variables == 0 {
        return if degree == 0 { vec![Vec::new()] } else { Vec::new() };
    }
    let with_last = |last: usize| {
        let mut others = of_degree(variables - 1, degree - last);
        others.iter_mut().for_each(|powers| powers.push(last));
        others
    };
    (0..=degree).flat_map(with_last).collect()
}
