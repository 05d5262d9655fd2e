//! Fits in a folder: which row answers for a structure.

use rockfrag::stages::shared::model_args::{ModelArgs, ModelName};
use rockfrag::table::rows;
use rockfrag_core::fragility::{Calibration, Measure, Model, MotionKind};
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::Warning;

use crate::paper::RUN;

/// To answer by the fits of the paper's run to combined motions.
fn args() -> ModelArgs {
    ModelArgs {
        fits: Some(RUN.path().join("out")),
        name: None,
        suite: Some(MotionKind::Csgm),
        model: ModelName::Calibrated,
        limit_state: 0.1,
    }
}

fn chosen(args: &ModelArgs, structure: &Structure) -> (Model, Vec<Warning>) {
    args.read().unwrap().model(structure).unwrap()
}

/// The calibration by which a surface answers.
fn calibration(args: &ModelArgs, structure: &Structure) -> Calibration {
    let (Model::Surface { overturning, .. }, _) = chosen(args, structure) else { panic!("no surface") };
    overturning
}

/// That of the equipment under these motions.
fn stored(kind: MotionKind) -> Calibration {
    let all: Vec<Calibration> = rows::read(&RUN.path().join("out/pro.calibration.parquet")).unwrap();
    let mut its =
        all.into_iter().filter(|row| row.kind == kind && row.structure.name == "electrical-equipment");
    its.next().unwrap()
}

#[test]
fn the_row_of_the_same_structure_answers_by_either_model() {
    let near = Structure::new("mine", 2.51, 0.201, 0.925).unwrap();
    let (model, warnings) = chosen(&args(), &near);
    let Model::Surface { overturning, exceeding, .. } = model else { panic!("no surface") };
    assert_eq!((overturning, exceeding.limit_state), (stored(MotionKind::Csgm), Some(0.1)));
    assert_eq!(warnings, []);
    let pulses = ModelArgs { suite: Some(MotionKind::Pulse), ..args() };
    assert_eq!(calibration(&pulses, &near), stored(MotionKind::Pulse));
    let paper = ModelArgs { model: ModelName::Paper, ..args() };
    let (Model::Paper { demand, overturning, .. }, _) = chosen(&paper, &near) else { panic!("no curve") };
    assert_eq!((demand.len(), overturning.im_y), (2, Some(Measure::Im3Inverse)));
}

#[test]
fn a_structure_that_is_not_there_gets_the_surface_unless_it_is_named() {
    let other = Structure::new("other", 1.8, 0.15, 0.92).unwrap();
    let uncalibrated = |kind| Model::uncalibrated(kind, &other, 0.1);
    assert_eq!(chosen(&args(), &other), (uncalibrated(MotionKind::Csgm), vec![Warning::NotFitted]));
    let named = ModelArgs { name: Some("electrical-equipment".to_string()), ..args() };
    assert_eq!(calibration(&named, &other), stored(MotionKind::Csgm));
    let without = ModelArgs { fits: None, suite: None, ..args() };
    assert_eq!(chosen(&without, &other), (uncalibrated(MotionKind::Recorded), vec![]));
}

#[test]
fn what_cannot_be_chosen_is_an_error_that_tells_what_to_do() {
    let equipment = Structure::new("electrical-equipment", 2.5, 0.2, 0.92).unwrap();
    for (args, told) in [
        (ModelArgs { suite: None, ..args() }, "--suite"),
        (ModelArgs { suite: Some(MotionKind::Recorded), ..args() }, "fits of csgm"),
        (ModelArgs { limit_state: 0.3, ..args() }, "--limit-state 0.3"),
        (ModelArgs { name: Some("shelf".to_string()), ..args() }, "'shelf'"),
    ] {
        let error = args.read().and_then(|models| models.model(&equipment)).unwrap_err().to_string();
        assert!(error.contains(told), "{told}: {error}");
    }
}
