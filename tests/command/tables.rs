//! Tables of people with mistakes and damage: what they say is read, or refused by its place.

use std::path::Path;

use serde_json::Value;

use super::common::{evaluated, fail, folder, near, number, rows, succeed};
use super::packed::{gzip, xlsx_of, zip};

const HAZARD: &str = concat!("--hazard ", env!("CARGO_MANIFEST_DIR"), "/data/hazard.csv");

/// The answers for a list, by the names of its objects.
#[track_caller]
fn objects(list: &str) -> Vec<(String, Value)> {
    let folder = folder(&[("list.csv", list)]);
    let rows = evaluated(folder.path(), "--structures list.csv --pga 0.5");
    rows.into_iter().map(|row| (row["structure"].as_str().unwrap().to_string(), row)).collect()
}

/// A workbook with two columns, of which the second may be shown as percent.
fn workbook(path: &Path, headings: [&str; 2], cells: &[(Value, f64)], is_percent: bool) {
    let mut workbook = rust_xlsxwriter::Workbook::new();
    let percent = rust_xlsxwriter::Format::new().set_num_format(if is_percent { "0.0%" } else { "General" });
    let sheet = workbook.add_worksheet();
    sheet.write_row(0, 0, headings).unwrap();
    for (row, (first, second)) in (1..).zip(cells) {
        match first {
            Value::String(text) => sheet.write_string(row, 0, text).unwrap(),
            first => sheet.write_number(row, 0, first.as_f64().unwrap()).unwrap(),
        };
        sheet.write_number_with_format(row, 1, *second, &percent).unwrap();
    }
    workbook.save(path).unwrap();
}

#[test]
fn shares_under_a_percent_sign_of_a_workbook_are_refused() {
    let folder = folder(&[]);
    let path = folder.path().join("h.xlsx");
    let object = "evaluate --width 0.5 --height 1.9 --hazard h.xlsx";
    let cells = |size: f64| {
        [(0.05, 0.5), (0.4, 0.1), (1.0, 0.01), (2.0, 0.001)].map(|(pga, poe)| (pga.into(), size * poe))
    };
    for is_percent in [true, false] {
        workbook(&path, ["PGA (g)", "PoE in 50 years (%)"], &cells(1.0), is_percent);
        fail(folder.path(), object, 1, &["h.xlsx", "line 2", "PoE in 50 years (%)", "CSV"]);
    }
    let rate = |headings: [&str; 2], size: f64| {
        workbook(&path, headings, &cells(size), size == 1.0);
        let row = evaluated(folder.path(), "--width 0.5 --height 1.9 --hazard h.xlsx").remove(0);
        number(&row, "overturning_per_year")
    };
    let plain = rate(["PGA (g)", "PoE in 50 years"], 1.0);
    assert!(near(rate(["PGA (g)", "PoE in 50 years (%)"], 100.0), plain, 1e-9));
}

#[test]
fn no_row_with_numbers_is_a_comment() {
    let names = |list: &str| objects(list).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    for (list, expected) in [
        ("name,width,height,note\n#2 rack,0.3,1.9\nB,0.5,1.9,x\n", ["#2 rack", "B"]),
        ("name,width,height\n101,0.5,1.9\n#103,0.4,1.9\n", ["#103", "101"]),
        ("name,width,height\n101,0.5,1.9\n# measured in May\n% 3,0.4,1.9\n", ["% 3", "101"]),
        ("name,width,height\n\"server\n#2\",0.3,1.9\n\"B\",0.5,1.9\n", ["server\n#2", "B"]),
        ("name,width,height\n# \"by hand\nB,0.3,1.9\n\"C\n\n\",0.5,1.9\n", ["B", "C"]),
    ] {
        assert_eq!(names(list), expected, "{list}");
    }
    // The number of objects is an error of a workbook, which CSV keeps.
    let list = "Qty,width,height\n#N/A,0.4,1.9\n2,0.5,1.9\n#REF!,0.3,1.9\n";
    let refused = objects(list).into_iter().filter(|(_, row)| row["p_rad_s"].is_null()).count();
    assert_eq!(refused, 2);
    let outcomes =
        "width,height,PGA (g),PGV (m/s),fell\n#N/A,1.9,.5,.4,yes\n.5,1.9,.5,.4,no\n.4,1.9,.5,.4,no\n";
    let folder = folder(&[("o.csv", outcomes), ("h.csv", "PGA (g),AFE\n0.1,0.01\n#0.3,0.001\n1,1e-4\n")]);
    fail(folder.path(), "fit-pro --in o.csv --out pro.parquet", 1, &["o.csv", "line 2", "#N/A"]);
    let hazard = "evaluate --width 0.5 --height 1.9 --hazard";
    fail(folder.path(), &format!("{hazard} h.csv"), 1, &["h.csv", "line 3", "#0.3"]);
    let cells = [("#REF!".into(), 0.01), (0.3.into(), 0.001), (1.0.into(), 1e-4)];
    workbook(&folder.path().join("h.xlsx"), ["PGA (g)", "AFE"], &cells, false);
    fail(folder.path(), &format!("{hazard} h.xlsx"), 1, &["h.xlsx", "line 2", "#REF!"]);
}

#[test]
fn workbooks_that_are_damaged_or_too_large_are_errors() {
    const TABLE: &str = concat!(
        r#"<row r="1"><c r="A1" t="str"><v>width</v></c><c r="B1" t="str"><v>height</v></c>"#,
        r#"<c r="C1" t="str"><v>note</v></c></row>"#,
        r#"<row r="2"><c r="A2"><v>0.5</v></c><c r="B2"><v>1.9</v></c>"#,
    );
    let folder = folder(&[]);
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let read = |name: &str| format!("evaluate --structures {name} --pga 0.5");
    let cell =
        |place: &str, row: &str| format!(r#"{TABLE}</row><row r="{row}"><c r="{place}"><v>1</v></c></row>"#);
    let formula = r#"<c r="C2"><f t="shared" ref="C2" si="4294967290">A2</f><v>1</v></c></row>"#;
    for (name, rows, texts, named) in [
        ("far.xlsx", cell("XFD1048576", "1048576"), "", "cells"),
        ("beyond.xlsx", cell("ZZZZZZ4294967295", "4294967295"), "", "cells"),
        ("texts.xlsx", format!("{TABLE}</row>"), r#"uniqueCount="4294967295""#, "damaged"),
        ("shared.xlsx", format!("{TABLE}{formula}"), "", "damaged"),
    ] {
        write(name, &xlsx_of(&rows, texts));
        fail(folder.path(), &read(name), 1, &[name, named]);
    }
    let error = r#"<c r="C2" t="e"><v>#SPILL!</v></c></row>"#;
    write("spill.xlsx", &xlsx_of(&format!("{TABLE}{error}"), ""));
    assert_eq!(evaluated(folder.path(), "--structures spill.xlsx --pga 0.5").len(), 1);
    let error = error.replace("C2", "A2");
    let row = TABLE.replace(r#"<c r="A2"><v>0.5</v></c>"#, "");
    write("spilt.xlsx", &xlsx_of(&format!("{row}{error}"), ""));
    fail(folder.path(), &read("spilt.xlsx"), 1, &["spilt.xlsx", "line 2", "#SPILL!"]);
    // An .xls that is cut off in its first sector.
    let mut xls = vec![0xff; 4096];
    xls[..8].copy_from_slice(&[0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1]);
    write("cut.xls", &xls);
    fail(folder.path(), &read("cut.xls"), 1, &["cut.xls", "damaged"]);
}

#[test]
fn all_that_a_file_unpacks_to_has_one_limit() {
    let folder = folder(&[]);
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    let half = vec![b'a'; 110 << 20];
    write("large.gz", &gzip(&[&half[..], &half].concat()));
    write("large.zip", &zip(&[("a.gz", &gzip(&half)), ("b.gz", &gzip(&half))]));
    // Whose parts are damaged: nothing but their names is read.
    let mut parts = zip(&[("a.csv", b"width,height\n0.5,1.9\n"), ("b.csv", b"width,height\n")]);
    let at = parts.windows(5).position(|bytes| bytes == b"a.csv").unwrap();
    parts[at + 5..at + 15].fill(0xff);
    write("parts.zip", &parts);
    let table = |name: &str| format!("evaluate --structures {name} --pga 0.5");
    fail(folder.path(), &table("large.gz"), 1, &["large.gz", "200 MB"]);
    fail(folder.path(), &table("parts.zip"), 1, &["parts.zip", "a.csv, b.csv"]);
    fail(folder.path(), "import-motions large.zip --out m.parquet", 1, &["large.zip", "200 MB"]);
}

#[test]
fn the_columns_of_a_site_are_found_by_their_headings() {
    let folder = folder(&[
        ("one.csv", "frequency\n1\n2\n"),
        ("period.csv", "period_s,factor\n0.1,1\n1,2\n"),
        ("a.csv", "frequency_hz,factor\n0.1,1\n10,2\n"),
        ("b.csv", "factor,frequency_hz\n1,0.1\n2,10\n"),
        ("c.csv", "0.1,1\n10,2\n"),
    ]);
    succeed(folder.path(), "sample-scenarios --mw 6.5 --re 5 --samples 1");
    let synthesize =
        |site: &str| format!("synthesize-motions --dt 0.02 --site {site}.csv --out {site}.parquet");
    let motions = |site: &str| {
        succeed(folder.path(), &synthesize(site));
        rows(folder.path(), &format!("{site}.parquet"))
    };
    assert_eq!(motions("a"), motions("b"));
    assert_eq!(motions("a"), motions("c"));
    for site in ["one", "period"] {
        fail(folder.path(), &synthesize(site), 1, &[site, "frequency_hz"]);
    }
}

#[test]
fn units_of_a_table_of_intensities_are_applied_or_refused() {
    let folder = folder(&[]);
    let table = |headings: &str| {
        let text = format!("pga_g,pgv_m_s,eta,{headings}\n0.5,0.5,0.92,0.4,0.2\n");
        std::fs::write(folder.path().join("t.csv"), text).unwrap();
    };
    for (headings, p, alpha) in [
        ("p_rad_s,alpha_rad", 0.4, 0.2),
        ("p,alpha", 0.4, 0.2),
        ("p (Hz),alpha (deg)", 0.4 * std::f64::consts::TAU, 0.2_f64.to_radians()),
    ] {
        table(headings);
        let row = evaluated(folder.path(), "--in t.csv").remove(0);
        assert!(near(number(&row, "p_rad_s"), p, 1e-12), "{headings}: {row}");
        assert!(near(number(&row, "alpha_rad"), alpha, 1e-12), "{headings}: {row}");
    }
    for (headings, named) in
        [("p (s),alpha", "p (s)"), ("p,alpha (m)", "alpha (m)"), ("p,alpha (%)", "alpha (%)")]
    {
        table(headings);
        fail(folder.path(), "evaluate --in t.csv", 1, &["t.csv", named]);
    }
    // A unit that the user names does not replace that of the file.
    std::fs::write(folder.path().join("h.csv"), "Peak (m/s2),AFE\n1,0.01\n10,1e-4\n").unwrap();
    let call = ["evaluate", "--width", "0.5", "--height", "1.9", "--hazard", "h.csv", "--columns"];
    let columns = |column: &str| {
        let mut command = super::common::rockfrag(folder.path(), "");
        command.args(call).arg(format!("{column}=Peak (m/s2)")).output().unwrap()
    };
    assert!(columns("pga_m_s2").status.success());
    let refused = columns("pga_g");
    assert!(
        refused.status.code() == Some(1) && String::from_utf8_lossy(&refused.stderr).contains("Peak (m/s2)")
    );
}

#[test]
fn a_floor_is_one_number_or_one_name() {
    let list = |floors: &[&str]| {
        let rows = floors.iter().map(|floor| format!("{floor},0.5,1.9,30,{floor}\n"));
        format!("name,width,height,storeys,floor\nground,0.5,1.9,30,G\n{}", rows.collect::<String>())
    };
    let read = |floors: &[&str]| {
        let folder = folder(&[("list.csv", &list(floors))]);
        evaluated(folder.path(), &format!("--structures list.csv {HAZARD}"))
    };
    let strange = ["2-3", "1.5", "-1.5", "3.5", "1 & 2", "L2.1", "2nd - 3rd", "L-3", "~3", "basement to 3"];
    let rows = read(&strange);
    for floor in strange {
        let row = rows.iter().find(|row| row["structure"] == *floor).unwrap();
        assert!(row["overturning_per_year"].is_null(), "{floor}: {row}");
        assert!(row["warnings"].to_string().contains(floor), "{floor}: {row}");
    }
    let known = ["3", "3.0", "3rd floor", "L3", "3. OG", "Level 3", "-1", "B2", "basement level 1"];
    for row in read(&known) {
        assert!(row["overturning_per_year"].is_number(), "{row}");
    }
}

#[test]
fn one_site_is_one_place() {
    let file = |place: &str| format!("# {place}\nPGA (g),AFE\n0.1,0.01\n0.5,1e-3\n1,1e-4\n");
    let spectral = |place: &str| file(place).replace("PGA", "SA(1.0)").replace("0.1,", "0.05,");
    for (first, second, is_one) in [
        ("lon=-0.1276, lat=51.5", "lon=-0.128, lat=51.5", true),
        ("lon=0.0, lat=0.0", "lon=0.0001, lat=0.0", true),
        ("lon=139.70, lat=35.6", "lon=139.713, lat=35.6", false),
        ("lon=10, lat=45.00", "lon=10, lat=45.02", false),
        ("vs30=760", "vs30=765", false),
    ] {
        let folder = folder(&[("a.csv", &file(first)), ("b.csv", &spectral(second))]);
        let call = "evaluate --width 0.5 --height 1.9 --hazard a.csv,b.csv";
        match is_one {
            true => drop(succeed(folder.path(), call)),
            false => fail(folder.path(), call, 1, &["b.csv", "one site"]),
        }
    }
}

#[test]
fn a_sheet_may_have_the_sign_in_its_name() {
    let folder = folder(&[]);
    let mut workbook = rust_xlsxwriter::Workbook::new();
    for (name, width) in [("Room #1", 0.5), ("Room#2", 0.4)] {
        let sheet = workbook.add_worksheet().set_name(name).unwrap();
        sheet.write_row(0, 0, ["width", "height"]).unwrap();
        sheet.write_row(1, 0, [width, 1.9]).unwrap();
    }
    workbook.save(folder.path().join("l.xlsx")).unwrap();
    assert_eq!(evaluated(folder.path(), "--structures l.xlsx#Room#2 --pga 0.5").len(), 1);
}
