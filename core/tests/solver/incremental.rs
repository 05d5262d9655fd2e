//! Incremental dynamic analysis: scans against closed forms and known ranges.

use std::f64::consts::PI;

use rockfrag_core::rocking::{
    Capacity, CapacityStatus, Outcome, Problem, Record, Response, SafeWindow, Scan, ScanPoint, ScanResponse,
    Structure, simulate_all,
};
use rockfrag_core::units::G_M_S2;

/// So slender that the equation of motion is linear.
const ALPHA: f64 = 1e-5;

/// Capacity, as PGA/(g tan alpha), of a block under samples whose largest is 1.
fn capacity(scan: &Scan, structure: &Structure, samples: &[f64], dt: f64) -> Capacity {
    let unit = G_M_S2 * structure.alpha_rad.tan();
    let respond = |points: &[ScanPoint]| -> Result<Vec<Response>, std::convert::Infallible> {
        let scaled =
            |point: &ScanPoint| samples.iter().map(|a| point.intensity * unit * a).collect::<Vec<f64>>();
        let scaled: Vec<Vec<f64>> = points.iter().map(scaled).collect();
        let problem = |samples| Problem { structure, record: Record::new(samples, dt).unwrap() };
        Ok(simulate_all(&scaled.iter().map(|samples| problem(samples)).collect::<Vec<_>>()))
    };
    scan.capacity(&scan.run(1, respond).unwrap()[0])
}

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() <= tolerance, "{value} is not {expected}");
}

#[test]
fn a_rectangular_pulse_overturns_from_the_amplitude_of_the_linear_equation_on() {
    // With time in 1/p, the unstable mode u = (theta + theta'/p)/alpha - 1 of a block that moves to one side
    // obeys u' = u + A(t) from u = -1: it overturns where the integral of A(t) exp(-t) exceeds 1. The pulse
    // ends with a ramp of one step.
    let block = Structure::new("block", 2.0, ALPHA, 0.9).unwrap();
    let scan = Scan::new(0.5, 20.0, 20);
    for duration in [0.3, 0.8, 2.0] {
        let steps = 400;
        let step: f64 = duration / steps as f64;
        let mut samples = vec![1.0; steps + 1];
        samples.extend([0.0; 4]);
        let ramp = 1.0 - (-(-step).exp_m1()) / step;
        let least = 1.0 / (1.0 - (-duration).exp() + (-duration).exp() * ramp);
        let found = capacity(&scan, &block, &samples, step / block.p_rad_s);
        assert_eq!((found.status, found.windows), (CapacityStatus::Overturns, vec![]));
        let (safe, overturning) = (found.safe_below.unwrap(), found.overturning.unwrap());
        assert!(
            safe < least * (1.0 + 3e-5) && least * (1.0 - 3e-5) < overturning,
            "{safe} {least} {overturning}"
        );
        close(safe, overturning, 1e-3);
    }
}

/// Whether a block overturns under one period of A sin(w t), and after how many impacts: closed form of the
/// linear equation y'' = y - s + F, piece by piece, with y = theta/alpha, time in 1/p, and s the side to
/// which it leans.
fn overturns_under_sine(amplitude: f64, w: f64, eta: f64) -> Option<u32> {
    let end = 2.0 * PI / w;
    let forced = -amplitude / (1.0 + w * w);
    let (mut t, mut y, mut v, mut side, mut impacts) = ((1.0 / amplitude).asin() / w, 0.0, 0.0, 1.0, 0);
    while t < end {
        let (particular, its_slope) = (forced * (w * t).sin(), forced * w * (w * t).cos());
        let grows = 0.5 * (y - side - particular + v - its_slope);
        let decays = 0.5 * (y - side - particular - v + its_slope);
        let rotation =
            |x: f64| side + grows * (x - t).exp() + decays * (t - x).exp() + forced * (w * x).sin();
        let velocity = |x: f64| grows * (x - t).exp() - decays * (t - x).exp() + forced * w * (w * x).cos();
        let time = |k: usize| t + (end - t) * k as f64 / 2000.0;
        let Some(k) = (1..=2000).find(|&k| side * rotation(time(k)) < 0.0) else {
            (y, v) = (rotation(end), velocity(end));
            break;
        };
        let (mut before, mut after) = (time(k - 1), time(k));
        for _ in 0..80 {
            let middle = 0.5 * (before + after);
            if side * rotation(middle) < 0.0 { after = middle } else { before = middle }
        }
        (y, v, t, side, impacts) = (0.0, eta * velocity(after), after, -side, impacts + 1);
    }
    // Free rocking: (y - s)^2 - v^2 is constant, and an impact reduces v.
    loop {
        if side * (y - side + v) > 0.0 {
            return Some(impacts);
        }
        let squared = 1.0 - (y - side).powi(2) + v * v;
        if impacts > 40 {
            return None;
        }
        (y, v, side, impacts) = (0.0, -side * eta * squared.max(0.0).sqrt(), -side, impacts + 1);
    }
}

#[test]
fn a_sine_pulse_overturns_after_an_impact_then_not_and_then_without_one() {
    // The two modes of Zhang & Makris (2001) and the safe window between them, w = wp/p.
    let (scan, steps) = (Scan::new(1.1, 15.0, 60), 4000);
    for (w, eta) in [(3.0, 0.9), (4.0, 0.9), (5.0, 0.9), (6.0, 0.92)] {
        let block = Structure::new("block", 1.5, ALPHA, eta).unwrap();
        let samples: Vec<f64> =
            (0..=steps).map(|k| (2.0 * PI * f64::from(k) / f64::from(steps)).sin()).collect();
        let dt = 2.0 * PI / w / f64::from(steps) / block.p_rad_s;
        let found = capacity(&scan, &block, &samples, dt);
        let [SafeWindow { low, high: Some(high) }] = found.windows[..] else { panic!("{found:?}") };
        for (edge, below, above) in
            [(found.overturning.unwrap(), None, Some(1)), (low, Some(1), None), (high, None, Some(0))]
        {
            let near = |share: f64| overturns_under_sine(edge * share, w, eta);
            assert_eq!((near(1.0 - 1.1e-3), near(1.0 + 1.1e-3)), (below, above), "{w} {eta} {edge}");
        }
    }
}

#[test]
fn similar_blocks_have_the_same_capacity() {
    let scan = Scan::new(1.0, 30.0, 30);
    let pulse = |t: f64| (2.0 * PI * t).sin() * (-(t - 1.5).powi(2)).exp();
    let samples: Vec<f64> = (0..=1500).map(|k| pulse(f64::from(k) / 500.0)).collect();
    let largest = samples.iter().fold(0.0_f64, |largest, a| a.abs().max(largest));
    let samples: Vec<f64> = samples.iter().map(|a| a / largest).collect();
    let of = |p: f64| {
        let block = Structure::new("block", p, 0.2, 0.9).unwrap();
        capacity(&scan, &block, &samples, 2.4 / 500.0 / p)
    };
    let [slow, fast] = [of(0.7), of(3.1)];
    assert_eq!(slow.status, CapacityStatus::Overturns);
    assert!(!slow.windows.is_empty(), "{slow:?}");
    assert_eq!(slow, fast);
}

/// A scan of a structure that overturns in these ranges, after this many impacts.
fn scan_of(scan: &Scan, ranges: &[(f64, f64, u32)]) -> Vec<ScanResponse> {
    let of = |point: &ScanPoint| {
        let range = ranges.iter().find(|(low, high, _)| (*low..*high).contains(&point.intensity));
        match range {
            Some(&(_, _, impacts)) => Response { outcome: Outcome::Overturned, impacts },
            None => Response { outcome: Outcome::SafeRocking(0.9), impacts: 2 },
        }
    };
    let respond = |points: &[ScanPoint]| Ok::<_, std::convert::Infallible>(points.iter().map(of).collect());
    scan.run(1, respond).unwrap().remove(0)
}

#[test]
fn all_windows_that_are_wide_enough_are_found() {
    let scan = Scan::new(1.0, 100.0, 8);
    close(scan.ratio, 100.0_f64.powf(1.0 / 8.0), 1e-12);
    close(scan.finest_ratio(), 100.0_f64.powf(1.0 / 128.0), 1e-12);
    assert_eq!((scan.levels.len(), scan.levels[0], scan.levels[8]), (9, 1.0, 100.0));
    // A narrow overturning range, a window between two modes, and a window at the end of the scan.
    let found = scan.capacity(&scan_of(&scan, &[(2.0, 2.1, 1), (3.0, 5.0, 1), (5.2, 50.0, 0)]));
    close(found.overturning.unwrap(), 2.0, 1e-3);
    close(found.safe_below.unwrap(), 2.0, 1e-3);
    let edges = [(2.1, Some(3.0)), (5.0, Some(5.2)), (50.0, None)];
    assert_eq!(found.windows.len(), edges.len(), "{found:?}");
    for (window, (low, high)) in found.windows.iter().zip(edges) {
        close(window.low, low, 1e-3);
        assert_eq!(window.high.is_some(), high.is_some());
        close(window.high.unwrap_or(1.0), high.unwrap_or(1.0), 1e-3);
    }
}

#[test]
fn shares_are_those_of_the_logarithm_of_the_intensity() {
    let scan = Scan::new(1.0, 16.0, 4);
    let responses = scan_of(&scan, &[(1.1, 1.3, 2), (1.5, 1.6, 2), (2.5, 7.0, 2)]);
    let shares = scan.overturning_shares(&responses);
    let part = |low: f64, high: f64| (high / low).ln() / 2.0_f64.ln();
    let expected = [part(1.1, 1.3) + part(1.5, 1.6), part(2.5, 4.0), part(4.0, 7.0), 0.0];
    for (share, expected) in shares.iter().zip(expected) {
        assert!((share - expected).abs() < 4e-3, "{shares:?}");
    }
    assert_eq!(shares.len(), 4);
}
