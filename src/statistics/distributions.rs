//! Quantiles and tails of Student's t, F and chi squared.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, StudentsT};

use super::normal;

/// Finds the `x` below which Student's t lies with probability `p`; with infinite degrees of freedom it is
/// normal.
pub fn t_quantile(p: f64, degrees: f64) -> f64 {
    if degrees.is_infinite() {
        return normal::quantile(p);
    }
    StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |t| t.inverse_cdf(p))
}

/// Computes the probability that F with these degrees of freedom lies above `x`.
pub fn f_upper_tail(x: f64, numerator: f64, denominator: f64) -> f64 {
    FisherSnedecor::new(numerator, denominator).map_or(f64::NAN, |f| f.sf(x))
}

/// Computes the probability that chi squared lies above `x`.
pub fn chi_squared_upper_tail(x: f64, degrees: f64) -> f64 {
    ChiSquared::new(degrees).map_or(f64::NAN, |chi_squared| chi_squared.sf(x))
}

/// Finds the `x` below which chi squared lies with probability `p`.
pub fn chi_squared_quantile(p: f64, degrees: f64) -> f64 {
    ChiSquared::new(degrees).map_or(f64::NAN, |chi_squared| chi_squared.inverse_cdf(p))
}
