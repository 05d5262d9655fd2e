//! Hazard in CSV files: a column for each peak that it knows, and one of annual rates. Lines that begin with # are words.

use std::path::Path;

use anyhow::{Context, anyhow, bail};
use csv::StringRecord;

use crate::fragility::Peak;
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks};
use crate::table::store::text_file::{self, CsvText};
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
    let table = CsvText::new(text)?;
    let names = table.names.clone();
    let place = |wanted: &str| names.iter().position(|name| name == wanted);
    let intensities: Vec<(Peak, f64, usize)> =
        INTENSITIES.iter().filter_map(|&(name, peak, unit)| Some((peak, unit, place(name)?))).collect();
    let number = |(line, record): &(u64, StringRecord), at: usize, bound: Option<(Peak, f64)>| {
        let (text, name) = (record.get(at).unwrap_or_default(), &names[at]);
        let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
        let refusal = match (value, bound) {
            (None, _) => Some("a finite number".to_string()),
            (Some(value), Some((peak, unit))) => peak.bound().refusal(value * unit / peak.usual_unit().1),
            (Some(value), None) => (value < 0.0).then(|| "0 or more".to_string()),
        };
        match (value, refusal) {
            (Some(value), None) => Ok(value * bound.map_or(1.0, |(_, unit)| unit)),
            (_, refusal) => {
                let expected = refusal.unwrap_or_default();
                Err(anyhow!("line {line}, column '{name}': '{text}'; expected {expected}"))
            }
        }
    };
    match (&intensities[..], place(EXCEEDANCE), place(OCCURRENCE)) {
        (&[(peak, unit, at)], Some(rate), None) => {
            let point = |row| Ok((number(&row, at, Some((peak, unit)))?, number(&row, rate, None)?));
            let points = table.rows().map(|row| point(row?)).collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Hazard::Curve(peak, HazardCurve::new(points)?))
        }
        (&[(Peak::Pga, unit_a, a), (Peak::Pgv, unit_v, v)], None, Some(rate)) => {
            let bin = |row| {
                Ok(PairOfPeaks {
                    pga_m_s2: number(&row, a, Some((Peak::Pga, unit_a)))?,
                    pgv_m_s: number(&row, v, Some((Peak::Pgv, unit_v)))?,
                    annual_rate: number(&row, rate, None)?,
                })
            };
            let bins = table.rows().map(|row| bin(row?)).collect::<anyhow::Result<Vec<_>>>()?;
            match bins.is_empty() {
                true => bail!("no rows; expected bins of PGA and PGV with annual rates"),
                false => Ok(Hazard::Joint(JointHazard { bins })),
            }
        }
        _ => bail!(
            "columns {}; expected pga_g, pga_m_s2 or pgv_m_s with {EXCEEDANCE}, or a PGA and pgv_m_s with {OCCURRENCE}",
            names.join(", ")
        ),
    }
}
