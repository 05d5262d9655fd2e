//! File formats of records: from the bytes of a file to accelerations.

mod agencies;
mod csv;
mod header;

use std::borrow::Cow;

use rockfrag_core::motion::measures::peak;
use rockfrag_core::records::{HeaderPga, Origin, RecordedMotion};
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::units::Unit;
use strum::VariantArray;

use super::{InputError, Result, decode, words};

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<RecordFormat>)]
pub enum RecordFormat {
    Cosmos,
    Knet,
    Esm,
    #[serde(rename = "at2")]
    #[strum(serialize = "at2")]
    PeerAt2,
    Csv,
}

#[derive(Debug, Clone, Default, PartialEq)]
pub struct ReadOptions {
    /// None: detected from the content.
    pub format: Option<RecordFormat>,
    pub dt_s: Option<f64>,
    pub unit: Option<Unit>,
    /// Column of the acceleration in a CSV file: number from 1, heading, or `all` for a series over lines.
    pub column: Option<String>,
}

pub fn is_vertical(origin: &Origin) -> bool {
    origin.azimuth_deg.is_none() && origin.component.as_deref().is_some_and(words::is_vertical)
}

const HEADER: usize = 200;
/// Accepted relative difference of the peak in a header, which may be rounded or of uncorrected samples.
const SAME_PEAK: f64 = 0.05;

/// Reads the motions in the bytes of a file, and compares them with the peaks in their headers.
pub fn read_records(bytes: &[u8], options: &ReadOptions) -> Result<Vec<RecordedMotion>> {
    // A workbook.
    let text = if bytes.starts_with(b"PK") { Cow::Borrowed("") } else { decode(bytes)? };
    let lines: Vec<&str> = text.lines().map(|line| line.trim_end_matches(['\x1a', '\0'])).collect();
    let first = lines.first().map_or("", |line| line.trim_start());
    let recognises = |format: &RecordFormat| match format {
        RecordFormat::Cosmos => header::after(first, "(format v").is_some(),
        RecordFormat::Knet => first.starts_with("Origin Time"),
        RecordFormat::Esm => agencies::is_esm(&lines),
        RecordFormat::PeerAt2 => agencies::line_of_counts(&lines).is_some(),
        RecordFormat::Csv => true,
    };
    let recognised = RecordFormat::VARIANTS.iter().copied().find(recognises);
    let format = options.format.or(recognised).unwrap_or(RecordFormat::Csv);
    let mut motions = match format {
        RecordFormat::Cosmos => agencies::cosmos(&lines, options)?,
        RecordFormat::Knet => vec![agencies::knet(&lines, options)?],
        RecordFormat::Esm => vec![agencies::esm(&lines, options)?],
        RecordFormat::PeerAt2 => vec![agencies::at2(&lines, options)?],
        RecordFormat::Csv => csv::parse(bytes, options)?,
    };
    let in_borehole = ["borehole", "downhole"];
    let is_in_borehole = |line: &&str| in_borehole.iter().any(|word| header::after(line, word).is_some());
    let is_in_borehole = lines.iter().take(HEADER).any(is_in_borehole);
    for motion in &mut motions {
        motion.format = format.into();
        motion.is_in_borehole |= is_in_borehole;
        // Different peaks show a wrong unit or a wrong number of samples.
        let found_m_s2 = peak(&motion.acceleration_m_s2);
        if let Some(HeaderPga { m_s2, rounding_m_s2 }) = motion.header_pga
            && (found_m_s2 - m_s2).abs() > SAME_PEAK * m_s2 + rounding_m_s2
        {
            return Err(InputError::Peak { header_m_s2: m_s2, found_m_s2 });
        }
    }
    Ok(motions)
}
