//! Inputs that become other ones between the look at them and the end of the stage.

use std::path::Path;

use rockfrag::pipeline::console::Console;
use rockfrag::pipeline::stage::Stage;
use rockfrag::stages::report::{Report, ReportOptions};
use rockfrag::stages::sample_scenarios::{SampleScenarios, SampleScenariosOptions};
use rockfrag::stages::synthesize_motions::{SynthesizeMotions, SynthesizeMotionsOptions};

fn quiet() -> Console {
    Console { quiet: true, ..Console::default() }
}

fn copy(name: &str, to: &Path) {
    std::fs::copy(Path::new("tests/reference/files").join(name), to).unwrap();
}

/// That a stage, whose input becomes another one once it is known what its file will say, says so and leaves none.
fn expect_refusal(stage: &dyn Stage, replace: impl FnOnce()) {
    let planned = stage.provenance().unwrap();
    replace();
    let words = stage.execute(&planned, &quiet()).unwrap_err().to_string();
    assert!(words.contains("changed or removed while it was read"), "{words}");
    assert!(stage.outputs().iter().all(|output| !output.exists()), "{words}");
    let now = stage.provenance().unwrap();
    stage.execute(&now, &quiet()).unwrap();
    assert!(stage.outputs().iter().all(|output| output.exists()));
}

#[test]
fn a_table_does_not_say_that_it_comes_from_what_it_does_not_come_from() {
    let folder = tempfile::tempdir().unwrap();
    let [scenarios, motions] = ["scenarios.parquet", "motions.parquet"].map(|name| folder.path().join(name));
    copy("scenarios.parquet", &scenarios);
    let options = SynthesizeMotionsOptions { dt: 0.05, ..SynthesizeMotionsOptions::default() };
    let stage = SynthesizeMotions::new(&options, scenarios.clone(), motions).unwrap();
    expect_refusal(&stage, || {
        let options = SampleScenariosOptions {
            mw: "6.5".parse().unwrap(),
            re: "5".parse().unwrap(),
            samples: 3,
            ..SampleScenariosOptions::default()
        };
        let other = SampleScenarios::new(&options, scenarios).unwrap();
        other.execute(&other.provenance().unwrap(), &quiet()).unwrap();
    });
}

#[test]
fn a_page_does_not_either() {
    let folder = tempfile::tempdir().unwrap();
    let responses = folder.path().join("responses.parquet");
    copy("traced.parquet", &responses);
    let options = ReportOptions { dpi: 36.0, groups: 1, motions: 0, ..ReportOptions::default() };
    let stage =
        Report::new(&options, folder.path().to_path_buf(), None, folder.path().join("report.html")).unwrap();
    expect_refusal(&stage, || copy("responses.parquet", &responses));
    assert!(folder.path().join("report").is_dir());
}
