//! A table as a workbook: numbers as numbers, names as texts, whatever they begin with.

use polars_core::prelude::{AnyValue, DataFrame};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook};

pub fn workbook(frame: &DataFrame) -> anyhow::Result<Vec<u8>> {
    let mut book = Workbook::new();
    // What is the same is the same whenever it is written.
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    book.set_properties(&DocProperties::new().set_creation_datetime(&created));
    let sheet = book.add_worksheet();
    sheet.set_name("rockfrag")?.set_freeze_panes(1, 1)?;
    let bold = Format::new().set_bold();
    for (at, column) in frame.columns().iter().enumerate() {
        let (at, name) = (at as u16, column.name().as_str());
        sheet.write_string_with_format(0, at, name, &bold)?;
        sheet.set_column_width(at, (name.chars().count() as f64 + 2.0).max(10.0))?;
        for row in 0..frame.height() {
            let line = row as u32 + 1;
            match column.get(row)? {
                AnyValue::Null => continue,
                AnyValue::Float64(number) => sheet.write_number(line, at, number)?,
                AnyValue::Int64(count) => sheet.write_number(line, at, count as f64)?,
                AnyValue::Boolean(flag) => sheet.write_boolean(line, at, flag)?,
                other => sheet.write_string(line, at, other.str_value())?,
            };
        }
    }
    Ok(book.save_to_buffer()?)
}
