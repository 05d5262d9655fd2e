//! Bent curves against statsmodels and scipy (scripts/reference/bent.py), and what they are for.

use rockfrag::fragility::overturning::{Curve, CurveOptions, Pair};
use rockfrag::fragility::{
    Bend, Case, CaseTable, CurveModel, Event, HeldOut, JointPeaks, Measure, Peak, Predictor, Uncertainty,
    unwatched,
};
use rockfrag::motion::IntensityMeasures;
use rockfrag::resampling::{Strata, bootstrap};
use rockfrag::rocking::Outcome;
use rockfrag::statistics::{Estimator, FitStatus, Link, binary_regression};

use crate::paper_model::equipment;

fn rows(file: &str) -> Vec<Vec<f64>> {
    let path = format!("{}/tests/reference/fits/{file}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    text.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect()
}

/// With these two measures.
fn measures(im4: f64, im3: f64) -> IntensityMeasures {
    let structure = equipment();
    let pga = im4 * structure.uplift_acceleration_m_s2();
    IntensityMeasures::new(&structure, pga, pga / (structure.p_rad_s * im3), None, None)
}

fn case(row: &[f64]) -> Case {
    let overturned = row[3] == 1.0;
    let outcome = if overturned { Outcome::Overturning } else { Outcome::SafeRocking };
    Case { outcome, edp: if overturned { f64::INFINITY } else { 0.2 }, measures: measures(row[0], row[1]) }
}

fn fitted(cases: &[Case], cells: &[usize], replicates: usize) -> Curve {
    let group = CaseTable::of(cases, cells, cells);
    let options = CurveOptions {
        event: Event::Overturning,
        pairs: vec![Pair(Measure::Im4, Measure::Im3Inverse)],
        model: CurveModel::default(),
        uncertainty: Uncertainty { replicates, confidence: 0.95, seed: 1 },
    };
    let Ok(curves) = options.fit(&[&group], &unwatched);
    curves.into_iter().next().unwrap().pop().unwrap()
}

#[test]
fn the_bent_curve_and_its_errors_are_those_of_statsmodels() {
    let (data, answers) = (rows("bent_cases.csv"), rows("bent_answers.csv"));
    let cases: Vec<Case> = data.iter().map(|row| case(row)).collect();
    let cells: Vec<usize> = data.iter().map(|row| row[2] as usize).collect();
    let curve = fitted(&cases, &cells, 0);
    let bent = curve.bent_answer().expect("the tests reject the line, and the bent curve does better");
    assert_eq!(curve.status(), FitStatus::Misfit);
    let straight = Predictor {
        im_x: Measure::Im4,
        im_y: Some(Measure::Im3Inverse),
        coefficients: [bent.coefficients[0], bent.coefficients[1], bent.coefficients[2]],
        covariance: [[0.0; 3]; 3],
        ranges: [[0.0, 100.0]; 2],
        bend: None,
        spread: 0.0,
    };
    let bends = [bent.coefficients[3], bent.coefficients[4], bent.coefficients[5]];
    let bend = Bend { knots: bent.knots, coefficients: bends, covariance: bent.covariance };
    let index = Predictor { bend: Some(bend), ..straight };
    for (case, answer) in cases.iter().step_by(10).zip(&answers) {
        let said = index.at(&case.measures).unwrap();
        assert!((said.value - answer[0]).abs() < 2e-5, "{} for scipy's {}", said.value, answer[0]);
        assert!((said.value - answer[1]).abs() < 0.01, "{} for statsmodels' {}", said.value, answer[1]);
        let error = said.variance.sqrt();
        assert!((error / answer[2] - 1.0).abs() < 0.05, "{error} for statsmodels' {}", answer[2]);
    }
    // What is off is what was put in: the cells differ by 0.4.
    let spread = bent.held_out.unwrap().spread;
    assert!((0.25..0.65).contains(&spread), "{spread}");
    assert!(bent.held_out.unwrap().log_score > curve.held_out.unwrap().log_score);
}

#[test]
fn the_spread_between_cells_is_that_of_adaptive_quadrature() {
    let (data, answers) = (rows("bent_cases.csv"), rows("bent_answers.csv"));
    let column = |k: usize| data.iter().map(|row| row[k]).collect::<Vec<f64>>();
    let cells: Vec<usize> = column(2).iter().map(|cell| *cell as usize).collect();
    let happened: Vec<bool> = column(3).iter().map(|event| *event == 1.0).collect();
    let found = HeldOut::of_indices(&column(4), &happened, &cells, Link::Probit).unwrap().spread;
    // Those that are tried are 8.5 % apart.
    assert!((found / answers[0][3] - 1.0).abs() < 0.05, "{found} for {}", answers[0][3]);
    let each_its_own: Vec<usize> = (0..cells.len()).collect();
    assert_eq!(HeldOut::of_indices(&column(4), &happened, &each_its_own, Link::Probit), None);
}

#[test]
fn resamples_of_the_bent_curve_spread_as_its_errors_within_cells() {
    let data = rows("bent_cases.csv");
    let cases: Vec<Case> = data.iter().map(|row| case(row)).collect();
    // Each case a cell of its own kind: the sandwich is then that of independent cases.
    let cells: Vec<usize> = (0..cases.len()).map(|case| case % 600).collect();
    let curve = fitted(&cases, &cells, 200);
    let bent = curve.bent_answer().unwrap();
    let replicates: Vec<[f64; 6]> = curve.bent_replicates.iter().flatten().copied().collect();
    assert_eq!(replicates.len(), 200);
    for k in [1, 2] {
        let values: Vec<f64> = replicates.iter().map(|b| b[k]).collect();
        let mean = values.iter().sum::<f64>() / 200.0;
        let sd = (values.iter().map(|b| (b - mean).powi(2)).sum::<f64>() / 199.0).sqrt();
        let error = bent.covariance[k][k].sqrt();
        // Two of a cell are drawn from two, which halves the variance.
        let ratio = sd / error;
        assert!((0.55..1.2).contains(&ratio), "{sd} for {error}");
    }
}

#[test]
fn refits_of_the_bent_curve_are_those_of_repeated_cases() {
    let data = rows("bent_cases.csv");
    let cases: Vec<Case> = data.iter().map(|row| case(row)).collect();
    let cells: Vec<usize> = data.iter().map(|row| row[2] as usize).collect();
    let curve = fitted(&cases, &cells, 200);
    let bent = curve.bent_answer().unwrap();
    let terms = |row: &Vec<f64>| {
        let (x, y) = (row[0].ln(), -row[1].ln());
        let [spline_x, spline_y, product] = Bend::terms(&bent.knots, x, Some(y));
        [1.0, x, y, spline_x, spline_y, product]
    };
    let designs: Vec<[f64; 6]> = data.iter().map(terms).collect();
    let index = |b: &[f64; 6], x: &[f64; 6]| b.iter().zip(x).map(|(b, x)| b * x).sum::<f64>();
    let error = |x: &[f64; 6]| index(&bent.covariance.map(|row| index(&row, x)), x).sqrt();
    let exact = bootstrap(&Strata::new(&cells), 200, 1, |resamples| {
        std::array::from_fn(|resample| {
            let counts = resamples.counts.iter().map(|counts| counts[resample] as usize);
            let repeated: Vec<usize> =
                counts.enumerate().flat_map(|(row, count)| std::iter::repeat_n(row, count)).collect();
            let column = |k: usize| repeated.iter().map(|&row| designs[row][k]).collect::<Vec<f64>>();
            let columns: Vec<Vec<f64>> = (1..6).map(column).collect();
            let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
            let events: Vec<bool> = repeated.iter().map(|&row| data[row][3] == 1.0).collect();
            let fit = binary_regression(&columns, &events, Link::Probit, Estimator::Ml).unwrap();
            std::array::from_fn::<f64, 6, _>(|k| fit.coefficients[k])
        })
    });
    let mut apart = Vec::new();
    for (refit, exact) in curve.bent_replicates.iter().zip(&exact) {
        let refit = refit.unwrap();
        let of_case = |x: &[f64; 6]| ((index(&refit, x) - index(exact, x)) / error(x)).abs();
        let mut of_cases: Vec<f64> = designs.iter().map(of_case).collect();
        of_cases.sort_by(f64::total_cmp);
        apart.push(of_cases[of_cases.len() * 19 / 20]);
    }
    apart.sort_by(f64::total_cmp);
    assert!(apart[199] < 0.03, "{} standard errors apart", apart[199]);
}

#[test]
fn a_resample_of_every_case_is_the_bent_curve_itself() {
    let data = rows("bent_cases.csv");
    let cases: Vec<Case> = data.iter().map(|row| case(row)).collect();
    // Of a cell of its own each case is drawn once. With its penalty the likelihood is then greatest where it was.
    let cells: Vec<usize> = (0..cases.len()).collect();
    let curve = fitted(&cases, &cells, 8);
    let bent = curve.bent_answer().unwrap();
    for refit in &curve.bent_replicates {
        for (refit, fitted) in refit.unwrap().iter().zip(&bent.coefficients) {
            assert!((refit / fitted - 1.0).abs() < 1e-6, "{refit} for {fitted}");
        }
    }
}

#[test]
fn a_peak_says_of_the_ratio_what_a_regression_says() {
    let n = 400;
    let ln_pga: Vec<f64> = (0..n).map(|k| -1.0 + 3.0 * f64::from(k) / f64::from(n)).collect();
    // A straight line with a wiggle as large above as below.
    let ln_ratio: Vec<f64> = ln_pga
        .iter()
        .enumerate()
        .map(|(k, u)| -2.0 + 0.3 * u + if k % 2 == 0 { 0.4 } else { -0.4 })
        .collect();
    let pga: Vec<f64> = ln_pga.iter().map(|u| u.exp()).collect();
    let pgv: Vec<f64> = ln_pga.iter().zip(&ln_ratio).map(|(u, r)| (u + r).exp()).collect();
    let peaks = JointPeaks::of(&pga, &pgv).unwrap();
    for (intensity, deviations) in [(0.5f64, 0.0), (1.0, 1.0), (5.0, -1.0), (20.0, 0.0)] {
        let expected = -2.0 + 0.3 * intensity.ln() + 0.4 * deviations;
        let found = peaks.pgv_over_pga(Peak::Pga, intensity, deviations).ln();
        assert!((found - expected).abs() < 0.01, "{found} for {expected}");
    }
    assert_eq!(JointPeaks::of(&pga[..2], &pgv[..2]), None);
    assert_eq!(JointPeaks::of(&[1.0, 2.0, 0.0], &[0.1, 0.2, 0.3]), None);
}
