//! evaluate as a user calls it.

use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use arrow_array::{ArrayRef, Float64Array};
use rockfrag::fragility::Measure;
use rockfrag::fragility::{p_failure_given_rocking, p_overturning};
use rockfrag::statistics::{FitStatus, Link};
use rockfrag::table::pro::ProRow;
use rockfrag::table::row::ReadRow;

use crate::common::{content, fail, rockfrag, succeed, write};

/// Enough motions for both planes.
const PIPELINE: &str = "\
sample-scenarios: { mw: \"6,7\", re: \"5,10\", samples: 60 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate:
  structures:
    - { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
    - { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
fit-pex: { transition: 1.3 }
fit-pro: {}
";

/// The folder of a run of that pipeline, made once for all tests.
pub fn run_folder() -> &'static Path {
    static RUN: OnceLock<PathBuf> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("evaluate");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("pipeline.yaml"), PIPELINE).unwrap();
        succeed(&folder, "run --force");
        folder.join("out")
    })
}

/// A folder of one's own, and options that choose the fits of the worked example.
pub fn fitted() -> (tempfile::TempDir, String) {
    let run = run_folder().display();
    let chosen = format!(
        "--pex {run}/pex.parquet --pro {run}/pro.parquet --suite csgm --structure electrical-equipment"
    );
    (tempfile::tempdir().unwrap(), chosen)
}

fn stdout(folder: &Path, arguments: &str) -> String {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A quantity of an answer in CSV.
fn quantity(answer: &str, name: &str) -> Option<f64> {
    let row = answer.lines().map(|line| line.split(',').collect::<Vec<_>>()).find(|cells| cells[0] == name);
    row.unwrap()[1].parse().ok()
}

#[test]
fn the_worked_example_of_section_3_is_answered() {
    let (folder, fits) = fitted();
    let wanted = |row: &&ProRow| {
        row.suite.as_deref() == Some("csgm")
            && row.structure == "electrical-equipment"
            && row.im_y == Some(Measure::Im3Inverse)
    };
    let rows = ProRow::read(run_folder().join("pro.parquet")).unwrap();
    let row = rows.iter().find(wanted).unwrap();
    let [lambda, mu, beta] = [row.lambda, row.mu, row.beta].map(Option::unwrap);
    for im in [1.55f64, 1.88] {
        // Where p PGV / PGA is 0.3, the PGA that makes the hybrid measure (Eq. 23) this.
        let im4 = (im.powf(1.0 + lambda) / 0.3).powf(1.0 / lambda);
        let pga_g = im4 * 0.2f64.tan();
        let pgv = 0.3 * pga_g * 9.81 / 2.5;
        let answer = stdout(
            folder.path(),
            &format!(
                "evaluate {fits} --model paper --p 2.5 --alpha 0.2 --pga {pga_g} --pgv {pgv} --format csv"
            ),
        );
        let number = |name| quantity(&answer, name).unwrap();
        assert!((number("im_hybrid") - im).abs() < 1e-12);
        assert!((number("p_ro") - p_overturning(im, mu, beta, Link::Probit)).abs() < 1e-12);
        let joined = p_failure_given_rocking(number("p_ro"), number("p_ex"));
        assert!((number("p_f_r") - joined).abs() < 1e-12);
    }
}

#[test]
fn a_table_is_not_written_under_the_name_of_another_format() {
    let (folder, fits) = fitted();
    let run = run_folder().display().to_string();
    for (call, file) in [
        (format!("evaluate {fits} --p 2.5 --alpha 0.2 --in {run}/motions.parquet --out t.json"), "t.json"),
        (format!("simulate --in {run}/motions.parquet --structures paper --out r.XLSX"), "r.XLSX"),
        (format!("fit-pro --in {run}/responses.parquet --out p.json"), "p.json"),
    ] {
        fail(folder.path(), &call, 2, &[file, "written as Parquet", "ends in .parquet"]);
        assert!(!folder.path().join(file).exists(), "{file}");
    }
}

#[test]
fn answers_come_in_every_format() {
    let (folder, fits) = fitted();
    let ask = |rest: &str| {
        stdout(folder.path(), &format!("evaluate {fits} --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6 {rest}"))
    };
    let table = ask("");
    assert!(table.contains("p_f_r") && table.contains("Eq. 12"), "{table}");
    let json: serde_json::Value = serde_json::from_str(&ask("--format json")).unwrap();
    assert_eq!(json["rows"][2]["quantity"], "p_ro");
    assert_eq!(json["rows"][2]["value"].as_f64(), quantity(&ask("--format csv"), "p_ro"));
    assert_eq!(ask("--format parquet --out a.parquet"), "");
    assert!(stdout(folder.path(), "inspect a.parquet").contains("made by evaluate"));
    assert_eq!(ask("--format csv --out a.csv"), "");
    assert_eq!(std::fs::read_to_string(folder.path().join("a.csv")).unwrap(), ask("--format csv"));
}

#[test]
fn below_uplift_nothing_fails() {
    let (folder, fits) = fitted();
    let answer = stdout(
        folder.path(),
        &format!("evaluate {fits} --p 2.5 --alpha 0.2 --pga 0.2 --pgv 0.6 --format csv"),
    );
    assert_eq!((quantity(&answer, "p_nr"), quantity(&answer, "p_ro")), (Some(1.0), None));
    assert_eq!(quantity(&answer, "p_f"), Some(0.0));
}

#[test]
fn extrapolation_is_told_with_the_reason() {
    let (folder, fits) = fitted();
    let ask = |rest: &str| succeed(folder.path(), &format!("evaluate {fits} {rest}"));
    assert!(!ask("--p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6").contains("extrapolated"));
    let told = ask("--p 2.5 --alpha 0.2 --pga 5 --pgv 6");
    assert!(told.contains("im4 is 24.6658, outside of 1.30"), "{told}");
    let told = ask("--p 2.5 --alpha 0.2 --eta 0.8 --pga 0.5 --pgv 0.6");
    assert!(told.contains("eta is 0.8000, but the fits are of eta 0.9200"), "{told}");
}

#[test]
fn structures_come_by_dimensions_or_by_name() {
    let (folder, fits) = fitted();
    let ask = |rest: &str| {
        stdout(folder.path(), &format!("evaluate {fits} --pga 0.5 --pgv 0.6 --format csv {rest}"))
    };
    std::fs::write(folder.path().join("s.yaml"), "- { name: a, width: 0.4, height: 1.6, eta: 0.92 }\n")
        .unwrap();
    assert_eq!(
        ask("--structures s.yaml --name a"),
        ask("--width 0.4 --height 1.6 --eta 0.92"),
        "the same block either way"
    );
    let univariate = ask("--p 2.5 --alpha 0.2 --model univariate --measure im4");
    assert!(!univariate.contains("im_hybrid") && quantity(&univariate, "p_ro").is_some());
}

#[test]
fn a_table_has_the_same_answers_on_any_number_of_threads() {
    let (folder, fits) = fitted();
    let run = run_folder().display();
    let table = format!("--in {run}/motions.parquet --p 2.5 --alpha 0.2");
    succeed(folder.path(), &format!("evaluate {fits} {table} --out one.parquet --threads 1"));
    succeed(folder.path(), &format!("evaluate {fits} {table} --out two.parquet --threads 2"));
    assert_eq!(content(&folder.path().join("one.parquet")), content(&folder.path().join("two.parquet")));
    let again = succeed(folder.path(), &format!("evaluate {fits} {table} --out two.parquet"));
    assert!(again.contains("up to date"), "{again}");
    // Each row of responses has its own structure.
    let told =
        succeed(folder.path(), &format!("evaluate {fits} --in {run}/responses.parquet --out r.parquet"));
    assert!(told.contains("960 rows"), "{told}");
}

#[test]
fn a_table_of_anyone_will_do() {
    let (folder, fits) = fitted();
    let numbers = |values: Vec<f64>| -> ArrayRef { Arc::new(Float64Array::from(values)) };
    let path = folder.path().join("t.parquet");
    let (pga, pgv) = (numbers(vec![1.0, 5.0, 5.0]), numbers(vec![0.1, 0.6, 0.0]));
    write(&path, vec![("pga_m_s2", pga.clone()), ("pgv_m_s", pgv.clone())]);
    let told = succeed(folder.path(), &format!("evaluate {fits} --in t.parquet --p 2.5 --alpha 0.2"));
    assert!(told.contains("1 rows have no value of a measure"), "{told}");
    fail(folder.path(), &format!("evaluate {fits} --in t.parquet"), 1, &["no column 'p_rad_s'"]);
    let p = numbers(vec![2.5, 0.0, 2.5]);
    write(&path, vec![("pga_m_s2", pga), ("pgv_m_s", pgv), ("p_rad_s", p.clone()), ("alpha_rad", p)]);
    fail(folder.path(), &format!("evaluate {fits} --in t.parquet"), 1, &["row 1", "p_rad_s", "above 0"]);
}

/// The motions of a hazard of PGA, in bins of PGA and of PGV given it: what a joint hazard of them is.
fn joint_bins(pro: &ProRow, rate_of_exceedance: impl Fn(f64) -> f64) -> String {
    let [k0, k1, k2, b0, b1, b2, sd] = pro.ratio_given_pga.unwrap();
    let cube = |u: f64| u.max(0.0).powi(3);
    let bend = |u: f64| {
        let outer = ((k2 - k0) * cube(u - k1) - (k1 - k0) * cube(u - k2)) / (k2 - k1);
        (cube(u - k0) - outer) / (k2 - k0).powi(2)
    };
    let mut text = String::from("pga_m_s2,pgv_m_s,annual_rate_of_occurrence\n");
    let edges: Vec<f64> = (0..=600).map(|k| 0.5 * (100.0f64).powf(f64::from(k) / 600.0)).collect();
    for edge in edges.windows(2) {
        let (pga, rate) =
            ((edge[0] * edge[1]).sqrt(), rate_of_exceedance(edge[0]) - rate_of_exceedance(edge[1]));
        for z in (-40..=40).map(|k| 0.1 * f64::from(k)) {
            let weight = 0.1 * (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
            let ln_pgv = pga.ln() + b0 + b1 * pga.ln() + b2 * bend(pga.ln()) + z * sd;
            // What is larger is refused, and too rare to matter.
            if ln_pgv.exp() < 20.0 {
                text += &format!("{pga},{},{}\n", ln_pgv.exp(), rate * weight);
            }
        }
    }
    text
}

#[test]
fn without_a_ratio_a_hazard_of_one_peak_is_the_joint_one_of_the_motions_of_the_fits() {
    let (folder, fits) = fitted();
    let rows = ProRow::read(run_folder().join("pro.parquet")).unwrap();
    let of = |row: &&ProRow| row.suite.as_deref() == Some("csgm") && row.structure == "electrical-equipment";
    // A power law from 0.5 to 50 m/s2, cut off there.
    let exceeded = |pga: f64| 0.02 * (pga.powi(-2) - 50f64.powi(-2)).max(1e-12);
    let line = |k: u32| {
        let pga = 0.5 * 100f64.powf(f64::from(k) / 600.0);
        format!("{pga},{}\n", exceeded(pga))
    };
    let curve = "pga_m_s2,annual_rate_of_exceedance\n".to_string() + &(0..=600).map(line).collect::<String>();
    std::fs::write(folder.path().join("curve.csv"), curve).unwrap();
    let joint = joint_bins(rows.iter().find(of).unwrap(), exceeded);
    std::fs::write(folder.path().join("joint.csv"), joint).unwrap();
    let rates = |hazard: &str| {
        let call = format!("evaluate {fits} --p 2.5 --alpha 0.2 --hazard {hazard} --format json");
        let rates: serde_json::Value = serde_json::from_str(&stdout(folder.path(), &call)).unwrap();
        [0, 1, 2].map(|state| rates["rows"][state]["annual_rate"].as_f64().unwrap())
    };
    for (one, joint) in rates("curve.csv").into_iter().zip(rates("joint.csv")) {
        // Bins of 0.8 % of PGA cut uplift and the transition roughly.
        assert!((one / joint - 1.0).abs() < 0.01, "{one} for {joint}");
    }
    let said = stdout(folder.path(), &format!("evaluate {fits} --p 2.5 --alpha 0.2 --hazard curve.csv"));
    assert!(said.contains("p PGV / PGA rises with PGA, as in the motions of the fits"), "{said}");
}

#[test]
fn a_curve_that_its_tests_reject_says_by_how_much_it_is_off() {
    let rows = ProRow::read(run_folder().join("pro.parquet")).unwrap();
    let gap = |row: &ProRow| Some((row.gap_straight? - row.gap_bent?).abs());
    for row in &rows {
        let least = [row.hosmer_lemeshow_p, row.spline_p, row.interaction_p]
            .into_iter()
            .flatten()
            .fold(1.0, f64::min);
        let rejected = least < 0.01 / 3.0 && gap(row).is_some_and(|gap| gap > 0.05);
        assert!(row.status != FitStatus::Misfit || rejected, "{row:?}");
        assert!(row.status != FitStatus::Ok || !rejected, "{row:?}");
    }
    assert!(rows.iter().any(|row| row.status == FitStatus::Misfit));
}

#[test]
fn a_curve_taken_to_another_structure_says_how_such_transfers_fared() {
    let (folder, fits) = fitted();
    let ask =
        |structure: &str| succeed(folder.path(), &format!("evaluate {fits} {structure} --pga 0.5 --pgv 0.6"));
    assert!(!ask("--p 2.5 --alpha 0.2").contains("study of universality"));
    let told = ask("--p 2.5 --alpha 0.05");
    assert!(told.contains("alpha 0.050") && told.contains("curves taken as far, 0 held"), "{told}");
    assert!(ask("--p 2.5 --alpha 0.5").contains("in the study of universality"));
}

#[test]
fn a_hazard_gives_annual_rates() {
    let (folder, fits) = fitted();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/data");
    let ask = |rest: &str| {
        stdout(folder.path(), &format!("evaluate {fits} --p 2.5 --alpha 0.2 --format csv {rest}"))
    };
    let curve = ask(&format!("--hazard {data}/hazard.csv --ratio 0.25"));
    let [rocking, failure, overturning] = ["LS1", "LS2", "LS3"].map(|state| quantity(&curve, state).unwrap());
    assert!(rocking > failure && failure > overturning && overturning > 0.0, "{curve}");
    // ln H is linear in ln PGA between 0.20 and 0.30 g, and uplift is at g tan alpha.
    let expected = 7e-3 * (0.2f64.tan() / 0.2).powf((3.6e-3f64 / 7e-3).ln() / 1.5f64.ln());
    assert!((rocking / expected - 1.0).abs() < 1e-9);
    // The same site with both peaks known: the ratio of 0.25 is the median of its motions.
    let joint = ask(&format!("--hazard {data}/hazard_joint.csv"));
    assert!((quantity(&joint, "LS2").unwrap() / failure - 1.0).abs() < 0.2, "{joint}");
}

#[test]
fn limits_come_from_resamples_if_asked() {
    let folder = tempfile::tempdir().unwrap();
    let responses = run_folder().join("responses.parquet");
    std::fs::copy(responses, folder.path().join("responses.parquet")).unwrap();
    let fit = |rest: &str| {
        succeed(folder.path(), &format!("fit-pex --transition 1.3 {rest}"));
        succeed(folder.path(), "fit-pro --bootstrap 200");
    };
    let call = "evaluate --suite csgm --structure electrical-equipment --p 2.5 --alpha 0.2";
    let point = format!("{call} --pga 0.5 --pgv 0.6 --format json");
    fit("");
    fail(
        folder.path(),
        &format!("{point} --limits percentile"),
        2,
        &["pex.bootstrap.parquet", "--bootstrap 2000"],
    );
    fit("--bootstrap 200 --seed 7");
    fail(folder.path(), &format!("{point} --limits percentile"), 2, &["other seeds"]);
    fit("--bootstrap 200");
    let ask = |limits: &str| -> serde_json::Value {
        serde_json::from_str(&stdout(folder.path(), &format!("{point} --limits {limits}"))).unwrap()
    };
    let delta = ask("delta");
    for limits in ["percentile", "bc"] {
        let answer = ask(limits);
        for row in [1, 2, 3, 4] {
            let of = |answer: &serde_json::Value, name: &str| answer["rows"][row][name].as_f64().unwrap();
            assert_eq!(of(&answer, "value"), of(&delta, "value"));
            let width = |answer| of(answer, "high") - of(answer, "low");
            assert!(of(&answer, "low") < of(&answer, "value") && of(&answer, "value") < of(&answer, "high"));
            // They hold the fits alone; those by the delta method hold what a magnitude and distance differ by, too.
            let ratio = width(&answer) / width(&delta);
            assert!((0.05..1.1).contains(&ratio), "{limits} limits of row {row} are {ratio} times as wide");
        }
    }
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/data");
    let hazard = format!("{call} --hazard {data}/hazard.csv --ratio 0.25 --limits bc --format json");
    let rates: serde_json::Value = serde_json::from_str(&stdout(folder.path(), &hazard)).unwrap();
    let rate = |state: usize, name: &str| rates["rows"][state][name].as_f64().unwrap();
    assert!(rates["rows"][0]["annual_rate_low"].is_null(), "uplift is certain");
    assert!(
        rate(2, "annual_rate_low") < rate(2, "annual_rate")
            && rate(2, "annual_rate") < rate(2, "annual_rate_high")
    );
    let table = format!("{call} --in {}/motions.parquet --out t.parquet", run_folder().display());
    succeed(folder.path(), &table);
    let told = succeed(folder.path(), &format!("{table} --limits bc"));
    assert!(told.contains("480 rows") && !told.contains("up to date"), "{told}");
    std::fs::remove_file(folder.path().join("pro.parquet")).unwrap();
    succeed(folder.path(), "fit-pro");
    fail(folder.path(), &format!("{point} --limits bc"), 2, &["not made together with pro.parquet"]);
}

#[test]
fn few_events_are_told_with_what_to_take() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(run_folder().join("responses.parquet"), folder.path().join("responses.parquet")).unwrap();
    succeed(folder.path(), "fit-pex --transition 1.3 --bootstrap 50");
    let told = succeed(folder.path(), "fit-pro --bootstrap 50");
    assert!(told.contains("few events for pulse, electrical-equipment (10 of 92 cases)"), "{told}");
    let call =
        "evaluate --suite pulse --structure electrical-equipment --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6";
    assert!(!succeed(folder.path(), call).contains("limits delta"));
    let told = succeed(folder.path(), &format!("{call} --limits percentile"));
    assert!(told.contains("those of --limits delta are not"), "{told}");
}

#[test]
fn limits_from_few_magnitudes_and_distances_are_doubted() {
    for (cells, few) in
        [("--mw 6.5 --re 5:20:5 --samples 30", true), ("--mw 6:7:0.5 --re 5:20:2.5 --samples 6", false)]
    {
        let folder = tempfile::tempdir().unwrap();
        succeed(folder.path(), &format!("sample-scenarios {cells}"));
        succeed(folder.path(), "synthesize-motions --suite csgm");
        succeed(folder.path(), "simulate --structures paper");
        succeed(folder.path(), "fit-pex --transition 1.3");
        succeed(folder.path(), "fit-pro");
        let call = "evaluate --structure electrical-equipment --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6";
        let told = succeed(folder.path(), call);
        assert_eq!(told.contains("fewer than 20 magnitudes and distances, or earthquakes"), few, "{told}");
    }
}

#[test]
fn questions_without_an_answer_are_explained() {
    let (folder, fits) = fitted();
    let ask = |rest: &str, code, expected: &[&str]| {
        fail(folder.path(), &format!("evaluate {rest}"), code, expected);
    };
    let structure = "--p 2.5 --alpha 0.2";
    let run = run_folder().display();
    let files = format!("--pex {run}/pex.parquet --pro {run}/pro.parquet");
    ask(&format!("{files} --suite csgm {structure} --pga 1 --pgv 1"), 2, &["--suite csgm --structure frame"]);
    ask(
        &format!("{files} --suite cgsm {structure} --pga 1 --pgv 1"),
        2,
        &["--suite pulse --structure frame"],
    );
    ask(&format!("{fits} --pga 1 --pgv 1"), 2, &["expected p, alpha and eta"]);
    ask(&format!("{fits} {structure} --pga 1"), 2, &["--pga (g) and --pgv (m/s)"]);
    ask(&format!("{fits} {structure} --pga=-1 --pgv 1"), 2, &["pga is -1"]);
    ask(&format!("{fits} {structure} --pga nan --pgv 1"), 2, &["pga is not a finite number"]);
    ask(&format!("{fits} {structure} --pga 1 --pgv 1 --measure im4"), 2, &["needs --model univariate"]);
    ask(&format!("{fits} {structure} --pga 1 --pgv 1 --format parquet"), 2, &["--out"]);
    ask("--pex none.parquet --p 1 --alpha 0.2 --pga 1 --pgv 1", 1, &["none.parquet: no such file"]);
    let hazard = |text: &str, rest: &str, code, expected: &[&str]| {
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        ask(&format!("{fits} {structure} --hazard h.csv {rest}"), code, expected);
    };
    let good = "pga_g,annual_rate_of_exceedance\n0.1,0.01\n1,0.001\n";
    hazard(good, "--ratio 0", 2, &["ratio is 0"]);
    hazard("pga,rate\n1,1\n", "--ratio 1", 1, &["h.csv", "columns pga, rate", "expected pga_g"]);
    hazard(&good.replace("0.001", "x"), "--ratio 1", 1, &["h.csv", "line 3", "'x'"]);
    hazard(&good.replace("0.001", "0.1"), "--ratio 1", 1, &["h.csv", "line 3", "before it stand pga_g 0.1"]);
    hazard(good, "--ratio 1 --model univariate --measure im6", 2, &["need the period"]);
    hazard(good, "--ratio 1 --model univariate --measure im1", 2, &["im1 is falling", "choose a measure"]);
}

#[test]
fn a_table_of_pga_in_g_is_doubted() {
    let folder = tempfile::tempdir().unwrap();
    let table = |scale: f64| {
        let peaks = |values: [f64; 3]| Arc::new(Float64Array::from(values.to_vec())) as ArrayRef;
        let pga = peaks([0.3, 0.5, 0.8].map(|pga| pga * scale));
        write(&folder.path().join("g.parquet"), vec![("pga_m_s2", pga), ("pgv_m_s", peaks([0.3, 0.5, 0.8]))]);
        let call = "evaluate --in g.parquet --p 2.5 --alpha 0.2 --eta 0.92 --out e.parquet";
        succeed(folder.path(), call)
    };
    let told = table(1.0);
    assert!(told.contains("no row rocks: PGA is at most 0.8 m/s2; is it in g?"), "{told}");
    let told = table(9.81);
    assert!(!told.contains("no row rocks"), "{told}");
}

#[test]
fn one_fit_alone_asks_for_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let run = run_folder().display();
    let ask = "--p 2.5 --alpha 0.2 --pga 1 --pgv 1";
    fail(
        folder.path(),
        &format!("evaluate --pro {run}/pro.parquet {ask}"),
        2,
        &["pro.parquet", "expected --pex FILE"],
    );
    fail(
        folder.path(),
        &format!("evaluate --pex {run}/pex.parquet {ask}"),
        2,
        &["pex.parquet", "expected --pro FILE"],
    );
}

#[test]
fn a_hazard_that_misleads_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let told = |rows: &str, rest: &str| {
        std::fs::write(folder.path().join("h.csv"), rows).unwrap();
        succeed(folder.path(), &format!("evaluate --width 0.5 --height 2.0 --hazard h.csv {rest}"))
    };
    let short = told("pga_g,annual_rate_of_exceedance\n0.1,0.01\n0.3,0.002\n", "");
    assert!(short.contains("too low to use") && short.contains("extend the curve"), "{short}");
    let long = "PGA (g),return_period\n0.05,50\n0.2,100\n1,5000\n4,900000\n";
    let plain = told(long, "");
    assert!(!plain.contains("warning"), "{plain}");
    let in_m_s2 = told("PGA (g),return_period\n0.5,50\n2,100\n10,5000\n14.7,50000\n", "");
    assert!(in_m_s2.contains("reaches 14.7000 g") && in_m_s2.contains("ever recorded"), "{in_m_s2}");
    let ratio = told(long, "--ratio 2.5");
    assert!(ratio.contains("ratio is 2.5") && ratio.contains("PGA in m/s2"), "{ratio}");
}

#[test]
fn a_hazard_from_rare_to_frequent_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let answer = |rows: &[&str]| {
        let text = format!("pga_g,annual_rate_of_exceedance\n{}\n", rows.join("\n"));
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        stdout(folder.path(), "evaluate --width 0.5 --height 2.0 --hazard h.csv")
    };
    let rows = ["0.1,0.01", "0.5,0.001", "2,0.000001"];
    let turned: Vec<&str> = rows.into_iter().rev().collect();
    assert_eq!(answer(&rows), answer(&turned));
    let refused = |text: &str, expected: &[&str]| {
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        fail(folder.path(), "evaluate --width 0.5 --height 2.0 --hazard h.csv", 1, expected);
    };
    refused("pga_g,annual_rate_of_exceedance\n0.01,0.1\n0.001,0.5\n", &["columns are not exchanged"]);
    refused(
        "PGA,annual_rate_of_exceedance\n0.1,0.01\n0.5,0.001\n",
        &["column 'PGA' has no unit", "pga_m_s2"],
    );
}

#[test]
fn a_measure_that_is_missing_is_named_with_its_option() {
    let (folder, fits) = fitted();
    let asked =
        format!("evaluate {fits} --p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --model univariate --measure im6");
    fail(folder.path(), &format!("{asked} --pgv 0.6"), 2, &["the fits need im6: give --tm\n"]);
    assert!(!succeed(folder.path(), &format!("{asked} --pgv 0.6 --tm 0.6")).contains("the fits need"));
    let told = succeed(folder.path(), &format!("{asked} --pgv 0 --tm 0.6"));
    assert!(told.contains("warning: the fits need im6: give --pgv above 0\n"), "{told}");
}

#[test]
fn what_is_missing_is_named() {
    let (folder, _) = fitted();
    let ask = |rest: &str, expected: &[&str]| {
        fail(folder.path(), &format!("evaluate {rest}"), 2, expected);
    };
    ask("--width 0.6 --height 1.8 --pga 0.5", &["depends strongly on the PGV", "to 1.05 m/s", "both ends"]);
    ask("--p 2 --alpha 0.2 --pga 0.5 --pgv 0.5", &["eta is missing"]);
    std::fs::copy(run_folder().join("pex.parquet"), folder.path().join("pex.parquet")).unwrap();
    let lone = "--width 0.6 --height 1.8 --pga 0.5 --pgv 0.5";
    ask(lone, &["found pex.parquet, but no pro.parquet", "--model universal, which needs neither"]);
    succeed(folder.path(), &format!("evaluate {lone} --model universal"));
}

#[test]
fn a_curve_from_one_overturning_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let pipeline = PIPELINE.split("simulate:").next().unwrap();
    let structure = "simulate: { structures: [{ name: block, width: 0.8, height: 2.4 }] }\n";
    let fits = "fit-pex: { transition: 1.3 }\nfit-pro: { estimator: firth }\n";
    let pipeline = pipeline.replace("[pulse, csgm]", "[csgm]") + structure + fits;
    std::fs::write(folder.path().join("pipeline.yaml"), &pipeline).unwrap();
    let run = rockfrag(folder.path()).args(["run"]).output().unwrap();
    let [said, found] = [run.stderr, run.stdout].map(|text| String::from_utf8(text).unwrap());
    assert!(said.contains("overturned, of 240 motions: block by 1\n"), "{said}");
    assert!(
        found.contains("from 1 overturning of 212 motions: this says little more than an upper"),
        "{found}"
    );
    let fits = "--pex out/pex.parquet --pro out/pro.parquet";
    let told =
        succeed(folder.path(), &format!("evaluate {fits} --width 0.8 --height 2.4 --pga 0.6 --pgv 0.5"));
    assert!(told.contains("P_ro comes from 1 overturning of 212 motions"), "{told}");
    // Of synthesized motions there can be more; they are not scaled.
    std::fs::write(folder.path().join("pipeline.yaml"), pipeline.replace("firth", "ml")).unwrap();
    let told = succeed(folder.path(), "run");
    for part in ["1 of 212", "more samples", "pipeline.yaml", "--model universal"] {
        assert!(told.contains(part), "{part}: {told}");
    }
}
