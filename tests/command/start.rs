//! What a newcomer meets: a folder to start from, examples in every help, completions, manual pages.

use std::collections::BTreeMap;
use std::path::Path;

use crate::common::{fail, rockfrag, succeed};
use crate::evaluate::run_folder;

/// All files of a folder, with what they hold.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
        if entry.path().is_dir() {
            files.extend(self::files(&entry.path()));
        } else {
            files.insert(entry.path().display().to_string(), std::fs::read(entry.path()).unwrap());
        }
    }
    files
}

fn stdout(folder: &Path, arguments: &str) -> String {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The commands of a help or a page: lines that are indented and call the program.
fn commands(text: &str) -> Vec<String> {
    let text = text.replace("\\\n", "");
    let calls = text.lines().filter(|line| line.starts_with("  "));
    calls.filter_map(|line| Some(line.trim().strip_prefix("rockfrag ")?.to_string())).collect()
}

/// The commands of a start, run one after the other.
fn run_start(start: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    stdout(folder.path(), &format!("init {start}"));
    let readme = std::fs::read_to_string(folder.path().join("README.md")).unwrap();
    let commands = commands(&readme);
    assert_eq!(commands.len(), 3, "{readme}");
    for command in &commands {
        let said = stdout(folder.path(), command);
        assert!(!said.is_empty(), "{command}");
    }
    folder
}

#[test]
fn three_commands_of_the_paper_answer() {
    run_start("paper");
}

#[test]
fn three_commands_of_records_answer() {
    let folder = run_start("records");
    // One structure: a table of one row has its words.
    let said = stdout(folder.path(), "run");
    assert!(said.contains("record  museum-piece  im5"), "{said}");
    let motions = stdout(folder.path(), "inspect out/motions.parquet --format json");
    let motions: serde_json::Value = serde_json::from_str(&motions).unwrap();
    assert_eq!(motions["file"]["rows"], 24);
    assert_eq!(motions["warnings"].as_array().unwrap().len(), 0, "made-up records are plausible: {motions}");
}

#[test]
fn three_commands_of_a_site_answer() {
    let folder = run_start("site");
    // Fits that lie in the folder of the run are not passed over without a word.
    let flags = "--pex out/pex.parquet --pro out/pro.parquet";
    let said = succeed(folder.path(), "evaluate --structures structures.csv --pga 0.5 --pgv 0.6");
    assert!(said.contains(&format!("there are fits in out; {flags} uses them")), "{said}");
    let said =
        succeed(folder.path(), "evaluate --model universal --structures structures.csv --pga 0.5 --pgv 0.6");
    assert!(!said.contains("there are fits in out"), "{said}");
    let asked = "--structure museum-piece --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6";
    fail(folder.path(), &format!("evaluate {asked}"), 2, &[&format!("expected {flags}")]);
    fail(folder.path(), "fit-pro", 1, &["responses.parquet: no such file; there is out/responses.parquet"]);
    // A figure of one panel is narrower than its legend in one line.
    let figure = std::fs::read_to_string(folder.path().join("out/report/overturning.svg")).unwrap();
    let place = |words: &str| {
        let text = figure[..figure.find(words).unwrap()].rsplit("<text").next().unwrap();
        let number = |name: &str| -> f64 {
            text.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        [number("x"), number("y")]
    };
    let [first, last] = ["share in a bin", "beyond the data"].map(place);
    assert!(last[0] == first[0] && last[1] > first[1], "{first:?} {last:?}");
}

#[test]
fn a_start_replaces_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for start in ["paper", "records", "site"] {
        let there = folder.path().join(start);
        std::fs::create_dir(&there).unwrap();
        std::fs::write(there.join("structures.csv"), "mine").unwrap();
        fail(folder.path(), &format!("init {start} --out {start}"), 2, &["structures.csv", "--out"]);
        assert_eq!(files(&there).len(), 1, "nothing is written");
        assert_eq!(std::fs::read_to_string(there.join("structures.csv")).unwrap(), "mine");
    }
    stdout(folder.path(), "init --out twice");
    let before = files(&folder.path().join("twice"));
    fail(folder.path(), "init site --out twice", 2, &["pipeline.yaml", "replaces nothing"]);
    assert_eq!(files(&folder.path().join("twice")), before);
}

#[test]
fn a_start_is_the_same_every_time_and_small() {
    let folder = tempfile::tempdir().unwrap();
    for out in ["a", "b"] {
        stdout(folder.path(), &format!("init records --out {out}"));
    }
    let [a, b] = ["a", "b"].map(|name| files(&folder.path().join(name)).into_values().collect::<Vec<_>>());
    assert_eq!(a, b);
    let bytes: usize = a.iter().map(Vec::len).sum();
    assert!(a.len() == 27 && bytes < 2_000_000, "{} files, {bytes} bytes", a.len());
}

#[test]
fn a_run_of_nothing_leads_to_a_start() {
    let folder = tempfile::tempdir().unwrap();
    fail(folder.path(), "run", 2, &["no pipeline.yaml here", "rockfrag init"]);
    fail(folder.path(), "run other.yaml", 2, &["other.yaml"]);
    stdout(folder.path(), "init records");
    fail(folder.path(), "seed-spread", 2, &["pipeline.yaml", "no compare-paper", "add 'compare-paper: {}'"]);
}

/// The names of all commands.
fn names(folder: &Path) -> Vec<String> {
    let help = stdout(folder, "--help");
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let is_name = |line: &&str| line.starts_with("  ") && !line.starts_with("   ");
    let names = list.lines().filter(is_name).map(|line| line.split_whitespace().next().unwrap().to_string());
    names.filter(|name| name != "help").collect()
}

#[test]
fn every_help_has_examples_that_run() {
    let folder = tempfile::tempdir().unwrap();
    // What the examples read: a run, records, a hazard curve.
    stdout(folder.path(), "init records");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    std::fs::copy(data.join("hazard.csv"), folder.path().join("hazard.csv")).unwrap();
    let out = folder.path().join("out");
    std::fs::create_dir(&out).unwrap();
    for name in ["scenarios", "motions", "responses", "pex", "pro"] {
        let file = format!("{name}.parquet");
        for there in [&out, &folder.path().to_path_buf()] {
            std::fs::copy(run_folder().join(&file), there.join(&file)).unwrap();
        }
    }
    let run = std::fs::read_to_string(run_folder().parent().unwrap().join("pipeline.yaml")).unwrap();
    std::fs::write(folder.path().join("pipeline.yaml"), run + "compare-paper: {}\n").unwrap();
    for name in names(folder.path()) {
        let help = stdout(folder.path(), &format!("{name} --help"));
        let examples = help.split("\nExamples:\n").nth(1).unwrap_or_default();
        let examples = commands(examples);
        assert!(help.starts_with(char::is_uppercase) && !help.starts_with("How "), "{help}");
        assert!((1..=2).contains(&examples.len()), "{name}: {} examples\n{help}", examples.len());
        for example in examples {
            assert!(example.starts_with(&name), "{name}: {example}");
            // Into a folder of its own: what is made does not meet what is there.
            let example = match example.split_once(" > ") {
                Some((example, _)) => example.to_string(),
                None if name == "init" && !example.contains("--out") => format!("{example} --out new"),
                None if ["sample-scenarios", "synthesize-motions", "simulate", "fit-pex", "fit-pro"]
                    .contains(&name.as_str())
                    && !example.contains("--out") =>
                {
                    format!("{example} --out {name}.parquet")
                }
                None => example,
            };
            succeed(folder.path(), &example);
        }
    }
}

#[test]
fn shared_options_are_in_every_help_where_they_mean_something_and_refused_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    let common = |name: &str| {
        let help = stdout(folder.path(), &format!("{name} --help"));
        help.split("Common options:\n").nth(1).unwrap_or_default().to_string()
    };
    for (name, absent) in [
        ("inspect", "--threads"),
        ("init", "--force"),
        ("man", "--quiet"),
        ("run", "--config"),
        ("seed-spread", "--force"),
        ("validate", "--progress"),
    ] {
        assert!(!common(name).contains(absent), "{name} has {absent}");
    }
    for present in ["--config", "--threads", "--quiet", "--progress", "--force", "--overwrite"] {
        assert!(common("simulate").contains(present), "{present}");
    }
    fail(folder.path(), "inspect --force x.parquet", 2, &["inspect takes no --force"]);
    fail(folder.path(), "--threads 2 inspect x.parquet", 2, &["inspect takes no --threads"]);
    fail(folder.path(), "run --config x.yaml", 2, &["run takes no --config"]);
    // In front of the command and behind it.
    let run = run_folder().display();
    for call in ["--quiet fit-pro --force", "fit-pro --quiet --force", "--force --quiet fit-pro"] {
        let said = succeed(folder.path(), &format!("{call} --in {run}/responses.parquet --out p.parquet"));
        assert!(said.is_empty(), "{call}: {said}");
    }
}

#[test]
fn every_shell_gets_completions_of_every_command() {
    let folder = tempfile::tempdir().unwrap();
    let names = names(folder.path());
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = stdout(folder.path(), &format!("completions {shell}"));
        let missing: Vec<&String> = names.iter().filter(|name| !script.contains(name.as_str())).collect();
        assert!(missing.is_empty(), "{shell}: {missing:?}");
        std::fs::write(folder.path().join(shell), script).unwrap();
    }
    fail(folder.path(), "completions tcsh", 2, &["'tcsh'", "bash"]);
    // By a bash, where there is one: what follows `rockfrag fit`.
    let words = "source ./bash && COMP_WORDS=(rockfrag fit) COMP_CWORD=1 && _rockfrag rockfrag fit rockfrag && echo ${COMPREPLY[@]}";
    if let Ok(output) =
        std::process::Command::new("bash").args(["-c", words]).current_dir(folder.path()).output()
    {
        assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "fit-pex fit-pro", "{output:?}");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    assert!(
        stdout(folder.path(), "man pages").starts_with("wrote pages/rockfrag.1 and a page of each command")
    );
    for name in names(folder.path()) {
        let page = std::fs::read_to_string(folder.path().join(format!("pages/rockfrag-{name}.1"))).unwrap();
        assert!(page.contains(".TH rockfrag-"), "{page}");
        assert!(page.contains("Examples:"), "{name}");
    }
    assert!(folder.path().join("pages/rockfrag.1").exists());
}
