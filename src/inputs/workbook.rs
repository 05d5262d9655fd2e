//! Sheets of workbooks: .xlsx, .xls and .ods.

use std::collections::{HashMap, HashSet};
use std::io::Cursor;

use calamine::open_workbook_auto_from_rs;
use calamine::{Cell, Data, DataType, Range, Reader, SheetVisible, Sheets, Xlsx, XlsxError};

use rockfrag_core::units::Unit;
use zip::ZipArchive;

use super::error::{InputError, Result, expect_few_cells};
use super::grid::Source;
use super::words::normal;
use crate::number::rounded;
use crate::source::guarded;

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\xd0\xcf\x11\xe0")
}

pub struct Sheet {
    /// Line of the first row, from 1.
    pub first_line: usize,
    pub rows: Range<String>,
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
    let mut filled = Vec::new();
    let is_visible = |sheet: &calamine::Sheet| sheet.visible == SheetVisible::Visible;
    for sheet in all.iter().filter(|sheet| name.map_or(is_visible(sheet), |name| sheet.name == name)) {
        let cells = filled_cells(&mut workbook, &sheet.name)?;
        if !cells.is_empty() {
            filled.push((sheet.name.clone(), cells));
        }
    }
    match &mut filled[..] {
        [(name, cells)] => {
            let mut cells = std::mem::take(cells);
            if let Sheets::Ods(_) = workbook {
                expect_no_merged_rows(bytes)?;
            }
            let repeated = repeat_merged(&mut workbook, name, &mut cells)?;
            let rows = in_range(cells)?;
            let (line, column) = rows.start().unwrap_or_default();
            let repeated = repeated.into_iter().map(|(row, at)| (row as usize + 1, (at - column) as usize));
            let source = if matches!(workbook, Sheets::Xlsx(_)) { Source::Xlsx } else { Source::Workbook };
            let (first_line, repeated, name) = (line as usize + 1, repeated.collect(), name.clone());
            Ok(Sheet { first_line, rows, repeated, source, name })
        }
        [] if name.is_none() => Err(InputError::unexpected("an empty workbook", "a table")),
        [] => Err(InputError::Sheets { found: all.into_iter().map(|sheet| sheet.name).collect() }),
        _ => Err(InputError::Sheets { found: filled.into_iter().map(|(name, _)| name).collect() }),
    }
}

/// Repeats merged cells; returns the places of those that are merged over rows.
fn repeat_merged(
    workbook: &mut Sheets<Cursor<&[u8]>>,
    sheet: &str,
    cells: &mut Vec<Cell<String>>,
) -> Result<Vec<(u32, u32)>> {
    let Sheets::Xlsx(workbook) = workbook else { return Ok(Vec::new()) };
    let last = cells.iter().fold((0, 0), |(row, column), cell| {
        let at = cell.get_position();
        (at.0.max(row), at.1.max(column))
    });
    let (mut repeated, known) = (Vec::new(), cells.len());
    let texts: HashMap<(u32, u32), usize> = (0..known).map(|at| (cells[at].get_position(), at)).collect();
    for merged in workbook.merge_cells_by_sheet_name(sheet).map_err(InputError::damaged)? {
        let Some(&from) = texts.get(&merged.start) else { continue };
        let text = cells[from].get_value().clone();
        for row in merged.start.0..=merged.end.0.min(last.0) {
            for column in merged.start.1..=merged.end.1.min(last.1) {
                if (row, column) != merged.start && !texts.contains_key(&(row, column)) {
                    cells.push(Cell::new((row, column), text.clone()));
                    expect_few_cells(cells.len())?;
                }
                repeated.extend((merged.end.0 > merged.start.0).then_some((row, column)));
            }
        }
    }
    Ok(repeated)
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

fn filled_cells(workbook: &mut Sheets<Cursor<&[u8]>>, sheet: &str) -> Result<Vec<Cell<String>>> {
    let mut cells = Vec::new();
    match workbook {
        Sheets::Xlsx(workbook) => cells = cells_of_xlsx(workbook, sheet)?,
        Sheets::Xlsb(_) => return Err(InputError::NoTable { found: "a binary workbook" }),
        others => {
            let range = others.worksheet_range(sheet).map_err(InputError::damaged)?;
            let formulas = others.worksheet_formula(sheet).map_err(InputError::damaged)?;
            let (top, left) = range.start().unwrap_or_default();
            for (row, column, value) in range.cells() {
                let place = (top + row as u32, left + column as u32);
                cells.push(Cell::new(place, text(value, formulas.get_value(place))));
                expect_few_cells(cells.len())?;
            }
        }
    }
    cells.retain(|cell| !cell.get_value().is_empty());
    Ok(cells)
}

/// Reads a sheet twice, for formulas and values: the places of the former hold for values too, of which the
/// reader skips those that it does not know, such as the error #SPILL!.
fn cells_of_xlsx(workbook: &mut Xlsx<Cursor<&[u8]>>, sheet: &str) -> Result<Vec<Cell<String>>> {
    let mut formulas = Vec::new();
    match workbook.worksheet_cells_reader(sheet) {
        Err(XlsxError::NotAWorksheet(_)) => return Ok(Vec::new()),
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
        Ok(Cell::new(formula.get_position(), shown))
    });
    cells.collect()
}

fn in_range(mut cells: Vec<Cell<String>>) -> Result<Range<String>> {
    cells.sort_by_key(Cell::get_position);
    let columns = || cells.iter().map(|cell| cell.get_position().1 as usize);
    let width = columns().max().unwrap_or_default() + 1 - columns().min().unwrap_or_default();
    let [first, last] =
        [cells.first(), cells.last()].map(|cell| cell.map_or(0, |cell| cell.get_position().0));
    expect_few_cells((last as usize + 1 - first as usize).saturating_mul(width))?;
    Ok(Range::from_sparse(cells))
}

/// The text of a cell; that of its formula where no program has computed the value.
fn text(cell: &Data, formula: Option<&String>) -> String {
    let formula = formula.filter(|formula| !formula.is_empty());
    match cell {
        _ if cell.is_empty() || cell.get_string() == Some("") => {
            formula.map_or(String::new(), |formula| format!("={formula}"))
        }
        Data::Bool(true) => "yes".to_string(),
        Data::Bool(false) => "no".to_string(),
        Data::DateTime(date) if date.is_datetime() => {
            let (year, month, day, ..) = date.to_ymd_hms_milli();
            format!("{year}-{month:02}-{day:02}")
        }
        other => other.to_string().trim().to_string(),
    }
}
