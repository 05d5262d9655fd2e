use nalgebra::{DMatrix, DVector};

use crate::normal;

/// The most Newton steps.
const MOST_STEPS: usize = 100;

/// A probit regression with an intercept: P(event) = Phi(b0 + b1 x1 + ...).
#[derive(Debug, Clone, PartialEq)]
pub struct ProbitFit {
    /// Intercept first.
    pub coefficients: DVector<f64>,
    /// Inverse of the observed information.
    pub covariance: DMatrix<f64>,
    /// At the maximum.
    pub log_likelihood: f64,
}

/// Why Newton's iterations found no maximum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the likelihood has no maximum that Newton's iterations reach")]
pub struct ProbitError;

/// Log-likelihood and its derivatives.
struct Likelihood {
    value: f64,
    gradient: DVector<f64>,
    /// The negative of the matrix of second derivatives.
    information: DMatrix<f64>,
}

/// Maximises the Bernoulli likelihood of `events` (true: it happened) under the probit link by Newton's method with step halving; the
/// likelihood is concave. `predictors` are each as long as `events`. Under separation there is no maximum, and the iterations may
/// still stop, far out where the likelihood is flat: [`is_separated`](super::is_separated) must be asked first.
///
/// # Errors
/// If the iterations do not converge, or the predictors are collinear.
pub fn probit(predictors: &[&[f64]], events: &[bool]) -> Result<ProbitFit, ProbitError> {
    let (n, k) = (events.len(), predictors.len() + 1);
    let design =
        DMatrix::from_fn(n, k, |row, column| if column == 0 { 1.0 } else { predictors[column - 1][row] });
    let mut coefficients = DVector::zeros(k);
    let mut here = likelihood(&design, events, &coefficients);
    for _ in 0..MOST_STEPS {
        let step = here.information.clone().cholesky().ok_or(ProbitError)?.solve(&here.gradient);
        // The gain that the quadratic model promises; below rounding of the likelihood nothing is left to gain.
        let promised = 0.5 * step.dot(&here.gradient);
        let (next, there) = ascend(&design, events, &coefficients, &step, &here);
        if promised <= 1e-20 * (1.0 + here.value.abs()) || next == coefficients {
            let covariance = there.information.cholesky().ok_or(ProbitError)?.inverse();
            return Ok(ProbitFit { coefficients: next, covariance, log_likelihood: there.value });
        }
        (coefficients, here) = (next, there);
    }
    Err(ProbitError)
}

/// The longest of the step and its halves that does not lower the likelihood.
fn ascend(
    design: &DMatrix<f64>,
    events: &[bool],
    from: &DVector<f64>,
    step: &DVector<f64>,
    here: &Likelihood,
) -> (DVector<f64>, Likelihood) {
    let tolerance = 1e-12 * (1.0 + here.value.abs());
    let mut share = 1.0;
    loop {
        let to = from + step * share;
        let there = likelihood(design, events, &to);
        if there.value >= here.value - tolerance || share < 1e-6 {
            return (to, there);
        }
        share *= 0.5;
    }
}

fn likelihood(design: &DMatrix<f64>, events: &[bool], coefficients: &DVector<f64>) -> Likelihood {
    let k = coefficients.len();
    let index = design * coefficients;
    let mut value = 0.0;
    let mut gradient = DVector::zeros(k);
    let mut information = DMatrix::zeros(k, k);
    for (row, &event) in events.iter().enumerate() {
        let sign = if event { 1.0 } else { -1.0 };
        let z = sign * index[row];
        let ln_p = normal::ln_cdf(z);
        // The inverse Mills ratio pdf/cdf, by logarithms so that it survives the far tail.
        let mills = (-0.5 * z * z - 0.5 * (2.0 * std::f64::consts::PI).ln() - ln_p).exp();
        let weight = mills * (mills + z);
        value += ln_p;
        for i in 0..k {
            gradient[i] += sign * mills * design[(row, i)];
            for j in 0..=i {
                information[(i, j)] += weight * design[(row, i)] * design[(row, j)];
            }
        }
    }
    information.fill_upper_triangle_with_lower_triangle();
    Likelihood { value, gradient, information }
}
