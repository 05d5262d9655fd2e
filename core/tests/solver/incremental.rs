//! Incremental dynamic analysis: scans against closed forms and known ranges.

use std::convert::Infallible;
use std::f64::consts::PI;

use rockfrag_core::rocking::{
    Capacity, CapacityStatus, Outcome, Response, SafeWindow, Scan, ScanPoint, ScanResponse, Structure,
};

use crate::shared::{Row, close, respond, rows};

/// So slender that the equation of motion is linear.
const SLENDER: f64 = 1e-5;

fn scan_by(scan: &Scan, of: impl Fn(&ScanPoint) -> Response) -> Vec<ScanResponse> {
    let respond = |points: &[ScanPoint]| Ok::<_, Infallible>(points.iter().map(&of).collect());
    scan.run(1, respond).unwrap().remove(0)
}

/// Capacity, as PGA/(g tan alpha), of a block under samples whose largest is 1.
fn capacity(scan: &Scan, block: &Structure, samples: &[f64], dt: f64) -> Capacity {
    let of = |point: &ScanPoint| {
        let unit = point.intensity * block.uplift_acceleration_m_s2();
        respond(block, &samples.iter().map(|a| unit * a).collect::<Vec<f64>>(), dt)
    };
    scan.capacity(&scan_by(scan, of))
}

#[test]
fn a_rectangular_pulse_overturns_from_the_amplitude_of_the_linear_equation_on() {
    // With time in 1/p, the unstable mode u = (theta + theta'/p)/alpha - 1 of a block that moves to one side
    // obeys u' = u + A(t) from u = -1: it overturns where the integral of A(t) exp(-t) exceeds 1. The pulse
    // ends with a ramp of one step.
    let block = Structure::new("block", 2.0, SLENDER, 0.9).unwrap();
    for duration in [0.3, 0.8, 2.0_f64] {
        let step = duration / 400.0;
        let samples = [vec![1.0; 401], vec![0.0; 4]].concat();
        let ramp = 1.0 + (-step).exp_m1() / step;
        let least = 1.0 / (1.0 - (-duration).exp() + (-duration).exp() * ramp);
        let found = capacity(&Scan::new(0.5, 20.0, 20), &block, &samples, step / block.p_rad_s);
        assert_eq!((found.status, &found.windows[..]), (CapacityStatus::Overturns, &[][..]));
        let (safe, overturning) = (found.safe_below.unwrap(), found.overturning.unwrap());
        assert!(safe < least * (1.0 + 3e-5) && least * (1.0 - 3e-5) < overturning, "{found:?}, {least}");
        close(safe, overturning, 1e-3);
    }
}

#[test]
fn a_sine_pulse_overturns_after_an_impact_then_not_and_then_without_one() {
    // The two modes of Zhang & Makris (2001) and the window between them (scripts/reference/one_sine.py).
    let (scan, steps) = (Scan::new(1.1, 15.0, 60), 4000);
    let samples: Vec<f64> = (0..=steps).map(|k| (2.0 * PI * f64::from(k) / f64::from(steps)).sin()).collect();
    let block = Structure::new("block", 1.5, SLENDER, 0.9).unwrap();
    let edges: Vec<Row> = rows("rocking/one_sine.csv");
    for edges in edges[..9].chunks(3) {
        let dt = 2.0 * PI / edges[0].get::<f64>("w_p") / f64::from(steps) / block.p_rad_s;
        let found = capacity(&scan, &block, &samples, dt);
        assert_eq!(found.status, CapacityStatus::Overturns);
        let [SafeWindow { low, high: Some(high) }] = found.windows[..] else { panic!("{found:?}") };
        for (found, edge) in [found.overturning.unwrap(), low, high].into_iter().zip(edges) {
            close(found, edge.get("r"), 1.1e-3);
        }
    }
}

/// A scan of a structure that overturns in these ranges.
fn scan_of(scan: &Scan, ranges: &[(f64, f64)]) -> Vec<ScanResponse> {
    scan_by(scan, |point| {
        let overturns = ranges.iter().any(|(low, high)| (*low..*high).contains(&point.intensity));
        let outcome = if overturns { Outcome::Overturned } else { Outcome::SafeRocking(0.9) };
        Response { outcome, impacts: 2 }
    })
}

#[test]
fn all_windows_that_are_wide_enough_are_found() {
    let scan = Scan::new(1.0, 100.0, 8);
    close(scan.ratio, 100.0_f64.powf(1.0 / 8.0), 1e-12);
    close(scan.finest_ratio(), 100.0_f64.powf(1.0 / 128.0), 1e-12);
    assert_eq!((scan.levels.len(), scan.levels[0], scan.levels[8]), (9, 1.0, 100.0));
    // A narrow overturning range, a window between two modes, and a window at the end of the scan.
    let found = scan.capacity(&scan_of(&scan, &[(2.0, 2.1), (3.0, 5.0), (5.2, 50.0)]));
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
    let responses = scan_of(&scan, &[(1.1, 1.3), (1.5, 1.6), (2.5, 7.0)]);
    let shares = scan.overturning_shares(&responses);
    let part = |low: f64, high: f64| (high / low).ln() / 2.0_f64.ln();
    let expected = [part(1.1, 1.3) + part(1.5, 1.6), part(2.5, 4.0), part(4.0, 7.0), 0.0];
    for (share, expected) in shares.iter().zip(expected) {
        assert!((share - expected).abs() < 4e-3, "{shares:?}");
    }
    assert_eq!(shares.len(), 4);
}
