//! Tables as people and agencies write them.

use rockfrag::inputs::{Grid, Heading, InputError};

/// A text, the names of its columns with their units, the line of its first row, and its rows (text if not a
/// number).
const CASES: &[(&str, &str, usize, &str)] = &[
    // Separators and decimal commas.
    ("pga_g,rate\n0.1,2e-3\n0.2,1e-3\n", "pga:g rate", 2, "0.1 0.002; 0.2 0.001"),
    ("PGA [g];rate\n0,1;0,002\n0,2;0,001\n", "pga:g rate", 2, "0.1 0.002; 0.2 0.001"),
    ("time\tacc m/s^2\n0,00\t1,5\n0,01\t-2\n", "time acc:m/s2", 2, "0 1.5; 0.01 -2"),
    ("time (s)  acc (cm/s^2)\n 0.00   1.5\n 0.01  -2.\n", "time:s acc:cm/s2", 2, "0 1.5; 0.01 -2"),
    ("0,00 1,5\n0,01 -2\n", "", 1, "0 1.5; 0.01 -2"),
    ("0.00, 1.5\n0.01, -2e-1\n", "", 1, "0 1.5; 0.01 -0.2"),
    ("1, 5\n2, 6\n", "", 1, "1 5; 2 6"),
    ("0.1\n0.2\n", "", 1, "0.1; 0.2"),
    // Lists of objects.
    (
        "name; width (cm); depth (cm); height (cm)\nshelf, tall; 60; 40; 180\nrack; 80,5; 60; 220\n",
        "name width:cm depth:cm height:cm",
        2,
        "shelf, tall 60 40 180; rack 80.5 60 220",
    ),
    (
        "Hospital A\n\nfirst floor;;;\nName;Width [mm];Height [mm];note\nrack;600;2200;\n12;500;;\"on\nwheels\"\n",
        "name width:mm height:mm note",
        5,
        "rack 600 2200 ; 12 500  on\nwheels",
    ),
    ("#;name;h_m\n1;a;2\n2;b;3\n", " name h:m", 2, "1 a 2; 2 b 3"),
    ("rack;600\nshelf;500\n", "", 1, "rack 600; shelf 500"),
    ("a;b;c\nd;n/a\ne;1;2\nf;3;4;\n\ng;;5\n", "a b c", 2, "d n/a ; e 1 2; f 3 4; g  5"),
    // Units behind numbers, as in the heading.
    (
        "name;w (cm);h (cm)\na;40 cm;180\nb;1.029,5cm;1.900 mm\n",
        "name w:cm h:cm",
        2,
        "a 40 180; b 1029.5 1.900 mm",
    ),
    // Agencies.
    (
        "#,,,\"generated_by='OpenQuake engine 3.16', kind='mean', investigation_time=50.0\"\n\
         lon,lat,depth,poe-0.0050000,poe-0.0070000\n15.0,38.0,0.0,9.9E-01,9.8E-01\n",
        "lon lat depth poe-0-0050000 poe-0-0070000",
        3,
        "15 38 0 0.99 0.98",
    ),
    ("lon,lat,0.0025,0.0045\n-118,34,0.9,0.8\n", "lon lat 0-0025 0-0045", 2, "-118 34 0.9 0.8"),
    ("Station,ABC\nVs30,760\ntime,acc_g\n0.00,1\n0.01,2\n# end\n", "time acc:g", 4, "0 1; 0.01 2"),
    ("// site class B\n% time acc_g\n0.00 1\n0.01 2\n", "time acc:g", 3, "0 1; 0.01 2"),
    ("return_period_years,pga_m_s2\n475,2\n", "return-period:years pga:m/s2", 2, "475 2"),
    ("pga (g),poe_in_50_years (%)\n0.1,10%\n0.2,2 %\n", "pga:g poe-in-50-years", 2, "0.1 0.1; 0.2 0.02"),
    // Bytes.
    ("pga\u{a0}(g);rate\n0,1;2\n\u{1a}", "pga:g rate", 2, "0.1 2"),
    ("1,2\n,,\n3,4\n", "", 1, "1 2; 3 4"),
];

fn shown(sheet: &Grid) -> (String, usize, String) {
    let heading = |Heading { name, unit, .. }: &Heading| match unit {
        Some(unit) => format!("{name}:{}", unit.name),
        None => name.clone(),
    };
    let headings = sheet.headings.iter().filter(|_| sheet.has_headings).map(heading);
    let headings: Vec<String> = headings.collect();
    let cell = |row: usize, column: usize| match sheet.number(row, column) {
        Ok(value) => value.to_string(),
        Err(_) => sheet.cell(row, column).to_string(),
    };
    let row = |row| (0..sheet.headings.len()).map(|column| cell(row, column)).collect::<Vec<_>>().join(" ");
    let rows: Vec<String> = (0..sheet.lines.len()).map(row).collect();
    (headings.join(" "), sheet.lines[0], rows.join("; "))
}

#[test]
fn tables_are_read_as_they_are_meant() {
    for (text, headings, line, rows) in CASES {
        let read = shown(&Grid::parse(text.as_bytes(), None).unwrap());
        assert_eq!(read, (headings.to_string(), *line, rows.to_string()), "{text}");
    }
}

#[test]
fn notes_keep_what_stands_above_and_in_comments() {
    let agency = CASES.iter().find(|(text, ..)| text.contains("OpenQuake")).unwrap();
    let sheet = Grid::parse(agency.0.as_bytes(), None).unwrap();
    assert!(sheet.notes[0].contains("investigation_time=50.0"));
    let sheet = Grid::parse(b"Hospital A\nname;h\nrack;2\n# measured in May\nshelf;3\n", None).unwrap();
    assert_eq!(sheet.notes, ["Hospital A", "# measured in May"]);
    assert_eq!(sheet.lines, [3, 5]);
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let sheet = Grid::parse(b"# a\npga_g,rate\n0.1,2\n0.2,many\n0.3\n", None).unwrap();
    for (row, line, found) in [(1, 4, "many"), (2, 5, "")] {
        let Err(InputError::Cell { line: at, heading, found: word, .. }) = sheet.number(row, 1) else {
            panic!("row {row} has a number");
        };
        assert_eq!((at, &*heading, &*word), (line, "rate", found));
    }
    let decimal_commas = Grid::parse(b"pga_g,rate\n0,1,0,2\n0,3,0,1\n", None);
    assert_eq!(decimal_commas, Err(InputError::Cells { line: 2, found: 4, expected: 2 }));
    for number in ["nan", "inf", "1e999", "1.23,5", "0x1", "1,2,3"] {
        let sheet = Grid::parse(format!("a;b\n1;2\n3;{number}\n").as_bytes(), None).unwrap();
        assert!(matches!(sheet.number(1, 1), Err(InputError::Cell { line: 3, .. })), "{number}");
    }
}

/// The numbers of the last column, or the kind of error of the first that is none.
fn last_column(text: &str) -> Result<Vec<f64>, InputError> {
    let grid = Grid::parse(text.as_bytes(), None)?;
    (0..grid.lines.len()).map(|row| grid.number(row, grid.headings.len() - 1)).collect()
}

#[test]
fn points_and_commas_are_settled_by_the_whole_table() {
    for (text, numbers) in [
        // Another column, or other cells of the same, tell what a comma is.
        ("t\ta\n0.00\t999\n0.01\t1,029\n", vec![999.0, 1029.0]),
        ("t\ta\n0,00\t0,999\n0,01\t1,029\n", vec![0.999, 1.029]),
        ("t\ta\n0,00\t999\n0,01\t1.029\n", vec![999.0, 1029.0]),
        ("t;a\n0.50;\"1,029\"\n0.01;\"1,234,567\"\n", vec![1029.0, 1234567.0]),
        ("a;b\n600;1,000\n900;400\n", vec![1000.0, 400.0]),
        ("a;b\nx;1.029,5\ny;3.000\n", vec![1029.5, 3000.0]),
        ("a;b\nx;1,029.5\ny;3,000\n", vec![1029.5, 3000.0]),
        // Points alone are decimal.
        ("a;b\nx;1.029\ny;2.100\n", vec![1.029, 2.1]),
        ("a;b\nx;1.029\ny;0.999\nz;475\n", vec![1.029, 0.999, 475.0]),
        ("a;b\nx;10290\ny;1.029\n", vec![10290.0, 1.029]),
    ] {
        assert_eq!(last_column(text), Ok(numbers), "{text}");
    }
    for text in [
        // Nothing tells, or the table contradicts itself.
        "a;b\nx;1,029\ny;2,100\n",
        "a;b\nx;1.029\ny;999\n",
        "t\ta\n0.00\t999\n0.01\t1.029\n",
        "t\ta\n0,00\t999\n0,01\t1,029\n",
    ] {
        assert!(matches!(last_column(text), Err(InputError::Cell { .. })), "{text}");
    }
}

#[test]
fn many_columns_and_long_lines_are_read() {
    // In quadratic time this test would not end.
    const COLUMNS: usize = 100_000;
    let headings: Vec<String> = (0..COLUMNS).map(|at| format!("c{at}")).collect();
    let table = headings.join(",") + "\n" + &"0.1,".repeat(COLUMNS - 1) + "0.2\n";
    let grid = Grid::parse(table.as_bytes(), None).unwrap();
    assert_eq!((grid.headings.len(), grid.number(0, COLUMNS - 1)), (COLUMNS, Ok(0.2)));
    let note = format!("a,b\n# {}\n1,2\n", "(0.1 ".repeat(COLUMNS));
    let grid = Grid::parse(note.as_bytes(), None).unwrap();
    assert!(grid.notes.iter().all(|note| Heading::new(note).unit.is_none()));
}

#[test]
fn the_unit_is_that_of_the_numbers() {
    for (text, name, unit) in [
        ("acc (g) NS", "acc-ns", "g"),
        ("acc (NS) (m/s2)", "acc-ns", "m/s2"),
        ("SA (T = 1.0 s) (g)", "sa-t-1-0-s", "g"),
        ("acc [unit: cm/s2]", "acc", "cm/s2"),
        ("pga_m_s2", "pga", "m/s2"),
    ] {
        let heading = Heading::new(text);
        let found = heading.unit.map(|unit| unit.name);
        assert!(heading.name.starts_with(name) && found == Some(unit), "{text}: {heading:?}");
    }
    for text in [
        "acc (x10 m/s2)",
        "acc (gravity, 1g = 980.5 cm/s/s)",
        "acc in g, 1 g = 9.81 m/s2",
        "acc (0.1 g)",
        "acc (9.81 m/s2)",
        "acc x 1000 g",
    ] {
        let heading = Heading::new(text);
        assert!(heading.is_scaled && heading.unit.is_none(), "{text}: {heading:?}");
    }
}

#[test]
fn units_stand_in_a_row_of_their_own() {
    for text in
        ["Time,PGA\n(s),(g)\n0,1\n0.1,2\n", "Time PGA\nsec g\n0 1\n0.1 2\n", "Time,PGA (g)\ns,\n0,1\n0.1,2\n"]
    {
        let grid = Grid::parse(text.as_bytes(), None).unwrap();
        let units: Vec<_> = grid.headings.iter().map(|heading| heading.unit.unwrap().name).collect();
        assert_eq!((units, grid.lines), (vec!["s", "g"], vec![3, 4]), "{text}");
    }
    let contradiction = Grid::parse(b"Time,PGA (g)\n(s),(m/s2)\n0,1\n0.1,2\n", None);
    assert!(matches!(contradiction, Err(InputError::Units { .. })));
}

#[test]
fn rows_without_all_numbers_are_rows() {
    for (text, cells) in [
        ("pga_g,AFE\n0.001,NA\n0.01,0.1\n", vec!["0.001", "0.01"]),
        ("pga_g,AFE\nNA,NA\nnan,null\n", vec!["NA", "nan"]),
        ("name,w,h\nA,0.5 m,2\nB,0.5,2\n", vec!["A", "B"]),
        ("name,w,h\nA,0.5 m,2 m\nB,0.6 m,2 m\n", vec!["A", "B"]),
        ("name,w,h\nA,1e400,2\nB,0.5,2\n", vec!["A", "B"]),
        ("name,w,h\nA,0.5,2\n#2 rack,0.6,2\n// 3,0.6,2\nC,0.5,2\n# end\n", vec!["A", "#2 rack", "// 3", "C"]),
        ("name,w,h,note\n#2 rack,0.3,1.9\nB,0.5,1.9,x\n", vec!["#2 rack", "B"]),
        ("name,w,h\n101,0.5,1.9\n#103,0.4,1.9\n", vec!["101", "#103"]),
        ("name,w,h\n101,0.5,1.9\n# measured in May\n% 3,0.4,1.9\n", vec!["101", "% 3"]),
        ("name,w,h\n\"server\n#2\",0.3,1.9\n\"B\",0.5,1.9\n", vec!["server\n#2", "B"]),
        ("name,w,h\n# \"by hand\nB,0.3,1.9\n\"C\n\n\",0.5,1.9\n", vec!["B", "C"]),
        ("shelf; tall,60,180\nrack; low,60,90\n", vec!["shelf; tall", "rack; low"]),
        ("name,lon,lat,0.01,0.02\nTown,-122,37,0.2,0.1\n", vec!["Town"]),
    ] {
        let grid = Grid::parse(text.as_bytes(), None).unwrap();
        let found: Vec<&str> = (0..grid.lines.len()).map(|row| grid.cell(row, 0)).collect();
        assert_eq!(found, cells, "{text}");
    }
}
