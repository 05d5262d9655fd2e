//! How often 95 % limits hold the truth, over data sets simulated from known fits. Seeds keep both from
//! failing by chance.

use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use rockfrag_core::fragility::{
    Cases, Event, Measure, PLANE, Parameter, ParameterRow, Predictors, fit_curve, fit_law,
};
use rockfrag_core::rocking::Outcome;

use crate::common::{cases, random};

/// ln EDP = -2 + 2.5 ln IM4 - ln IM3 + 0.8 noise; z of overturning = -1 + 2 ln IM4 - 1.2 ln IM3. Half of the
/// variance of the noise of demand, and 0.5 of z, is shared within a cell where `shared`.
fn simulated(seed: u64, cells: u32, shared: bool) -> [Cases; 2] {
    let mut random = random(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let of_cells: Vec<f64> = (0..cells).map(|_| if shared { normal() } else { 0.0 }).collect();
    let share = if shared { 0.5f64.sqrt() } else { 0.0 };
    let rows = (0..30 * cells).map(|k| {
        let (cell, x, y) = (k % cells, 0.4 + 0.4 * normal(), 0.4 * normal());
        let noise = share * of_cells[cell as usize] + (1.0 - share * share).sqrt() * normal();
        let safe = Outcome::SafeRocking((-2.0 + 2.5 * x - y + 0.8 * noise).exp());
        let overturns = -1.0 + 2.0 * x - 1.2 * y + 0.5 * of_cells[cell as usize] + normal() > 0.0;
        let outcome = if overturns { Outcome::Overturned } else { safe };
        [safe, outcome].map(|outcome| (outcome, x.exp(), y.exp(), cell))
    });
    let rows: Vec<_> = rows.collect();
    [0, 1].map(|k| cases(rows.iter().map(|of| of[k])))
}

/// The share of data sets in which the limits of each parameter hold its truth.
fn coverage(cells: u32, shared: bool, truths: &[(Parameter, f64)]) -> Vec<f64> {
    const SETS: u64 = 200;
    let held = |seed: u64| -> Vec<bool> {
        let [demand, overturning] = simulated(seed, cells, shared);
        let curve = fit_curve(&overturning, Event::Overturning, Measure::Im4, Some(Measure::Im3Inverse));
        let (plane, curve) =
            (fit_law(&demand, Predictors::two(PLANE)).parameters(0.95), curve.parameters(0.95));
        let holds = |&(parameter, truth): &(Parameter, f64)| {
            let rows: &[ParameterRow] = match parameter {
                Parameter::LnA | Parameter::B1 | Parameter::B2 | Parameter::Zeta => &plane,
                _ => &curve,
            };
            let row = rows.iter().find(|row| row.parameter == parameter).unwrap();
            (row.low..=row.high).contains(&truth)
        };
        truths.iter().map(holds).collect()
    };
    let held: Vec<Vec<bool>> = (0..SETS).into_par_iter().map(held).collect();
    (0..truths.len()).map(|k| held.iter().filter(|held| held[k]).count() as f64 / SETS as f64).collect()
}

#[test]
fn limits_hold_the_truth_as_often_as_they_say() {
    let truths = [
        (Parameter::LnA, -2.0),
        (Parameter::B1, 2.5),
        (Parameter::B2, -1.0),
        (Parameter::Zeta, 0.8 / 2.5),
        (Parameter::Lambda, 2.0 / 1.2),
        (Parameter::Mu, 1.0 / 3.2),
        (Parameter::Beta, 1.0 / 3.2),
    ];
    // The slope of z shrinks with the noise of cells, mu does not.
    let (all, kept) = (&truths[..], &[truths[0], truths[1], truths[5]][..]);
    // Up to nine cells widen the errors of the model where they differ, twelve are few for clustered ones.
    let sets = [(9, false, all), (9, true, kept), (12, false, all), (35, false, all), (35, true, kept)];
    for (cells, shared, truths) in sets {
        for (share, (parameter, _)) in coverage(cells, shared, truths).into_iter().zip(truths) {
            assert!((0.89..=0.99).contains(&share), "{cells} cells, {shared}: {parameter:?} in {share}");
        }
    }
}
