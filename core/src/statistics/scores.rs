//! Scores of predicted probabilities, and quantiles of a sample.

/// A bin of [`largest_difference`] has at least this sum of p (1 - p), by which the standard error of its
/// share is at most 1/12.
const LEAST_VARIANCE: f64 = 9.0;
const MOST_BINS: f64 = 10.0;
/// Chance explains a difference of fewer standard errors (99 %).
const CHANCE: f64 = 2.575_829_303_548_901;

/// Finds the largest difference between the share of events and their mean probability that chance does not
/// explain, 0 if there is none. Bins of rising probability, at most ten, have equal sums of p (1 - p): where
/// the probability is nearly 0 or 1, cases tell little. None where they are too few for two bins.
pub fn largest_difference(probabilities: &[f64], events: &[bool]) -> Option<f64> {
    let mut order: Vec<usize> = (0..probabilities.len()).collect();
    order.sort_by(|&a, &b| probabilities[a].total_cmp(&probabilities[b]));
    let variance = |case: usize| probabilities[case] * (1.0 - probabilities[case]);
    let whole: f64 = order.iter().map(|&case| variance(case)).sum();
    let count = (whole / LEAST_VARIANCE).floor().min(MOST_BINS);
    // Cases, events more than expected, and their variance.
    let mut bins = vec![[0.0; 3]; count as usize];
    let mut before = 0.0;
    for case in order {
        let bin = (before / whole * count).min(count - 1.0) as usize;
        before += variance(case);
        let added = [1.0, f64::from(events[case]) - probabilities[case], variance(case)];
        bins.get_mut(bin)?.iter_mut().zip(added).for_each(|(sum, added)| *sum += added);
    }
    let apart = bins.iter().filter(|[_, excess, variance]| excess.abs() > CHANCE * variance.sqrt());
    let largest = apart.map(|[n, excess, _]| excess.abs() / n).fold(0.0, f64::max);
    (bins.len() > 1).then_some(largest)
}

/// Computes the area under the receiver operating characteristic: the probability that an event has a higher
/// score than another case, ties counted half. NaN without events or without other cases.
pub fn auc(scores: &[f64], events: &[bool]) -> f64 {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].total_cmp(&scores[b]));
    let (mut wins, mut others_below, mut happened_in_all) = (0.0, 0.0, 0.0);
    for tied in order.chunk_by(|&a, &b| scores[a] == scores[b]) {
        let happened = tied.iter().filter(|&&case| events[case]).count() as f64;
        let others = tied.len() as f64 - happened;
        wins += happened * (others_below + 0.5 * others);
        others_below += others;
        happened_in_all += happened;
    }
    wins / (happened_in_all * others_below)
}

/// Computes the Brier score: the mean squared difference of probability and outcome.
pub fn brier_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let squares = probabilities.iter().zip(events).map(|(p, &event)| (p - f64::from(event)).powi(2));
    squares.sum::<f64>() / events.len() as f64
}

/// Computes the logarithmic score: the mean log probability of the outcomes, at most 0.
pub fn log_score(probabilities: &[f64], events: &[bool]) -> f64 {
    let logarithms =
        probabilities.iter().zip(events).map(|(p, &event)| if event { p.ln() } else { (-p).ln_1p() });
    logarithms.sum::<f64>() / events.len() as f64
}

/// Finds the value that this fraction of a sample lies below; NaN do not count. None of an empty sample.
pub fn sample_quantile(mut values: Vec<f64>, fraction: f64) -> Option<f64> {
    values.retain(|value| !value.is_nan());
    values.sort_unstable_by(f64::total_cmp);
    values.get((fraction * values.len() as f64) as usize).copied()
}
