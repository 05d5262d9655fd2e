//! A small pipeline that makes every kind of file, by calls of the binary.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use assert_cmd::Command;

use crate::snapshot::{check_each, redact};
use crate::tables::{fingerprints, schema};

const PIPELINE: &str = "\
seed: 42
out: out
sample-scenarios: { mw: \"6,7\", re: \"5,12\", samples: 60 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01, housner: true, sa: \"0.2,1\" }
simulate: { structures: structures.csv }
fit-pex: { transition: 1.3, bootstrap: 40 }
fit-pro: { pairs: [\"im4:im3_inv\", \"im5:im1\"], bootstrap: 40 }
universality: { reference: electrical-equipment }
rank-ims: { terms: 2, transition: 1.3 }
compare-paper: {}
report: { dpi: 50, motions: 3, groups: 2 }
";

const STRUCTURES: &str = "\
name,p,alpha,eta
frame,1.0,0.15,0.92
electrical-equipment,2.5,0.20,0.92
small,3.5,0.15,0.90
slender,2.0,0.10,0.85
";

const BLOCKS: &str = "\
- { name: block, width: 0.5, height: 2.0 }
- { name: bent, width: 1, height: 6, beam-mass-ratio: 3 }
";

const SPREAD: &str = "\
sample-scenarios: { mw: 7, re: 5, samples: 40 }
synthesize-motions: { suite: csgm, dt: 0.02 }
simulate: { structures: structures.csv }
fit-pex: { transition: 1.3 }
fit-pro: {}
compare-paper: {}
";

/// In place of FITS: which fits evaluate and export start from.
const FITS: &str =
    "--pex out/pex.parquet --pro out/pro.parquet --suite csgm --structure electrical-equipment";

/// In place of POINT: what evaluate is asked.
const POINT: &str = "--p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6";

/// Each call with a name for what it says. Files in `more` are of kinds that there are already.
const CALLS: [(&str, &str); 38] = [
    ("plan", "run --dry-run"),
    ("run", "run"),
    ("run_again", "run"),
    (
        "synthesize",
        "synthesize-motions --in out/scenarios.parquet --out more/soil.parquet --suite csgm,hfc --dt 0.02 \
         --difference signed --epoch pga --site soil --kappa 0.02 --fmax 20 --low-cut 0.1",
    ),
    (
        "simulate_one",
        "simulate --in more/soil.parquet --out more/soil.responses.parquet --p 2.5 --alpha 0.2 --eta 0.92",
    ),
    (
        "simulate_trace",
        "simulate --in out/motions.parquet --out traced.parquet --p 1 --alpha 0.15 --eta 0.92 --trace 0,1",
    ),
    (
        "simulate_blocks",
        "simulate --in out/motions.parquet --out more/blocks.parquet --structures blocks.yaml",
    ),
    ("fit_pex_found", "fit-pex --in out/responses.parquet --out more/found.parquet --limit-state 0.2"),
    (
        "fit_pro_firth",
        "fit-pro --in out/responses.parquet --out more/firth.parquet --estimator firth --link logit",
    ),
    (
        "fit_pro_rocking",
        "fit-pro --in out/responses.parquet --out more/rocking.parquet --event rocking --link cloglog",
    ),
    (
        "universality_univariate",
        "universality --in out/responses.parquet --out more/univariate.parquet --model univariate --measure im5",
    ),
    (
        "rank_ims_further",
        "rank-ims --in out/responses.parquet --motions out/motions.parquet --out more/further.parquet --terms 2",
    ),
    (
        "import",
        "import-motions records --unit g --scale 0.5:2:0.5 --residual --sa 0.2,1 --housner --baseline linear \
         --out imported.parquet",
    ),
    (
        "import_rotated",
        "import-motions records/n.at2 records/e.at2 records/v.at2 --rotate strongest-pulse --high-pass 0.1 \
         --resample 0.02 --out more/rotated.parquet",
    ),
    (
        "simulate_records",
        "simulate --in imported.parquet --out more/imported.responses.parquet --structures structures.csv",
    ),
    ("ida", "ida --in imported.parquet --measure im5 --steps 15 --halvings 2 --structures structures.csv"),
    ("fit_pro_stripes", "fit-pro --in ida.stripes.parquet --out more/stripes.parquet"),
    (
        "validate",
        "validate --in more/imported.responses.parquet --pex out/pex.parquet --pro out/pro.parquet --out validation.parquet",
    ),
    ("evaluate", "evaluate FITS POINT"),
    ("evaluate_csv", "evaluate FITS POINT --format csv"),
    ("evaluate_json", "evaluate FITS POINT --format json"),
    ("evaluate_parquet", "evaluate FITS POINT --format parquet --out answer.parquet"),
    ("evaluate_percentile", "evaluate FITS POINT --limits percentile --format csv"),
    ("evaluate_bc", "evaluate FITS POINT --limits bc --format csv"),
    ("evaluate_univariate", "evaluate FITS POINT --model univariate --format csv"),
    ("evaluate_table", "evaluate FITS --in out/responses.parquet --out evaluated.parquet"),
    ("evaluate_rates", "evaluate FITS --p 2.5 --alpha 0.2 --hazard hazard.csv --ratio 0.3"),
    (
        "evaluate_rates_parquet",
        "evaluate FITS --p 2.5 --alpha 0.2 --hazard hazard.csv --ratio 0.3 --format parquet --out rates.parquet",
    ),
    (
        "evaluate_rates_joint",
        "evaluate FITS --p 2.5 --alpha 0.2 --hazard hazard_joint.csv --limits percentile --format csv",
    ),
    ("export", "export FITS --p 2.5 --alpha 0.2 --tolerance 1e-2 --to openquake --ratio 0.2,0.4"),
    (
        "export_continuous",
        "export FITS --p 2.5 --alpha 0.2 --to openquake-continuous --model paper --im pgv --ratio 0.3 --out continuous.xml",
    ),
    ("export_pelicun", "export FITS --p 2.5 --alpha 0.2 --tolerance 1e-2 --to pelicun --ratio 0.3"),
    ("seed_spread", "seed-spread spread.yaml --seeds 2 --out spread.csv"),
    ("inspect_motions", "inspect out/motions.parquet"),
    ("inspect_pex", "inspect out/pex.parquet"),
    ("inspect_imported", "inspect imported.parquet"),
    ("inspect_ida", "inspect ida.fragility.parquet"),
    ("inspect_validation", "inspect validation.parquet"),
];

/// Text files that the calls write, compared as they are.
const TEXTS: [&str; 5] = ["fragility.xml", "continuous.xml", "fragility.csv", "fragility.json", "spread.csv"];

/// The folder that the calls worked in, and what each of them said.
pub struct Made {
    pub folder: PathBuf,
    said: Vec<(String, String)>,
}

/// The files, made once for all tests.
pub fn made() -> &'static Made {
    static MADE: OnceLock<Made> = OnceLock::new();
    MADE.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("guard");
        let _ = std::fs::remove_dir_all(&folder);
        ["records", "more"].iter().for_each(|name| std::fs::create_dir_all(folder.join(name)).unwrap());
        write_inputs(&folder);
        let said = CALLS.iter().map(|(name, call)| (name.to_string(), say(&folder, call))).collect();
        Made { folder, said }
    })
}

fn write_inputs(folder: &Path) {
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    write("pipeline.yaml", PIPELINE);
    write("structures.csv", STRUCTURES);
    write("blocks.yaml", BLOCKS);
    write("spread.yaml", SPREAD);
    for name in ["hazard.csv", "hazard_joint.csv"] {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("data").join(name);
        std::fs::copy(shipped, folder.join(name)).unwrap();
    }
    for (name, cycles) in [("a.csv", 1.0), ("b.csv", 2.0)] {
        let row = |k: u32| {
            let time = f64::from(k) * 0.01;
            format!("{time:.2},{:.6}\n", 0.5 * (PI * cycles * time).sin())
        };
        write(&format!("records/{name}"), &(0..=200).map(row).collect::<String>());
    }
    for (name, component) in [("n.at2", "000"), ("e.at2", "090"), ("v.at2", "UP")] {
        write(&format!("records/{name}"), &at2(component));
    }
}

/// A record of one component (azimuth or `UP`) of a pulse of 2 s in direction N30E.
fn at2(component: &str) -> String {
    let along = component.parse().map_or(0.1, |azimuth: f64| (30.0 - azimuth).to_radians().cos());
    let velocity = |time: f64| {
        let x = PI * (time - 8.0);
        if x.abs() > 2.0 * PI { 0.0 } else { 0.5 * (1.0 + (x / 2.0).cos()) * x.cos() }
    };
    let acceleration = |k: u32| {
        let time = f64::from(k) * 0.01;
        along * (velocity(time + 5e-3) - velocity(time - 5e-3)) / 0.01 / 9.81
    };
    let samples: Vec<f64> = (0..3000).map(acceleration).collect();
    let peak = samples.iter().fold(0.0_f64, |peak, a| a.abs().max(peak));
    let mut text = format!(
        "PEER STRONG MOTION DATABASE RECORD\nTestville 1/1/2001, Somewhere, {component}\n\
         ACCELERATION TIME HISTORY IN UNITS OF G,  PGA= {peak:.5} G\nNPTS=  3000, DT= .01000 SEC\n"
    );
    for row in samples.chunks(5) {
        row.iter().for_each(|a| write!(text, "{a:15.7E}").unwrap());
        text.push('\n');
    }
    text
}

/// Calls the binary, and gives its exit code and what it wrote to stdout and stderr.
fn say(folder: &Path, call: &str) -> String {
    let call = call.replace("FITS", FITS).replace("POINT", POINT);
    let mut command = Command::cargo_bin("rockfrag").unwrap();
    let output = command.current_dir(folder).args(call.split_whitespace()).output().unwrap();
    let (stdout, stderr) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    let code = output.status.code().map_or("none".to_string(), |code| code.to_string());
    redact(&format!("$ rockfrag {call}\n--- exit code {code}, stdout\n{stdout}--- stderr\n{stderr}"))
}

/// All files below a folder with this ending, by their paths from there.
pub fn files(folder: &Path, ending: &str) -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(next) = folders.pop() {
        for path in std::fs::read_dir(next).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == ending) {
                let name = path.strip_prefix(folder).unwrap().with_extension("");
                found.insert(name.to_string_lossy().replace('/', "."), path);
            }
        }
    }
    found
}

#[test]
fn names() {
    let names: String = files(&made().folder, "parquet").into_keys().map(|name| name + "\n").collect();
    check_each("schema", [("files".to_string(), names)]);
}

#[test]
fn schemas() {
    let kinds = files(&made().folder, "parquet").into_iter().filter(|(name, _)| !name.starts_with("more."));
    check_each("schema", kinds.map(|(name, path)| (name, schema(&path))));
}

#[test]
fn numbers() {
    let texts = files(&made().folder, "parquet").into_iter();
    check_each("fingerprints", texts.map(|(name, path)| (name, fingerprints(&path))));
}

#[test]
fn words() {
    check_each("says", made().said.clone());
}

#[test]
fn text_files() {
    let text = |name: &str| redact(&std::fs::read_to_string(made().folder.join(name)).unwrap());
    check_each("text", TEXTS.map(|name| (name.to_string(), text(name))));
}
