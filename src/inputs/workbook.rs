//! Sheets of workbooks: .xlsx, .xls, .xlsb and .ods.

use std::io::Cursor;

use calamine::{Data, DataType, Reader, SheetVisible, open_workbook_auto_from_rs};

use super::error::InputError;

/// Whether bytes can be a workbook.
pub fn is_workbook(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\xd0\xcf\x11\xe0")
}

/// Reads the cells of the sheet with this name, or of the only visible one that has any, with the number of
/// the first row.
pub fn cells(bytes: &[u8], name: Option<&str>) -> Result<(usize, Vec<Vec<String>>), InputError> {
    let mut workbook = open_workbook_auto_from_rs(Cursor::new(bytes))?;
    let all = workbook.sheets_metadata().to_vec();
    let mut filled = Vec::new();
    for sheet in &all {
        let is_meant = match name {
            Some(name) => sheet.name == name,
            None => sheet.visible == SheetVisible::Visible,
        };
        let range = if is_meant { workbook.worksheet_range(&sheet.name)? } else { continue };
        if !range.is_empty() {
            filled.push((sheet.name.clone(), range));
        }
    }
    match &filled[..] {
        [(name, range)] => {
            let formulas = workbook.worksheet_formula(name)?;
            let (first, left) = range.start().unwrap_or_default();
            let rows = range.rows().zip(first..).map(|(row, at)| {
                let cells = row.iter().zip(left..);
                cells.map(|(cell, column)| text(cell, formulas.get_value((at, column)))).collect()
            });
            Ok((first as usize + 1, rows.collect()))
        }
        [] if name.is_none() => Ok((1, Vec::new())),
        [] => Err(InputError::Sheets { found: all.into_iter().map(|sheet| sheet.name).collect() }),
        _ => Err(InputError::Sheets { found: filled.into_iter().map(|(name, _)| name).collect() }),
    }
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
