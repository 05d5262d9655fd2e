//! Fits in a folder: which row answers for a structure.

use std::path::Path;

use rockfrag::pipeline::context::Context;
use rockfrag::stages::shared::model_args::{ModelArgs, ModelName};
use rockfrag::table::rows::Row;
use rockfrag_core::fragility::{
    Calibration, Cases, Event, Measure, Model, MotionKind, Predictors, fit_curves, fit_demand,
};
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::Warning;

#[allow(dead_code, reason = "the fits of core need the rest")]
#[path = "../core/tests/fits/common.rs"]
mod common;
#[path = "../core/tests/shared/mod.rs"]
mod shared;

use common::{equipment, rocking};

/// Writes the fits of the equipment under these suites.
fn folder(suites: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let of_suite = |suite: &&str| {
        let mut cases = rocking(600);
        cases.suite = Some(suite.to_string());
        cases
    };
    let all: Vec<Cases> = suites.iter().map(of_suite).collect();
    let pairs = [Predictors::two([Measure::Im4, Measure::Im3Inverse])];
    let curves = |of: &Cases| fit_curves(of, Event::Overturning, &pairs, false);
    let planes = |of: &Cases| fit_demand(of, Some(1.3), 0.95, &[], true);
    let write = |name: &str, write: &dyn Fn(&Path)| write(&folder.path().join(name));
    fn put<R: Row>(path: &Path, rows: Vec<R>) {
        let context = Context::default();
        context.write(path, &rows, "").unwrap();
        context.persist().unwrap();
    }
    write("pro.calibration.parquet", &|path| {
        put(path, all.iter().map(|of| Calibration::fit(of, None)).collect())
    });
    write("pex.calibration.parquet", &|path| {
        put(path, all.iter().map(|of| Calibration::fit(of, Some(0.1))).collect());
    });
    write("pro.parquet", &|path| put(path, all.iter().flat_map(curves).collect()));
    write("pex.parquet", &|path| put(path, all.iter().flat_map(planes).collect()));
    folder
}

fn args(folder: &tempfile::TempDir) -> ModelArgs {
    ModelArgs {
        fits: Some(folder.path().to_path_buf()),
        name: None,
        suite: None,
        model: ModelName::Calibrated,
        limit_state: 0.1,
    }
}

fn error(args: &ModelArgs) -> String {
    args.read().and_then(|models| models.model(&equipment())).unwrap_err().to_string()
}

#[test]
fn the_row_of_the_same_structure_answers_by_either_model() {
    let folder = folder(&["csgm"]);
    let args = args(&folder);
    let near = Structure::new("mine", 2.51, 0.201, 0.925).unwrap();
    let (model, warnings) = args.read().unwrap().model(&near).unwrap();
    let Model::Surface { overturning, exceeding, .. } = model else { panic!() };
    assert_eq!((overturning, exceeding.limit_state), (Calibration::fit(&rocking(600), None), Some(0.1)));
    assert_eq!(warnings, []);
    let paper = ModelArgs { model: ModelName::Paper, ..args };
    let (Model::Paper { demand, overturning, .. }, _) = paper.read().unwrap().model(&near).unwrap() else {
        panic!()
    };
    assert_eq!((demand.len(), overturning.im_y), (2, Some(Measure::Im3Inverse)));
}

#[test]
fn a_structure_that_is_not_there_gets_the_surface_unless_it_is_named() {
    let folder = folder(&["csgm"]);
    let other = Structure::new("other", 1.0, 0.15, 0.92).unwrap();
    let (model, warnings) = args(&folder).read().unwrap().model(&other).unwrap();
    assert_eq!(
        (model, warnings),
        (Model::uncalibrated(MotionKind::Csgm, &other, 0.1), vec![Warning::NotFitted])
    );
    let named = ModelArgs { name: Some("equipment".to_string()), ..args(&folder) };
    let (Model::Surface { overturning, .. }, _) = named.read().unwrap().model(&other).unwrap() else {
        panic!()
    };
    assert_eq!(overturning.structure, "equipment");
    let unknown = ModelArgs { name: Some("shelf".to_string()), ..args(&folder) };
    assert!(error(&unknown).contains("no structure 'shelf'; expected one of equipment"));
    let without = ModelArgs { fits: None, ..args(&folder) };
    let (model, warnings) = without.read().unwrap().model(&other).unwrap();
    assert_eq!((model, warnings), (Model::uncalibrated(MotionKind::Recorded, &other, 0.1), vec![]));
}

#[test]
fn what_cannot_be_chosen_is_an_error_that_tells_what_to_do() {
    let folder = folder(&["csgm", "pulse"]);
    assert!(error(&args(&folder)).ends_with("fits of csgm, pulse; expected --suite with one of them"));
    let pulses = ModelArgs { suite: Some(MotionKind::Pulse), ..args(&folder) };
    let (Model::Surface { overturning, .. }, _) = pulses.read().unwrap().model(&equipment()).unwrap() else {
        panic!()
    };
    assert_eq!(overturning.kind, MotionKind::Pulse);
    let recorded = ModelArgs { suite: Some(MotionKind::Recorded), ..pulses.clone() };
    assert!(error(&recorded).ends_with("no fits of recorded, only of csgm, pulse"));
    let limit = ModelArgs { limit_state: 0.3, ..pulses };
    assert!(error(&limit).ends_with("run fit-pex --limit-state 0.1,0.3"), "{}", error(&limit));
}
