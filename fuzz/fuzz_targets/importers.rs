//! Bytes as the text file of a recorded motion, in the format that the first byte names.
#![no_main]

use libfuzzer_sys::fuzz_target;
use rockfrag::keyword::Keyword;
use rockfrag::records::{AccelerationUnit, ColumnChoice, Format, Given, read};
use rockfrag::rocking::Record;

fuzz_target!(|bytes: &[u8]| {
    let Some((&first, text)) = bytes.split_first() else { return };
    let formats = Format::ALL.iter().copied().map(Some).chain([None]);
    let format = formats.cycle().nth(usize::from(first & 7)).flatten();
    let column = match first >> 3 & 3 {
        0 => None,
        1 => Some(ColumnChoice::All),
        _ => Some(ColumnChoice::Number(2)),
    };
    let given = Given {
        unit: (first & 32 != 0).then_some(AccelerationUnit::G),
        dt_s: (first & 64 != 0).then_some(0.01),
        column,
    };
    for motion in read(text, format, &given).into_iter().flatten() {
        assert!(motion.acceleration_m_s2.len() <= text.len(), "samples that the file does not have");
        // What cannot be simulated is refused, and nothing else.
        let _ = Record::new(&motion.acceleration_m_s2, motion.dt_s);
        if let Some(pga) = motion.header_pga {
            let _ = pga.check(&motion.acceleration_m_s2, 0.01);
        }
    }
});
