//! What one sees at a terminal: words, lists, traces.

use rockfrag::table::responses::{CapacityFitRow, TraceRow};
use rockfrag::table::rows;
use rockfrag_core::rocking::SolverEvent;
use std::path::Path;

use crate::common::{HAZARD, bytes, evaluated, fail, folder, near, number, numbers, objects};
use crate::common::{motions_of, rockfrag, succeed, texts, write, write_motions};

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
        let its: Vec<_> = traced.iter().filter(|point| row["motion_id"] == *point.motion_id).collect();
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

/// Twelve sines in three groups, those of a group alike, as motions of one magnitude and distance or of
/// unknown ones.
fn write_groups(path: &Path, is_known: bool) {
    let omega = |k: usize| [3.0, 5.0, 8.0][k / 4] * (1.0 + 0.02 * (k % 4) as f64);
    let sine = |omega: f64| (0..400).map(|k| 3.0 * (omega * 0.01 * f64::from(k)).sin()).collect();
    let sines: Vec<Vec<f64>> = (0..12).map(|k| sine(omega(k))).collect();
    let ids: Vec<String> = (0..12).map(|k| k.to_string()).collect();
    // NaN is null.
    let known = if is_known { 1.0 } else { f64::NAN };
    let mw: Vec<f64> = (0..12).map(|k| known * (6.0 + 0.5 * (k / 4) as f64)).collect();
    let ids = texts(&ids.iter().map(String::as_str).collect::<Vec<_>>());
    let mut columns = motions_of(ids, 0.01, &sines.iter().map(Vec::as_slice).collect::<Vec<_>>());
    columns.extend([("mw", numbers(&mw)), ("re_km", numbers(&[10.0 * known; 12]))]);
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
    let stripes = objects(folder.path(), "ida.stripes.parquet");
    let share = |level: f64| {
        let at: Vec<_> = stripes.iter().filter(|row| number(row, "intensity") == level).collect();
        at.iter().filter(|row| row["outcome"] == "overturning").count() as f64 / at.len() as f64
    };
    let half = clustered.half_overturn_at.unwrap();
    let levels: Vec<f64> = stripes.iter().map(|row| number(row, "intensity")).collect();
    let above = levels.iter().copied().filter(|level| *level >= half).fold(f64::MAX, f64::min);
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
    succeed(folder.path(), "init site");
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

#[test]
fn threads_that_no_machine_can_start_are_errors() {
    let call = "evaluate --width 0.5 --height 2 --pga 0.5 --pgv 0.6";
    // No machine has the memory for such a stack.
    for (variable, value, code) in
        [("RAYON_NUM_THREADS", "100000", 2), ("RUST_MIN_STACK", "100000000000000", 1)]
    {
        let output = rockfrag(Path::new("."), call).env(variable, value).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(code) && !stderr.contains("panicked"), "{variable}: {stderr}");
    }
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
        ("run.yaml", &format!("evaluate:\n  structure: [{json}]\n  pga: 0.5\n  out: out/e.parquet\n")),
        ("option.yaml", &format!("evaluate:\n  \"{ESCAPED}\": 1\n")),
        ("value.yaml", &format!("evaluate:\n  pga: \"{ESCAPED}\"\n")),
    ]);
    let sine: Vec<f64> = (0..300).map(|k| 9.0 * (0.05 * f64::from(k)).sin()).collect();
    let motions = motions_of(texts(&[HOSTILE, "b"]), 0.01, &[&sine, &[0.1; 50]]);
    write(&folder.path().join("motions.parquet"), motions);
    let text = format!("name={HOSTILE},p=1.0,alpha=0.2,eta=0.9");
    let simulate = rockfrag(folder.path(), "simulate --structure").arg(text).output().unwrap();
    assert!(simulate.status.success());
    let page = "evaluate --structures list.csv --pga 0.5 --pgv 0.4 --out page.html";
    succeed(folder.path(), page);
    let html = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(!html.contains(is_raw));
    let over_hazard = format!("evaluate --structures list.csv {HAZARD}");
    let calls = [
        (page, 0),
        (&*over_hazard, 0),
        ("inspect responses.parquet", 0),
        ("inspect responses.parquet --head 3 --format json", 0),
        ("evaluate --structures list.csv --pga 0.5 --pgv 0.4 --format json", 0),
        ("simulate --structures list.csv", 0),
        ("ida --structures list.csv", 0),
        ("run run.yaml --dry-run", 0),
        ("run run.yaml", 0),
        ("run option.yaml", 2),
        ("run value.yaml", 2),
        ("evaluate --structures wrong.csv --pga 0.5 --pgv 0.4", 0),
        ("evaluate --structures heading.csv --pga 0.5 --pgv 0.4", 1),
    ];
    // A second time what is made is up to date.
    for (call, code) in calls.into_iter().chain(calls) {
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
    let csv = succeed(folder.path(), "evaluate --structures list.csv --pga 0.5 --format csv").0;
    assert!(csv.contains(HOSTILE), "CSV, too");
    let missing = rockfrag(folder.path(), "simulate --in none.parquet --trace").arg(HOSTILE).output();
    assert!(!missing.unwrap().stderr.contains(&0x1b));
}

#[test]
fn names_that_xml_cannot_hold_or_are_colours_are_drawn_and_kept() {
    let names = ["#0069a8", "a\u{fffe}\u{ffff}\u{85}b\u{202e}"];
    let list = names.map(|name| format!("{name},0.5,2\n")).concat();
    let folder = folder(&[("list.csv", &*format!("name,width,height\n{list}c,0.6,2\n"))]);
    for out in ["o.html", "o.svg", "o.png", "o.xlsx", "o.parquet"] {
        let call = format!("evaluate --structures list.csv {HAZARD} --out {out}");
        succeed(folder.path(), &call);
        let first = bytes(&folder.path().join(out));
        succeed(folder.path(), &format!("{call} --force"));
        assert!(bytes(&folder.path().join(out)) == first, "{out}");
    }
    succeed(folder.path(), "export --structures list.csv --to openquake --out o.xml");
    for file in ["o.html", "o.svg", "o.xml"] {
        let text = String::from_utf8(bytes(&folder.path().join(file))).unwrap();
        let stays = |letter: char| is_raw(letter) || ['\u{fffe}', '\u{ffff}'].contains(&letter);
        assert!(!text.contains(stays), "{file}");
        assert!(file != "o.html" || !text.contains(">var(--") && text.contains("\"var(--muted)\""));
    }
    succeed(folder.path(), "report --in o.parquet");
}
