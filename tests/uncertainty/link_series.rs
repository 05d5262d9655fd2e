//! The Taylor series of the log-likelihood of a case.

use rockfrag::statistics::{Link, ln_probability_series};

/// What is left out at t = 0.1 is below 1e-14.
const TERMS: usize = 16;

#[test]
fn the_series_of_each_link_is_that_of_its_log_likelihood() {
    for link in [Link::Probit, Link::Logit, Link::Cloglog] {
        for (index, event) in [-2.0, -0.7, 0.0, 0.4, 1.3].into_iter().flat_map(|z| [(z, true), (z, false)]) {
            let (value, slope) = (link.ln_probability(index, event), link.score(index, event).slope);
            let series: [f64; TERMS] = ln_probability_series(link, event, index, value, slope);
            for t in [-0.1, -0.03, 0.05, 0.1] {
                let sum = series.iter().rev().fold(0.0, |sum, factor| sum * t + factor);
                let expected = link.ln_probability(index + t, event);
                let apart = (sum / expected - 1.0).abs();
                assert!(apart < 2e-14, "{link:?} at {index} + {t}, event {event}: {apart:e}");
            }
        }
    }
}

#[test]
fn the_series_at_0_are_the_known_ones() {
    // -ln(1 + exp(-t)) and -exp(t).
    let logit: [f64; 7] = ln_probability_series(Link::Logit, true, 0.0, -std::f64::consts::LN_2, 0.5);
    let known = [-std::f64::consts::LN_2, 0.5, -1.0 / 8.0, 0.0, 1.0 / 192.0, 0.0, -1.0 / 2880.0];
    assert!(logit.iter().zip(known).all(|(factor, known)| (factor - known).abs() < 1e-16), "{logit:?}");
    let cloglog: [f64; 5] = ln_probability_series(Link::Cloglog, false, 0.0, -1.0, -1.0);
    assert_eq!(cloglog, [-1.0, -1.0, -0.5, -1.0 / 6.0, -1.0 / 24.0]);
}
