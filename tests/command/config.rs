//! pipeline.yaml and the command line: what cannot be right is refused, and the nearest right word is named.

use std::path::Path;

use rockfrag::cli::calls;
use rockfrag::pipeline::options::{Given, Rule, merge, name_of};
use rockfrag::stages;
use serde_json::Value;

use crate::common::{HAZARD, fail, folder_with, succeed};

#[test]
fn mistakes_in_a_pipeline_file_are_named() {
    for (wrong, named) in [
        ("fit-prox: {}", vec!["pipeline.yaml", "fit-prox", "fit-pro"]),
        ("fit-pro: { confidense: 0.9 }", vec!["fit-pro", "confidense", "confidence"]),
        ("fit-pro: { confidence: 2 }", vec!["fit-pro", "confidence", "2"]),
        ("fit-pro: 3", vec!["pipeline.yaml", "fit-pro", "3"]),
        ("simulate: { structure: [{ name: a, q: 1 }] }", vec!["simulate", "'q'"]),
        ("fit-pex: { out: a.parquet }\nfit-pro: { out: b/../a.parquet }", vec!["fit-pro", "b/../a."]),
        ("a: [", vec!["pipeline.yaml"]),
        ("fit-pro: { confidence: 0.9, confidence: 0.8 }", vec!["line 1"]),
        ("fit-pro: {}\n---\nfit-pex: {}", vec!["2 documents"]),
        ("simulate: { structure: [{ name: a, p: 100, alpha: 0.1, eta: 0.9 }] }", vec!["a", "p is 100"]),
        ("fit-pex: { limit-state: 0.1, limit_state: 0.2 }", vec!["limit-state", "twice"]),
        ("evaluate: { hazard: { pga: h.csv } }", vec!["evaluate", "hazard", "mapping"]),
        ("simulate: { structures: \"\" }", vec!["simulate", "structures", "value"]),
        ("{}", vec!["pipeline.yaml", "no stage"]),
        ("seed: x\nfit-pro: {}\nsample-scenarios: {}", vec!["seed", "x"]),
        ("evaluate: { width: 1, height: 2, p: 1, pga: 1, out: a.csv }", vec!["evaluate: --width and --p"]),
        ("fit-pro: {}\nevaluate: { p: 1, alpha: 0.2, eta: 0.9, pga: 0.5 }", vec!["fits: out"]),
        ("floor-motions: { period: 1, level: 1 }\nida: { structures: paper }", vec!["in: out/floor.parquet"]),
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
    let folder = folder_with("evaluate: { width: 0.5, height: 2, eta: 2, pga: 0.5, pgv: 0.6 }\n");
    for (call, named) in [
        ("evaluate --config pipeline.yaml", vec!["pipeline.yaml: evaluate: --eta is 2"]),
        ("simulat", vec!["simulat", "simulate"]),
        ("simulate --pp 3", vec!["--pp", "--p"]),
        ("simulate --p 1 --alpha 0.2", vec!["eta"]),
        ("simulate --width 2 --height 0.5", vec!["width"]),
        ("simulate --p 1,0 --alpha 0.2 --eta 0.9", vec!["--p"]),
        ("simulate --structures paper --threads 0", vec!["--threads"]),
        ("evaluate --width 0.5 --height 2 --pga 0.5 --threads 20000", vec!["threads"]),
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
        ("evaluate --width 1 --height 2 --model paper", vec!["--fits"]),
        ("evaluate --width 1 --height 2 --hazard pga.csv --vs30 90", vec!["vs30"]),
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
        fail(folder.path(), "run --check", 1, &[]);
        fail(folder.path(), &format!("init {start}"), 2, &["pipeline.yaml"]);
    }
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "init list");
    let (text, warned) = succeed(folder.path(), &format!("evaluate --structures objects.csv {HAZARD}"));
    assert!(warned.is_empty() && !text.contains("Not understood"), "{warned}{text}");
}

#[test]
fn short_help_has_the_options_of_its_examples_and_of_what_answers_advise() {
    for stage in stages::all() {
        let name = stage.name();
        let [short, long] = ["-h", "--help"].map(|help| succeed(Path::new("."), &format!("{name} {help}")).0);
        assert!(long.contains("--threads") && !short.contains("--threads"), "{name}");
        let examples: Vec<&str> = short.lines().filter(|line| line.starts_with("rockfrag ")).collect();
        assert!(!examples.is_empty(), "{name}");
        let advised = if name == "evaluate" { " --magnitude --target --vs30 --eta" } else { "" };
        let words = examples.join(" ") + advised;
        for word in words.split(' ').filter_map(|word| word.strip_prefix("--")) {
            let option = stage.command.get_arguments().find(|option| name_of(option) == word);
            assert!(option.is_some_and(|option| !option.is_hide_short_help_set()), "{name}: {word}");
        }
    }
}

/// A value that an option can have.
fn value_of(option: &str) -> &'static str {
    match option {
        "structure" => "name=a,p=1,alpha=0.2,eta=0.9",
        "structures" => "paper",
        "over" => "pga",
        "base" => "timber",
        "suite" => "pulse",
        "variants" => "true",
        "target" => "1%",
        "vs30" | "effective-years" => "400",
        "partition" => "0/2",
        "trace" | "name" | "in" | "hazard" | "fits" => "a",
        _ => "0.3",
    }
}

fn given(options: &[&str]) -> Given {
    options.iter().map(|option| (option.to_string(), Value::from(value_of(option)))).collect()
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
        let (name, rules) = (stage.name(), &stages::RULES);
        let options: Vec<&str> = stage.command.get_arguments().map(name_of).collect();
        for (&one, &other) in options.iter().flat_map(|one| options.iter().map(move |other| (one, other))) {
            let is_excluded = one != other && exclude(rules, one, other);
            let texts = |option: &str| Given::from_iter([(option.to_string(), Value::from("text"))]);
            let merged = merge(&texts(one), &texts(other), rules);
            assert!(merged.contains_key(other), "{name}: --{other} over {one}");
            assert_eq!(merged.contains_key(one), !is_excluded, "{name}: --{other} over {one}");
            if is_excluded {
                excluded += 1;
                let refused = calls::of_stage(&stage, given(&[one, other])).err().unwrap().to_string();
                for option in [one, other] {
                    assert!(refused.contains(&format!("--{option}")), "{name}, {one}, {other}: {refused}");
                }
            }
        }
    }
    assert!(excluded > 200, "{excluded}");
}

#[test]
fn an_angle_and_a_length_may_have_their_unit() {
    let here = Path::new(".");
    let printed = |call: &str| succeed(here, call).0;
    let alpha = 8.5_f64.to_radians().to_string();
    let call = |alpha: &str| format!("evaluate --p 2 --alpha {alpha} --eta 0.9 --pga 0.3 --format csv");
    assert_eq!(printed(&call("8.5deg")), printed(&call(&alpha)));
    let block = |width: &str| format!("evaluate --width {width} --height 2 --pga 0.3 --pgv 0.4 --format csv");
    assert_eq!(printed(&block("50cm")), printed(&block("0.5")));
    fail(here, &call("8.5s"), 2, &["--alpha", "rad"]);
}
