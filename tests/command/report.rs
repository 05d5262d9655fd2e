//! report as a user calls it.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, StringArray};
use rockfrag::pipeline::terminal::{Terminal, Weight};

use crate::common::{fail, succeed, write};
use crate::evaluate::run_folder;

/// The figures that every run of both suites and structures has.
const FIGURES: [&str; 23] = [
    "motion",
    "outcomes-frame",
    "outcomes-electrical-equipment",
    "demand-frame-pulse",
    "demand-frame-csgm",
    "demand-electrical-equipment-pulse",
    "demand-electrical-equipment-csgm",
    "histories",
    "similarity",
    "tree",
    "regressions-frame-pulse",
    "regressions-frame-csgm",
    "regressions-electrical-equipment-pulse",
    "regressions-electrical-equipment-csgm",
    "radar",
    "planes-pulse",
    "planes",
    "exceedance",
    "overturning",
    "overturning-im4",
    "overturning-hybrid",
    "overturning-hybrid-im5",
    "reliability",
];

/// All files of a report by name.
fn files(folder: &Path, page: &str) -> BTreeMap<String, Vec<u8>> {
    let figures = std::fs::read_dir(folder.join(page)).unwrap();
    let mut files: BTreeMap<String, Vec<u8>> = figures
        .map(|entry| {
            let path = entry.unwrap().path();
            (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap())
        })
        .collect();
    files.insert("page".to_string(), std::fs::read(folder.join(format!("{page}.html"))).unwrap());
    files
}

fn attribute(svg: &str, name: &str) -> f64 {
    let text = svg.split(&format!(" {name}=\"")).nth(1).unwrap().split('"').next().unwrap();
    text.trim_end_matches("pt").parse().unwrap()
}

#[test]
fn figures_and_page_are_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    for threads in ["1", "2"] {
        let out = format!("--in {} --out {threads}/report.html", run_folder().display());
        succeed(folder.path(), &format!("report {out} --threads {threads} --dpi 72"));
    }
    let [one, two] = ["1", "2"].map(|threads| files(&folder.path().join(threads), "report"));
    assert!(one == two);
    let page = String::from_utf8(one["page"].clone()).unwrap();
    for name in FIGURES {
        assert!(page.contains(&format!("id=\"figure-{name}\"")), "{name} is not in the page");
        let svg = String::from_utf8(one[&format!("{name}.svg")].clone()).unwrap();
        let (width, height) = (attribute(&svg, "width"), attribute(&svg, "height"));
        assert!(
            svg.contains("Made by rockfrag") && svg.contains("seed "),
            "{name} does not say what was run"
        );
        assert!(!svg.contains("NaN") && !svg.contains("inf "), "{name} draws what is not a number");
        let png = &one[&format!("{name}.png")];
        let side = |at: usize| f64::from(u32::from_be_bytes(png[at..at + 4].try_into().unwrap()));
        assert_eq!((&png[1..4], side(16), side(20)), (&b"PNG"[..], width.ceil(), height.ceil()), "{name}");
    }
    assert_eq!(one.len(), 2 * FIGURES.len() + 1);
    assert!(
        !page.contains("http://")
            || page.matches("http://").count() == page.matches("http://www.w3.org/").count()
    );
}

#[test]
fn a_report_is_made_again_only_when_its_files_or_options_change() {
    let folder = tempfile::tempdir().unwrap();
    let call = format!("report --in {} --out report.html --dpi 50 --motions 3", run_folder().display());
    succeed(folder.path(), &call);
    assert!(succeed(folder.path(), &call).contains("up to date"));
    assert!(!succeed(folder.path(), &format!("{call} --structure frame")).contains("up to date"));
}

#[test]
fn ten_responses_of_anyone_without_overturning_or_fits_are_enough() {
    let folder = tempfile::tempdir().unwrap();
    let numbers = |scale: f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values((1..=10).map(|k| scale * f64::from(k))))
    };
    let constant = |value: f64| -> ArrayRef { Arc::new(Float64Array::from(vec![value; 10])) };
    write(
        &folder.path().join("responses.parquet"),
        vec![
            ("motion_id", Arc::new(Int64Array::from_iter_values(0..10))),
            ("structure", Arc::new(StringArray::from(vec!["<b>*Säule*_{1}</b>"; 10]))),
            ("p_rad_s", constant(2.0)),
            ("alpha_rad", constant(0.2)),
            ("eta", constant(0.9)),
            ("outcome", Arc::new(StringArray::from(vec!["safe_rocking"; 10]))),
            ("edp", numbers(0.01)),
            ("impacts", Arc::new(Int32Array::from(vec![3; 10]))),
            ("pga_m_s2", numbers(1.0)),
            ("pgv_m_s", numbers(0.1)),
            ("im4", numbers(1.0)),
            ("im5", numbers(0.2)),
        ],
    );
    succeed(folder.path(), "report --in . --dpi 72");
    let files = files(folder.path(), "report");
    let page = String::from_utf8(files["page"].clone()).unwrap();
    assert!(page.contains("&lt;b&gt;*Säule*_{1}&lt;/b&gt;") && !page.contains("<b>*Säule"));
    let shown = page.split("<script").next().unwrap();
    assert!(shown.contains("not made by rockfrag") && !shown.contains("NaN"));
    assert!(files.keys().any(|name| name.starts_with("outcomes-")) && files.contains_key("tree.png"));
}

#[test]
fn what_cannot_be_drawn_is_refused_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let run = run_folder().display();
    fail(folder.path(), "report --in .", 1, &["responses.parquet", "no such file"]);
    fail(folder.path(), &format!("report --in {run} --out page"), 2, &["ends in .html"]);
    fail(folder.path(), &format!("report --in {run} --out r.html --dpi 5000"), 2, &["dpi is 5000"]);
    fail(folder.path(), &format!("report --in {run} --out r.html --suite csmg"), 2, &["csgm frame"]);
    assert!(!folder.path().join("r.html").exists());
}

#[test]
fn lines_fit_the_window_and_only_a_terminal_gets_weights() {
    let window = Terminal { width: Some(8), styled: true };
    assert_eq!(window.line("123456789", Weight::Plain), "1234567\u{2026}\n");
    assert_eq!(window.line("12345678", Weight::Strong), "\u{1b}[1m12345678\u{1b}[0m\n");
    let quiet = Terminal { styled: false, ..window };
    assert_eq!(quiet.table("a\nb"), "a\nb\n");
    assert_eq!(Terminal::PLAIN.line("123456789", Weight::Faint), "123456789\n");
}
