//! From bytes to cells: encodings, archives, workbooks.

use rockfrag::inputs::{Grid, InputError, unpack};

use super::packed::{csv, gzip, ods, utf_16, xlsx, zip};

fn table() -> Vec<Vec<&'static str>> {
    vec![vec!["Höhe (cm)", "größe"], vec!["189.5", "1e-3"], vec!["1029.25", "2"]]
}

/// Its headings, lines and numbers.
fn read(bytes: &[u8]) -> (Vec<String>, Vec<usize>, Vec<f64>) {
    let grid = Grid::parse(bytes, None).unwrap_or_else(|why| panic!("{why}"));
    let headings = grid.headings.iter().map(|heading| heading.text.clone()).collect();
    let cells = (0..grid.lines.len()).flat_map(|row| [(row, 0), (row, 1)]);
    (headings, grid.lines.clone(), cells.map(|(row, column)| grid.number(row, column).unwrap()).collect())
}

#[test]
fn one_table_is_one_table_in_any_bytes() {
    let cells = table();
    let text = csv(&cells, ",");
    let expected = read(text.as_bytes());
    assert_eq!(expected.1, [2, 3]);
    assert_eq!(expected.2, [189.5, 1e-3, 1029.25, 2.0]);
    let latin_1: Vec<u8> = text.chars().map(|sign| sign as u8).collect();
    for (name, bytes) in [
        ("semicolons", text.replace(',', ";").into_bytes()),
        ("decimal commas", text.replace(',', ";").replace('.', ",").into_bytes()),
        ("quoted decimal commas", "Höhe (cm),größe\n\"189,5\",1e-3\n\"1029,25\",2\n".as_bytes().to_vec()),
        ("thousands", "Höhe (cm);größe\n189,5;1e-3\n1.029,25;2\n".as_bytes().to_vec()),
        ("apostrophes", "Höhe (cm);größe\n189.5;1e-3\n1\u{2019}029.25;2\n".as_bytes().to_vec()),
        ("blanks", "Höhe (cm);größe\n189,5;1e-3\n1\u{202f}029,25;2\n".as_bytes().to_vec()),
        ("Fortran", text.replace("1e-3", "1D-3").into_bytes()),
        ("byte-order mark", format!("\u{feff}{text}").into_bytes()),
        ("Latin-1", latin_1),
        ("UTF-16", utf_16(&text, true, false)),
        ("UTF-16, big end first", utf_16(&text, true, true)),
        ("UTF-16 without a mark", utf_16(&text, false, false)),
        ("CR", text.replace('\n', "\r").into_bytes()),
        ("CR LF", text.replace('\n', "\r\n").into_bytes()),
        ("gzip", gzip(text.as_bytes())),
        ("zip", zip(&[("__MACOSX/._t.csv", b"\0\0"), ("a/t.csv", text.as_bytes())])),
        ("gzip in zip", zip(&[("t.csv.gz", &gzip(text.as_bytes()))])),
        ("xlsx", xlsx(&[("Tabelle1", &cells), ("Tabelle2", &[])])),
        ("ods", ods(&cells)),
    ] {
        assert_eq!(read(&bytes), expected, "{name}");
    }
    let text = "名称,高さ (cm)\n花瓶,180\n仏像,90\n";
    let shift_jis = encoding_rs::SHIFT_JIS.encode(text).0;
    assert_eq!(Grid::parse(&shift_jis, None), Grid::parse(text.as_bytes(), None));
    let refused = |bytes: &[u8]| matches!(Grid::parse(bytes, None), Err(InputError::Unexpected { .. }));
    assert!(refused(&encoding_rs::EUC_JP.encode(text).0));
    assert!(refused(&encoding_rs::WINDOWS_1251.encode("Имя,h\nВаза,3\n").0));
}

#[test]
fn what_is_no_table_is_refused_by_what_it_is() {
    let two = zip(&[("a.csv", b"1,2\n"), ("b.csv", b"1,2\n")]);
    let found = |bytes: &[u8]| format!("{:?}", Grid::parse(bytes, None).unwrap_err());
    assert_eq!(unpack(two.clone()).unwrap().len(), 2);
    for (bytes, named) in [
        (two, "Members { found: [\"a.csv\", \"b.csv\"] }"),
        (b"%PDF-1.7\n".to_vec(), "a PDF"),
        (b"<!DOCTYPE html>\n<html>404</html>\n".to_vec(), "a web page"),
        (b"PAR1\x15\x04".to_vec(), "Parquet"),
        (b"{\"a\": [1]}\n".to_vec(), "JSON"),
        (zip(&[("[Content_Types].xml", b"/word/document.xml")]), "a Word document"),
        (b"\xd0\xcf\x11\xe0E\0n\0c\0r\0y\0p\0t\0e\0d\0P\0a\0c\0k\0a\0g\0e\0".to_vec(), "a password"),
        (gzip(b"pga_g,AFE\n0.1,0.2\n")[..20].to_vec(), "Damaged"),
        (b"\x00\x01\x02\x03".to_vec(), "binary data"),
        (b"name,h\nrack,2\n\"shelf,3\nbox,4\n".to_vec(), "Quote { line: 3 }"),
    ] {
        assert!(found(&bytes).contains(named), "{named}: {}", found(&bytes));
    }
}

#[test]
fn a_sheet_is_named_where_several_have_cells() {
    let (first, second) = (table(), vec![vec!["h"], vec!["3"]]);
    let bytes = xlsx(&[("Geräte #1", &first), ("Räume#2", &second)]);
    let found = vec!["Geräte #1".to_string(), "Räume#2".to_string()];
    assert_eq!(Grid::parse(&bytes, None), Err(InputError::Sheets { found }));
    assert_eq!(Grid::parse(&bytes, Some("Räume#2")).unwrap().headings.len(), 1);
    assert!(matches!(Grid::parse(&bytes, Some("x")), Err(InputError::Sheets { .. })));
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("list.xlsx"), &bytes).unwrap();
    for (sheet, lines) in [("Geräte #1", vec![2, 3]), ("Räume#2", vec![2])] {
        let path = folder.path().join(format!("list.xlsx#{sheet}"));
        assert_eq!(Grid::read(&path).unwrap().lines, lines, "{sheet}");
    }
}
