//! report as a user calls it.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, StringArray};
use rockfrag::fragility::{Measure, p_overturning};
use rockfrag::pipeline::terminal::{Terminal, Weight};
use rockfrag::statistics::Link;
use rockfrag::table::pro::ProRow;
use rockfrag::table::row::ReadRow;

use crate::common::{fail, rockfrag, small_pipeline, succeed, write};
use crate::evaluate::{fitted, run_folder};

/// The figures that every run of both suites and structures has, in the order of the page.
const FIGURES: [&str; 27] = [
    "overturning",
    "overturning-hybrid",
    "exceedance",
    "medians",
    "reliability",
    "tree",
    "outcomes-frame",
    "outcomes-electrical-equipment",
    "demand-frame-pulse",
    "demand-frame-csgm",
    "demand-electrical-equipment-pulse",
    "demand-electrical-equipment-csgm",
    "motion",
    "histories",
    "similarity",
    "overturning-im4",
    "overturning-hybrid-im5",
    "planes",
    "planes-pulse",
    "quality-frame-pulse",
    "quality-frame-csgm",
    "quality-electrical-equipment-pulse",
    "quality-electrical-equipment-csgm",
    "regressions-frame-pulse",
    "regressions-frame-csgm",
    "regressions-electrical-equipment-pulse",
    "regressions-electrical-equipment-csgm",
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
    let places: Vec<usize> =
        FIGURES.iter().filter_map(|name| page.find(&format!("id=\"figure-{name}\""))).collect();
    assert!(places.is_sorted() && page.find("id=\"findings\"").unwrap() < places[0]);
    assert_eq!(
        page.matches("Made by rockfrag").count(),
        1 + FIGURES.len(),
        "once to read, and once for each file"
    );
    for name in FIGURES {
        assert!(page.contains(&format!("id=\"figure-{name}\"")), "{name} is not in the page");
        let svg = String::from_utf8(one[&format!("{name}.svg")].clone()).unwrap();
        let (width, height) = (attribute(&svg, "width"), attribute(&svg, "height"));
        assert!(
            svg.contains("Made by rockfrag") && svg.contains("seed "),
            "{name} does not say what was run"
        );
        assert!(!svg.contains("NaN") && !svg.contains("inf "), "{name} draws what is not a number");
        assert!(svg.contains("<text ") && svg.contains("font-family=\"Fira Sans, "), "{name} has no text");
        assert!(
            one[&format!("{name}.csv")].starts_with(b"panel,series,x_is,x,y_is,y,low,high,n\n"),
            "{name}"
        );
        let png = &one[&format!("{name}.png")];
        let side = |at: usize| f64::from(u32::from_be_bytes(png[at..at + 4].try_into().unwrap()));
        assert_eq!((&png[1..4], side(16), side(20)), (&b"PNG"[..], width.ceil(), height.ceil()), "{name}");
    }
    assert_eq!(one.len(), 3 * FIGURES.len() + 1);
    assert!(
        !page.contains("http://")
            || page.matches("http://").count() == page.matches("http://www.w3.org/").count()
    );
}

/// The rows of the table of a figure.
fn rows(folder: &Path, figure: &str) -> Vec<Vec<String>> {
    let mut reader = csv::Reader::from_path(folder.join(format!("report/{figure}.csv"))).unwrap();
    reader.records().map(|row| row.unwrap().iter().map(str::to_string).collect()).collect()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn the_tables_of_figures_hold_the_curves_and_all_that_overturned() {
    let folder = tempfile::tempdir().unwrap();
    succeed(
        folder.path(),
        &format!("report --in {} --out report.html --dpi 50 --motions 1", run_folder().display()),
    );
    let fits = ProRow::read(run_folder().join("pro.parquet")).unwrap();
    let fit = |panel: &str| {
        let is_its = |row: &&ProRow| {
            panel == format!("{}, {}", row.structure, row.suite.as_deref().unwrap())
                && (row.im_x, row.im_y) == (Measure::Im5, None)
        };
        fits.iter().find(is_its).unwrap()
    };
    let mut curves = 0;
    for row in rows(folder.path(), "overturning") {
        if row[1].starts_with("curve") {
            let expected = p_overturning(
                number(&row[3]),
                fit(&row[0]).mu.unwrap(),
                fit(&row[0]).beta.unwrap(),
                Link::Probit,
            );
            assert!((number(&row[5]) - expected).abs() < 1e-9, "{row:?}, expected {expected}");
            assert!(number(&row[6]) <= expected && expected <= number(&row[7]), "{row:?}");
            curves += 1;
        }
    }
    assert!(curves > 300, "{curves} points of curves");
    for structure in ["frame", "electrical-equipment"] {
        let demand = rows(folder.path(), &format!("demand-{structure}-csgm"));
        let overturned = fit(&format!("{structure}, csgm")).n_events;
        let drawn = demand.iter().filter(|row| row[1].starts_with("overturning") && row[2] == "PGV (m/s)");
        assert_eq!(drawn.count(), overturned, "{structure}");
        // Most demands lie within the axis.
        assert!(demand.iter().any(|row| number(&row[5]) > 0.3), "{structure}");
    }
}

#[test]
fn findings_say_who_asked_and_what_to_doubt() {
    let folder = tempfile::tempdir().unwrap();
    let run = run_folder().display();
    let mut call = rockfrag(folder.path());
    call.args(["report", "--in", &run.to_string(), "--out", "report.html", "--dpi", "50", "--motions", "1"]);
    call.args(["--title", "Statue <A> & co", "--author", "J. Doe", "--date", "May 2026"]);
    assert!(call.output().unwrap().status.success());
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("<title>Statue &lt;A&gt; &amp; co</title>") && page.contains("J. Doe · May 2026"));
    let findings = page.split("id=\"findings\"").nth(1).unwrap().split("</section>").next().unwrap();
    for said in
        ["What was asked", "What came out", "How sure", "By what method", "Dimitrakopoulos", "R² below 0.1"]
    {
        assert!(findings.contains(said), "{said} is not in {findings}");
    }
    let warnings =
        rockfrag::table::store::contents::recorded(&run_folder().join("pro.parquet")).unwrap().unwrap();
    let warnings = warnings.provenance.warnings.all();
    assert!(!warnings.is_empty() && warnings.iter().all(|words| findings.contains(words)), "{findings}");
}

#[test]
fn rates_of_a_site_stand_in_the_findings() {
    let (folder, fits) = fitted();
    let at = |name: &str| folder.path().join(name);
    let ask = format!(
        "evaluate {fits} --p 2.5 --alpha 0.2 --hazard {}/data/hazard.csv",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::create_dir(at("out")).unwrap();
    std::fs::create_dir(at("rates")).unwrap();
    for file in ["responses.parquet", "pex.parquet", "pro.parquet"] {
        std::fs::copy(run_folder().join(file), at("out").join(file)).unwrap();
    }
    succeed(folder.path(), &format!("{ask} --out out/evaluated.parquet"));
    succeed(folder.path(), "report --in out --out one/report.html --dpi 50");
    succeed(folder.path(), &format!("{ask} --out rates/a.parquet"));
    std::fs::remove_file(at("out/evaluated.parquet")).unwrap();
    succeed(folder.path(), "report --in out --rates rates --out two/report.html --dpi 50");
    let csv =
        rockfrag(folder.path()).args(ask.split_whitespace()).args(["--format", "csv"]).output().unwrap();
    let answer = String::from_utf8(csv.stdout).unwrap();
    let made = rockfrag::table::store::contents::recorded(&at("rates/a.parquet")).unwrap().unwrap();
    let warnings = made.provenance.warnings.all();
    assert!(!warnings.is_empty());
    let rates: Vec<f64> =
        answer.lines().skip(1).map(|line| number(line.split(',').nth(1).unwrap())).collect();
    for folder in ["one", "two"] {
        let drawn: Vec<f64> = rows(&at(folder), "rates").iter().map(|row| number(&row[3])).collect();
        assert_eq!(drawn, rates, "{folder}");
        let page = std::fs::read_to_string(at(folder).join("report.html")).unwrap();
        let findings = page.split("id=\"findings\"").nth(1).unwrap().split("</section>").next().unwrap();
        assert!(
            findings.contains("At the site") && findings.contains("probability in 50 years"),
            "{findings}"
        );
        assert!(warnings.iter().all(|words| findings.contains(words)), "{warnings:?} are not in {findings}");
        let drawn: Vec<[f64; 2]> =
            rows(&at(folder), "hazard").iter().map(|row| [3, 5].map(|column| number(&row[column]))).collect();
        let known =
            std::fs::read_to_string(format!("{}/data/hazard.csv", env!("CARGO_MANIFEST_DIR"))).unwrap();
        let known = known.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit()));
        let known: Vec<Vec<f64>> = known.map(|line| line.split(',').map(number).collect()).collect();
        assert_eq!(drawn.len(), known.len());
        for ([pga_g, rate], known) in drawn.iter().zip(&known) {
            assert!((pga_g / known[0] - 1.0).abs() < 1e-9 && *rate == known[1], "{pga_g} {rate} {known:?}");
        }
        let words = "hazard.csv: annual rates of exceedance at";
        assert!(page.matches(words).count() >= 2 && findings.contains(words), "{findings}");
    }
}

#[test]
fn a_joint_hazard_is_drawn_by_each_peak() {
    let (folder, fits) = fitted();
    let at = |name: &str| folder.path().join(name);
    let data = format!("{}/data", env!("CARGO_MANIFEST_DIR"));
    succeed(
        folder.path(),
        &format!("evaluate {fits} --p 2.5 --alpha 0.2 --hazard {data}/hazard_joint.csv --out rates.parquet"),
    );
    std::fs::create_dir(at("out")).unwrap();
    std::fs::copy(run_folder().join("responses.parquet"), at("out/responses.parquet")).unwrap();
    succeed(folder.path(), "report --in out --rates rates.parquet --out page/report.html --dpi 50");
    let known = std::fs::read_to_string(format!("{data}/hazard_joint.csv")).unwrap();
    let bins: Vec<Vec<f64>> = known
        .lines()
        .filter(|line| line.starts_with(|first: char| first.is_ascii_digit()))
        .map(|line| line.split(',').map(number).collect())
        .collect();
    let drawn = rows(&at("page"), "hazard");
    for (peak, label) in [(0, "PGA (g)"), (1, "PGV (m/s)")] {
        let curve: Vec<_> = drawn.iter().filter(|row| row[2] == label).collect();
        assert!(curve.len() > 5, "{label}");
        for row in curve {
            let (value, rate) = (number(&row[3]), number(&row[5]));
            let reached = bins.iter().filter(|bin| bin[peak] > value * (1.0 - 1e-6));
            let expected: f64 = reached.map(|bin| bin[2]).sum();
            assert!((rate / expected - 1.0).abs() < 1e-6, "{label} {value}: {rate} for {expected}");
        }
    }
    let page = std::fs::read_to_string(at("page/report.html")).unwrap();
    assert!(page.contains("hazard_joint.csv: annual rates of"), "the hazard has no name");
}

#[test]
fn partitions_give_the_report_of_the_whole() {
    let (folder, _) = small_pipeline();
    let at = |name: &str| folder.path().join(name);
    succeed(folder.path(), "run --out whole");
    for i in 0..2 {
        let cut = format!("--partition {i}/2 --config pipeline.yaml");
        succeed(
            folder.path(),
            &format!("synthesize-motions --in whole/scenarios.parquet --out out/motions {cut}"),
        );
        succeed(folder.path(), &format!("simulate --in out/motions --out out/responses {cut}"));
    }
    for file in ["pex.parquet", "pro.parquet"] {
        std::fs::copy(at("whole").join(file), at("out").join(file)).unwrap();
    }
    for (name, from) in [("whole", "whole"), ("run", "out"), ("parts", "out/responses")] {
        succeed(folder.path(), &format!("report --in {from} --out {name}-page/report.html --dpi 50"));
    }
    let page = |name: &str| files(&at(&format!("{name}-page")), "report");
    let figures = |name: &str| {
        // Which motion is shown with its parts depends on the row groups.
        let is_of_rows = |file: &str| file.ends_with(".csv") && file != "motion.csv";
        let drawn = page(name).into_iter().filter(|(file, _)| is_of_rows(file));
        drawn.collect::<BTreeMap<_, _>>()
    };
    assert!(!figures("whole").is_empty());
    assert!(figures("run") == figures("whole") && figures("parts") == figures("whole"));
}

#[test]
fn motions_without_a_period_are_counted_by_how_they_ended() {
    let folder = tempfile::tempdir().unwrap();
    let outcomes =
        ["no_rocking", "safe_rocking", "safe_rocking", "overturning", "safe_rocking", "overturning"];
    let numbers =
        |of: fn(usize) -> f64| -> ArrayRef { Arc::new(Float64Array::from_iter_values((0..6).map(of))) };
    let some =
        |of: fn(usize) -> Option<f64>| -> ArrayRef { Arc::new(Float64Array::from_iter((0..6).map(of))) };
    write(
        &folder.path().join("responses.parquet"),
        vec![
            ("motion_id", Arc::new(Int64Array::from_iter_values(0..6))),
            ("structure", Arc::new(StringArray::from(vec!["pier"; 6]))),
            ("p_rad_s", numbers(|_| 2.0)),
            ("alpha_rad", numbers(|_| 0.2)),
            ("eta", numbers(|_| 0.9)),
            ("outcome", Arc::new(StringArray::from(outcomes.to_vec()))),
            ("edp", some(|k| (![3, 5].contains(&k)).then_some(if k == 0 { 0.0 } else { 0.1 }))),
            ("impacts", Arc::new(Int32Array::from(vec![3; 6]))),
            ("pga_m_s2", numbers(|k| 1.0 + k as f64)),
            ("pgv_m_s", numbers(|k| 0.1 + 0.1 * k as f64)),
            ("tp_s", some(|k| (k % 2 == 0).then_some(1.0 + k as f64))),
            ("im4", numbers(|k| 1.0 + k as f64)),
            ("im5", numbers(|k| 0.1 + k as f64)),
        ],
    );
    succeed(folder.path(), "report --in . --dpi 72");
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    let caption = |figure: &str| {
        let figure = page.split(&format!("id=\"figure-{figure}\"")).nth(1).unwrap();
        figure.split("<figcaption>").nth(1).unwrap().split("</figcaption>").next().unwrap().to_string()
    };
    let outcomes = caption("outcomes-pier");
    assert!(
        outcomes.contains("3 without a pulse period Tp are left out (1 safe rocking, 2 overturning)"),
        "{outcomes}"
    );
    assert!(page.contains("3 of 6 responses are to motions without a pulse period"));
    // Captions tell of what is shown.
    let bars = caption("overturning");
    assert!(bars.contains("There is no curve.") && !bars.contains("the band is"), "{bars}");
    let no_curve = "no curve: 2 of 5 overturn, 5 of each are needed";
    assert!(page.contains(no_curve), "{page}");
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
    let file = format!("{run}/pro.parquet");
    fail(folder.path(), &format!("report --in {file}"), 2, &["pro.parquet, a file", "expected the folder"]);
}

#[test]
fn an_analysis_of_peaks_has_their_units() {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "sample-scenarios --mw 6.5,7 --re 10 --samples 8");
    succeed(folder.path(), "synthesize-motions --suite csgm --dt 0.01");
    let said = succeed(folder.path(), "simulate --p 2.5 --alpha 0.2 --eta 0.92");
    // So few motions have their names told.
    assert!(
        said.contains("overturned, of 16 motions: p2.5-alpha0.2-eta0.92 by ") && said.contains(" ("),
        "{said}"
    );
    succeed(folder.path(), "ida --p 2.5 --alpha 0.2 --eta 0.92 --measure pga");
    succeed(folder.path(), "report --in . --dpi 50");
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.contains("Medians of the lowest PGA (g): p2.5-alpha0.2-eta0.92"));
    let table = page.split("Incremental dynamic analysis: lowest").last().unwrap();
    let table = table.split("</table>").next().unwrap();
    for cell in ["csgm", "p2.5-alpha0.2-eta0.92", "PGA (g)", ">ok<"] {
        assert!(table.contains(cell), "{cell} is not in {table}");
    }
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

#[test]
fn of_few_records_the_medians_of_scaled_motions_come_first() {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "init records");
    let records = folder.path().join("records");
    let mut files: Vec<_> = std::fs::read_dir(&records).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files.iter().skip(12).for_each(|file| std::fs::remove_file(file).unwrap());
    std::fs::write(folder.path().join("structures.csv"), "name,width,height,eta\ncabinet,0.6,2.2,0.9\n")
        .unwrap();
    let pipeline = folder.path().join("pipeline.yaml");
    let text = std::fs::read_to_string(&pipeline).unwrap();
    let text = text.replace("measure: im5 }", "measure: im5, steps: 12 }");
    std::fs::write(&pipeline, text).unwrap();
    succeed(folder.path(), "run");
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    let place = |words: &str| page.find(words).unwrap_or_else(|| panic!("no '{words}'"));
    assert!(
        place("<h4>Lowest p PGV / (g tan α) (IM5) that overturns")
            < place("half of those that rock overturn at PGV")
    );
    assert!(place("id=\"figure-ida\"") < place("id=\"figure-overturning\""));
    assert!(!page.contains("no test speaks against it"), "tests of so few say nothing");
    place("overturn, too few");
    place("slides instead unless its friction is above 0.27");
    // A curve of so few would have a band from 0 to 1.
    let points = std::fs::read_to_string(folder.path().join("out/report/overturning.csv")).unwrap();
    assert!(points.contains("share in a bin") && !points.contains("curve"), "{points}");
    // The motion that is drawn is that under which most happens.
    place("the nearest to overturning that does not");
}

#[test]
fn of_records_that_overturn_nothing_there_is_a_report_too() {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "init records");
    let pipeline = folder.path().join("pipeline.yaml");
    let text = std::fs::read_to_string(&pipeline).unwrap();
    let text = text.replace("[records] }", "[records], scale: \"0.2\" }");
    std::fs::write(&pipeline, text.replace("measure: im5 }", "measure: im5, steps: 12 }")).unwrap();
    let told = succeed(folder.path(), "run");
    assert!(told.contains("none of 10 regressions") && told.contains("none of 7 curves"), "{told}");
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    for words in ["(IM5) that overturns", "not drawn: 0 of", "none of 7 curves can be fitted"] {
        assert!(page.contains(words), "no '{words}'");
    }
}
