//! How our numbers stand to those that the paper prints: its planes as wholes, and its worked example.

use std::f64::consts::SQRT_2;

use nalgebra::{DMatrix, DVector};

use crate::fragility::{Plane, Sample, rms_difference};
use crate::motion::IntensityMeasures;
use crate::normal;
use crate::rocking::Structure;
use crate::statistics::{Test, f_upper_tail};
use crate::units::G_M_S2;

/// Hotelling's T2 of a printed set of numbers about sets of ours, one a seed: whether it could be one more of them, all numbers
/// together, which depend on each other. Rounding of the print (the widths of the intervals that round to it) counts as an error
/// of variance width^2 / 12. None with too few sets, or with numbers that do not vary independently.
///
/// T2 (n - k) / (k (n - 1)) of k numbers and n sets is F with k and n - k degrees of freedom (Hotelling 1931, The generalization of
/// Student's ratio, Annals of Mathematical Statistics 2, 360-378).
pub fn joint_test(ours: &[Vec<f64>], printed: &[f64], rounding: &[f64]) -> Option<Test> {
    let (n, k) = (ours.len(), printed.len());
    if n <= k || k == 0 || ours.iter().any(|set| set.len() != k) {
        return None;
    }
    let (sets, numbers) = (n as f64, k as f64);
    let mean = |at: usize| ours.iter().map(|set| set[at]).sum::<f64>() / sets;
    let means = DVector::from_fn(k, |at, _| mean(at));
    let deviations = DMatrix::from_fn(n, k, |set, at| ours[set][at] - means[at]);
    let covariance = deviations.tr_mul(&deviations) / (sets - 1.0);
    let rounded = DVector::from_fn(k, |at, _| rounding[at] * rounding[at] / 12.0);
    // One more set and the mean of ours: (1 + 1/n) times the covariance of one.
    let of_difference = covariance * (1.0 + 1.0 / sets) + DMatrix::from_diagonal(&rounded);
    let difference = DVector::from_column_slice(printed) - means;
    let t2 = difference.dot(&of_difference.cholesky()?.solve(&difference));
    let f = t2 * (sets - numbers) / (numbers * (sets - 1.0));
    Some(Test { statistic: t2, p: f_upper_tail(f, numbers, sets - numbers) })
}

/// How far apart in ln EDP two of these planes are, over the cases of a sample for planes: root of the mean square over all pairs. None
/// with fewer than two planes, or without cases.
pub fn rms_between(planes: &[Plane], sample: &Sample) -> Option<f64> {
    let pairs = planes.iter().enumerate().flat_map(|(k, a)| planes[..k].iter().map(move |b| (a, b)));
    let squares: Option<Vec<f64>> = pairs.map(|(a, b)| Some(rms_difference(a, b, sample)?.powi(2))).collect();
    let squares = squares.filter(|squares| !squares.is_empty())?;
    Some((squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}

/// The measures of the one motion of the worked example (section 3: PGA 0.5 g, PGA/PGV 2 1/s) for one of its two structures.
pub fn example(structure: &Structure) -> IntensityMeasures {
    const PGA_M_S2: f64 = 0.5 * G_M_S2;
    const PGA_OVER_PGV: f64 = 2.0;
    IntensityMeasures::new(structure, PGA_M_S2, PGA_M_S2 / PGA_OVER_PGV, None, None)
}

/// The hybrid measure of IM4 and p PGV / PGA (Eq. 23).
pub fn hybrid(measures: &IntensityMeasures, lambda: f64) -> Option<f64> {
    let weight = lambda / (1.0 + lambda);
    Some(libm::pow(measures.im4, weight) * libm::pow(measures.im3?, weight - 1.0))
}

/// The exponent that the hybrid measures printed in the worked example imply.
pub const EXAMPLE_LAMBDA: f64 = 1.5;

/// 1/2 (1 + erf(ln IM)): Eq. 24 with mu and beta sqrt 2 left out. Of the hybrid measures of the worked example it gives the
/// probabilities that the paper prints there, 0.73 and 0.81.
pub fn half_erf(im: f64) -> f64 {
    normal::cdf(SQRT_2 * libm::log(im))
}
