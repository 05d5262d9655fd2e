//! The paper's run as it is shipped, without the report: its numbers, and the schemas of all files that the
//! stages write.

use std::collections::{BTreeMap, HashSet};
use std::f64::consts::PI;
use std::path::Path;
use std::sync::LazyLock;

use arrow_schema::{FieldRef, Schema};
use parquet::arrow::arrow_reader::{ArrowReaderMetadata, ArrowReaderOptions};
use rockfrag::table::answers::FragilityRow;
use rockfrag::table::responses::ResponseRow;
use rockfrag::table::rows;
use rockfrag_core::fragility::{CurveFit, DemandFit, DemandModel, Event, Group, Measure, ParameterRow};
use rockfrag_core::fragility::{lambda, mu};
use rockfrag_core::studies::{ReliabilityBin, Validation};

use crate::common::{fail, folder_with, objects, succeed};

/// The folder of the run. It holds `out`.
static RUN: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = folder_with(&include_str!("../../pipeline.yaml").replace("report: {}", ""));
    succeed(folder.path(), "run");
    folder
});

fn out(name: &str) -> std::path::PathBuf {
    RUN.path().join("out").join(name)
}

/// A number of the fit of this suite and structure, by its name in paper_run.csv, the run of tree 6769d62.
fn number(name: &str, suite: &str, structure: &str) -> f64 {
    let (of, column) = name.split_once('_').unwrap();
    let its = |row_suite: &Option<String>, row_structure: &str| {
        row_suite.as_deref() == Some(suite) && row_structure == structure
    };
    if let "low" | "high" = of {
        let planes: Vec<DemandFit> = rows::read(&out("pex.parquet")).unwrap();
        let is_it = |fit: &DemandFit| {
            its(&fit.suite, &fit.structure)
                && fit.model == DemandModel::Biplanar
                && fit.range_high.is_some() == (of == "low")
        };
        let plane = planes.into_iter().find(is_it).unwrap();
        return match column {
            "ln_a" => plane.coefficients[0],
            "b1" => plane.coefficients[1],
            "b2" => plane.coefficients[2],
            "r2" => plane.r2.unwrap(),
            _ => plane.beta.unwrap(),
        };
    }
    let measures = match of {
        "im5" => (Measure::Im5, None),
        _ => (Measure::Im4, Some(Measure::Im3Inverse)),
    };
    let curves: Vec<CurveFit> = rows::read(&out("pro.parquet")).unwrap();
    let is_it = |fit: &CurveFit| {
        its(&fit.suite, &fit.structure)
            && fit.event == Event::Overturning
            && (&fit.im_x, &fit.im_y) == (&measures.0, &measures.1)
    };
    let curve = curves.into_iter().find(is_it).unwrap();
    match column {
        "mu" => mu(&curve.coefficients).value,
        "lambda" => lambda(&curve.coefficients).value,
        "log_likelihood" => curve.log_likelihood.unwrap(),
        "auc" => curve.auc.unwrap(),
        "brier" => curve.brier.unwrap(),
        other => {
            let parameters: Vec<ParameterRow> = rows::read(&out("pro.parameters.parquet")).unwrap();
            let is_it = |row: &ParameterRow| {
                its(&row.suite, &row.structure)
                    && (&row.im_x, &row.im_y) == (&measures.0, &measures.1)
                    && other.contains(&row.parameter.to_string())
            };
            let row = parameters.into_iter().find(is_it).unwrap();
            if other.starts_with("se_") { row.standard_error } else { row.value }
        }
    }
}

#[test]
fn the_papers_run_has_its_numbers() {
    let table = include_str!("../reference/paper_run.csv");
    let mut wrong = Vec::new();
    for line in table.lines().skip(1) {
        let [name, suite, structure, value]: [&str; 4] =
            line.split(',').collect::<Vec<_>>().try_into().unwrap();
        let (expected, ours): (f64, f64) = (value.parse().unwrap(), number(name, suite, structure));
        let tolerance = 1e-6 * expected.abs().max(1.0);
        if ours.is_nan() || (ours - expected).abs() > tolerance {
            wrong.push(format!("{name}, {suite}, {structure}: {ours}, not {expected}"));
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
        assert_eq!(
            first.contains("of the paper") && first.contains("--width"),
            stage == "simulate",
            "{first}"
        );
    }
    let planes = |path: &Path| -> Vec<DemandFit> {
        let fits: Vec<DemandFit> = rows::read(path).unwrap();
        fits.into_iter().filter(|fit| fit.model == DemandModel::Biplanar).collect()
    };
    let bare = planes(&folder.path().join("pex.parquet"));
    assert_eq!(bare.len(), 8);
    assert_eq!(bare, planes(&out("pex.parquet")));
    assert!(!print("compare-paper").contains("not the paper"));
    fail(folder.path(), "ida", 2, &["no structure"]);
}

#[test]
fn responses_have_the_measures_of_eq_13() {
    let rows: Vec<ResponseRow> = rows::read(&out("responses.parquet")).unwrap();
    for row in rows.iter().step_by(97) {
        let im = row.measures;
        let (p, unit) = (row.p_rad_s, 9.81 * row.alpha_rad.tan());
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

/// The log scores that rank-ims of 0.2.2 had for the equipment under combined motions.
const SCORES: [(&str, f64); 9] = [
    ("pro im4", -0.358_543_496_8),
    ("pro im5", -0.279_533_448_8),
    ("pro im4:im3_inv", -0.263_553_849_1),
    ("pro cav_m_s", -0.352_371_800_8),
    ("pro im5:arias_m_s", -0.267_612_270_3),
    ("pex im4", -2.081_602_363_5),
    ("pex im4:im3", -2.042_665_455_7),
    ("pex cav_m_s", -2.299_554_767_7),
    ("pex im5:arias_m_s", -2.165_073_507_7),
];

#[test]
fn columns_of_the_motions_are_fitted_printed_and_drawn() {
    let folder = RUN.path();
    let read = "--in out/responses.parquet --motions out/motions.parquet";
    let measures = "im4,im5,cav_m_s,im5:arias_m_s,pgv_m_s,gamma";
    let fit = |stage: &str, pair: &str| {
        let name = &stage[4..];
        succeed(folder, &format!("{stage} {read} --pairs {measures},{pair} --out further/{name}.parquet")).0
    };
    let printed = [fit("fit-pro", "im4:im3_inv"), fit("fit-pex", "im4:im3")].concat();
    assert!(printed.contains("im5:arias_m_s"), "{printed}");
    let curves: Vec<CurveFit> = rows::read(&folder.join("further/pro.parquet")).unwrap();
    let laws: Vec<DemandFit> = rows::read(&folder.join("further/pex.parquet")).unwrap();
    let is_it = |group: Group| group == Group { suite: Some("csgm"), structure: "electrical-equipment" };
    let curves: Vec<&CurveFit> = curves.iter().filter(|fit| is_it(fit.group())).collect();
    let laws: Vec<&DemandFit> = laws.iter().filter(|fit| is_it(fit.group())).collect();
    let of_curves = curves.iter().map(|fit| (format!("pro {}", fit.predictors()), fit.held_out_log_score));
    let of_laws = laws.iter().map(|fit| {
        let planes = if fit.model == DemandModel::Biplanar { ", two planes" } else { "" };
        (format!("pex {}{planes}", fit.predictors()), fit.held_out_log_score)
    });
    let scores: BTreeMap<String, Option<f64>> = of_curves.chain(of_laws).collect();
    for (name, expected) in SCORES {
        assert!(
            scores[name].is_some_and(|score| (score - expected).abs() < 1e-6),
            "{name}: {:?}",
            scores[name]
        );
    }
    // p PGV / (g tan alpha) is IM5.
    let of = |name: &str| curves.iter().find(|fit| fit.predictors().to_string() == name).unwrap();
    let apart = of("pgv_m_s").coefficients.iter().zip(&of("im5").coefficients).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-9);
    succeed(
        folder,
        "report --in out/responses.parquet,further/pro.parquet,further/pex.parquet --out more.html",
    );
    let drawn = std::fs::read_to_string(folder.join("more/quality.csv")).unwrap();
    assert!(drawn.contains("log score"), "{drawn}");
    let svg = std::fs::read_to_string(folder.join("more/quality.svg")).unwrap();
    assert!(svg.contains("cav_m_s") && svg.contains("IM5, arias_m_s"));
}

#[test]
fn structures_have_the_same_line_together_and_alone() {
    let folder = RUN.path();
    let lines = |names: &str| -> Vec<String> {
        let simulate = format!("simulate --in out/motions.parquet {names} --out some.parquet --force");
        succeed(folder, &simulate);
        let printed =
            succeed(folder, "fit-pex --in some.parquet --pairs im4:im3 --out some/pex.parquet --force").0;
        let lines = printed.lines().filter(|line| line.contains("block") && !line.contains("predict"));
        lines.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
    };
    let [one, other] =
        ["--structure name=block1,p=2,alpha=0.2,eta=0.9", "--structure name=block2,p=3,alpha=0.15,eta=0.9"];
    let mut alone = [lines(one), lines(other)].concat();
    let mut together = lines(&format!("{one} {other}"));
    assert!(together.len() >= 12 && alone.len() == together.len(), "{together:?}");
    alone.sort_unstable();
    together.sort_unstable();
    assert_eq!(alone, together);
}

#[test]
fn every_file_has_its_schema() {
    let folder = RUN.path();
    let record = "time (s),acceleration (g)\n".to_string()
        + &(0..400)
            .map(|k| format!("{},{}\n", f64::from(k) * 0.01, (f64::from(k) * 0.1).sin()))
            .collect::<String>();
    std::fs::write(folder.join("record.csv"), record).unwrap();
    let about = "file,magnitude,distance (km),earthquake\nother.csv,6.1,,B\nrecord.csv,7.3,4.5,A\n";
    std::fs::write(folder.join("about.csv"), about).unwrap();
    std::fs::write(folder.join("hazard.csv"), include_str!("../../data/hazard.csv")).unwrap();
    std::fs::write(folder.join("peaks.csv"), "pga_m_s2,pgv_m_s\n4,0.5\n").unwrap();
    for call in [
        "import-motions record.csv --out out/records.parquet --accept-implausible --about about.csv",
        "simulate --in out/motions.parquet --p 2.5 --alpha 0.2 --eta 0.92 --trace 1 --out out/one.parquet",
        "ida --in out/records.parquet --p 2.5 --alpha 0.2 --eta 0.92 --out out/ida.parquet",
        "report --in out/ida.parquet --out read.html",
        "floor-motions --in out/records.parquet --period 0.5 --level 1 --out out/floor.parquet",
        "evaluate --width 0.5 --height 2 --out out/evaluate.over.parquet",
        "evaluate --width 0.5 --height 2 --pga 0.4 --out out/evaluate.motion.parquet",
        "evaluate --width 0.5 --height 2 --hazard hazard.csv --target 1% --out out/evaluate.hazard.parquet",
        "evaluate --width 0.5 --height 2 --in peaks.csv --out out/evaluate.in.parquet",
    ] {
        succeed(folder, call);
    }
    let record = &objects(folder, "out/records.parquet")[0];
    assert!(record["mw"] == 7.3 && record["re_km"] == 4.5 && record["earthquake"] == "A", "{record}");
    std::fs::write(folder.join("about.csv"), "file,magnitude\nrecord.csv,73\n").unwrap();
    fail(folder, "import-motions record.csv --out other.parquet --about about.csv", 2, &["about.csv", "73"]);
    std::fs::write(folder.join("about.csv"), "file,magnitude\nrecord.csv,7.3\nrecord.csv,5\n").unwrap();
    fail(folder, "import-motions record.csv --out other.parquet --about about.csv", 2, &["line 3", "again"]);
    std::fs::copy(folder.join("record.csv"), folder.join("copy.csv")).unwrap();
    let both = "import-motions record.csv copy.csv --out other.parquet --accept-implausible";
    fail(folder, both, 1, &["same record"]);
    let mut files: Vec<_> =
        folder.join("out").read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "parquet"));
    files.sort_unstable();
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let schema = |path: &Path| {
        let file = std::fs::File::open(path).unwrap();
        ArrowReaderMetadata::load(&file, ArrowReaderOptions::new()).unwrap().schema().clone()
    };
    let mut text: String =
        files.iter().map(|path| format!("{}\n{}", name(path), columns(&schema(path)))).collect();
    text += &format!("validation.parquet\n{}", columns(&rows::schema::<Validation>()));
    text += &format!("evaluate.over.csv\n{}", columns(&rows::schema::<FragilityRow>()));
    text += &format!("validation.reliability.parquet\n{}", columns(&rows::schema::<ReliabilityBin>()));
    assert!(!text.contains("NOT IN"), "{text}");
    let written: HashSet<&str> = text.split_whitespace().collect();
    let unwritten = rockfrag::table::dictionary::names().filter(|name| !written.contains(name));
    // Spectral accelerations are named by their period; `inspect` alone prints meanings.
    assert_eq!(unwritten.collect::<Vec<_>>(), ["sa_*_m_s2", "meaning"]);
    insta::assert_snapshot!(text);
}
