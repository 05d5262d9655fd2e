//! Slips of units, names, files and order: each is told, with what is meant or likely, and never becomes a number in silence.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, LargeStringArray};

use crate::common::{rockfrag, succeed, write};
use crate::evaluate::run_folder;

/// Files that are not quite right.
const FILES: [(&str, &str); 20] = [
    ("semicolons.csv", "name;Width;Height\nblock;0,6;2,4\n"),
    ("capitals.csv", "\u{feff}Name,Width,HEIGHT,eta\nblock,0.6,2.4,housner\n"),
    ("comma.csv", "name,p,alpha,eta\na,\"2,0\",0.2,0.9\n"),
    ("titled.csv", "Blocks of a museum;;\nName;Width;HEIGHT\n;;\nblock;0,6;2,4\n;;\n"),
    ("capital_comma.csv", "Blocks\nName,Width,HEIGHT\nblock,\"0,6\",2.4\n"),
    ("typo.csv", "name,widht,height\nblock,0.6,2.4\n"),
    ("weights.csv", "name,width (m),height,Weight,date\nblock,0.6,2.4,3000,2026-01-01\n"),
    ("millimetres.csv", "name,width,height\nblock,600,2400\n"),
    ("map.yaml", "frame: { p: 1, alpha: 0.15, eta: 0.92 }\n"),
    ("degrees.yaml", "- { name: a, p: 2.5, alpha: 14, eta: 0.92 }\n"),
    ("key.yaml", "- { name: a, Width: 0.6, height: 2.4 }\n"),
    ("pipeline.yaml", "simulate: { structures: { name: a, p: 1, alpha: 0.15, eta: 0.92 } }\n"),
    ("exchanged.csv", "annual_rate_of_exceedance,pga_g\n0.1,0.05\n0.2,0.01\n0.4,0.002\n"),
    ("percent.csv", "pga_g,annual_rate_of_exceedance\n10,0.05\n40,0.002\n"),
    ("german.csv", "PGA_g;Annual rate of exceedance\n0,1;0,05\n0,4;0,002\n"),
    ("no_bins.csv", "pga_g,pgv_m_s,annual_rate_of_occurrence\n"),
    ("fast.csv", "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.05,3,0.01\n"),
    ("site.csv", "Site amplification;\nf (Hz);Factor\n0,1;1,0\n;\n10;2,5\n"),
    ("site_word.csv", "f (Hz),Factor\n0.1,1.0\n10,high\n"),
    ("table.csv", "motion_id,dt_s\n1,0.01\n"),
];

/// In place of RUN: a folder of files; of FITS: the fits of a structure in it.
const CALLS: [(&str, i32, &[&str]); 81] = [
    // No structure is anyone's unless it is named.
    ("simulate --in RUN/motions.parquet", 2, &["no structure", "--width", "--structures FILE", "paper"]),
    ("ida --in RUN/motions.parquet", 2, &["no structure", "--p, --alpha and --eta"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 0.2", 2, &["p, alpha and eta", "housner"]),
    ("simulate --in RUN/motions.parquet --width 0.6", 2, &["width and height"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --width 0.6 --height 2", 2, &["--width", "cannot be used"]),
    ("evaluate FITS --pga 0.5 --pgv 0.6", 2, &["no structure", "width and height"]),
    // Units and order.
    ("simulate --in RUN/motions.parquet --width 600 --height 2400", 2, &["width is 600", "mm?"]),
    ("ida --in RUN/motions.parquet --width 600 --height 2400", 2, &["width is 600", "mm?"]),
    ("evaluate FITS --width 600 --height 2400 --pga 0.5 --pgv 0.6", 2, &["width is 600", "mm?"]),
    (
        "simulate --in RUN/motions.parquet --structures millimetres.csv",
        2,
        &["'block'", "width is 600", "mm?"],
    ),
    ("simulate --in RUN/motions.parquet --width 60 --height 240", 2, &["height is 240", "200 m"]),
    ("simulate --in RUN/motions.parquet --width 2.4 --height 0.6", 2, &["width is 2.4", "exchanged?"]),
    ("simulate --in RUN/motions.parquet --width -0.6 --height 2", 2, &["width is -0.6", "above 0 m"]),
    ("simulate --in RUN/motions.parquet --width 0 --height 2", 2, &["width is 0", "above 0 m"]),
    ("simulate --in RUN/motions.parquet --width 1 --height 4 --beam-mass-ratio 300", 2, &["300", "percent?"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 14 --eta 0.92", 2, &["alpha is 14", "degrees"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 1.4 --eta 0.92", 2, &["alpha is 1.4", "degrees"]),
    (
        "simulate --in RUN/motions.parquet --p 2.5 --alpha 4 --eta 0.92",
        2,
        &["alpha is 4", "height over width?"],
    ),
    ("simulate --in RUN/motions.parquet --structures degrees.yaml", 2, &["'a'", "alpha is 14", "degrees"]),
    ("export FITS --p 2.5 --alpha 11.5 --to openquake --ratio 0.3", 2, &["alpha is 11.5", "degrees"]),
    ("simulate --in RUN/motions.parquet --p 0.15 --alpha 0.2 --eta 0.92", 2, &["p is 0.15", "Hz"]),
    ("simulate --in RUN/motions.parquet --p 143 --alpha 0.2 --eta 0.92", 2, &["p is 143", "0.2 to 50"]),
    ("simulate --in RUN/motions.parquet --p -2.5 --alpha 0.2 --eta 0.92", 2, &["p is -2.5", "above 0 rad/s"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 0.2 --eta 92", 2, &["eta is 92", "percent?"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 0.2 --eta 1.05", 2, &["eta is 1.05", "up to 1"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 0.2 --eta 0", 2, &["eta is 0", "above 0"]),
    ("simulate --in RUN/motions.parquet --p 2.5 --alpha 0.2 --eta hausner", 2, &["'hausner'", "housner"]),
    (
        "fit-pex --in RUN/responses.parquet --out x.parquet --limit-state 10",
        2,
        &["limit-state is 10", "percent?"],
    ),
    ("fit-pex --in RUN/responses.parquet --out x.parquet --limit-state -0.1", 2, &["limit-state is -0.1"]),
    ("rank-ims --in RUN/responses.parquet --out x.parquet --limit-state 10", 2, &["limit-state is 10"]),
    ("universality --in RUN/responses.parquet --out x.parquet --limit-state 10", 2, &["limit-state is 10"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga -0.5 --pgv 0.6", 2, &["pga is -0.5", "0 g or more"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 50 --pgv 0.6", 2, &["pga is 50", "percent of g?"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 0.5 --pgv 60", 2, &["pgv is 60", "cm/s?"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 0.05 --pgv 5", 0, &["warning", "PGV", "exchanged"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 4.9 --pgv 0.6", 0, &["warning", "m/s2 in place of g"]),
    ("evaluate --width 0.5 --height 2.0 --pga 4.9 --pgv 0.6", 0, &["warning", "m/s2 in place of g"]),
    ("evaluate --width 0.5 --height 2.0 --pga 4.9 --pgv 0.8", 0, &["warning", "more than was ever recorded"]),
    ("evaluate --width 50 --height 200 --pga 0.5 --pgv 0.6", 0, &["warning", "200 m high", "in cm?"]),
    (
        "simulate --in RUN/motions.parquet --out big.parquet --width 50 --height 200",
        0,
        &["200 m high", "in cm?"],
    ),
    (
        "export --width 50 --height 200 --to openquake --ratio 0.3 --tolerance 0.01 --out big.xml",
        0,
        &["in cm?"],
    ),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6 --tp -2", 2, &["tp is -2", "above 0 s"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6 --tm 500", 2, &["tm is 500", "up to 60"]),
    ("export FITS --p 2.5 --alpha 0.2 --to openquake --ratio -0.3", 2, &["ratio is -0.3", "above 0"]),
    ("export FITS --p 2.5 --alpha 0.2 --to openquake --ratio 0.3 --upto -1", 2, &["intensity", "-1"]),
    // Tables of structures and of hazard.
    ("simulate --in RUN/motions.parquet --out s.parquet --structures semicolons.csv", 0, &["1 structure"]),
    ("simulate --in RUN/motions.parquet --out c.parquet --structures capitals.csv", 0, &["1 structure"]),
    ("simulate --in RUN/motions.parquet --structures comma.csv", 2, &["line 2, column 'p'", "'2,0'", "2.5"]),
    ("simulate --in RUN/motions.parquet --out t.parquet --structures titled.csv", 0, &["1 structure"]),
    (
        "simulate --in RUN/motions.parquet --structures capital_comma.csv",
        2,
        &["line 3, column 'Width'", "'0,6'", "a point before the decimals"],
    ),
    (
        "simulate --in RUN/motions.parquet --structures typo.csv",
        2,
        &["'widht'", "did you mean 'width'?", "width and height"],
    ),
    ("simulate --in RUN/motions.parquet --out w.parquet --structures weights.csv", 0, &["1 structure"]),
    ("simulate --in RUN/motions.parquet --structures map.yaml", 2, &["expected a list", "- { name: block"]),
    ("simulate --in RUN/motions.parquet --structures key.yaml", 2, &["'Width'", "did you mean 'width'?"]),
    (
        "simulate --in RUN/motions.parquet --structures RUN/pex.parquet",
        2,
        &["pex.parquet", ".csv file of structures"],
    ),
    ("simulate --in RUN/motions.parquet --structures equipment", 2, &["equipment", ".csv", "paper"]),
    ("run", 2, &["line 1", "a list of structures", "{ name: block"]),
    (
        "evaluate FITS --p 2.5 --alpha 0.2 --hazard exchanged.csv --ratio 0.3",
        1,
        &["columns are not exchanged"],
    ),
    (
        "evaluate FITS --p 2.5 --alpha 0.2 --hazard percent.csv --ratio 0.3",
        1,
        &["line 3", "'40'", "percent of g?"],
    ),
    ("evaluate FITS --p 2.5 --alpha 0.2 --hazard german.csv --ratio 0.3", 0, &[]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --hazard no_bins.csv", 1, &["no rows"]),
    ("evaluate FITS --p 2.5 --alpha 0.2 --hazard fast.csv", 0, &["1 of 1 bins", "exchanged"]),
    ("synthesize-motions --in RUN/scenarios.parquet --suite hfc --out m.parquet --site site.csv", 0, &[]),
    (
        "synthesize-motions --in RUN/scenarios.parquet --site site_word.csv",
        2,
        &["site_word.csv", "line 3, column 'Factor'", "'high'"],
    ),
    // Numbers of flags.
    (
        "evaluate --width 0,5 --height 2 --pga 0.5 --pgv 0.6",
        2,
        &["'0,5'", "--width", "a point before the decimals"],
    ),
    (
        "evaluate --width half --height 2 --pga 0.5 --pgv 0.6",
        2,
        &["'half'", "expected a number, such as 2.5"],
    ),
    (
        "evaluate --p 2.5 --alpha 0.2 --eta 0,92 --pga 0.5 --pgv 0.6",
        2,
        &["'0,92'", "a point before the decimals"],
    ),
    ("sample-scenarios --mw 5,5:7,5:0,5", 2, &["first:last:step", "a point before the decimals"]),
    ("sample-scenarios --samples 10,5", 2, &["'10,5'", "--samples", "a whole number, 0 or more"]),
    ("run --threads 1,5", 2, &["'1,5'", "--threads", "a whole number"]),
    // Limits that there are none of.
    (
        "evaluate FITS --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6 --limits profile",
        2,
        &["of the parameters", "fit-pro"],
    ),
    (
        "evaluate --model universal --p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.6 --limits bc",
        2,
        &["the universal surface has its own", "leave --limits out"],
    ),
    // Files in the wrong place.
    (
        "report --in RUN --out x.html --rates table.csv",
        1,
        &["table.csv: not a Parquet file", "evaluate --hazard"],
    ),
    ("inspect table.csv", 1, &["table.csv: not a Parquet file", "CSV is for import-motions"]),
    ("simulate --in table.csv --structures paper", 1, &["table.csv: not a Parquet file", "import-motions"]),
    ("fit-pro --in table.csv", 1, &["the responses that simulate makes"]),
    ("fit-pex --in RUN/motions.parquet", 1, &["made by synthesize-motions", "output of simulate"]),
    (
        "evaluate FITS --p 2.5 --alpha 0.2 --in table.csv",
        1,
        &["table.csv: columns motion_id, dt_s", "pga_g or pga_m_s2"],
    ),
    (
        "evaluate --pex RUN/pro.parquet --pro RUN/pex.parquet --pga 1 --pgv 1",
        1,
        &["made by fit-pro", "fit-pex"],
    ),
    (
        "rank-ims --in RUN/responses.parquet --motions RUN/motions.parquet --candidate fiv3",
        2,
        &["'fiv3'", "_m_s"],
    ),
    (
        "rank-ims --in RUN/responses.parquet --motions RUN/motions.parquet --out x.parquet --candidate fiv3_m_s",
        2,
        &["no further column 'fiv3_m_s'"],
    ),
];

#[test]
fn each_slip_is_told() {
    let run = run_folder().display();
    let fits = format!(
        "--pex {run}/pex.parquet --pro {run}/pro.parquet --suite csgm --structure electrical-equipment"
    );
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in FILES {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let mut wrong = Vec::new();
    for (call, code, expected) in CALLS {
        let call = call.replace("FITS", &fits).replace("RUN", &run.to_string());
        let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        let says_all = expected.iter().all(|part| told.contains(part));
        if output.status.code() != Some(code) || !says_all || told.contains("panicked") {
            wrong.push(format!("{call}\n  {:?}, not {code} with {expected:?}: {told}", output.status.code()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // What fails leaves nothing.
    assert!(!folder.path().join("x.parquet").exists());
}

#[test]
fn a_block_is_the_same_by_flags_and_in_any_file() {
    let run = run_folder().display();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.csv"), "name;Width;Height\nb;0,6;2,4\n").unwrap();
    std::fs::write(folder.path().join("b.yaml"), "- { name: b, width: 0.6, height: 2.4, eta: housner }\n")
        .unwrap();
    // As polars and pandas write it.
    let columns: [(&str, ArrayRef); 4] = [
        ("name", Arc::new(LargeStringArray::from(vec!["b"]))),
        ("width", Arc::new(Float64Array::from(vec![0.6]))),
        ("height (m)", Arc::new(Float64Array::from(vec![2.4]))),
        ("eta", Arc::new(Float64Array::from(vec![None]))),
    ];
    write(&folder.path().join("c.parquet"), columns.to_vec());
    // 2.4 m tall, 0.6 m wide: R = sqrt(0.3^2 + 1.2^2), p = sqrt(3 g / 4 R), alpha = atan(1/4), sin^2 = 1/17.
    let p = (3.0 * 9.81 / (4.0 * (0.3_f64 * 0.3 + 1.2 * 1.2).sqrt())).sqrt();
    let (alpha, eta) = (0.25_f64.atan(), 1.0 - 1.5 / 17.0);
    let ways = [
        "--width 0.6 --height 2.4".to_string(),
        "--structures a.csv".to_string(),
        "--structures b.yaml".to_string(),
        "--structures c.parquet".to_string(),
        format!("--p {p} --alpha {alpha} --eta {eta}"),
        format!("--p {p} --alpha {alpha} --eta housner"),
    ];
    for way in ways {
        succeed(folder.path(), &format!("simulate --in {run}/motions.parquet --out r.parquet {way}"));
        let parameters = rockfrag::table::store::contents::recorded(&folder.path().join("r.parquet"));
        let of = parameters.unwrap().unwrap().provenance.parameters["structures"][0].clone();
        for (name, expected) in [("p", p), ("alpha", alpha), ("eta", eta)] {
            let value = of[name].as_f64().unwrap();
            assert!((value / expected - 1.0).abs() < 1e-12, "{way}: {name} {value}, not {expected}");
        }
    }
}
