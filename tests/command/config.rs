//! pipeline.yaml and the command line: what cannot be right is refused, and the nearest right word is named.

use crate::common::{SMALL, fail, folder_with, succeed};

#[test]
fn mistakes_in_a_pipeline_file_are_named() {
    for (wrong, named) in [
        ("fit-prox: {}", vec!["pipeline.yaml", "fit-prox", "fit-pro"]),
        ("fit-pro: { confidense: 0.9 }", vec!["fit-pro", "confidense", "confidence"]),
        ("fit-pro: { confidence: 2 }", vec!["fit-pro", "confidence", "2"]),
        ("fit-pro: 3", vec!["pipeline.yaml", "fit-pro", "3"]),
        ("simulate: { structure: [{ name: a, q: 1 }] }", vec!["simulate", "'q'"]),
        (
            "fit-pex: { out: a.parquet }\nfit-pro: { out: b/../a.parquet }",
            vec!["fit-pex", "fit-pro", "b/../a."],
        ),
        ("a: [", vec!["pipeline.yaml"]),
        ("{}", vec!["pipeline.yaml", "no stage"]),
        ("seed: x\nfit-pro: {}\nsample-scenarios: {}", vec!["seed", "x"]),
    ] {
        let folder = folder_with(wrong);
        fail(folder.path(), "run", 2, &named);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "{wrong}: nothing is written");
    }
    fail(tempfile::tempdir().unwrap().path(), "run", 2, &["pipeline.yaml", "rockfrag init"]);
    fail(folder_with("simulate: { structures: none.csv }").path(), "run", 1, &["none.csv"]);
}

#[test]
fn mistakes_on_the_command_line_are_named() {
    let folder = folder_with(SMALL);
    for (call, named) in [
        ("simulat", vec!["simulat", "simulate"]),
        ("simulate --pp 3", vec!["--pp", "--p"]),
        ("simulate --p 1 --width 2", vec!["--p", "--width"]),
        ("simulate --p 1 --alpha 0.2", vec!["eta"]),
        ("simulate --width 2 --height 0.5", vec!["width"]),
        ("simulate --p 1,0 --alpha 0.2 --eta 0.9", vec!["--p"]),
        ("simulate --structures paper --threads 0", vec!["--threads"]),
        ("sample-scenarios --mw 5:4:1", vec!["--mw"]),
        ("sample-scenarios --re 5,5", vec!["--re"]),
        ("sample-scenarios --mw 12", vec!["mw"]),
        ("sample-scenarios --design sobol", vec!["--design", "sobol", "lhs"]),
        ("synthesize-motions --dt 1", vec!["--dt", "0.1"]),
        ("synthesize-motions --suite pulse,pulse", vec!["suite"]),
        ("synthesize-motions --site swamp --in out.parquet", vec!["out.parquet"]),
        ("ida --from 2 --to 1 --structures paper", vec!["to", "2"]),
        ("ida --measure pgv --to 300 --structures paper", vec!["to", "300", "cm/s"]),
        ("simulate --structures paper --out responses.csv", vec!["responses.csv", ".parquet"]),
        ("evaluate --width 1 --height 2 --pga 0.3 --period-sd 0.2", vec!["--period"]),
        ("evaluate --width 1 --height 2 --pga 0.3 --ground-floor 1", vec!["--ground-floor"]),
        ("evaluate --width 1 --height 2 --years 30", vec!["--hazard"]),
        ("evaluate --width 1 --height 2 --model paper", vec!["--fits"]),
        ("evaluate --structures - --hazard -", vec!["--structures", "--hazard", "stdin"]),
    ] {
        let code = if call.contains("out.parquet") { 1 } else { 2 };
        fail(folder.path(), call, code, &named);
    }
}

#[test]
fn every_start_is_a_pipeline_that_can_be_planned() {
    for start in ["paper", "records", "site"] {
        let folder = tempfile::tempdir().unwrap();
        succeed(folder.path(), &format!("init {start}"));
        std::fs::create_dir_all(folder.path().join("records")).unwrap();
        succeed(folder.path(), "run --dry-run");
        fail(folder.path(), &format!("init {start}"), 2, &["pipeline.yaml"]);
    }
}

#[test]
fn every_stage_has_a_description_of_its_own() {
    let commands = rockfrag::cli::stage_commands();
    let descriptions: std::collections::BTreeSet<String> =
        commands.iter().map(|command| command.get_about().unwrap().to_string()).collect();
    assert_eq!(descriptions.len(), commands.len());
}
