//! Whether a model fits: tests whose small probabilities speak against it, and scores of probabilities.

use crate::statistics::binary::BinaryFit;
use crate::statistics::distribution::{chi_squared_upper_tail, f_upper_tail};
use crate::statistics::regression::{LinearFit, least_squares};

/// Groups of a Hosmer-Lemeshow test.
const GROUPS: usize = 10;

/// The outcome of a test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Test {
    pub statistic: f64,
    /// Probability of one as large, if the model holds.
    pub p: f64,
}

/// The rows in so many groups of rising values and of equal size, but for the first ones, which take what does not divide.
pub fn rising_groups(values: &[f64], groups: usize) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let (size, larger) = (values.len() / groups, values.len() % groups);
    let (first, rest) = order.split_at(larger * (size + 1));
    first.chunks(size + 1).chain(rest.chunks(size.max(1))).map(<[usize]>::to_vec).collect()
}

/// Hosmer and Lemeshow's test of fitted probabilities: in ten groups of rising probability, as many events as expected?
/// (Hosmer & Lemeshow 1980, Communications in Statistics A9, 1043-1069). None with fewer than two cases a group, or if a
/// group is certain of its outcome.
pub fn hosmer_lemeshow(probabilities: &[f64], events: &[bool]) -> Option<Test> {
    let n = probabilities.len();
    if n < 2 * GROUPS {
        return None;
    }
    let of_group = |rows: &Vec<usize>| {
        let expected: f64 = rows.iter().map(|&row| probabilities[row]).sum();
        let observed = rows.iter().filter(|&&row| events[row]).count() as f64;
        (observed - expected).powi(2) / (expected * (1.0 - expected / rows.len() as f64))
    };
    let statistic: f64 = rising_groups(probabilities, GROUPS).iter().map(of_group).sum();
    let test = Test { statistic, p: chi_squared_upper_tail(statistic, GROUPS - 2) };
    statistic.is_finite().then_some(test)
}

/// The likelihood-ratio test of a binary regression against a larger one that contains it.
pub fn likelihood_ratio(restricted: &BinaryFit, full: &BinaryFit) -> Test {
    let statistic = (2.0 * (full.log_likelihood - restricted.log_likelihood)).max(0.0);
    let degrees = full.coefficients.len() - restricted.coefficients.len();
    Test { statistic, p: chi_squared_upper_tail(statistic, degrees) }
}

/// Ramsey's test of a linear regression: do squares and cubes of the fitted values add to it? (Ramsey 1969, J. Royal
/// Statistical Society B31, 350-371). None where they do not vary on their own.
pub fn reset(predictors: &[&[f64]], y: &[f64], fit: &LinearFit) -> Option<Test> {
    let fitted = |row: usize| -> f64 {
        let slopes = fit.coefficients.iter().skip(1).zip(predictors);
        fit.coefficients[0].value + slopes.map(|(b, x)| b.value * x[row]).sum::<f64>()
    };
    added_powers(predictors, y, &(0..y.len()).map(fitted).collect::<Vec<_>>(), fit.rss)
}

/// The F test of what squares and cubes of `fitted` add to a regression on `predictors` that leaves `rss`.
pub fn added_powers(predictors: &[&[f64]], y: &[f64], fitted: &[f64], rss: f64) -> Option<Test> {
    let n = fitted.len() as f64;
    // Standardised, which changes nothing but the conditioning.
    let mean = fitted.iter().sum::<f64>() / n;
    let sd = (fitted.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / n).sqrt();
    let power = |k: i32| fitted.iter().map(|f| ((f - mean) / sd).powi(k)).collect::<Vec<f64>>();
    let (squares, cubes) = (power(2), power(3));
    let more: Vec<&[f64]> = predictors.iter().copied().chain([&squares[..], &cubes[..]]).collect();
    let full = least_squares(&more, y).ok()?;
    let degrees = (full.n - full.coefficients.len()) as f64;
    let statistic = (rss - full.rss) / 2.0 / (full.rss / degrees);
    statistic.is_finite().then(|| Test { statistic, p: f_upper_tail(statistic, 2.0, degrees) })
}

/// Area under the receiver operating characteristic: the probability that an event has a higher score than a non-event,
/// ties counted half. NaN without both.
pub fn auc(scores: &[f64], events: &[bool]) -> f64 {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].total_cmp(&scores[b]));
    let (mut wins, mut others_below, mut events_so_far) = (0.0, 0.0, 0.0);
    for tied in order.chunk_by(|&a, &b| scores[a] == scores[b]) {
        let happened = tied.iter().filter(|&&row| events[row]).count() as f64;
        let did_not = tied.len() as f64 - happened;
        wins += happened * (others_below + 0.5 * did_not);
        others_below += did_not;
        events_so_far += happened;
    }
    wins / (events_so_far * others_below)
}

/// Brier score: the mean squared difference of probability and outcome.
pub fn brier_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let square = |(p, &event): (&f64, &bool)| (p - f64::from(u8::from(event))).powi(2);
    probabilities.iter().zip(events).map(square).sum::<f64>() / events.len() as f64
}

/// Logarithmic score: the mean logarithm of the probability of what happened, 0 at best.
pub fn log_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let of = |(p, &event): (&f64, &bool)| if event { p.ln() } else { (-p).ln_1p() };
    probabilities.iter().zip(events).map(of).sum::<f64>() / events.len() as f64
}

/// The logarithmic score that right probabilities have in the mean.
pub fn expected_log_score(probabilities: &[f64]) -> f64 {
    let times_ln = |weight: f64, ln: f64| if weight > 0.0 { weight * ln } else { 0.0 };
    let of = |&p: &f64| times_ln(p, p.ln()) + times_ln(1.0 - p, (-p).ln_1p());
    probabilities.iter().map(of).sum::<f64>() / probabilities.len() as f64
}
