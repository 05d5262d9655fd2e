//! Hazard in CSV files: a column for each peak that it knows, and one of annual rates. Lines that begin with # are words.

use std::path::Path;

use anyhow::{Context, anyhow, bail};

use crate::fragility::Peak;
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks};
use crate::table::store::text_file;
use crate::units::G_M_S2;

/// What the file may call an intensity: the peak, and the size of its unit in m/s2 or m/s.
const INTENSITIES: [(&str, Peak, f64); 3] =
    [("pga_g", Peak::Pga, G_M_S2), ("pga_m_s2", Peak::Pga, 1.0), ("pgv_m_s", Peak::Pgv, 1.0)];
const EXCEEDANCE: &str = "annual_rate_of_exceedance";
const OCCURRENCE: &str = "annual_rate_of_occurrence";

/// The largest file: a joint hazard of two million pairs.
const MOST_MIB: u64 = 64;

/// The hazard in a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Hazard {
    /// Of one peak: annual rates at which it is exceeded.
    Curve(Peak, HazardCurve),
    /// Of both peaks: annual rates at which pairs of them occur.
    Joint(JointHazard),
}

/// Reads a hazard: pga_g, pga_m_s2 or pgv_m_s with annual_rate_of_exceedance; or a PGA and a PGV with
/// annual_rate_of_occurrence.
///
/// # Errors
/// If the file cannot be read, has other columns, or holds what is no hazard.
pub fn read(path: &Path) -> anyhow::Result<Hazard> {
    let read = || of(&text_file::text(path, MOST_MIB, "a hazard")?);
    read().with_context(|| path.display().to_string())
}

fn of(text: &str) -> anyhow::Result<Hazard> {
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).trim(csv::Trim::All).from_reader(text.as_bytes());
    let names = reader.headers()?.clone();
    let place = |wanted: &str| names.iter().position(|name| name == wanted);
    let intensities: Vec<(Peak, f64, usize)> =
        INTENSITIES.iter().filter_map(|&(name, peak, unit)| Some((peak, unit, place(name)?))).collect();
    let records = reader.into_records();
    match (&intensities[..], place(EXCEEDANCE), place(OCCURRENCE)) {
        (&[(peak, unit, at)], Some(rate), None) => {
            let point = |record: csv::StringRecord| {
                Ok((unit * number(&record, &names, at)?, number(&record, &names, rate)?))
            };
            let points = records.map(|record| point(record?)).collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Hazard::Curve(peak, HazardCurve::new(points)?))
        }
        (&[(Peak::Pga, unit_a, a), (Peak::Pgv, unit_v, v)], None, Some(rate)) => {
            let bin = |record: csv::StringRecord| {
                let at_least_0 = |at| match number(&record, &names, at)? {
                    value if value >= 0.0 => Ok(value),
                    value => Err(bad(&record, &names, at, &value.to_string(), "0 or more")),
                };
                Ok(PairOfPeaks {
                    pga_m_s2: unit_a * at_least_0(a)?,
                    pgv_m_s: unit_v * at_least_0(v)?,
                    annual_rate: at_least_0(rate)?,
                })
            };
            let bins = records.map(|record| bin(record?)).collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Hazard::Joint(JointHazard { bins }))
        }
        _ => bail!(
            "columns {}; expected pga_g, pga_m_s2 or pgv_m_s with {EXCEEDANCE}, or a PGA and pgv_m_s with {OCCURRENCE}",
            names.iter().collect::<Vec<_>>().join(", ")
        ),
    }
}

fn number(record: &csv::StringRecord, names: &csv::StringRecord, at: usize) -> anyhow::Result<f64> {
    let text = record.get(at).unwrap_or_default();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(bad(record, names, at, text, "a finite number")),
    }
}

fn bad(
    record: &csv::StringRecord,
    names: &csv::StringRecord,
    at: usize,
    text: &str,
    expected: &str,
) -> anyhow::Error {
    let line = record.position().map_or(0, csv::Position::line);
    anyhow!("line {line}, column '{}': '{text}'; expected {expected}", names.get(at).unwrap_or_default())
}
