//! The report: each figure as SVG, PNG and CSV, and the page.

mod fixtures;

use resvg::{tiny_skia::Pixmap, usvg};
use rockfrag::answer::AnswerTable;
use rockfrag::chart::{Axis, Figure, Ink, Layer, Mark, Panel, Symbol, png, svg};
use rockfrag::document::{Document, Table, compare, response};
use rockfrag::figures::common::{estimate, observed_shares, ratio_bins};
use rockfrag::figures::{planes, universality};
use rockfrag::number;
use rockfrag_core::fragility::{Event, Measure, beta, fit_curve};
use rockfrag_core::paper;
use rockfrag_core::statistics::{Interval, Range};
use rockfrag_core::studies::observed_share;

use fixtures::{answers, cases, figures, limited, tables, traced};

#[test]
fn each_figure_is_drawn_and_its_table_has_the_numbers() {
    assert!(figures(100).iter().all(|figure| !figure.panels.is_empty()));
    for figure in [figures(100), figures(1), figures(0)].concat() {
        let text = svg(&figure);
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
        let rows = rows.records().map(Result::unwrap).filter(|row| &row[15] != "words");
        let read = rows.map(|row| [4, 6, 8, 9, 10].map(|column| number(&row[column])));
        let marks = figure.panels.iter().flat_map(|panel| &panel.layers).flat_map(|layer| &layer.marks);
        let drawn: Vec<[f64; 5]> = marks.map(|mark| [mark.x, mark.y, mark.low, mark.high, mark.n]).collect();
        assert!(format!("{:?}", read.collect::<Vec<_>>()) == format!("{drawn:?}"), "{}", figure.name);
    }
}

/// A point at the middle of a linear and of a logarithmic axis stands in the middle of the area of the data.
#[test]
fn values_stand_where_the_axes_say() {
    let (x, y) = (Axis::linear("x").over(0.0, 10.0), Axis::log("y").over(1.0, 100.0));
    let panel =
        Panel::new("", x, y, vec![Layer::points("", Ink::Data(0), Symbol::Dot, [Mark::new(5.0, 10.0)])]);
    // 30 and half of 510.2 - 30 - 12 points, 16 and half of 100.
    assert!(svg(&Figure::new("", "", 1, 100.0, vec![panel])).contains("M264.1 66h0"));
}

#[test]
fn cases_on_the_planes_are_seen_on_two_lines() {
    let (groups, tables) = tables(100);
    let figure = planes(&tables, &[&groups[0]]);
    let layers = &figure.panels[0].layers;
    for (points, line) in layers[..2].iter().zip(&layers[2..]) {
        let (from, to) = (line.marks[0], line.marks[1]);
        let slope = (to.y - from.y) / (to.x - from.x);
        let off = |mark: &Mark| (mark.y - from.y - slope * (mark.x - from.x)).abs();
        assert!(points.marks.len() > 20 && points.marks.iter().all(|mark| off(mark) < 1e-9));
    }
}

/// Structures whose p grow by a tenth and that overturn at the same IM4 and IM3: over PGV the sd of ln theta
/// is that of ln p, over dimensionless measures 0; beta is that of one.
#[test]
fn curves_that_are_universal_have_one_median() {
    let groups: Vec<_> = (0..10).map(|k| cases((0.1 * f64::from(k)).exp(), 200)).collect();
    let figure = universality(&groups);
    let titles: Vec<&str> = figure.panels.iter().map(|panel| panel.title.as_str()).collect();
    let curve = fit_curve(&cases(1.0, 200), Event::Overturning, Measure::Im5, None);
    let of_pgv = (55.0_f64 / 6.0).sqrt() * 0.1 / beta(&curve.coefficients).value;
    let ratios = [of_pgv, 0.0, 0.0].map(|ratio| format!("combined motions, 10 of 10: sd / *β* {ratio:.2}"));
    assert_eq!(titles, ratios);
    assert!(universality(&groups[1..]).panels.is_empty(), "nine structures are few");
}

#[test]
fn the_page_of_claims_has_their_numbers() {
    let page = include_str!("../../docs/review/claims.md");
    for row in paper::claims() {
        let half = 0.5 * (row.high - row.low);
        let cells: Vec<String> =
            (0..5).map(|digits| format!("{:.digits$}±{half:.digits$}", row.mean)).collect();
        assert!(cells.iter().any(|cell| page.contains(cell)), "{row:?}");
        assert!(page.contains(&format!("{} | {} |", row.claim, row.verdict)), "{row:?}");
    }
}

#[test]
fn shares_count_cases_and_events() {
    let cases = [(1.0, false), (1.5, true), (3.0, true), (90.0, false), (100.0, true)];
    let shares = observed_shares(&cases, 2, ratio_bins(Range { low: 1.0, high: 100.0 }, 4));
    let first = Mark { n: 3.0, ..estimate(5.5 / 3.0, observed_share(2, 3)) };
    let last = Mark { n: 2.0, ..estimate(95.0, observed_share(1, 2)) };
    assert_eq!(shares, [first, last]);
}

#[test]
fn the_page_is_static_and_escapes_what_it_holds() {
    let row = ["<script>alert(1)</script>", "2 *P*_{ro}", "none"].map(str::to_string);
    let table = Table::new(&["a", "b", "c"], vec![row.into()]);
    let response = Document { figures: Vec::new(), ..response::document(&[traced(100)]) };
    let sections = vec![Document { tables: vec![table.clone()], ..Default::default() }, response];
    let (title, figures) = ("{sentence} <b>".to_string(), figures(3));
    let panels: usize = figures.iter().map(|figure| figure.panels.len()).sum();
    let page = Document { title, tables: vec![table], figures, sections, ..Default::default() };
    let page = page.html().unwrap();
    let code = ["<script", "<b>", "http", "<1>", "<i>me</i>"];
    assert!(!code.iter().any(|code| page.contains(code)) && page.contains("Motion m&lt;1&gt;: fra*me*2"));
    let [frames, pictures] = ["<figure>", "role=\"img\""].map(|part| page.matches(part).count());
    assert_eq!([frames, pictures], [panels + 1; 2], "each panel is a picture, and what moves");
    assert_eq!(page.matches("<td class=\"number\" data-head=\"b\">2 <i>P</i><sub>ro</sub></td>").count(), 2);
    assert_eq!(page.matches("<td class=\"short\" data-head=\"c\">none</td>").count(), 2);
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
    let of = Interval { value: Some(0.0069), low: Some(0.005), high: Some(0.00984) };
    assert_eq!(number::PERCENT.both(of, "95 % limits "), "0.69 % (95 % limits 0.50 to 0.98 %)");
    // What rounds to zero has no sign.
    let fixed = [-1234.5, -0.001, -0.0, -0.006].map(|x| number::fixed(x, 2));
    assert_eq!(fixed, ["-1,234.50", "0.00", "0.00", "-0.01"]);
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
        command.current_dir(folder.path()).args(arguments.split(' ')).output().unwrap().status.success()
    };
    std::fs::write(at("pipeline.yaml"), RUN).unwrap();
    assert!(call("run"));
    let first = std::fs::read(at("out/report.html")).unwrap();
    assert!(call("run"));
    assert!(std::fs::read(at("out/report.html")).unwrap() == first, "the same page has the same bytes");
    let endings = |ending: &str| {
        let files = std::fs::read_dir(at("out/report")).unwrap().map(|file| file.unwrap().path());
        files.filter(|file| file.extension().is_some_and(|of| of == ending)).collect::<Vec<_>>()
    };
    let names = ["motion", "similarity", "demand-a", "regressions-a-csgm", "quality", "planes", "exceedance"];
    assert!(names.iter().all(|name| at(&format!("out/report/{name}.svg")).exists()), "{:?}", endings("svg"));
    assert!(endings("svg").len() == endings("png").len() && endings("svg").len() == endings("csv").len());
    let rows = csv::Reader::from_path(at("out/report/planes.csv")).unwrap().into_records();
    let dots = rows.filter(|row| row.as_ref().unwrap()[16] == *"dot").count();
    let planes = std::fs::read_to_string(at("out/report/planes.svg")).unwrap();
    assert!(dots > 0 && planes.matches("h0").count() == dots + 2, "each row, two in the legend");
    // Responses of another structure under the same names: their fits are left out, and the page says so.
    let simulate = "simulate --in out/motions.parquet --out out/responses.parquet";
    assert!(call(&format!("{simulate} --structure name=a,p=2,alpha=0.3,eta=0.9")));
    assert!(call("report --in out --title Other --force"));
    let page = std::fs::read_to_string(at("out/report.html")).unwrap();
    let told = ["<h1>Other</h1>", "pro.parquet is not shown", "pex.parquet is not shown"];
    assert!(told.iter().all(|words| page.contains(words)) && !call("report --in empty"));
}

#[test]
fn values_beyond_all_axes_are_left_out() {
    let hostile = [f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 1e-308, 0.0, f64::NAN];
    let points: Vec<Mark> = hostile.iter().flat_map(|x| hostile.map(|y| Mark::new(*x, y))).collect();
    for axis in [Axis::linear("x"), Axis::log("x"), Axis::log("x").over(1e-308, 1e300)] {
        let layers = vec![
            Layer::line("", Ink::Data(0), points.clone()),
            Layer::points("", Ink::Text, Symbol::Circle, points.clone()),
        ];
        let panel = Panel::new("", axis.clone(), axis, layers);
        let text = svg(&Figure::new("", "", 1, 100.0, vec![panel]));
        assert!(!text.contains("NaN") && !text.contains("inf") && text.len() < 20_000, "{}", text.len());
        usvg::Tree::from_str(&text, &usvg::Options::default()).expect("the SVG is XML");
    }
}

#[test]
fn a_column_of_one_value_is_said_once() {
    let mut all = answers(3, 1e-3);
    all.rows.iter_mut().for_each(|answer| answer.object.count = Some(3.0));
    all.rows[2].object.alpha_rad = Some(0.2);
    let page = Document::of_answers(&all);
    let heads: Vec<String> = page.tables.into_iter().flat_map(|table| table.heads).collect();
    let has = |head: &str| heads.iter().any(|of| of == head);
    assert!(!has("number") && has("size") && has("place"), "{heads:?}");
    assert!(page.facts[0].contains("number 3") && !page.facts[0].contains("size"));
    assert!(page.title.starts_with("9 objects") && page.tiles[1].number == "9", "pieces, not rows");
}

#[test]
fn what_is_changed_comes_first_and_is_named() {
    let mut before = answers(3, 1e-3);
    (before.rows[2].object.width_m, before.rows[2].object.height_m) = (Some(0.5), Some(1.9));
    let mut after = before.clone();
    after.rows[2].object.width_m = Some(0.6);
    after.rows[2].p.p_overturning = limited(0.002);
    let page = compare::document(&[before, after]).unwrap();
    let table = &page.tables[0];
    assert!(table.rows.len() == 3 && table.rows[0][0].contains("me\\*2"));
    assert!(table.rows[0][3].replace('\u{a0}', " ").contains("0.50 × 1.90 m → 0.60"), "{table:?}");
    assert!(page.lead[0] == "1 of 3 objects changed." && page.tiles[0].number.contains('→'));
}

/// The same object may stand in both files.
#[test]
fn the_expected_number_is_that_of_each_file() {
    let [one, other] = ["a", "b"].map(|file| {
        let mut table = answers(4, 1e-3);
        table.rows.iter_mut().for_each(|answer| answer.file = file.to_string());
        table
    });
    let expected = |table: &AnswerTable| {
        let tiles = Document::of_answers(table).tiles;
        tiles.into_iter().take(2).map(|tile| tile.number).collect::<Vec<_>>()
    };
    let alone = expected(&one).remove(0);
    assert_eq!(expected(&AnswerTable::joined(&[one, other])), [alone.clone(), alone]);
}

#[test]
fn texts_of_a_workbook_are_no_formulas_and_numbers_are_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let hazard = concat!(env!("CARGO_MANIFEST_DIR"), "/data/hazard.csv");
    std::fs::write(folder.path().join("list.csv"), "name,width,height\n=1+1,0.5,1.9\n@b,0.4,1.9\n").unwrap();
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_rockfrag"));
    command.current_dir(folder.path()).args(["evaluate", "--quiet", "--hazard", hazard]);
    assert!(command.args(["--structures", "list.csv", "--out", "a.xlsx"]).status().unwrap().success());
    let mut book: calamine::Xlsx<_> = calamine::open_workbook(folder.path().join("a.xlsx")).unwrap();
    let sheet = calamine::Reader::worksheet_range_at(&mut book, 0).unwrap().unwrap();
    let rows: Vec<_> = sheet.rows().collect();
    let column = |name: &str| rows[0].iter().position(|head| *head == *name).unwrap();
    assert!(rows.len() == 3 && rows[1..].iter().any(|row| row[column("object")] == *"=1+1"));
    let mut rates = rows[1..].iter().map(|row| &row[column("overturns in 50 years (%)")]);
    assert!(rates.all(|rate| matches!(rate, calamine::Data::Float(rate) if *rate > 0.0)));
}
