//! What one sees at a terminal: words, lists, traces.

use rockfrag::stages;
use rockfrag::table::capacities::CapacityFitRow;
use rockfrag::table::file::ParquetTable;
use rockfrag::table::responses::TraceRow;
use rockfrag::table::rows;
use rockfrag_core::rocking::SolverEvent;
use std::path::Path;

use crate::common::write_motions;
use crate::common::{
    evaluated, fail, folder, lists, near, number, numbers, objects, rockfrag, succeed, texts, write,
};

fn trace(folder: &Path) -> Vec<TraceRow> {
    rows::read(&folder.join("responses.trace.parquet")).unwrap()
}

#[test]
fn a_trace_has_what_a_picture_needs() {
    let folder = tempfile::tempdir().unwrap();
    let (dt, omega) = (0.01, 6.0);
    let sine: Vec<f64> = (0..300).map(|k| 5.0 * (omega * dt * f64::from(k)).sin()).collect();
    write_motions(&folder.path().join("motions.parquet"), dt, &[&sine, &[0.1; 50]]);
    succeed(folder.path(), "simulate --width 0.5 --height 2 --trace 0");
    let one = trace(folder.path());
    assert!(one.iter().all(|row| row.motion_id == "0"));
    for row in one.iter().filter(|row| row.time_s < 2.99) {
        let (acceleration, velocity) =
            (5.0 * (omega * row.time_s).sin(), 5.0 / omega * (1.0 - (omega * row.time_s).cos()));
        assert!((row.ground_acceleration_m_s2 - acceleration).abs() < 3e-3, "{row:?}");
        assert!((row.ground_velocity_m_s - velocity).abs() < 1e-3, "{row:?}");
        assert!((row.block_width_m - 0.5).abs() < 1e-12 && (row.block_height_m - 2.0).abs() < 1e-12);
    }
    succeed(folder.path(), "simulate --width 0.5 --height 2 --trace all");
    let all = trace(folder.path());
    assert_eq!(all[..one.len()], one);
    assert!(all[one.len()..].iter().all(|row| row.motion_id == "1" && row.theta_rad == 0.0));
    succeed(folder.path(), "simulate --width 0.6 --height 2");
    assert!(!folder.path().join("responses.trace.parquet").exists(), "a trace of another structure");
}

#[test]
fn a_trace_and_its_row_agree_where_a_record_ends_at_full_acceleration() {
    let folder = tempfile::tempdir().unwrap();
    let (dt, acceleration) = (0.05, 0.3 * 9.80665);
    let records = [13, 14, 15].map(|samples| vec![acceleration; samples]);
    write_motions(&folder.path().join("motions.parquet"), dt, &records.each_ref().map(Vec::as_slice));
    succeed(folder.path(), "simulate --width 0.5 --height 2 --trace all");
    let traced = trace(folder.path());
    for (row, record) in objects(folder.path(), "responses.parquet").iter().zip(&records) {
        let its: Vec<&TraceRow> =
            traced.iter().filter(|point| row["motion_id"] == *point.motion_id).collect();
        let overturns = its.iter().any(|point| point.solver_event == Some(SolverEvent::Overturn));
        assert_eq!(overturns, row["outcome"] == "overturning", "{row}");
        let largest = its.iter().map(|point| point.theta_over_alpha.abs()).fold(0.0, f64::max);
        assert!(overturns || near(largest, number(row, "edp"), 0.01), "{largest}: {row}");
        // The ground is still, and keeps its velocity.
        let last = its[its.len() - 1];
        let velocity = acceleration * dt * (record.len() - 1) as f64;
        assert!(last.ground_acceleration_m_s2 == 0.0 && near(last.ground_velocity_m_s, velocity, 1e-9));
    }
}

#[test]
fn a_motion_that_cannot_be_traced_is_told_before_anything_is_simulated() {
    let folder = tempfile::tempdir().unwrap();
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&[0.1, f64::NAN, 0.1]]);
    let simulate = "simulate --width 0.5 --height 2";
    fail(folder.path(), &format!("{simulate} --trace 7"), 1, &["motions.parquet", "no motion '7' to trace"]);
    fail(folder.path(), &format!("{simulate} --trace 0"), 1, &["NaN"]);
}

/// The names of the options that a help lists.
fn options(help: &str) -> Vec<&str> {
    // Lines of meanings are further to the right.
    let listed =
        help.lines().filter(|line| line.find('-').is_some_and(|at| at <= 6 && line[..at].trim().is_empty()));
    listed.filter_map(|line| line.split([' ', ',']).find(|word| word.starts_with("--"))).collect()
}

#[test]
fn short_help_has_the_usual_options_and_long_help_all() {
    let folder = tempfile::tempdir().unwrap();
    let short = succeed(folder.path(), "evaluate -h").0;
    // What answers advise.
    for advised in ["--magnitude", "--target", "--vs30", "--eta"] {
        assert!(options(&short).contains(&advised), "{short}");
    }
    for stage in stages::all().iter().map(|stage| stage.name()) {
        let short = succeed(folder.path(), &format!("{stage} -h")).0;
        let long = succeed(folder.path(), &format!("{stage} --help")).0;
        let (few, all) = (options(&short), options(&long));
        assert!(few.len() <= 22 && few.len() < all.len(), "{stage}: {few:?}");
        assert!(few.iter().all(|option| all.contains(option)), "{stage}");
        assert!(all.contains(&"--threads") && !few.contains(&"--threads"), "{stage}");
        let examples: Vec<&str> = short.lines().filter(|line| line.starts_with("rockfrag ")).collect();
        assert!(!examples.is_empty(), "{stage}");
        for word in examples.iter().flat_map(|line| line.split(' ')).filter(|word| word.starts_with("--")) {
            assert!(few.contains(&word), "{stage}: {word} of an example is not an option");
        }
    }
}

/// Twelve sines in three groups, those of a group alike, as motions of one magnitude and distance or of
/// unknown ones.
fn write_groups(path: &Path, is_known: bool) {
    let places: Vec<(f64, f64, f64)> = [(0.0, 3.0), (1.0, 5.0), (2.0, 8.0)]
        .into_iter()
        .flat_map(|(group, omega)| [0.0, 1.0, 2.0, 3.0].map(|one| (group, one, omega * (1.0 + 0.02 * one))))
        .collect();
    let sines = places.iter().map(|(_, _, omega)| {
        (0..400).map(|k| 3.0 * (omega * 0.01 * f64::from(k)).sin()).collect::<Vec<f64>>()
    });
    let sines: Vec<Vec<f64>> = sines.collect();
    let ids: Vec<String> = places.iter().map(|(group, one, _)| format!("{group}-{one}")).collect();
    // NaN is null.
    let known = if is_known { 1.0 } else { f64::NAN };
    let mw: Vec<f64> = places.iter().map(|(group, ..)| known * (6.0 + 0.5 * group)).collect();
    let columns = vec![
        ("motion_id", texts(&ids.iter().map(String::as_str).collect::<Vec<_>>())),
        ("dt_s", numbers(&[0.01; 12])),
        ("mw", numbers(&mw)),
        ("re_km", numbers(&[10.0 * known; 12])),
        ("acceleration_m_s2", lists(&sines.iter().map(Vec::as_slice).collect::<Vec<_>>())),
    ];
    write(path, columns);
}

#[test]
fn ida_has_the_clusters_of_fits_and_where_half_overturn() {
    let folder = tempfile::tempdir().unwrap();
    let fit = |is_known: bool| -> CapacityFitRow {
        write_groups(&folder.path().join("motions.parquet"), is_known);
        succeed(folder.path(), "ida --width 0.5 --height 2 --measure pga --from 0.05 --to 4 --steps 80");
        rows::read(&folder.path().join("ida.fragility.parquet")).unwrap().remove(0)
    };
    let (alone, clustered) = (fit(false), fit(true));
    assert_eq!(alone.theta.value, clustered.theta.value);
    let width = |fit: &CapacityFitRow| (fit.theta.high.unwrap() / fit.theta.low.unwrap()).ln();
    assert!(width(&clustered) > 1.3 * width(&alone), "{clustered:?} {alone:?}");
    // The share of the stripes that overturns passes one half there.
    let table = ParquetTable::open(&folder.path().join("ida.stripes.parquet")).unwrap();
    let stripes = table.batches(|_| true).next().unwrap().unwrap();
    let (intensity, outcome) =
        (stripes.required_numbers("intensity").unwrap(), stripes.texts("outcome").unwrap());
    let share = |level: f64| {
        let at: Vec<usize> = (0..intensity.len()).filter(|&row| intensity[row] == level).collect();
        at.iter().filter(|&&row| outcome[row].as_deref() == Some("overturning")).count() as f64
            / at.len() as f64
    };
    let half = clustered.half_overturn_at.unwrap();
    let mut levels = intensity.clone();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let above = *levels.iter().find(|level| **level >= half).unwrap();
    assert!(share(above) >= 0.5 && above / half < 1.06);
    assert!(levels.iter().filter(|level| **level < half).all(|level| share(*level) <= 0.5));
}

const LIST: &str = "name,width (m),height (m),anchored,level,period
Autoclave,0.6,1.5,yes,,
Bookcase,0.4,2.0,no,0,
Upstairs,0.4,2.0,no,0.5,0.6
";

#[test]
fn a_pipeline_of_a_list_goes_on_past_what_does_not_rock_on_the_ground() {
    let folder = tempfile::tempdir().unwrap();
    assert!(succeed(folder.path(), "init site --quiet").0.is_empty());
    std::fs::write(folder.path().join("structures.csv"), LIST).unwrap();
    let pipeline = folder.path().join("pipeline.yaml");
    let small = std::fs::read_to_string(&pipeline).unwrap().replace("samples: 40", "samples: 4");
    std::fs::write(&pipeline, small.replace("report:", "# report:")).unwrap();
    let (printed, warned) = succeed(folder.path(), "run");
    assert!(["Autoclave", "Bookcase", "Upstairs"].iter().all(|name| printed.contains(name)), "{printed}");
    assert!(warned.contains("Autoclave, Upstairs: left out"), "{warned}");
    // What cannot be right is still refused, and so is a list of which nothing rocks.
    std::fs::write(folder.path().join("wrong.csv"), "name,width,height\nA,0.4,2\nB,40,2\n").unwrap();
    fail(folder.path(), "simulate --in out/motions.parquet --structures wrong.csv", 2, &["'B'", "width"]);
    std::fs::write(folder.path().join("held.csv"), &LIST[..LIST.find("Bookcase").unwrap()]).unwrap();
    fail(folder.path(), "simulate --in out/motions.parquet --structures held.csv", 2, &["Autoclave"]);
}

/// A list of this many objects, the last ones the weakest.
fn list(objects: usize) -> String {
    let row = |k: usize| format!("object {k},{},2.0\n", 0.6 - 0.004 * k as f64);
    "name,width,height\n".to_string() + &(0..objects).map(row).collect::<String>()
}

#[test]
fn a_long_list_is_printed_by_its_worst() {
    let folder = folder(&[("short.csv", &list(25)), ("long.csv", &list(41))]);
    let objects = |call: &str| {
        let printed = succeed(folder.path(), &format!("evaluate --pga 0.6 --pgv 0.8 {call}")).0;
        let is_row =
            |line: &&str| line.starts_with("object ") && (line.contains(" × ") || line.contains(','));
        (printed.lines().filter(is_row).count(), printed.clone())
    };
    assert_eq!(objects("--structures short.csv").0, 25);
    let (rows, printed) = objects("--structures short.csv --out out.csv");
    assert!(rows == 20 && printed.contains("and 5 more, in out.csv"), "{printed}");
    let (rows, printed) = objects("--structures long.csv");
    assert!(rows == 20 && printed.contains("and 21 more"), "{printed}");
    assert!(printed.contains("object 40") && !printed.contains("object 1 "), "{printed}");
    assert_eq!(objects("--structures long.csv --out long.out.csv --format csv").0, 41);
    assert_eq!(objects("--structures long.csv --format json").1.matches("\"structure\"").count(), 41);
}

#[test]
fn control_characters_of_names_are_shown_and_not_sent() {
    let folder = folder(&[("list.csv", "name,width,height\n\"\u{1b}[31mred\nrow\",0.4,2.0\nB,0.5,2.0\n")]);
    let columns = vec![
        ("motion_id", texts(&["a\u{1b}[2J\nframe: 0 of 3 motions overturn it"])),
        ("dt_s", numbers(&[0.01])),
        ("acceleration_m_s2", lists(&[&[9.0; 300]])),
    ];
    write(&folder.path().join("motions.parquet"), columns);
    for call in [
        "evaluate --structures list.csv --pga 0.6 --pgv 0.8",
        "evaluate --structures list.csv --hazard hazard.csv",
        "simulate --structures list.csv",
        "ida --structures list.csv",
        "inspect responses.parquet --head 3",
    ] {
        std::fs::write(folder.path().join("hazard.csv"), include_str!("../../data/hazard.csv")).unwrap();
        let (printed, warned) = succeed(folder.path(), call);
        assert!(!(printed + &warned).replace('\n', "").contains(char::is_control), "{call}");
        assert!(!succeed(folder.path(), call).0.contains("\nframe: 0"), "{call}");
    }
    let csv = succeed(folder.path(), "evaluate --structures list.csv --pga 0.6 --pgv 0.8 --format csv").0;
    assert!(csv.contains("\u{1b}[31mred\nrow"), "names stay as they are");
    let missing =
        rockfrag(folder.path(), "simulate --in none.parquet --trace").arg("\u{1b}[31m").output().unwrap();
    assert!(!missing.stderr.contains(&0x1b));
}

#[test]
fn names_may_be_long() {
    let name = "n".repeat(65_536);
    let folder = folder(&[("list.csv", &format!("name,width,height\n{name},0.4,2.0\nB,0.5,2.0\n"))]);
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&[9.0; 300], &[0.1; 300]]);
    for call in [
        "evaluate --structures list.csv --pga 0.6 --pgv 0.8",
        "simulate --structures list.csv",
        "fit-pro",
        "fit-pex",
        "validate",
        "ida --structures list.csv",
        "report --in responses.parquet",
    ] {
        assert!(succeed(folder.path(), call).0.len() < 100_000, "{call}");
    }
    // A figure with the whole name takes minutes to draw.
    for figure in std::fs::read_dir(folder.path().join("report")).unwrap().flatten() {
        let is_drawn = figure.path().extension().is_some_and(|ending| ending == "svg");
        assert!(!is_drawn || figure.metadata().unwrap().len() < 65_536, "{figure:?}");
    }
}

#[test]
fn more_threads_than_any_machine_has_are_refused() {
    let folder = folder(&[]);
    fail(folder.path(), "evaluate --width 0.5 --height 2 --pga 0.5 --threads 20000", 2, &["threads"]);
    let mut command = rockfrag(folder.path(), "evaluate --width 0.5 --height 2 --pga 0.5 --pgv 0.6");
    let refused = command.env("RAYON_NUM_THREADS", "100000").output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn a_change_of_unit_leaves_no_digits() {
    let folder = folder(&[("list.csv", "name,width (mm),height (m)\nA,1.8,0.1\nB,400,2\n")]);
    let rows = evaluated(folder.path(), "--structures list.csv --pga 0.5");
    let widths: Vec<f64> = rows.iter().map(|row| number(row, "width_m")).collect();
    assert!(widths.contains(&0.0018) && widths.contains(&0.4), "{widths:?}");
}

/// A name that would colour, ring and reorder a terminal, and begin a line of its own.
const HOSTILE: &str = "\u{1b}[31m\u{7}\u{9b}5m\u{202e}gnp\u{2066}\nforged: up to date";

/// The same as JSON and YAML have it.
const ESCAPED: &str = r"\u001b[31m\u0007\u009b5m\u202egnp\u2066\nforged: up to date";

/// Whether a letter is none of a printed text.
fn is_raw(letter: char) -> bool {
    letter.is_control() && letter != '\n'
        || ('\u{202a}'..='\u{202e}').contains(&letter)
        || ('\u{2066}'..='\u{2069}').contains(&letter)
}

#[test]
fn nothing_of_a_file_moves_or_reorders_the_terminal_or_begins_a_line() {
    let quoted = format!("\"{HOSTILE}\"");
    let list = format!("name,width,height\n{quoted},0.5,1.9\nB,0.5,2\n");
    let json = format!(r#"{{"name": "{ESCAPED}", "p": 1.0, "alpha": 0.2, "eta": 0.9}}"#);
    let folder = folder(&[
        ("list.csv", &list),
        ("wrong.csv", &format!("name,width,height\n{quoted},0.5,{quoted}\nB,0.5,2\n")),
        ("heading.csv", &format!("name,width,{quoted}\na,0.5,2\n")),
        (
            "run.yaml",
            &format!("evaluate:\n  structure: [{json}]\n  pga: 0.5\n  pgv: 0.4\n  out: out/e.parquet\n"),
        ),
        ("option.yaml", &format!("evaluate:\n  \"{ESCAPED}\": 1\n")),
        ("value.yaml", &format!("evaluate:\n  pga: \"{ESCAPED}\"\n")),
    ]);
    let sine: Vec<f64> = (0..300).map(|k| 9.0 * (0.05 * f64::from(k)).sin()).collect();
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&sine, &[0.1; 50]]);
    let text = format!("name={HOSTILE},p=1.0,alpha=0.2,eta=0.9");
    let simulate = rockfrag(folder.path(), "simulate --structure").arg(text).output().unwrap();
    assert!(simulate.status.success());
    let page = "evaluate --structures list.csv --pga 0.5 --pgv 0.4 --out page.html";
    succeed(folder.path(), page);
    let html = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(!html.contains(is_raw));
    for (call, code) in [
        (page, 0),
        ("inspect responses.parquet", 0),
        ("inspect responses.parquet --head 3 --format json", 0),
        ("evaluate --structures list.csv --pga 0.5 --pgv 0.4", 0),
        ("evaluate --structures list.csv --pga 0.5 --pgv 0.4 --format json", 0),
        ("run run.yaml --dry-run", 0),
        ("run run.yaml", 0),
        ("run option.yaml", 2),
        ("run value.yaml", 2),
        ("evaluate --structures wrong.csv --pga 0.5 --pgv 0.4", 1),
        ("evaluate --structures heading.csv --pga 0.5 --pgv 0.4", 1),
    ] {
        let output = rockfrag(folder.path(), call).output().unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        assert_eq!(output.status.code(), Some(code), "{call}: {err}");
        let printed = out + &err;
        assert!(!printed.contains(is_raw), "{call}: {printed:?}");
        assert!(!printed.contains("\nforged"), "{call}: {printed:?}");
        assert!(code == 0 || err.lines().count() == 1, "{call}: {err:?}");
    }
    let rows = evaluated(folder.path(), "--structures list.csv --pga 0.5");
    assert!(rows.iter().any(|row| row["structure"] == HOSTILE), "JSON says what the list says");
}

#[test]
fn names_that_xml_cannot_hold_are_drawn_and_kept() {
    let folder =
        folder(&[("list.csv", "name,width,height\na\u{fffe}\u{ffff}\u{85}b\u{202e},0.5,2\nc,0.6,2\n")]);
    std::fs::write(folder.path().join("hazard.csv"), include_str!("../../data/hazard.csv")).unwrap();
    for out in ["o.html", "o.svg", "o.png", "o.xlsx", "o.parquet"] {
        let call = format!("evaluate --structures list.csv --hazard hazard.csv --out {out}");
        succeed(folder.path(), &call);
        let first = std::fs::read(folder.path().join(out)).unwrap();
        succeed(folder.path(), &format!("{call} --force"));
        assert!(std::fs::read(folder.path().join(out)).unwrap() == first, "{out}");
    }
    succeed(folder.path(), "export --structures list.csv --to openquake --out o.xml");
    for file in ["o.html", "o.svg", "o.xml"] {
        let text = std::fs::read_to_string(folder.path().join(file)).unwrap();
        let stays = |letter: char| is_raw(letter) || ['\u{fffe}', '\u{ffff}'].contains(&letter);
        assert!(!text.contains(stays), "{file}");
    }
    succeed(folder.path(), "report --in o.parquet");
}

#[test]
fn a_name_that_is_a_colour_stays_a_name() {
    let folder = folder(&[("list.csv", "name,width,height\n#0069a8,0.5,2\nc,0.6,2\n")]);
    std::fs::write(folder.path().join("hazard.csv"), include_str!("../../data/hazard.csv")).unwrap();
    succeed(folder.path(), "evaluate --structures list.csv --hazard hazard.csv --out o.html");
    let html = std::fs::read_to_string(folder.path().join("o.html")).unwrap();
    assert!(!html.contains(">var(--") && html.contains("\"var(--muted)\""));
}

#[test]
fn what_rounds_to_zero_has_no_sign() {
    for (value, text) in [(-0.001, "0.00"), (-0.0, "0.00"), (-0.006, "-0.01"), (-1234.5, "-1,234.50")] {
        assert_eq!(rockfrag::number::fixed(value, 2), text);
    }
    assert_eq!(rockfrag::number::fixed(f64::NEG_INFINITY, 0), "-inf");
}

#[test]
fn a_run_warns_of_the_objects_of_all_its_stages() {
    let slender = |name: &str| format!("{{ name: {name}, width: 0.06, height: 2 }}");
    let [one, other] = [["a", "b"], ["c", "d"]].map(|names| names.map(slender).join(", "));
    let pipeline = format!(
        "simulate: {{ in: motions.parquet, structure: [{one}] }}\n\
         evaluate: {{ pga: 0.5, pgv: 0.4, out: out/e.parquet, structure: [{other}] }}\n"
    );
    let folder = folder(&[("pipeline.yaml", &pipeline)]);
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&[0.1; 300]]);
    let warned = succeed(folder.path(), "run").1;
    assert!(warned.contains("a, b, c and 1 more"), "{warned}");
}

#[test]
fn a_thread_that_cannot_start_is_an_error() {
    let folder = folder(&[]);
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&[0.1; 300]]);
    for call in ["simulate", "simulate --threads 2", "evaluate --width 0.5 --height 2 --pga 0.5 --pgv 0.4"] {
        // No machine has the memory for such a stack.
        let output = rockfrag(folder.path(), call).env("RUST_MIN_STACK", "100000000000000").output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && !stderr.contains("panicked"), "{call}: {stderr}");
    }
}
