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
