//! Firth's penalised likelihood, which has a maximum even where a measure tells the outcomes apart, and less bias where
//! events are few.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::binary::BinaryLikelihood;
use super::derivatives::{Scores, derivatives};

use crate::keyword::keywords;

/// What is maximised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// The likelihood.
    #[default]
    Ml,
    /// The likelihood times the root of the determinant of the expected information (Firth 1993, Biometrika 80, 27-38;
    /// Heinze & Schemper 2002, Statistics in Medicine 21, 2409-2419).
    Firth,
}

keywords!(Estimator { Ml = "ml", Firth = "firth" });

/// The logarithm of Firth's factor.
pub struct Penalty {
    /// Half the logarithm of the determinant of the expected information.
    pub value: f64,
    /// Its first derivatives.
    pub gradient: DVector<f64>,
    /// The expected information.
    pub information: DMatrix<f64>,
}

/// Firth's penalty at these coefficients; none where the information is singular.
pub fn penalty(likelihood: &BinaryLikelihood, coefficients: &DVector<f64>) -> Option<Penalty> {
    let BinaryLikelihood { design, weights, link, .. } = likelihood;
    let indices = design.indices(coefficients.as_slice());
    let of_cases: Vec<_> = indices.iter().map(|&index| link.information(index)).collect();
    let expected = |cases: Range<usize>, scores: Scores| {
        let counted = of_cases[cases.clone()].iter().zip(&weights[cases]);
        for (curvature, (of_case, &weight)) in scores.curvature.iter_mut().zip(counted) {
            *curvature = if weight > 0.0 { weight * of_case.weight } else { 0.0 };
        }
        scores.slope.fill(0.0);
    };
    let information = derivatives(design, &[], expected).information;
    let factor = information.clone().cholesky()?;
    let inverse = factor.inverse();
    let mut gradient = DVector::zeros(coefficients.len());
    let cases = design.rows().zip(&of_cases).zip(*weights).filter(|(_, weight)| **weight > 0.0);
    for ((row, of_case), weight) in cases {
        let leverage = weight * of_case.weight * (&inverse * &row).dot(&row);
        gradient += row * (0.5 * leverage * of_case.ln_weight_slope);
    }
    Some(Penalty { value: factor.l().diagonal().map(f64::ln).sum(), gradient, information })
}
