//! Sheets of workbooks: .xlsx, .xls and .ods.

use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::io::Cursor;

use calamine::open_workbook_auto_from_rs;
use calamine::{Data, DataType, Dimensions, Reader, SheetVisible, Sheets, Xlsx, XlsxError};

use rockfrag_core::units::Unit;
use zip::ZipArchive;

use super::error::{InputError, Result, expect_few_cells};
use super::grid::Source;
use super::layout::RawRow;
use super::words::normal;
use crate::number::rounded;
use crate::source::guarded;

/// The texts of the cells that have one, by row and column from 0.
type Cells = BTreeMap<(u32, u32), String>;

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\xd0\xcf\x11\xe0")
}

pub struct Sheet {
    pub rows: Vec<RawRow>,
    /// Lines and columns of cells that are merged over rows.
    pub repeated: HashSet<(usize, usize)>,
    pub source: Source,
    pub name: String,
}

/// Reads the sheet with this name, or the only visible one that has any cells.
pub fn read(bytes: &[u8], name: Option<&str>) -> Result<Sheet> {
    let damaged = || Err(InputError::damaged("its cells cannot be read"));
    expect_few_announced(bytes)?;
    guarded(|| find(bytes, name)).unwrap_or_else(damaged)
}

fn find(bytes: &[u8], name: Option<&str>) -> Result<Sheet> {
    let mut workbook = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let all = workbook.sheets_metadata().to_vec();
    let is_visible = |sheet: &calamine::Sheet| sheet.visible == SheetVisible::Visible;
    let mut filled = Vec::new();
    for sheet in all.iter().filter(|sheet| name.map_or(is_visible(sheet), |name| sheet.name == name)) {
        let cells = filled_cells(&mut workbook, &sheet.name)?;
        if !cells.is_empty() {
            filled.push((sheet.name.clone(), cells));
        }
    }
    let (sheet, mut cells) = match filled.len() {
        1 => filled.remove(0),
        0 if name.is_none() => return Err(InputError::unexpected("an empty workbook", "a table")),
        0 => return Err(InputError::Sheets { found: all.into_iter().map(|sheet| sheet.name).collect() }),
        _ => return Err(InputError::Sheets { found: filled.into_iter().map(|(name, _)| name).collect() }),
    };
    let (mut source, mut merged) = (Source::Workbook, Vec::new());
    match &mut workbook {
        Sheets::Xlsx(workbook) => {
            source = Source::Xlsx;
            merged = workbook.merge_cells_by_sheet_name(&sheet).map_err(InputError::damaged)?;
        }
        Sheets::Ods(_) => expect_no_merged_rows(bytes)?,
        _ => {}
    }
    let repeated = repeat_merged(&merged, &mut cells)?;
    let (rows, left) = in_rows(&cells)?;
    let repeated = repeated.into_iter().map(|(row, at)| (row as usize + 1, (at - left) as usize));
    Ok(Sheet { rows, repeated: repeated.collect(), source, name: sheet })
}

/// Repeats merged cells; returns the places of those that are merged over rows.
fn repeat_merged(merged: &[Dimensions], cells: &mut Cells) -> Result<Vec<(u32, u32)>> {
    let last = cells.keys().fold((0, 0), |last: (u32, u32), at| (last.0.max(at.0), last.1.max(at.1)));
    let (mut repeated, mut count) = (Vec::new(), cells.len());
    for Dimensions { start, end } in merged {
        let Some(text) = cells.get(start).cloned() else { continue };
        for row in start.0..=end.0.min(last.0) {
            for column in start.1..=end.1.min(last.1) {
                count += 1;
                expect_few_cells(count)?;
                cells.entry((row, column)).or_insert_with(|| text.clone());
                repeated.extend((end.0 > start.0).then_some((row, column)));
            }
        }
    }
    Ok(repeated)
}

/// The rows that have any cell, and the first column.
fn in_rows(cells: &Cells) -> Result<(Vec<RawRow>, u32)> {
    let columns = cells.keys().map(|(_, column)| *column);
    let (left, right) = columns.fold((u32::MAX, 0), |(left, right), at| (left.min(at), right.max(at)));
    let rows: BTreeSet<u32> = cells.keys().map(|(row, _)| *row).collect();
    let height = rows.last().zip(rows.first()).map_or(0, |(last, first)| last - first + 1);
    expect_few_cells((height as usize).saturating_mul((right - left) as usize + 1))?;
    let row = |row: u32| {
        let texts = (left..=right).map(|column| cells.get(&(row, column)).map_or("", String::as_str));
        RawRow::new(row as usize + 1, texts.collect(), None)
    };
    Ok((rows.into_iter().map(row).collect(), left))
}

/// Refuses cells of an .ods that are merged over rows: its reader leaves all but the first empty.
fn expect_no_merged_rows(bytes: &[u8]) -> Result<()> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let content = archive.by_name("content.xml").map_err(InputError::damaged)?;
    let content = std::io::read_to_string(content).map_err(InputError::damaged)?;
    let mut spans = content.split("number-rows-spanned=\"").skip(1);
    if spans.any(|span| !span.starts_with("1\"")) {
        let expected = "a sheet saved as .xlsx or CSV: of .ods the others are taken as empty";
        return Err(InputError::unexpected("cells merged over rows", expected));
    }
    Ok(())
}

/// Checks the records of dimensions of an .xls: its reader reserves memory for all cells between.
fn expect_few_announced(bytes: &[u8]) -> Result<()> {
    const START: [u8; 4] = [0, 2, 14, 0];
    let is_xls = bytes.starts_with(b"\xd0\xcf\x11\xe0");
    for record in bytes.windows(18).filter(|record| is_xls && record.starts_with(&START)) {
        let rows = u32::from_le_bytes([record[8], record[9], record[10], record[11]]);
        let columns = u16::from_le_bytes([record[14], record[15]]);
        expect_few_cells((rows as usize).saturating_mul(columns.into()))?;
    }
    Ok(())
}

fn filled_cells(workbook: &mut Sheets<Cursor<&[u8]>>, sheet: &str) -> Result<Cells> {
    let mut cells = Cells::new();
    match workbook {
        Sheets::Xlsx(workbook) => cells = cells_of_xlsx(workbook, sheet)?,
        Sheets::Xlsb(_) => return Err(InputError::NoTable { found: "a binary workbook" }),
        others => {
            let range = others.worksheet_range(sheet).map_err(InputError::damaged)?;
            let formulas = others.worksheet_formula(sheet).map_err(InputError::damaged)?;
            let (top, left) = range.start().unwrap_or_default();
            for (row, column, value) in range.cells() {
                let place = (top + row as u32, left + column as u32);
                cells.insert(place, text(value, formulas.get_value(place)));
                expect_few_cells(cells.len())?;
            }
        }
    }
    cells.retain(|_, text| !text.is_empty());
    Ok(cells)
}

/// Reads a sheet twice, for formulas and values: the places of the former hold for values too, of which the
/// reader skips those that it does not know, such as the error #SPILL!.
fn cells_of_xlsx(workbook: &mut Xlsx<Cursor<&[u8]>>, sheet: &str) -> Result<Cells> {
    let mut formulas = Vec::new();
    match workbook.worksheet_cells_reader(sheet) {
        Err(XlsxError::NotAWorksheet(_)) => return Ok(Cells::new()),
        Err(error) => return Err(InputError::damaged(error)),
        Ok(mut reader) => {
            while let Some(formula) = reader.next_formula().map_err(InputError::damaged)? {
                formulas.push(formula);
                expect_few_cells(formulas.len())?;
            }
        }
    }
    let mut reader = workbook.worksheet_cells_reader(sheet).map_err(InputError::damaged)?;
    let cells = formulas.into_iter().map(|formula| {
        let (value, style) = match reader.next_cell_with_style_id() {
            Ok(Some((cell, style))) => (cell.get_value().clone().into(), style),
            Ok(None) => (Data::Empty, 0),
            Err(XlsxError::CellError(error)) => (Data::String(error), 0),
            Err(error) => return Err(InputError::damaged(error)),
        };
        let format = reader.styles().get(style).and_then(|style| style.number_format.as_ref());
        let code = format.map_or("", |format| &format.format_code);
        // What the format writes behind the number: 0" mm", General\ \c\m.
        let plain = code.split(';').next().unwrap_or_default().replace(['"', '\\'], "");
        let behind = plain.trim_start_matches("General").rsplit(['0', '#', '?']).next().unwrap_or_default();
        let is_unit = code.contains(['"', '\\']) && Unit::parse(&normal(behind)).is_some();
        let shown = match value.as_f64() {
            Some(share) if code.contains('%') => format!("{}%", rounded(100.0 * share)),
            Some(number) if is_unit => format!("{number} {}", behind.trim()),
            _ => text(&value, Some(formula.get_value())),
        };
        Ok((formula.get_position(), shown))
    });
    cells.collect()
}

/// The text of a cell; that of its formula where no program has computed the value.
fn text(cell: &Data, formula: Option<&String>) -> String {
    let formula = formula.filter(|formula| !formula.is_empty());
    match cell {
        _ if cell.is_empty() || cell.get_string() == Some("") => {
            formula.map_or(String::new(), |formula| format!("={formula}"))
        }
        Data::DateTime(date) if date.is_datetime() => {
            let (year, month, day, ..) = date.to_ymd_hms_milli();
            format!("{year}-{month:02}-{day:02}")
        }
        other => other.to_string().trim().to_string(),
    }
}
