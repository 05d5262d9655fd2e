//! How the files of people were read.

use super::{Document, Table};
use crate::chart::text::literal;
use crate::inputs::{ColumnReading, Reading};
use crate::number::{count, counted};

pub fn section(readings: &[&Reading]) -> Document {
    let tables = readings.iter().map(|reading| table(reading)).collect();
    Document { title: "How the files were read".to_string(), tables, ..Document::default() }
}

pub fn table(reading: &Reading) -> Table {
    let row = |ColumnReading { heading, meaning, unit, filled, first, last }: &ColumnReading| {
        let (meaning, unit) = (meaning.to_string(), unit.as_deref().unwrap_or_default());
        let [heading, meaning, unit, first, last] = [heading, &meaning, unit, first, last].map(literal);
        vec![heading, meaning, unit, count(*filled), first, last]
    };
    let others = reading.others.iter().map(|other| literal(other));
    let caption = [format!("{}: {}", literal(&reading.name()), counted(reading.rows, "row"))];
    let caption = caption.into_iter().chain(others).collect::<Vec<_>>().join("; ");
    let heads = ["column", "read as", "its unit", "cells filled", "first, in SI units", "last"];
    Table::new(&heads, reading.columns.iter().map(row).collect()).explained(&caption)
}
