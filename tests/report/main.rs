//! The report: each figure as SVG, PNG and CSV, and the page.

use std::slice::from_ref;

use resvg::{tiny_skia::Pixmap, usvg};
use rockfrag::motion::IntensityMeasures;
use rockfrag::number;
use rockfrag::report::figures::*;
use rockfrag::report::{
    Axis, Column, Estimate, Figure, Ink, Layer, Marks, Page, Panel, Section, Table, png, svg,
};

const PLANES: [[f64; 3]; 2] = [[-6.0, 30.0, -2.0], [0.5, 1.5, -2.0]];

/// A group whose demand lies on the planes; its name must be escaped.
fn group(count: usize) -> Group {
    let case = |k: usize| {
        let (im4, im3) = (1.02 + 0.01 * k as f64, 5.0 + (k % 7) as f64);
        let [ln_a, b1, b2] = PLANES[usize::from(im4 >= 1.3)];
        let edp = (ln_a + b1 * im4.ln() + b2 * im3.ln()).exp();
        let measures = IntensityMeasures::of_peaks(im4, im4 / im3);
        RockingCase {
            pgv_m_s: im4 / im3,
            tp_s: k.is_multiple_of(2).then_some(1.0),
            measures: IntensityMeasures { im2: Some(2.0), im6: Some(0.0), ..measures },
            edp: (k < 90).then_some(edp),
        }
    };
    Group { name: "a<b & \"c\"\u{1}, csgm".to_string(), cases: (0..count).map(case).collect() }
}

/// All fifteen figures, of `count` data, which may be none.
fn figures(count: usize) -> Vec<Figure> {
    let fit = Some(MeasureFit { ln_a: -2.0, b: 1.5, r2: 0.5, beta: 0.9 });
    let fits = vec![fit, None, fit, None, None, None];
    let wave: Vec<f64> = (0..50 * count).map(|k| (0.02 * k as f64).sin()).collect();
    let history = |p_rad_s| History { p_rad_s, alpha_rad: 0.15, dt_s: 0.01, theta_rad: wave.clone() };
    let record = Motion {
        words: "Mw 6.5".to_string(),
        dt_s: 0.01,
        acceleration_m_s2: wave.clone(),
        velocity_m_s: wave.clone(),
        pulse: (count > 0).then(|| [wave.clone(), wave.clone()]),
    };
    let share = Estimate { x: 1.0, y: 0.25, low: 0.0, high: f64::NAN, n: 4.0 };
    let points = vec![[0.5, 0.2], [f64::NAN, f64::NAN], [2.0, 0.9]];
    let curve = Curve { label: "curve".to_string(), band: vec![[0.0, 1.0]; 3], points };
    let frame =
        StructureCurves { name: "frame".to_string(), curves: vec![curve; 2], shares: vec![share; count] };
    let panel = ProbabilityPanel { structures: vec![frame; count.min(2)], ..Default::default() };
    let object = AnnualRate { name: "rack ".repeat(30), rate: 1e-3, low: f64::NAN, high: 2e-3 };
    let analysis = Ida { capacities: vec![0.3; count], motions: count, ..Default::default() };
    let named =
        NamedEstimates { series: vec![("im4".to_string(), vec![share]); count], ..Default::default() };
    let group = group(count);
    vec![
        motion(&record),
        demand(&vec![group.clone(); count.min(2)]),
        similarity(&[history(1.0), history(2.5)], "a motion"),
        regressions(&group, &fits),
        quality(&vec![("frame".to_string(), fits); count.min(2)]),
        planes(&[GroupPlanes { group, transition: 1.3, planes: PLANES }]),
        exceedance(from_ref(&panel)),
        overturning(&[panel.clone(), panel.clone()]),
        hybrids(from_ref(&panel)),
        maps(&[Map {
            rocks: vec![[0.3, 0.2]; count],
            lines: [(); 4].map(|()| vec![[0.4, 0.5]; count]),
            ..Map::default()
        }]),
        rates(&vec![object.clone(); count]),
        list(&vec![object; count]),
        ida(&[analysis]),
        validation(from_ref(&named)),
        ranking(&[named]),
    ]
}

#[test]
fn each_figure_is_drawn_and_its_table_has_the_numbers() {
    for figure in [figures(100), figures(1), figures(0)].concat() {
        let text = svg(&figure, "{\"stage\": \"report\"}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{}", figure.name);
        let tree = usvg::Tree::from_str(&text, &usvg::Options::default()).expect("the SVG is XML");
        let image =
            Pixmap::decode_png(&png(&text, 192.0).expect("the SVG is drawn")).expect("the PNG is whole");
        let ratio = |pixels: u32, at_96_dpi: f32| (f64::from(pixels) - 2.0 * f64::from(at_96_dpi)).abs();
        let off = [ratio(image.width(), tree.size().width()), ratio(image.height(), tree.size().height())];
        assert!(off.iter().all(|pixels| *pixels <= 1.0), "{}: {off:?}", figure.name);
        let is_drawn = image.pixels().iter().any(|pixel| pixel.red() < 128);
        assert!(is_drawn || figure.panels.is_empty(), "{}: nothing is drawn", figure.name);
        let table = figure.csv().unwrap();
        let mut rows = csv::Reader::from_reader(table.as_bytes());
        let number = |text: &str| text.parse().unwrap_or(f64::NAN);
        let read =
            rows.records().map(|row| [3, 5, 6, 7, 8].map(|column| number(&row.as_ref().unwrap()[column])));
        let layers = figure.panels.iter().flat_map(|panel| &panel.layers);
        let drawn: Vec<[f64; 5]> = layers.flat_map(|layer| layer.marks.numbers()).collect();
        assert!(format!("{:?}", read.collect::<Vec<_>>()) == format!("{drawn:?}"), "{}", figure.name);
    }
}

/// A point at the middle of a linear and of a logarithmic axis stands in the middle of the area of the data.
#[test]
fn values_stand_where_the_axes_say() {
    let (x, y) = (Axis::linear("x").over(0.0, 10.0), Axis::log("y").over(1.0, 100.0));
    let panel =
        Panel { x, y, layers: vec![Layer::points("", Ink::Data(0), [[5.0, 10.0]])], ..Default::default() };
    let figure = Figure { columns: 1, height: 100.0, panels: vec![panel], ..Default::default() };
    assert!(svg(&figure, "").contains("M230.6 50h0"), "half of 510.2 - 40 - 9 points, and of 100");
}

#[test]
fn cases_on_the_planes_are_seen_on_two_lines() {
    let figure = planes(&[GroupPlanes { group: group(100), transition: 1.3, planes: PLANES }]);
    let layers: Vec<Vec<[f64; 5]>> =
        figure.panels[0].layers.iter().map(|layer| layer.marks.numbers()).collect();
    for (points, line) in layers[..2].iter().zip(&layers[2..]) {
        let [[x0, y0, ..], [x1, y1, ..]] = [line[0], line[1]];
        let off = |[x, y, ..]: &[f64; 5]| (y - y0 - (y1 - y0) * (x - x0) / (x1 - x0)).abs();
        assert!(points.len() > 20 && points.iter().all(|point| off(point) < 1e-9));
    }
}

#[test]
fn shares_count_cases_and_events() {
    let cases = [(1.0, false), (1.5, true), (3.0, true), (90.0, false), (100.0, true)];
    let shares =
        observed_shares(&cases, equal_ratios([1.0, 100.0], 4), |events, n| [events as f64, n as f64]);
    let expected = [[5.5 / 3.0, 2.0 / 3.0, 2.0, 3.0, 3.0], [95.0, 0.5, 1.0, 2.0, 2.0]];
    assert_eq!(Marks::Estimates(shares).numbers(), expected);
}

#[test]
fn the_page_is_static_and_escapes_what_it_holds() {
    let rows = vec![vec!["<script>alert(1)</script>".to_string(), "*P*_{ro}".to_string()]];
    let table = Table {
        columns: [("a", false), ("b", true)]
            .map(|(head, is_number)| Column { head: head.into(), is_number })
            .into(),
        rows,
        ..Default::default()
    };
    let sections = vec![Section { tables: vec![table.clone()], ..Default::default() }];
    let (title, figures) = ("{sentence} <b>".to_string(), figures(3));
    let page = Page { title, table: Some(table), figures, sections, ..Default::default() }.html();
    assert!(!["<script", "<b>", "http"].iter().any(|code| page.contains(code)), "no code, no links");
    assert_eq!(page.matches("<svg viewBox").count(), 15);
    assert_eq!(page.matches("<td class=\"number\"><i>P</i><sub>ro</sub></td>").count(), 2);
    assert!(page.contains("<h1>{sentence} &lt;b&gt;</h1>") && page.contains("var(--data1)"));
}

#[test]
fn numbers_are_as_short_as_a_reader_needs() {
    let written = [0.0, 0.123456, 0.3, 8.3e-5, 2.9e-3, 9.96, 12_345.6, -0.5, 2.5e7, f64::NAN]
        .map(|x| number::significant(x, 2));
    assert_eq!(written, ["0", "0.12", "0.30", "8.3e-5", "0.0029", "10", "12,346", "-0.50", "2.5e7", "-"]);
    assert_eq!([999, 27_000, 1_234_567].map(number::count), ["999", "27,000", "1,234,567"]);
    assert_eq!([0.8, 0.905, 12.0].map(number::length), ["0.80", "0.905", "12.00"]);
    assert_eq!([9.66, 1449.0, 27_290.0].map(number::period), ["9.7", "1,400", "27,000"]);
    let of = [Some(0.0069), Some(0.005), Some(0.00984)];
    assert_eq!(number::PERCENT.both(of, "95 % limits "), "0.69 % (95 % limits 0.50 to 0.98 %)");
    assert_eq!(number::PERCENT.both([None, Some(0.0), Some(0.9999)], ""), "0 to >99.9 %");
    assert_eq!([-1234.5, -123.0].map(|x| number::fixed(x, 1)), ["-1,234.5", "-123.0"]);
}

const RUN: &str = "\
seed: 7
sample-scenarios: { mw: \"6.5,7.5\", re: \"5,10\", samples: 10 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate: { structure: [\"name=a,p=1,alpha=0.15,eta=0.92\", \"name=b,p=2.5,alpha=0.2,eta=0.92\"] }
fit-pex: { all: true }
fit-pro: {}
report: {}
";

#[test]
fn a_run_writes_a_page_and_each_figure_with_its_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let at = |path: &str| folder.path().join(path);
    let call = |arguments: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_rockfrag"));
        let output = command.current_dir(folder.path()).args(arguments.split(' ')).output().unwrap();
        (output.status.success(), String::from_utf8(output.stderr).unwrap())
    };
    std::fs::write(at("pipeline.yaml"), RUN).unwrap();
    assert!(call("run").0 && call("run").1.contains("report               up to date"));
    let endings = |ending: &str| {
        let files = std::fs::read_dir(at("out/report")).unwrap().map(|file| file.unwrap().path());
        files.filter(|file| file.extension().is_some_and(|of| of == ending)).collect::<Vec<_>>()
    };
    let names = ["motion", "similarity", "demand", "regressions-a-csgm", "quality", "planes", "exceedance"];
    assert!(names.iter().all(|name| at(&format!("out/report/{name}.svg")).exists()), "{:?}", endings("svg"));
    assert!(endings("svg").len() == endings("png").len() && endings("svg").len() == endings("csv").len());
    for svg in endings("svg") {
        let text = std::fs::read_to_string(&svg).unwrap();
        usvg::Tree::from_str(&text, &usvg::Options::default()).expect("the SVG is XML");
        let rows = csv::Reader::from_path(svg.with_extension("csv")).unwrap().into_records().count();
        let is_of_dots = svg.ends_with("demand.svg");
        assert!(
            rows > 0 && (!is_of_dots || text.matches("h0").count() == rows + 2),
            "each row, two in the legend"
        );
    }
    std::fs::write(at("out/report/planes.svg"), "another's").unwrap();
    std::fs::write(at("pipeline.yaml"), RUN.replace("report: {}", "report: { title: Again }")).unwrap();
    let (is_done, error) = call("run");
    assert!(!is_done && error.contains("planes.svg") && error.contains("--force"), "{error}");
    assert!(call("report --in out --title Again --force").0);
    assert!(std::fs::read_to_string(at("out/report.html")).unwrap().contains("<h1>Again</h1>"));
    // Responses of another structure under the same names: their fits are left out, and the page says so.
    let simulate = "simulate --in out/motions.parquet --out out/responses.parquet";
    assert!(call(&format!("{simulate} --structure name=a,p=2,alpha=0.3,eta=0.9")).0);
    assert!(call("report --in out --title Other --force").0);
    let page = std::fs::read_to_string(at("out/report.html")).unwrap();
    assert!(page.contains("pro.parquet is not shown") && page.contains("pex.parquet is not shown"));
    assert!(!call("report --in empty").0);
}
