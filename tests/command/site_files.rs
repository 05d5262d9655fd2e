//! What comes in and goes out for a site: hazard of other programs, tables in CSV, functions for OpenQuake, a report of rates.

use std::path::Path;

use crate::common::{fail, rockfrag, succeed};
use crate::evaluate::run_folder;

const BLOCK: &str = "--model universal --width 0.8 --height 2.1";
/// PGA (g) and the annual rate at which it is exceeded.
const HAZARD: [(f64, f64); 6] =
    [(0.02, 0.1), (0.1, 0.02), (0.4, 0.002), (1.0, 1.5e-4), (2.0, 6e-6), (3.0, 5e-7)];

fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

fn get(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// Both outputs of a call that succeeds.
fn call(folder: &Path, arguments: &[&str]) -> [String; 2] {
    let words = arguments[0].split_whitespace().chain(arguments[1..].iter().copied());
    let output = rockfrag(folder).args(words).output().unwrap();
    let [out, told] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    assert!(output.status.success(), "{arguments:?}: {told}");
    [out, told]
}

/// The rows of a hazard under other headings.
fn hazard(headings: &str, row: impl Fn(f64, f64) -> String) -> String {
    let rows = HAZARD.map(|(pga, rate)| row(pga, rate)).join("\n");
    format!("{headings}\n{rows}\n")
}

/// The annual rates that evaluate answers in CSV.
fn rates(answer: &str) -> Vec<f64> {
    answer.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect()
}

#[test]
fn a_hazard_under_the_headings_of_services_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let answer = |text: &str, more: &[&str]| {
        put(folder.path(), "h.csv", text);
        let ask = format!("evaluate {BLOCK} --hazard h.csv --format csv");
        rates(&call(folder.path(), &[&[ask.as_str()], more].concat())[0])
    };
    let plain = |headings: &str| hazard(headings, |pga, rate| format!("{pga},{rate:e}"));
    let known = answer(&plain("pga_g,annual_rate_of_exceedance"), &[]);
    for headings in [
        "PGA (g),Annual Frequency of Exceedance",
        "PGA [g],Mean annual rate of exceedance",
        "pga_g,AFE",
        "PGA (g),Annual frequency of exceedance (1/yr)",
    ] {
        assert_eq!(answer(&plain(headings), &[]), known, "{headings}");
    }
    let columns = ["--columns", "pga_g=Ground motion (g)"];
    assert_eq!(answer(&plain("Ground motion (g),AFE"), &columns), known);
    // Lines of another system, and rows that say only that weak motions are sure to come and the strongest never do.
    let headings = "pga_g,poe_in_50_years\n0.0,1.0\n0.01,1.000000E+00";
    let rows = hazard(headings, |pga, rate| format!("{pga},{}", -(-50.0 * rate).exp_m1()));
    let text = format!("\u{feff}{rows}4.0,0\n5.0,0.000E+00\n").replace('\n', "\r\n");
    for (one, other) in answer(&text, &[]).iter().zip(&known) {
        assert!((one / other - 1.0).abs() < 1e-8, "{one}, not {other}");
    }
    let [_, told] = call(folder.path(), &[&format!("evaluate {BLOCK} --hazard h.csv")]);
    assert!(told.contains("too weak to have a rate: line 2, 3\n"), "{told}");
    assert!(told.contains("too strong to have a rate: line 10, 11\n"), "{told}");
}

#[test]
fn a_row_that_cannot_be_is_named_by_its_line_and_its_texts() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |text: &str, rest: &str, code, expected: &[&str]| {
        put(folder.path(), "h.csv", text);
        fail(folder.path(), &format!("evaluate {BLOCK} --hazard h.csv {rest}"), code, expected);
    };
    for end in ["\n", "\r\n", "\r"] {
        let text = "# words\nPGA (g),AFE\n\n# more\n0.1,0.01\n0.4,0\n1,0.001\n".replace('\n', end);
        refused(&text, "", 1, &["h.csv: line 6: PGA (g) 0.4 with AFE 0;", "delete the row"]);
        let text = "pga_g,poe_in_50_years\n0.1,0.5\n0.2,100%\n0.4,150\n".replace('\n', end);
        refused(&text, "", 1, &["line 4, column 'poe_in_50_years': '150'", "write 10%"]);
    }
    refused(
        "pga_g,poe_in_50_years\n0.1,0.5\n0.2,1\n0.4,0.1\n",
        "",
        1,
        &["line 3", "below 1", "delete the row"],
    );
    refused(
        "pga_g,afe\n0.1,0.5\n0.1,0.4\n",
        "",
        1,
        &["line 3: pga_g 0.1 with afe 0.4", "a larger intensity"],
    );
    // Of what is missing, the column is named.
    refused("pga_g,x\n0.1,0.5\n", "", 1, &["--columns annual_rate_of_exceedance=x takes"]);
    refused("iml,afe\n0.1,0.5\n", "", 1, &["--columns pga_g=iml takes"]);
    // A spectral acceleration is no PGA, whatever it is called.
    refused(
        "SA(1.0) (g),afe\n0.1,0.5\n",
        "",
        1,
        &["'SA(1.0) (g)' is a spectral acceleration", "need PGA or PGV"],
    );
    for heading in ["SA(1.0)", "psa", "Spectral_acceleration"] {
        refused(
            "x,afe\n",
            &format!("--columns pga_g={heading}"),
            2,
            &[heading, "is a spectral acceleration"],
        );
    }
}

#[test]
fn a_table_in_csv_is_answered_row_by_row() {
    let folder = tempfile::tempdir().unwrap();
    let text = "Object;p (rad/s);alpha;eta;PGA (g);PGV (m/s);floor\nvase;2,5;0,2;0,92;50%;0,6;3\nurn;2,5;0,2;0,9;0,5;0,6;\n";
    put(folder.path(), "t.csv", text);
    succeed(folder.path(), "evaluate --model universal --in t.csv --out a.csv");
    let answer = get(folder.path(), "a.csv");
    let mut rows = csv::Reader::from_reader(answer.as_bytes());
    let names = rows.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    let at =
        |row: usize, name: &str| rows[row][names.iter().position(|known| known == name).unwrap()].to_string();
    assert_eq!([at(0, "Object"), at(1, "Object"), at(0, "floor"), at(1, "floor")], ["vase", "urn", "3", ""]);
    assert_eq!([at(0, "eta"), at(1, "eta"), at(0, "pga_m_s2")], ["0.92", "0.9", "4.905"]);
    let [alone, _] = call(
        folder.path(),
        &["evaluate --model universal --p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.6 --format csv"],
    );
    let p_ro = alone.lines().find(|line| line.starts_with("p_ro,")).unwrap().split(',').nth(1).unwrap();
    assert_eq!(at(0, "p_ro"), p_ro);
    assert_ne!(at(1, "p_ro"), p_ro);
    // The same by way of Parquet; what is written is known as such, and written over.
    succeed(folder.path(), "evaluate --model universal --in t.csv --out a.parquet");
    succeed(folder.path(), "evaluate --model universal --in a.parquet --out b.csv");
    assert_eq!(get(folder.path(), "b.csv"), answer);
    succeed(folder.path(), "evaluate --model universal --in t.csv --out a.csv --force");
    let block = "--p 2.5 --alpha 0.2 --eta 0.92";
    for (text, expected) in [
        ("PGA (g),PGV (m/s)\n0.5,0.6\n0.5,x\n", ["line 3, column 'PGV (m/s)': 'x'", "a finite number"]),
        ("PGA (g),PGV (m/s)\n0.5,60\n", ["line 2", "cm/s?"]),
        ("PGA,PGV (m/s)\n0.5,0.6\n", ["columns PGA, PGV (m/s)", "--columns pga_g=HEADING"]),
        ("SA(1.0) (g),PGV (m/s)\n0.5,0.6\n", ["is a spectral acceleration", "need PGA or PGV"]),
        ("pga_g,pga_m_s2,pgv_m_s\n0.5,5,0.6\n", ["two columns of pga_m_s2", "keep one"]),
        ("pga_g,pgv_m_s\n", ["no rows", "t.csv"]),
    ] {
        put(folder.path(), "t.csv", text);
        fail(
            folder.path(),
            &format!("evaluate --model universal {block} --in t.csv --out c.csv"),
            1,
            &expected,
        );
    }
    put(folder.path(), "t.csv", "PGA,PGV (m/s)\n0.5,0.6\n");
    let named = format!("evaluate --model universal {block} --in t.csv --columns pga_g=PGA --out c.csv");
    succeed(folder.path(), &named);
    assert!(get(folder.path(), "c.csv").contains(p_ro));
}

/// The numbers of an element of NRML.
fn numbers(xml: &str, opening: &str) -> Vec<f64> {
    let text = xml.split(opening).nth(1).unwrap().split_once('>').unwrap().1.split('<').next().unwrap();
    text.split(' ').map(|number| number.parse().unwrap()).collect()
}

#[test]
fn openquake_finds_the_rate_of_evaluate_over_the_same_hazard() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "h.csv", &hazard("pga_g,afe", |pga, rate| format!("{pga},{rate:e}")));
    let [answer, _] =
        call(folder.path(), &[&format!("evaluate {BLOCK} --limit-state 0.3 --hazard h.csv --format csv")]);
    let told = succeed(
        folder.path(),
        &format!("export {BLOCK} --limit-state 0.3 --to openquake --tolerance 1e-5 --out f.xml"),
    );
    assert!(told.contains("1 functions") && !told.contains("warning"), "{told}");
    let xml = get(folder.path(), "f.xml");
    assert!(xml.contains("_ratio_distributed\"") && xml.contains("above 0.3, or overturning"), "{xml}");
    assert!(xml.contains("holds from PGA 0.3810 (uplift) to 4.5000"), "no larger PGA was ever recorded");
    let levels = numbers(&xml, "<imls ");
    for (state, expected) in ["LS1", "LS2", "LS3"].into_iter().zip(rates(&answer)) {
        let poes = numbers(&xml, &format!("<poes ls=\"{state}\""));
        assert!(poes.iter().all(|p| (0.0..=1.0).contains(p)));
        let p = |pga: f64| match levels.partition_point(|level| *level <= pga) {
            0 => 0.0,
            after if after == levels.len() => poes[after - 1],
            after => {
                let share = (pga - levels[after - 1]) / (levels[after] - levels[after - 1]);
                poes[after - 1] + share * (poes[after] - poes[after - 1])
            }
        };
        // Thin slices of PGA, whose rates follow from the hazard.
        let mut rate = p(HAZARD[5].0) * HAZARD[5].1;
        for pair in HAZARD.windows(2) {
            let at = |share: f64| {
                let between = |low: f64, high: f64| low * (high / low).powf(share);
                (between(pair[0].0, pair[1].0), between(pair[0].1, pair[1].1))
            };
            for slice in 0..2000 {
                let [low, middle, high] = [0.0, 0.5, 1.0].map(|of| at((f64::from(slice) + of) / 2000.0));
                rate += p(middle.0) * (low.1 - high.1);
            }
        }
        assert!((rate / expected - 1.0).abs() < 0.01, "{state}: {rate}, not {expected}");
    }
}

#[test]
fn a_report_of_rates_alone_tells_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    put(folder.path(), "h.csv", &hazard("pga_g,afe", |pga, rate| format!("{pga},{rate:e}")));
    put(folder.path(), "two.csv", "name,width,height\ncabinet,0.8,2.1\nshelf,0.5,2.0\n");
    std::fs::create_dir(folder.path().join("rates")).unwrap();
    let ask = |name: &str, limit: &str| {
        let call = format!("evaluate --model universal --structures two.csv --name {name} --hazard h.csv");
        succeed(folder.path(), &format!("{call} --limit-state {limit} --out rates/{name}.parquet"));
    };
    ask("cabinet", "0.3");
    ask("shelf", "0.3");
    succeed(folder.path(), "report --in rates --out page.html --dpi 50");
    let page = get(folder.path(), "page.html");
    let findings = page.split("id=\"findings\"").nth(1).unwrap().split("</section>").next().unwrap();
    // What evaluate prints above its table stands beside each rate.
    let [printed, _] = call(
        folder.path(),
        &["evaluate --model universal --structures two.csv --name cabinet --hazard h.csv --limit-state 0.3"],
    );
    let sentences: Vec<&str> = printed.lines().skip(2).take_while(|line| !line.is_empty()).collect();
    assert!(sentences.len() >= 2 && sentences.iter().any(|line| line.contains("recorded motions")));
    for sentence in sentences {
        let rest: String = sentence.chars().skip(1).collect();
        assert!(findings.contains(&rest), "{rest} is not in {findings}");
    }
    assert!(findings.contains("320 other structures") && !findings.contains("They hold"), "{findings}");
    assert!(!findings.contains("What came out, further") && !findings.contains("LS2 is not the same"));
    for file in ["cabinet.parquet", "shelf.parquet"] {
        assert!(page.contains(&format!("<b>{file}</b>")), "{file} is not among the files");
    }
    assert!(page.contains("universal surface, for a structure that it has not seen"));
    assert!(findings.contains("rocking, from the hazard alone"), "{findings}");
    let svg = get(folder.path(), "page/rates.svg");
    assert!(svg.contains("max/α above 0.3, or overturning<"), "the label is cut: {svg}");
    ask("shelf", "0.1");
    succeed(folder.path(), "report --in rates --out page.html --dpi 50");
    assert!(get(folder.path(), "page.html").contains("LS2 is not the same limit state"));
    fail(folder.path(), "report --in . --out none.html", 1, &["responses.parquet: no such file"]);
}

#[test]
fn one_name_chooses_the_structure_and_its_fits() {
    let folder = tempfile::tempdir().unwrap();
    let run = run_folder().display();
    put(folder.path(), "two.csv", "name,p,alpha,eta\nframe,1,0.15,0.92\nelectrical-equipment,2.5,0.2,0.92\n");
    let ask = format!(
        "evaluate --pex {run}/pex.parquet --pro {run}/pro.parquet --suite csgm --structures two.csv --pga 0.5 --pgv 0.6"
    );
    for flag in ["--name", "--structure"] {
        let [answer, _] = call(folder.path(), &[&format!("{ask} {flag} electrical-equipment")]);
        assert!(
            answer.contains("fits of electrical-equipment") && answer.contains("p 2.5 rad/s"),
            "{answer}"
        );
    }
    fail(folder.path(), &ask, 2, &["--name with one of frame, electrical-equipment"]);
}
