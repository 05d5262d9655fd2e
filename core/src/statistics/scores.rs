//! Scores of predicted probabilities, and quantiles of a sample.

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
