//! pipeline.yaml and the command line: what cannot be right is refused, and the nearest right word is named.

use std::path::Path;

use rockfrag::cli::calls;
use rockfrag::pipeline::given::{Base, in_one_form, name_of};
use rockfrag::pipeline::options::{Given, Rule, merge};
use rockfrag::stages::{self, StageKind};
use serde_json::Value;

use crate::common::{SMALL, fail, folder_with, rockfrag, succeed};

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
        ("fit-pro: { confidense: }", vec!["pipeline.yaml: fit-pro", "confidense"]),
        ("fit-pex: { limit-state: 0.1, limit_state: 0.2 }", vec!["limit-state", "twice"]),
        ("evaluate: { hazard: { pga: h.csv } }", vec!["evaluate", "hazard", "mapping"]),
        ("simulate: { structures: \"\" }", vec!["simulate", "structures", "value"]),
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
    let stages = stages::all();
    let descriptions: std::collections::BTreeSet<String> =
        stages.iter().map(|stage| stage.command.get_about().unwrap().to_string()).collect();
    assert_eq!(descriptions.len(), stages.len());
}

/// A value that an option can have.
fn value_of(option: &str) -> &'static str {
    match option {
        "structure" => "name=a,p=1,alpha=0.2,eta=0.9",
        "structures" => "paper",
        "over" => "pga",
        "suite" => "pulse",
        "extrapolate" => "true",
        "target" => "1%",
        "vs30" | "effective-years" => "400",
        "partition" => "0/2",
        "trace" | "name" | "in" | "hazard" | "fits" => "a",
        _ => "0.3",
    }
}

fn given(stage: &StageKind, options: &[&str]) -> Given {
    let options = options.iter().map(|option| (option.to_string(), Value::from(value_of(option))));
    in_one_form(&stage.command, options, &Base::default()).unwrap()
}

/// Whether a rule of a stage lets only one of two options stand.
fn exclude(rules: &[Rule], one: &str, other: &str) -> bool {
    rules.iter().any(|rule| match rule {
        Rule::Either(these, those) => {
            let has = |one: &str, other: &str| these.contains(&one) && those.contains(&other);
            has(one, other) || has(other, one)
        }
        Rule::Needs(..) => false,
    })
}

#[test]
fn of_every_pair_the_flag_beats_the_file_and_alternatives_are_refused_within_one() {
    let mut excluded = 0;
    for stage in stages::all() {
        let (name, rules) = (stage.name(), &stage.rules);
        let options: Vec<&str> = stage.command.get_arguments().map(name_of).collect();
        for (&one, &other) in options.iter().flat_map(|one| options.iter().map(move |other| (one, other))) {
            let is_excluded = one != other && exclude(rules, one, other);
            let texts = |option: &str| Given::from_iter([(option.to_string(), Value::from("text"))]);
            let merged = merge(&texts(one), &texts(other), rules);
            assert!(merged.contains_key(other), "{name}: --{other} over {one}");
            assert_eq!(merged.contains_key(one), !is_excluded, "{name}: --{other} over {one}");
            if is_excluded {
                excluded += 1;
                let refused =
                    calls::of_stage(&stage, given(&stage, &[one, other])).err().unwrap().to_string();
                for option in [one, other] {
                    assert!(refused.contains(&format!("--{option}")), "{name}, {one}, {other}: {refused}");
                }
            }
        }
    }
    assert!(excluded > 200, "{excluded}");
}

#[test]
fn what_is_wrong_is_named_as_who_gave_it_does() {
    let folder = folder_with("evaluate: { width: 0.5, height: 2, eta: 2, pga: 0.5, pgv: 0.6 }\n");
    let evaluate = "evaluate --config pipeline.yaml";
    fail(folder.path(), evaluate, 2, &["pipeline.yaml: evaluate: eta is 2"]);
    fail(folder.path(), "evaluate --width 0.5 --height 2 --eta 2", 2, &["--eta is 2"]);
    fail(folder.path(), "evaluate --hazard h.csv --pga 0.5", 2, &["--pga", "--hazard"]);
    let both = "evaluate: { width: 0.5, height: 2, p: 1, pga: 0.5, out: a.csv }\n";
    std::fs::write(folder.path().join("pipeline.yaml"), both).unwrap();
    fail(folder.path(), "run", 2, &["pipeline.yaml: evaluate: width and p"]);
}

#[test]
fn an_angle_and_a_length_may_have_their_unit() {
    let here = Path::new(".");
    let printed = |call: &str| {
        let output = rockfrag(here, call).output().unwrap();
        assert!(output.status.success(), "{call}");
        output.stdout
    };
    let alpha = 8.5_f64.to_radians().to_string();
    let call =
        |alpha: &str| format!("evaluate --p 2 --alpha {alpha} --eta 0.9 --pga 0.3 --pgv 0.4 --format csv");
    assert_eq!(printed(&call("8.5deg")), printed(&call(&alpha)));
    let block = |width: &str| format!("evaluate --width {width} --height 2 --pga 0.3 --pgv 0.4 --format csv");
    assert_eq!(printed(&block("50cm")), printed(&block("0.5")));
    fail(here, &call("8.5s"), 2, &["--alpha", "rad"]);
}

#[test]
fn a_run_says_which_line_is_missing_and_a_check_whether_any_stage_is_due() {
    let evaluate = "evaluate: { p: 1, alpha: 0.2, eta: 0.9, pga: 0.5, pgv: 0.6";
    let fits = "fits: other, out: a.csv }";
    for (wrong, line) in [
        (format!("fit-pro: {{}}\n{evaluate}, {fits}\n"), "fits is other"),
        (format!("fit-pro: {{}}\n{evaluate} }}\n"), "fits: out"),
        (format!("{evaluate} }}\n"), "out: out/evaluated.parquet"),
        (
            "floor-motions: { period: 1, level: 1 }\nida: { structures: paper }\n".into(),
            "in: out/floor.parquet",
        ),
    ] {
        fail(folder_with(&wrong).path(), "run --dry-run", 2, &["pipeline.yaml", line]);
    }
    let folder = folder_with("sample-scenarios: &a { mw: &m 7, re: *m, samples: 2 }\nreport: {}\n");
    fail(folder.path(), "run --check", 1, &[]);
    succeed(folder.path(), "run");
    succeed(folder.path(), "run --check");
}
