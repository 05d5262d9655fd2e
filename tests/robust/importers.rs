//! Text files of records with bytes changed, and bytes that are no record.

use proptest::prelude::*;
use rockfrag::keyword::Keyword;
use rockfrag::records::{AccelerationUnit, ColumnChoice, Format, Given, read};

const SEEDS: [&str; 8] = [
    "PEER NGA STRONG MOTION DATABASE RECORD\nEvent, 1/1/1979, Station, 140\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=     4, DT=   .0050 SEC\n  .1 -.2\n  .3  0.\n",
    "Origin Time       2011/03/11 14:46:00\nStation Code      MYG004\nSampling Freq(Hz) 100Hz\nScale Factor      3920(gal)/6182761\nMax. Acc. (gal)   0.01\nDir.              N-S\nMemo.\n    1     2    3\n",
    "EVENT_NAME: A\nSTATION_CODE: B\nSAMPLING_INTERVAL_S: 0.005\nNDATA: 3\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n0.1\n0.2\n-0.3\n",
    "Corrected accelerogram  (Format v01.20 with 13 text lines) Src: 052\n   3 acceleration pts, approx 1 secs, units=cm/sec2 (4), Format=(8f10.5)\n   .1  .2  .3\n",
    "2 CORRECTED ACCELEROGRAM\n*\n*\n*\n*\n*\n*\n*\n*\n*\n*\n   3 .1 .2 .3\n",
    "CORRECTED ACCELEROGRAM\nCHAN 1 90 DEG\n   3 POINTS OF ACCEL DATA EQUALLY SPACED AT .020 SEC, IN CM/SEC2. (8F10.3)\n   .1  .2  .3\n",
    "time,acc\n0.00,0.1\n0.01,-0.2\n0.02,1e-320\n",
    "# words\n1.0D+02 -.5-101 3E 02\n",
];

proptest! {
    #[test]
    fn any_text_is_a_record_or_an_error(
        seed in prop::sample::select(SEEDS.to_vec()),
        edits in prop::collection::vec((any::<prop::sample::Index>(), prop_oneof![
            any::<u8>().prop_map(|byte| vec![byte]),
            prop::sample::select(vec!["99999999999999999999", "(", "F0.0", "1e999", "-1", "\u{feff}", "é", "\0", "NPTS=", "\n\n", "4294967296F9999999999.1"])
                .prop_map(|text| text.as_bytes().to_vec()),
        ]), 0..6),
        format in prop::option::of(prop::sample::select(Format::ALL.to_vec())),
        unit in any::<bool>(), dt in any::<bool>(), all in any::<bool>(),
    ) {
        let mut bytes = seed.as_bytes().to_vec();
        for (place, insert) in edits {
            let at = place.index(bytes.len());
            let end = if insert.len() == 1 { at + 1 } else { at };
            bytes.splice(at..end, insert);
        }
        let given = Given {
            unit: unit.then_some(AccelerationUnit::G),
            dt_s: dt.then_some(0.01),
            column: all.then_some(ColumnChoice::All),
        };
        for motion in read(&bytes, format, &given).into_iter().flatten() {
            prop_assert!(motion.acceleration_m_s2.len() <= bytes.len());
            prop_assert!(motion.dt_s > 0.0 && motion.dt_s.is_finite());
        }
    }
}
