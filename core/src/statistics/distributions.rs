//! Quantiles and tails of Student's t, F and chi squared.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor, StudentsT};

use super::normal;

/// Computes the `p` quantile of Student's t; normal with infinite degrees of freedom.
pub fn t_quantile(p: f64, degrees_of_freedom: f64) -> f64 {
    if degrees_of_freedom.is_infinite() {
        return normal::quantile(p);
    }
    StudentsT::new(0.0, 1.0, degrees_of_freedom).map_or(f64::NAN, |t| t.inverse_cdf(p))
}

pub fn f_upper_tail(x: f64, numerator: f64, denominator: f64) -> f64 {
    FisherSnedecor::new(numerator, denominator).map_or(f64::NAN, |f| f.sf(x))
}

pub fn chi_squared_quantile(p: f64, degrees_of_freedom: f64) -> f64 {
    ChiSquared::new(degrees_of_freedom).map_or(f64::NAN, |chi_squared| chi_squared.inverse_cdf(p))
}
