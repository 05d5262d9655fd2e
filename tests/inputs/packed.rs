//! The same table in the bytes of many programs, and curves as OpenQuake exports them.
#![allow(dead_code, reason = "no group needs all")]

use std::io::Write;

/// A table of text and numbers.
pub type Cells<'a> = &'a [Vec<&'a str>];

/// Parts cells by a sign.
pub fn csv(cells: Cells, separator: &str) -> String {
    cells.iter().map(|row| row.join(separator) + "\n").collect()
}

pub fn utf_16(text: &str, with_mark: bool, is_big: bool) -> Vec<u8> {
    let text = if with_mark { format!("\u{feff}{text}") } else { text.to_string() };
    let units = text.encode_utf16();
    units.flat_map(|unit| if is_big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect()
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

pub fn zip(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, bytes) in files {
        archive.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

/// A workbook with a sheet for each table.
pub fn xlsx(sheets: &[(&str, Cells)]) -> Vec<u8> {
    let mut workbook = rust_xlsxwriter::Workbook::new();
    for (name, cells) in sheets {
        let sheet = workbook.add_worksheet().set_name(*name).unwrap();
        for (row, cells) in cells.iter().enumerate() {
            for (column, cell) in cells.iter().enumerate() {
                let (row, column) = (row as u32, column as u16);
                match cell.parse::<f64>() {
                    Ok(number) => sheet.write_number(row, column, number).unwrap(),
                    Err(_) => sheet.write_string(row, column, *cell).unwrap(),
                };
            }
        }
    }
    workbook.save_to_buffer().unwrap()
}

pub fn ods(cells: Cells) -> Vec<u8> {
    let cell = |text: &&str| {
        let kind = match text.parse::<f64>() {
            Ok(number) => format!(r#"float" office:value="{number}"#),
            Err(_) => "string".to_string(),
        };
        let text = format!("<text:p>{text}</text:p>");
        format!(r#"<table:table-cell office:value-type="{kind}">{text}</table:table-cell>"#)
    };
    let row = |cells: &Vec<&str>| {
        format!("<table:table-row>{}</table:table-row>", cells.iter().map(cell).collect::<String>())
    };
    let content = format!(
        r#"<?xml version="1.0" encoding="UTF-8"?><office:document-content xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"><office:body><office:spreadsheet><table:table table:name="Sheet1">{}</table:table></office:spreadsheet></office:body></office:document-content>"#,
        cells.iter().map(row).collect::<String>()
    );
    let manifest =
        r#"<manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0"/>"#;
    let (kind, manifest) = (b"application/vnd.oasis.opendocument.spreadsheet", manifest.as_bytes());
    zip(&[("mimetype", kind), ("META-INF/manifest.xml", manifest), ("content.xml", content.as_bytes())])
}

/// A workbook with these rows of XML, and this start of its list of texts.
pub fn xlsx_of(rows: &str, texts: &str) -> Vec<u8> {
    const HEAD: &str = r#"<?xml version="1.0"?>"#;
    const MAIN: &str = r#"xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main""#;
    const OFFICE: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    const PACKAGE: &str = r#"xmlns="http://schemas.openxmlformats.org/package/2006/relationships""#;
    let types =
        format!(r#"{HEAD}<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>"#);
    let relation = |kind: &str, target: &str| {
        format!(
            r#"{HEAD}<Relationships {PACKAGE}><Relationship Id="r1" Type="{OFFICE}/{kind}" Target="{target}"/></Relationships>"#
        )
    };
    let book = format!(
        r#"{HEAD}<workbook {MAIN} xmlns:r="{OFFICE}"><sheets><sheet name="S" sheetId="1" r:id="r1"/></sheets></workbook>"#
    );
    let sheet = format!("{HEAD}<worksheet {MAIN}><sheetData>{rows}</sheetData></worksheet>");
    let texts = format!("{HEAD}<sst {MAIN} {texts}><si><t>x</t></si></sst>");
    zip(&[
        ("[Content_Types].xml", types.as_bytes()),
        ("_rels/.rels", relation("officeDocument", "xl/workbook.xml").as_bytes()),
        ("xl/workbook.xml", book.as_bytes()),
        ("xl/_rels/workbook.xml.rels", relation("worksheet", "worksheets/sheet1.xml").as_bytes()),
        ("xl/worksheets/sheet1.xml", sheet.as_bytes()),
        ("xl/sharedStrings.xml", texts.as_bytes()),
    ])
}

pub const PGA_G: [f64; 7] = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 4.5];

/// 1e-3 (PGA / 1 g)^-2 a year.
pub fn rate(pga_g: f64) -> f64 {
    1e-3 / (pga_g * pga_g)
}

/// A table under a heading, with a line for each PGA.
pub fn table(heading: &str, line: impl Fn(f64) -> String) -> String {
    let lines: String = PGA_G.iter().map(|&pga_g| line(pga_g) + "\n").collect();
    format!("{heading}\n{lines}")
}

/// A curve as OpenQuake exports it, under a header, of rates times a factor and intensities times a scale.
pub fn exported(header: &str, scale: f64, factor: f64) -> String {
    let levels = PGA_G.map(|pga_g| format!("poe-{}", pga_g * scale)).join(",");
    let poes = PGA_G.map(|pga_g| (-(-50.0 * factor * rate(pga_g)).exp_m1()).to_string()).join(",");
    format!("{header}\nlon,lat,depth,{levels}\n13.4,42.3,0.0,{poes}\n")
}
