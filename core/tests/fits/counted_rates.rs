//! Annual rates counted without a curve, against numpy, scipy and closed forms.

use rockfrag_core::hazard::{CountedMotion, CountedRate, HazardCurve, counted_rate};

use crate::common::read;

/// H = 1e-3 IM^-2.5, of which a curve of two points has every value.
fn hazard() -> HazardCurve {
    let point = |im: f64| (im, 1e-3 * im.powf(-2.5));
    HazardCurve::new(vec![point(1e-3), point(1e3)]).unwrap()
}

/// Motions at equal ratios from `least` on, each a cluster of its own.
fn motions(n: usize, least: f64, event: impl Fn(usize, f64) -> bool) -> Vec<CountedMotion> {
    let motion = |k: usize| {
        let intensity = least * 10f64.powf(k as f64 / n as f64);
        CountedMotion { intensity, event: event(k, intensity), cluster: k as u32 }
    };
    (0..n).map(motion).collect()
}

fn counted(least: f64, motions: Vec<CountedMotion>) -> CountedRate {
    counted_rate(&hazard(), least, motions, 42).unwrap()
}

#[test]
fn an_event_that_does_not_know_the_intensity_has_its_share_of_the_hazard() {
    let count = counted(0.3, motions(6400, 0.3, |k, _| k % 4 == 1));
    let expected = 0.25 * 1e-3 * 0.3f64.powf(-2.5);
    assert!((count.annual_rate.value / expected - 1.0).abs() < 1e-9, "{count:?}");
    assert!(count.annual_rate.low < expected && expected < count.annual_rate.high);
}

#[test]
fn an_event_from_an_intensity_on_has_the_rate_at_which_it_is_exceeded() {
    // A bin holds a third of a percent of the motions, 0.7 % of the intensity.
    let count = counted(0.3, motions(6400, 0.3, |_, im| im >= 0.8));
    let expected = 1e-3 * 0.8f64.powf(-2.5);
    assert!((count.annual_rate.value / expected - 1.0).abs() < 0.02, "{count:?}");
}

#[test]
fn no_event_says_an_upper_limit() {
    // All motions are in one bin, of which 0 of n happened: 3.69 / n of its rate (Poisson).
    let rate = counted(0.3, motions(19, 0.3, |_, _| false));
    let expected = 0.5 * 7.377_759 / 19.0 * 1e-3 * 0.3f64.powf(-2.5);
    assert_eq!((rate.annual_rate.value, rate.annual_rate.low), (0.0, 0.0));
    assert!((rate.annual_rate.high / expected - 1.0).abs() < 0.01, "{rate:?} for {expected}");
}

#[test]
fn motions_that_do_not_rock_and_the_order_of_all_do_not_matter() {
    let some = motions(400, 0.3, |k, _| k % 7 == 3);
    let mut others = some.clone();
    others.reverse();
    others.push(CountedMotion { intensity: 0.1, event: true, cluster: 17 });
    assert_eq!(counted(0.3, some), counted(0.3, others));
    assert_eq!(counted_rate(&hazard(), 0.3, Vec::new(), 42), None);
}

#[test]
fn numpy_and_scipy_count_the_same() {
    let motions = read::<(f64, u32, u8)>("counted_motions.csv").into_iter();
    let motion = |(intensity, cluster, event)| CountedMotion { intensity, event: event == 1, cluster };
    let rate = counted(0.3, motions.map(motion).collect());
    let [value, drawn_low, drawn_high, low, high] = read::<[f64; 5]>("counted_answers.csv")[0];
    assert!((rate.annual_rate.value / value - 1.0).abs() < 1e-9, "{rate:?} for {value}");
    // Of 500 resamples for 20,000.
    assert!((rate.annual_rate.low / drawn_low.min(low) - 1.0).abs() < 0.1, "{rate:?}");
    assert!((rate.annual_rate.high / drawn_high.max(high) - 1.0).abs() < 0.1, "{rate:?}");
}
