//! Incremental dynamic analysis: scans against closed forms and known ranges.

use std::convert::Infallible;

use rockfrag_core::rocking::{
    Capacity, CapacityStatus, Outcome, Response, Scan, ScanPoint, ScanResponse, Structure,
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
        let responses = scan_by(&scan, |point| {
            let (samples, dt) = sine(alpha, point.intensity, w_p * P, 2.0);
            respond(&block, &samples, dt)
        });
        let found = Capacity::of(&responses);
        assert_eq!(found.status, CapacityStatus::Overturns);
        let [(low, high)] = windows(&responses)[..] else { panic!("{found:?}") };
        assert_eq!(found.safe_up_to, Some(high));
        for (found, edge) in [found.overturning.unwrap(), low, high].into_iter().zip(edges) {
            close(found, edge.get("r"), 1.1e-3);
        }
    }
}

/// Least and largest intensity of each safe range above the first overturning one.
fn windows(responses: &[ScanResponse]) -> Vec<(f64, f64)> {
    let runs = responses.chunk_by(|a, b| a.overturns() == b.overturns());
    let safe = runs.skip(1).filter(|run| !run[0].overturns());
    safe.map(|run| (run[0].intensity, run[run.len() - 1].intensity)).collect()
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
    let responses = scan_of(&scan, &[(2.0, 2.1), (3.0, 5.0), (5.2, 50.0)]);
    let found = Capacity::of(&responses);
    close(found.overturning.unwrap(), 2.0, 1e-3);
    close(found.safe_below.unwrap(), 2.0, 1e-3);
    let (windows, edges) = (windows(&responses), [(2.1, 3.0), (5.0, 5.2), (50.0, 100.0)]);
    assert_eq!(windows.len(), edges.len(), "{windows:?}");
    for (window, (low, high)) in windows.into_iter().zip(edges) {
        close(window.0, low, 1e-3);
        close(window.1, high, 1e-3);
    }
}
