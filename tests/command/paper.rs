//! The paper's run as it is shipped, without the report: its numbers, and the schemas of all files that the
//! stages write.

use std::collections::{BTreeMap, HashSet};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::LazyLock;

use arrow_schema::{FieldRef, Schema};
use parquet::arrow::arrow_reader::{ArrowReaderMetadata, ArrowReaderOptions};
use rockfrag::table::responses::ResponseRow;
use rockfrag::table::rows;
use rockfrag_core::fragility::{CurveFit, DemandFit, DemandModel, Event, Group, Measure, ParameterRow};
use rockfrag_core::fragility::{lambda, mu};
use rockfrag_core::studies::{ReliabilityBin, Validation};

use crate::common::{fail, folder_with, objects, succeed};

/// The folder of the run. It holds `out`.
pub static RUN: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = folder_with(&include_str!("../../pipeline.yaml").replace("report: {}", ""));
    succeed(folder.path(), "run");
    folder
});

fn out(name: &str) -> std::path::PathBuf {
    RUN.path().join("out").join(name)
}

/// Numbers of the fits, by name, suite and structure as in paper_run.csv, values of regression.
fn numbers() -> BTreeMap<String, f64> {
    let mut all = BTreeMap::new();
    let mut put = |of: &str, suite: &Option<String>, structure: &str, columns: &[(&str, Option<f64>)]| {
        for (column, value) in columns {
            let name = format!("{of}_{column},{},{structure}", suite.as_deref().unwrap());
            all.entry(name).or_insert(value.unwrap_or(f64::NAN));
        }
    };
    let planes: Vec<DemandFit> = rows::read(&out("pex.parquet")).unwrap();
    for fit in planes.iter().filter(|fit| fit.model == DemandModel::Biplanar) {
        let side = if fit.range_high.is_some() { "low" } else { "high" };
        let [ln_a, b1, b2] = [0, 1, 2].map(|at: usize| Some(fit.coefficients[at]));
        let columns = [("ln_a", ln_a), ("b1", b1), ("b2", b2), ("r2", fit.r2), ("beta", fit.beta)];
        put(side, &fit.suite, &fit.structure.name, &columns);
    }
    let name_of = |im_x: &Measure, im_y: &Option<Measure>| match (im_x, im_y) {
        (Measure::Im5, None) => "im5",
        (Measure::Im4, Some(Measure::Im3Inverse)) => "hybrid",
        _ => "other",
    };
    let curves: Vec<CurveFit> = rows::read(&out("pro.parquet")).unwrap();
    for fit in curves.iter().filter(|fit| fit.event == Event::Overturning) {
        let lambda = fit.im_y.as_ref().map(|_| lambda(&fit.coefficients).value);
        let columns = [("mu", Some(mu(&fit.coefficients).value)), ("lambda", lambda), ("auc", fit.auc)];
        let scores = [("log_likelihood", fit.log_likelihood), ("brier", fit.brier)];
        put(
            name_of(&fit.im_x, &fit.im_y),
            &fit.suite,
            &fit.structure.name,
            &[&columns[..], &scores].concat(),
        );
    }
    let parameters: Vec<ParameterRow> = rows::read(&out("pro.parameters.parquet")).unwrap();
    for row in &parameters {
        let (parameter, error) = (row.parameter.to_string(), format!("se_{}_clustered", row.parameter));
        let columns = [(&*parameter, Some(row.value)), (&*error, Some(row.standard_error))];
        put(name_of(&row.im_x, &row.im_y), &row.suite, &row.structure, &columns);
    }
    all
}

#[test]
fn the_papers_run_has_its_numbers() {
    let numbers = numbers();
    let mut wrong = Vec::new();
    for line in include_str!("../reference/paper_run.csv").lines().skip(1) {
        let (name, value) = line.rsplit_once(',').unwrap();
        let (expected, ours): (f64, f64) = (value.parse().unwrap(), numbers[name]);
        if ours.is_nan() || (ours - expected).abs() > 1e-6 * expected.abs().max(1.0) {
            wrong.push(format!("{name}: {ours}, not {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_bare_commands_in_an_empty_folder_make_table_ii_of_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let print = |stage: &str| succeed(folder.path(), stage).0;
    for stage in ["sample-scenarios", "synthesize-motions", "simulate", "fit-pex", "fit-pro"] {
        let printed = print(stage);
        let first = printed.lines().next().unwrap();
        let tells_of_paper = first.contains("of the paper") && first.contains("--width");
        assert_eq!(tells_of_paper, stage == "simulate", "{first}");
    }
    let planes = |path: &Path| -> Vec<DemandFit> {
        let fits: Vec<DemandFit> = rows::read(path).unwrap();
        fits.into_iter().filter(|fit| fit.model == DemandModel::Biplanar).collect()
    };
    let bare = planes(&folder.path().join("pex.parquet"));
    assert_eq!(bare.len(), 8);
    assert_eq!(bare, planes(&out("pex.parquet")));
    assert!(print("compare-paper").contains("is in the paper's set-up"));
    fail(folder.path(), "ida", 2, &["no structure"]);
}

#[test]
fn responses_have_the_measures_of_eq_13() {
    let rows: Vec<ResponseRow> = rows::read(&out("responses.parquet")).unwrap();
    for row in rows.iter().step_by(97) {
        let im = row.measures;
        let (p, unit) = (row.structure.p_rad_s, 9.81 * row.structure.alpha_rad.tan());
        let circular = |period: Option<f64>| 2.0 * PI / period.unwrap();
        for (ours, expected) in [
            (im.im1.unwrap(), circular(row.tp_s) / p),
            (im.im2.unwrap(), circular(row.tm_s) / p),
            (im.im3.unwrap(), row.pga_m_s2 / (p * row.pgv_m_s)),
            (im.im4, row.pga_m_s2 / unit),
            (im.im5, p * row.pgv_m_s / unit),
            (im.im6.unwrap(), circular(row.tm_s) * row.pgv_m_s / unit),
        ] {
            assert!((ours / expected - 1.0).abs() < 1e-12, "{row:?}");
        }
    }
}

#[test]
fn what_is_not_the_papers_set_up_is_named() {
    let folder = RUN.path();
    const PAPERS: &str = "is in the paper's set-up";
    let call = |words: String| succeed(folder, &format!("{words} --force")).0;
    // Structures, if they are simulated anew; options of fit-pex; what is said; whether there are numbers.
    for (structures, options, said, is_compared) in [
        ("", "--transition 2.5", "fit-pex --transition 2.5, not 1.3.", true),
        ("", "--limit-state 0.5", "fit-pex --limit-state 0.5, not 0.1.", true),
        ("", "--rotation-floor 0", "fit-pex --rotation-floor 0, not 1e-6.", true),
        ("", "--limit-state 0.1,0.5 --all --confidence 0.68 --pairs im5", PAPERS, true),
        ("portal,p=1,alpha=0.15 trafo,p=2.5,alpha=0.2", "", PAPERS, true),
        ("frame,p=1.2,alpha=0.15 trafo,p=2.5,alpha=0.2", "", "frame: p 1.2, not 1.", true),
        ("frame,p=1,alpha=0.149", "", "frame: alpha 0.149 (also printed in the paper), not 0.15\n", false),
        ("cabinet,p=2,alpha=0.3", "", "no fits of its frame\n", false),
    ] {
        let of = if structures.is_empty() { "out" } else { "other" };
        if of == "other" {
            let named = structures.split(' ').map(|one| format!("--structure name={one},eta=0.92"));
            let named = named.collect::<Vec<_>>().join(" ");
            call(format!("simulate --in out/motions.parquet {named} --out other/responses.parquet"));
            call("fit-pro --in other/responses.parquet --out other/pro.parquet".to_string());
        }
        call(format!("fit-pex --in {of}/responses.parquet {options} --out other/pex.parquet"));
        let fits = format!("--pex other/pex.parquet --pro {of}/pro.parquet");
        let printed = call(format!("compare-paper {fits} --out other/paper.parquet"));
        assert!(printed.contains(said), "{printed}");
        assert!(printed.contains("planes of Table II") == is_compared, "{printed}");
    }
}

#[test]
fn high_frequencies_alone_have_no_pulse_and_no_im1() {
    let folder = RUN.path();
    succeed(folder, "sample-scenarios --samples 1 --out hfc/scenarios.parquet");
    succeed(folder, "synthesize-motions --in hfc/scenarios.parquet --suite hfc --out hfc/motions.parquet");
    succeed(folder, "simulate --in hfc/motions.parquet --out hfc/responses.parquet");
    let rows: Vec<ResponseRow> = rows::read(&folder.join("hfc/responses.parquet")).unwrap();
    let has_none = |row: &ResponseRow| row.tp_s.is_none() && row.measures.im1.is_none();
    assert!(rows.len() == 70 && rows.iter().all(|row| has_none(row) && row.measures.im2.is_some()));
}

/// Each column: name, type, unit.
fn columns(schema: &Schema) -> String {
    let column = |field: &FieldRef| {
        let unit = field.metadata().get("unit").map_or("NOT IN THE DICTIONARY", String::as_str);
        format!("  {} {} {unit}\n", field.name(), field.data_type())
    };
    schema.fields().iter().map(column).collect()
}

#[test]
fn fits_without_one_of_the_planes_are_not_exported() {
    let folder = tempfile::tempdir().unwrap();
    let responses = RUN.path().join("out/responses.parquet");
    succeed(folder.path(), &format!("fit-pro --in {} --out pro.parquet", responses.display()));
    let fit = format!("fit-pex --in {} --transition 1.001 --out pex.parquet", responses.display());
    succeed(folder.path(), &fit);
    let export = "export --to openquake --fits . --model paper --suite csgm --p 1 --alpha 0.15 --eta 0.92";
    fail(folder.path(), export, 2, &["some motions"]);
}

#[test]
fn columns_of_the_motions_are_fitted() {
    let folder = RUN.path();
    let read = "--in out/responses.parquet --motions out/motions.parquet";
    let measures = "im5,im5:arias_m_s,pgv_m_s,gamma";
    for name in ["pex", "pro"] {
        succeed(folder, &format!("fit-{name} {read} --pairs {measures} --out further/{name}.parquet"));
    }
    let curves: Vec<CurveFit> = rows::read(&folder.join("further/pro.parquet")).unwrap();
    let is_it = |group: Group| group == Group { suite: Some("csgm"), structure: "electrical-equipment" };
    let curves: Vec<&CurveFit> = curves.iter().filter(|fit| is_it(fit.group())).collect();
    // p PGV / (g tan alpha) is IM5.
    let of = |name: &str| curves.iter().find(|fit| fit.predictors().to_string() == name).unwrap();
    let apart = of("pgv_m_s").coefficients.iter().zip(&of("im5").coefficients).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-9);
}

#[test]
fn every_file_has_its_schema() {
    let folder = RUN.path();
    let row = |k: i32| format!("{},{}\n", f64::from(k) * 0.01, (f64::from(k) * 0.1).sin());
    let record: String = (0..400).map(row).collect();
    std::fs::write(folder.join("record.csv"), format!("time (s),acceleration (g)\n{record}")).unwrap();
    let about = "file,magnitude,distance (km),earthquake\nother.csv,6.1,,B\nrecord.csv,7.3,4.5,A\n";
    std::fs::write(folder.join("about.csv"), about).unwrap();
    std::fs::write(folder.join("hazard.csv"), include_str!("../../data/hazard.csv")).unwrap();
    std::fs::write(folder.join("peaks.csv"), "pga_m_s2,pgv_m_s\n4,0.5\n").unwrap();
    for call in [
        "import-motions record.csv --out out/records.parquet --accept-implausible --about about.csv",
        "simulate --in out/motions.parquet --p 2.5 --alpha 0.2 --eta 0.92 --trace 1 --out out/one.parquet",
        "ida --in out/records.parquet --p 2.5 --alpha 0.2 --eta 0.92 --out out/ida.parquet",
        "floor-motions --in out/records.parquet --period 0.5 --level 1 --out out/floor.parquet",
        "evaluate --width 0.5 --height 2 --out out/evaluate.over.parquet",
        "evaluate --width 0.5 --height 2 --pga 0.4 --out out/evaluate.motion.parquet",
        "evaluate --width 0.5 --height 2 --hazard hazard.csv --target 1% --variants --out out/evaluate.hazard.parquet",
        "evaluate --width 0.5 --height 2 --in peaks.csv --out out/evaluate.in.parquet",
    ] {
        succeed(folder, call);
    }
    fail(folder, "report --in out/ida.parquet --out read.html", 1, &["content"]);
    let record = &objects(folder, "out/records.parquet")[0];
    assert!(record["mw"] == 7.3 && record["re_km"] == 4.5 && record["earthquake"] == "A", "{record}");
    std::fs::write(folder.join("about.csv"), "file,magnitude\nrecord.csv,73\n").unwrap();
    fail(folder, "import-motions record.csv --out other.parquet --about about.csv", 2, &["about.csv", "73"]);
    std::fs::write(folder.join("about.csv"), "file,magnitude\nrecord.csv,7.3\nrecord.csv,5\n").unwrap();
    fail(folder, "import-motions record.csv --out other.parquet --about about.csv", 2, &["line 3", "again"]);
    std::fs::copy(folder.join("record.csv"), folder.join("copy.csv")).unwrap();
    let both = "import-motions record.csv copy.csv --out other.parquet --accept-implausible";
    fail(folder, both, 1, &["same record"]);
    let mut files: Vec<_> = out("").read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "parquet"));
    files.sort_unstable();
    let mut text = String::new();
    for path in &files {
        let file = std::fs::File::open(path).unwrap();
        let schema = ArrowReaderMetadata::load(&file, ArrowReaderOptions::new()).unwrap().schema().clone();
        text += &format!("{}\n{}", path.file_name().unwrap().display(), columns(&schema));
    }
    text += &format!("validation.parquet\n{}", columns(&rows::schema::<Validation>()));
    text += &format!("validation.reliability.parquet\n{}", columns(&rows::schema::<ReliabilityBin>()));
    assert!(!text.contains("NOT IN"), "{text}");
    let written: HashSet<&str> = text.split_whitespace().collect();
    let unwritten = rockfrag::table::dictionary::names().filter(|name| !written.contains(name));
    // Spectral accelerations are named by their period; `inspect` alone prints meanings.
    assert_eq!(unwritten.collect::<Vec<_>>(), ["sa_*_m_s2", "meaning"]);
    insta::assert_snapshot!(text);
}
