//! Sheets of workbooks: .xlsx, .xls, .xlsb and .ods.

use std::io::Cursor;

use calamine::open_workbook_auto_from_rs;
use calamine::{Cell, Data, DataType, Range, Reader, Sheet, SheetVisible, Sheets, Xlsx, XlsxError};

use super::decode::plain;
use super::error::{InputError, Result, expect_few_cells};
use crate::source::guarded;

pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\xd0\xcf\x11\xe0")
}

/// Reads the cells of the sheet with this name, or of the only visible one that has any.
pub fn cells(bytes: &[u8], name: Option<&str>) -> Result<Range<String>> {
    let damaged = || Err(InputError::damaged("its cells cannot be read"));
    expect_few_announced(bytes)?;
    guarded(|| read(bytes, name)).unwrap_or_else(damaged)
}

fn read(bytes: &[u8], name: Option<&str>) -> Result<Range<String>> {
    let mut workbook = open_workbook_auto_from_rs(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let all = workbook.sheets_metadata().to_vec();
    let mut filled = Vec::new();
    let is_visible = |sheet: &Sheet| sheet.visible == SheetVisible::Visible;
    for sheet in all.iter().filter(|sheet| name.map_or(is_visible(sheet), |name| sheet.name == name)) {
        let cells = filled_cells(&mut workbook, &sheet.name)?;
        if !cells.is_empty() {
            filled.push((sheet.name.clone(), cells));
        }
    }
    match &mut filled[..] {
        [(_, cells)] => in_range(std::mem::take(cells)),
        [] if name.is_none() => Ok(Range::empty()),
        [] => Err(InputError::Sheets { found: all.into_iter().map(|sheet| sheet.name).collect() }),
        _ => Err(InputError::Sheets { found: filled.into_iter().map(|(name, _)| name).collect() }),
    }
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

/// The cells of a sheet that have a text.
fn filled_cells(workbook: &mut Sheets<Cursor<&[u8]>>, sheet: &str) -> Result<Vec<Cell<String>>> {
    let mut cells = Vec::new();
    match workbook {
        Sheets::Xlsx(workbook) => cells = cells_of_xlsx(workbook, sheet)?,
        Sheets::Xlsb(workbook) => {
            let mut reader = workbook.worksheet_cells_reader(sheet).map_err(InputError::damaged)?;
            while let Some(cell) = reader.next_cell().map_err(InputError::damaged)? {
                cells.push(Cell::new(cell.get_position(), text(&cell.get_value().clone().into(), None)));
                expect_few_cells(cells.len())?;
            }
        }
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
        let value = match reader.next_cell() {
            Ok(cell) => cell.map_or(Data::Empty, |cell| cell.get_value().clone().into()),
            Err(XlsxError::CellError(error)) => Data::String(error),
            Err(error) => return Err(InputError::damaged(error)),
        };
        Ok(Cell::new(formula.get_position(), text(&value, Some(formula.get_value()))))
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
        other => other.to_string().trim().chars().map(plain).collect(),
    }
}
