//! Bytes as a table, as a list of objects, and as the file of a recorded motion, in the format that the first byte names.
#![no_main]

use libfuzzer_sys::fuzz_target;
use rockfrag::inputs::records::{ReadOptions, RecordFormat, read_records};
use rockfrag::inputs::{Grid, objects};
use rockfrag_core::rocking::Record;
use rockfrag_core::units::Unit;
use strum::VariantArray;

fuzz_target!(|bytes: &[u8]| {
    let Some((&first, text)) = bytes.split_first() else { return };
    if let Ok(grid) = Grid::parse(text, None) {
        let columns = grid.headings.len();
        for (row, column) in (0..grid.lines.len()).flat_map(|row| (0..columns).map(move |at| (row, at))) {
            assert!(grid.number(row, column).is_ok_and(f64::is_finite) || grid.number(row, column).is_err());
        }
        let _ = objects::in_rows(&grid, &[]);
    }
    let formats = RecordFormat::VARIANTS.iter().copied().map(Some).chain([None]);
    let column = ["", "all", "2", "a"][usize::from(first >> 3 & 3)];
    let options = ReadOptions {
        format: formats.cycle().nth(usize::from(first & 7)).flatten(),
        dt_s: (first & 64 != 0).then_some(0.01),
        unit: Unit::parse("g").filter(|_| first & 32 != 0),
        column: Some(column.to_string()).filter(|column| !column.is_empty()),
    };
    for motion in read_records(text, &options).into_iter().flatten() {
        assert!(motion.acceleration_m_s2.len() <= text.len(), "samples that the file does not have");
        // What cannot be simulated is refused, and nothing else.
        let _ = Record::new(&motion.acceleration_m_s2, motion.dt_s);
    }
});
