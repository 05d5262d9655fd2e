//! The curve of one structure on another, and curves of all: closed forms, and answers of statsmodels.

use std::collections::HashMap;

use rockfrag::fragility::{Case, DemandModel, Event, PLANE, Sample};
use rockfrag::keyword::Keyword;
use rockfrag::motion::IntensityMeasures;
use rockfrag::normal;
use rockfrag::rocking::Outcome;
use rockfrag::statistics::FitStatus;
use rockfrag::studies::{
    Curve, CurveForm, CurveSubject, PooledStructure, PooledTerms, Transfer, Verdict, calibration_slope,
    fit_pooled,
};

/// structure, ln p, ln alpha, eta, im4, im3, overturned, edp
type Row = (usize, f64, f64, f64, f64, f64, u8, f64);

fn read<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    let path = format!("{}/tests/reference/fits/{name}", env!("CARGO_MANIFEST_DIR"));
    csv::Reader::from_path(path).unwrap().into_deserialize().map(Result::unwrap).collect()
}

fn case(&(.., im4, im3, overturned, edp): &Row) -> Case {
    let measures = IntensityMeasures { im1: None, im2: None, im3: Some(im3), im4, im5: im4 / im3, im6: None };
    let outcome = if overturned == 1 { Outcome::Overturning } else { Outcome::SafeRocking };
    Case { outcome, edp, measures }
}

/// P_ex in one plane: the transition lies below all cases.
fn subject(event: Event) -> CurveSubject {
    CurveSubject { event, form: CurveForm::Hybrid { transition: 1.01 }, limit: 0.10 }
}

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance * (1.0 + expected.abs()), "{value} is not {expected}");
}

#[test]
fn pooled_curves_equal_those_of_statsmodels() {
    let rows: Vec<Row> = read("pooled.csv");
    let answers: Vec<(String, String, String, f64)> = read("pooled_answers.csv");
    let answers: HashMap<_, f64> = answers.into_iter().map(|(a, b, c, value)| ((a, b, c), value)).collect();
    let groups: Vec<Vec<Row>> = rows.chunk_by(|a, b| a.0 == b.0).map(<[Row]>::to_vec).collect();
    let cases: Vec<Vec<Case>> = groups.iter().map(|rows| rows.iter().map(case).collect()).collect();
    let parameters = groups.iter().map(|rows| (rows[0].1, rows[0].2, rows[0].3));
    let structures: Vec<PooledStructure> = cases
        .iter()
        .zip(parameters)
        .map(|(cases, (ln_p, ln_alpha, eta))| PooledStructure { cases, ln_p, ln_alpha, eta })
        .collect();
    for event in Event::BRANCHES {
        for &terms in PooledTerms::ALL {
            let fit = fit_pooled(&subject(event), &structures, terms).unwrap();
            let answer = |quantity: String| {
                answers[&(event.as_str().to_string(), terms.as_str().to_string(), quantity)]
            };
            let part = fit.parts.last().unwrap();
            let named = |key: &&(String, String, String)| {
                key.0 == event.as_str() && key.1 == terms.as_str() && key.2.starts_with("coefficient")
            };
            assert_eq!(part.terms.len(), answers.keys().filter(named).count());
            for (k, term) in part.terms.iter().enumerate() {
                close(term.coefficient, answer(format!("coefficient {k}")), 1e-7);
                close(term.standard_error, answer(format!("error {k}")), 1e-6);
            }
            for (k, log_score) in fit.log_scores.iter().enumerate() {
                close(log_score.unwrap(), answer(format!("log score {k}")), 1e-6);
            }
        }
    }
    let indices: Vec<f64> = rows.iter().map(|row| -2.5 + 2.0 * row.4.ln()).collect();
    let happened: Vec<bool> = rows.iter().map(|row| row.6 == 1).collect();
    let key = ("overturning".to_string(), String::new(), "slope".to_string());
    close(calibration_slope(&indices, &happened).unwrap(), answers[&key], 1e-7);
}

#[test]
fn a_slope_needs_outcomes_that_overlap() {
    assert_eq!(calibration_slope(&[-1.0, 0.0, 1.0], &[false, false, true]), None);
    assert_eq!(calibration_slope(&[0.5, 0.5, 0.5], &[false, true, true]), None);
    assert_eq!(calibration_slope(&[-1.0, 0.0, 1.0], &[true, true, true]), None);
}

fn cases_and_cells() -> (Vec<Case>, Vec<usize>) {
    let rows: Vec<Row> = read("pooled.csv");
    (rows.iter().map(case).collect(), (0..rows.len()).map(|row| row % 20).collect())
}

#[test]
fn a_curve_holds_for_its_own_structure() {
    let (cases, cells) = cases_and_cells();
    for event in Event::BRANCHES {
        let transfer = Transfer::new(&subject(event), &cases, &cases, &cells).unwrap().unwrap();
        let own = transfer.own.as_ref().unwrap();
        assert_eq!((own.loss.value, own.mean_error, own.worst_over, own.worst_under), (0.0, 0.0, 0.0, 0.0));
        assert_eq!((transfer.share_lost(), transfer.verdict()), (Some(0.0), Verdict::Holds));
    }
}

#[test]
fn each_side_of_the_transition_has_its_own_plane() {
    let (cases, _) = cases_and_cells();
    let (transition, limit) = (2.0, 0.1);
    let form = CurveForm::Hybrid { transition };
    let curve = CurveSubject { event: Event::Exceeding, form, limit }.fit(&cases).unwrap();
    let Curve::Exceeding { demand: DemandModel::Biplanar { low, high, .. }, .. } = curve else {
        panic!("{curve:?}")
    };
    for (law, range) in [(low, 0.0..transition), (high, transition..f64::INFINITY)] {
        let fit = Sample::of_demands(&cases, &PLANE, range).fit().unwrap();
        assert_eq!(law.ln_median.coefficients, [0, 1, 2].map(|k| fit.coefficients[k].value));
        assert_eq!((law.beta, law.degrees), (fit.residual_sd, (fit.n - 3) as f64));
    }
}

#[test]
fn a_structure_that_fails_earlier_is_underestimated_by_the_shift() {
    let (cases, cells) = cases_and_cells();
    let weaker = |case: &Case| {
        let mut case = *case;
        case.measures.im4 /= 3.0;
        case
    };
    let others: Vec<Case> = cases.iter().map(weaker).collect();
    let subject = subject(Event::Overturning);
    let transfer = Transfer::new(&subject, &cases, &others, &cells).unwrap().unwrap();
    let own = transfer.own.as_ref().unwrap();
    let Ok(Curve::Overturning(curve)) = subject.fit(&cases) else { panic!("no curve") };
    let shift = curve.coefficients[1] * 3f64.ln();
    let error = |case: &Case| {
        let index = curve.at(&case.measures).unwrap().value;
        normal::cdf(index) - normal::cdf(index - shift)
    };
    close(own.worst_under, cases.iter().map(error).fold(0.0, f64::max), 1e-8);
    close(own.mean_error, cases.iter().map(error).sum::<f64>() / cases.len() as f64, 1e-8);
    assert_eq!(own.worst_over, 0.0);
    assert!(own.loss.value > 3.0 * own.loss.standard_error && transfer.verdict() != Verdict::Holds);
    assert!(transfer.validation.calibration.unwrap() > 0.0, "log odds are too low");
}

#[test]
fn a_structure_without_events_is_counted_but_not_judged() {
    let (cases, cells) = cases_and_cells();
    let safe: Vec<Case> = cases.iter().map(|case| Case { outcome: Outcome::SafeRocking, ..*case }).collect();
    let subject = subject(Event::Overturning);
    let transfer = Transfer::new(&subject, &cases, &safe, &cells).unwrap().unwrap();
    assert_eq!((transfer.validation.seen, transfer.own.as_ref().err()), (0, Some(&FitStatus::TooFewEvents)));
    assert_eq!(transfer.verdict(), Verdict::TooFewEvents);
    assert_eq!(Transfer::new(&subject, &safe, &cases, &cells), Err(FitStatus::TooFewEvents));
}
