//! What OpenQuake exports for one site: a curve with a column for each level, and ground-motion fields.

use super::columns::{Frequency, Intensity, Statistic};
use super::{Curve, curve, pairs};
use crate::fragility::Peak;
use crate::hazard::PairOfPeaks;
use crate::inputs::{Grid, InputError};
use crate::motion::Peaks;
use crate::units::{CM_PER_M, G_M_S2};

/// Reads ground-motion fields: PGA in g and PGV in cm/s of each event.
pub fn fields(grid: &Grid, effective_years: Option<f64>) -> Result<Vec<PairOfPeaks>, InputError> {
    let Some(years) = effective_years else {
        return Err(InputError::Missing {
            found: "ground-motion fields of OpenQuake".to_string(),
            expected: "--effective-years: investigation time x stochastic event sets x branches",
        });
    };
    let column = |name: &str| grid.headings.iter().position(|heading| heading.text == name);
    let Some((pga, pgv)) = column("gmv_PGA").zip(column("gmv_PGV")) else {
        return Err(InputError::Missing { found: grid.found(), expected: "gmv_PGA and gmv_PGV" });
    };
    pairs(grid, |row| {
        let (pga_m_s2, pgv_m_s) = (grid.number(row, pga)? * G_M_S2, grid.number(row, pgv)? / CM_PER_M);
        Ok(PairOfPeaks { peaks: Peaks { pga_m_s2, pgv_m_s }, annual_rate: 1.0 / years, mw: None })
    })
}

/// Reads a curve: the probability of exceedance of each level, in g or cm/s.
pub fn probabilities(grid: &Grid, file: &str) -> Result<Curve, InputError> {
    let exported = |found: &str| InputError::Missing {
        found: format!("no {found} in the header of OpenQuake"),
        expected: "the file as it was exported",
    };
    let name = note(grid, "imt=").ok_or_else(|| exported("imt"))?;
    let (intensity, unit) = match name {
        "PGA" => (Intensity::Peak(Peak::Pga), G_M_S2),
        "PGV" => (Intensity::Peak(Peak::Pgv), 1.0 / CM_PER_M),
        "SA(1.0)" => (Intensity::Spectral, G_M_S2),
        _ => {
            let found = format!("a curve of {name}");
            return Err(InputError::Missing { found, expected: "PGA, PGV or SA(1.0)" });
        }
    };
    let years = investigation_years(grid).ok_or_else(|| exported("investigation_time"))?;
    let statistic = statistic(grid)?;
    if grid.lines.len() != 1 {
        let found = format!("curves of {} sites", grid.lines.len());
        return Err(InputError::Missing { found, expected: "the row of one" });
    }
    let mut points = Vec::new();
    for (at, heading) in grid.headings.iter().enumerate() {
        let Some(level) = heading.text.strip_prefix("poe-") else { continue };
        let level: f64 = level.parse().map_err(|_| InputError::Missing {
            found: format!("heading {}", heading.text),
            expected: "poe- and a level",
        })?;
        points.push((level * unit, Frequency::ProbabilityIn(years).annual_rate(grid, 0, at)?));
    }
    Ok(Curve { intensity, statistic, curve: curve(points)?, file: file.to_string() })
}

/// Which of several curves it is. What is not known to be the mean is not taken for it.
fn statistic(grid: &Grid) -> Result<Statistic, InputError> {
    // Before version 3, the kind was the first word of the header.
    let first = || grid.notes.first()?.trim_start_matches(['#', ' ']).split([',', ' ']).next();
    let kind = note(grid, "kind=").or_else(first).unwrap_or_default().to_lowercase();
    match kind.as_str() {
        "mean" | "hcurve-mean" => Ok(Statistic::Mean),
        "quantile-0.16" => Ok(Statistic::Low),
        "quantile-0.84" => Ok(Statistic::High),
        "quantile-0.5" | "quantile-0.50" | "median" => Ok(Statistic::Median),
        _ => Err(InputError::Missing {
            found: format!("a curve of kind '{kind}'"),
            expected: "the mean, and quantiles 0.16 and 0.84 beside it",
        }),
    }
}

/// The years that probabilities are for, by the header.
pub fn investigation_years(grid: &Grid) -> Option<f64> {
    note(grid, "investigation_time=")?.parse().ok()
}

/// What stands behind a key in the header, without quotation marks.
fn note<'a>(grid: &'a Grid, key: &str) -> Option<&'a str> {
    let rest = grid.notes.iter().find_map(|text| text.split_once(key).map(|(_, rest)| rest))?;
    rest.trim_start_matches(['\'', '"']).split([',', '"', '\'', ' ']).next()
}
