//! Tables of people with mistakes and damage: what they say is read, or refused by its place.

use std::path::Path;

use super::common::{evaluated, fail, folder, near, number};
use super::packed::{gzip, xlsx_of, zip};

/// A workbook with two columns, of which the second may be shown as percent.
fn workbook(path: &Path, headings: [&str; 2], cells: &[(f64, f64)], is_percent: bool) {
    let mut workbook = rust_xlsxwriter::Workbook::new();
    let percent = rust_xlsxwriter::Format::new().set_num_format(if is_percent { "0.0%" } else { "General" });
    let sheet = workbook.add_worksheet();
    sheet.write_row(0, 0, headings).unwrap();
    for (row, (first, second)) in (1..).zip(cells) {
        sheet.write_number(row, 0, *first).unwrap();
        sheet.write_number_with_format(row, 1, *second, &percent).unwrap();
    }
    workbook.save(path).unwrap();
}

#[test]
fn percent_of_a_workbook_is_what_it_shows() {
    let folder = folder(&[]);
    let path = folder.path().join("h.xlsx");
    let cells =
        |size: f64| [(0.05, 0.5), (0.4, 0.1), (1.0, 0.01), (2.0, 0.001)].map(|(pga, poe)| (pga, size * poe));
    let rate = |poe: &str, size: f64, is_percent: bool| {
        workbook(&path, ["PGA (g)", poe], &cells(size), is_percent);
        let row = evaluated(folder.path(), "--width 0.5 --height 1.9 --hazard h.xlsx").remove(0);
        number(&row, "overturning_per_year")
    };
    let plain = rate("PoE in 50 years", 1.0, false);
    for shown in [
        ("PoE in 50 years", 1.0, true),
        ("PoE in 50 years (%)", 1.0, true),
        ("PoE in 50 years (%)", 100.0, false),
    ] {
        assert!(near(rate(shown.0, shown.1, shown.2), plain, 1e-9), "{shown:?}");
    }
    assert!(rate("PoE in 50 years (%)", 1.0, false) < 0.1 * plain);
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
    write("two.zip", &zip(&[("a.csv", b"width,height\n0.5,1.9\n"), ("b.csv", b"width,height\n")]));
    let table = |name: &str| format!("evaluate --structures {name} --pga 0.5");
    fail(folder.path(), &table("large.gz"), 1, &["large.gz", "200 MB"]);
    fail(folder.path(), &table("two.zip"), 1, &["two.zip", "a.csv, b.csv"]);
    fail(folder.path(), "import-motions large.zip --out m.parquet", 1, &["large.zip", "200 MB"]);
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
}
