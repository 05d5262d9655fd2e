//! Responses as columns: what counts, clusters, and structures that are not one.

use rockfrag::fragility::{CaseRow, CasesBuilder, CasesError, Event, Measure, SharedBy};
use rockfrag::keyword::Keyword;
use rockfrag::rocking::Outcome;
use rockfrag::statistics::FitStatus;
use serde::Deserialize;
use serde::de::IntoDeserializer;

use crate::common::{cases, equipment, row};

#[test]
fn events_count_the_branches_of_the_tree() {
    let (none, safe, overturned) = (Outcome::NoRocking, Outcome::SafeRocking, Outcome::Overturning);
    for (event, expected) in [
        (Event::Rocking, [Some(false), Some(true), Some(true), Some(true)]),
        (Event::Overturning, [None, Some(false), Some(false), Some(true)]),
        (Event::Exceeding, [None, Some(false), Some(true), None]),
        (Event::Failure, [None, Some(false), Some(true), Some(true)]),
    ] {
        let happened = [(none, 0.0), (safe, 0.05), (safe, 0.2), (overturned, f64::NAN)]
            .map(|(outcome, edp)| event.happened(outcome, edp, 0.1));
        assert_eq!(happened, expected, "{event:?}");
    }
}

#[test]
fn only_cases_with_a_demand_and_all_measures_are_fitted() {
    let mut cases = cases([
        (Outcome::NoRocking, 0.0, 0.5, 1.0, 0),
        (Outcome::SafeRocking, 0.2, 1.5, 2.0, 1),
        (Outcome::SafeRocking, 0.0, 1.6, 2.0, 1),
        (Outcome::Overturning, 0.0, 3.0, 2.0, 2),
        (Outcome::SafeRocking, 1e-9, 2.5, 4.0, 2),
    ]);
    cases.raise_demands(1e-6);
    let sample = cases.sample(&[Measure::Im4, Measure::Im3Inverse], |case| cases.ln_demand(case));
    assert_eq!(sample.y, [0.2f64.ln(), 1e-6f64.ln(), 1e-6f64.ln()]);
    assert_eq!((&sample.clusters[..], &sample.ranges[..]), (&[1, 1, 2][..], &[[1.5, 2.5], [0.25, 0.5]][..]));
    assert!(cases.edp[3].is_nan() && cases.edp[0] == 0.0);
    assert!(cases.sample(&[Measure::Im1], |_| Some(())).y.is_empty());
}

#[test]
fn clusters_do_not_depend_on_the_order_of_rows() {
    let base = |edp: f64| row(Outcome::SafeRocking, edp, 1.5, 1.0, 0);
    let rows = [
        CaseRow { earthquake: Some("Kobe"), ..base(1.0) },
        CaseRow { mw: Some(6.0), re_km: Some(9.0), ..base(2.0) },
        CaseRow { mw: None, ..base(3.0) },
        CaseRow { earthquake: Some("Imperial Valley"), ..base(4.0) },
        CaseRow { mw: Some(6.0), re_km: Some(9.0), ..base(5.0) },
        CaseRow { mw: None, ..base(6.0) },
    ];
    let clusters = |order: &[usize]| {
        let mut builder = CasesBuilder::new(None, equipment(), &[]);
        order.iter().for_each(|&k| builder.push(&rows[k]).unwrap());
        let cases = builder.finish();
        (cases.cluster, cases.shared_by)
    };
    assert_eq!(clusters(&[0, 1, 2, 3, 4, 5]), (vec![1, 2, 3, 0, 2, 4], SharedBy::Earthquake));
    assert_eq!(clusters(&[4, 3, 0, 1]), (vec![2, 0, 1, 2], SharedBy::Earthquake));
    assert_eq!(clusters(&[4, 2, 1]), (vec![0, 1, 0], SharedBy::Cell));
    assert_eq!(clusters(&[5, 2]), (vec![0, 1], SharedBy::Nothing));
}

#[test]
fn another_structure_of_the_same_name_is_refused() {
    let mut builder = CasesBuilder::new(None, equipment(), &["housner".to_string()]);
    builder.push(&CaseRow { candidates: &[0.7], ..row(Outcome::NoRocking, 0.0, 0.5, 1.0, 0) }).unwrap();
    let other = CaseRow { alpha_rad: 0.19, ..row(Outcome::NoRocking, 0.0, 0.5, 1.0, 0) };
    let error = builder.push(&other).unwrap_err();
    assert!(matches!(error, CasesError::OtherStructure { parameter: "alpha", value: 0.19, first: 0.20, .. }));
    let cases = builder.finish();
    assert_eq!((cases.len(), &cases.candidates[0].1[..]), (1, &[0.7][..]));
}

#[test]
fn files_have_the_words_of_the_command_line() {
    fn check<T: Keyword + std::fmt::Debug + for<'de> Deserialize<'de>>() {
        for known in T::ALL {
            let word: serde::de::value::StrDeserializer<serde::de::value::Error> =
                known.as_str().into_deserializer();
            assert_eq!(T::deserialize(word).unwrap(), *known);
        }
    }
    check::<FitStatus>();
    check::<Measure>();
    check::<Event>();
    check::<rockfrag::fragility::DemandModel>();
    check::<rockfrag::fragility::Parameter>();
    check::<rockfrag::studies::Target>();
    check::<rockfrag::studies::Form>();
}
