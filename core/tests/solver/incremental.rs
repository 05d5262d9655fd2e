//! Incremental dynamic analysis: scans against closed forms and known ranges.

use std::convert::Infallible;

use rockfrag_core::rocking::{
    CapacityStatus, Outcome, Response, SafeWindow, Scan, ScanPoint, ScanResponse, Structure,
};

use crate::closed_forms::{P, sine};
use crate::shared::{Row, close, respond, rows};

fn scan_by(scan: &Scan, of: impl Fn(&ScanPoint) -> Response) -> Vec<ScanResponse> {
    let respond = |points: &[ScanPoint]| Ok::<_, Infallible>(points.iter().map(&of).collect());
    scan.run(1, respond).unwrap().remove(0)
}

#[test]
fn a_sine_pulse_overturns_after_an_impact_then_not_and_then_without_one() {
    // The two modes of Zhang & Makris (2001) and the window between them (scripts/reference/one_sine.py).
    let (scan, alpha) = (Scan::new(1.1, 15.0, 60), 1e-5);
    // So slender that the equation of motion is linear.
    let block = Structure::new("block", P, alpha, 0.9).unwrap();
    let edges: Vec<Row> = rows("rocking/one_sine.csv");
    for edges in edges[..9].chunks(3) {
        let w_p: f64 = edges[0].get("w_p");
        let found = scan.capacity(&scan_by(&scan, |point| {
            let (samples, dt) = sine(alpha, point.intensity, w_p * P, 2.0);
            respond(&block, &samples, dt)
        }));
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
