//! Hazard in CSV files: a column for each peak that it knows, and one of annual rates, of probabilities in some years or of return periods.

use std::path::Path;

use anyhow::{Context, anyhow, bail};
use csv::StringRecord;

use crate::fragility::Peak;
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks};
use crate::table::schema::headings::Headings;
use crate::table::store::text_file::{self, CsvText};
use crate::units::G_M_S2;

/// What the file may call an intensity: the peak, and the size of its unit in m/s2 or m/s.
const INTENSITIES: [(&str, Peak, f64); 3] =
    [("pga_g", Peak::Pga, G_M_S2), ("pga_m_s2", Peak::Pga, 1.0), ("pgv_m_s", Peak::Pgv, 1.0)];
const EXCEEDANCE: &str = "annual_rate_of_exceedance";
const OCCURRENCE: &str = "annual_rate_of_occurrence";
/// `probability_of_exceedance_in_50_years`, or of any other time.
const PROBABILITY: (&str, &str) = ("probability_of_exceedance_in_", "_years");

/// `return_period`, or `return_period_` with one of these units.
const RETURN_PERIOD: (&str, [&str; 5]) = ("return_period", ["years", "year", "yrs", "yr", "a"]);

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

/// What a cell holds, as its column says.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Cell {
    /// A peak in a unit of this size, m/s2 or m/s.
    Peak(Peak, f64),
    /// An annual rate at which a peak is exceeded.
    Exceedance,
    /// The probability of that in so many years.
    ExceedanceIn(f64),
    /// The mean time between exceedances, years: one over their annual rate.
    ReturnPeriod,
    /// An annual rate at which a pair of peaks occurs.
    Occurrence,
}

impl Cell {
    /// What the column of this name holds.
    fn of(name: &str) -> Option<Cell> {
        let of_peak =
            |&(known, peak, unit): &(&str, Peak, f64)| (known == name).then_some(Cell::Peak(peak, unit));
        let years = || {
            let years: f64 = name.strip_prefix(PROBABILITY.0)?.strip_suffix(PROBABILITY.1)?.parse().ok()?;
            (years > 0.0 && years.is_finite()).then_some(Cell::ExceedanceIn(years))
        };
        let period = || {
            let unit = name.strip_prefix(RETURN_PERIOD.0)?;
            let is_known =
                unit.is_empty() || unit.strip_prefix('_').is_some_and(|unit| RETURN_PERIOD.1.contains(&unit));
            is_known.then_some(Cell::ReturnPeriod)
        };
        match name {
            EXCEEDANCE => Some(Cell::Exceedance),
            OCCURRENCE => Some(Cell::Occurrence),
            _ => INTENSITIES.iter().find_map(of_peak).or_else(years).or_else(period),
        }
    }

    /// The peak (m/s2 or m/s) or the annual rate that a text says; otherwise what was expected.
    fn read(self, text: &str) -> Result<f64, String> {
        let percent = text.strip_suffix('%');
        let parsed = percent.unwrap_or(text).trim_end().parse::<f64>().ok().filter(|value| value.is_finite());
        let Some(written) = parsed else {
            let comma = if text.contains(',') {
                "; with decimal commas, separate the cells by semicolons"
            } else {
                ""
            };
            return Err(format!("a finite number{comma}"));
        };
        let value = if percent.is_some() { written / 100.0 } else { written };
        match self {
            Cell::Peak(peak, unit) if percent.is_none() || (peak, unit) == (Peak::Pga, G_M_S2) => {
                let refusal = peak.bound().refusal(value * unit / peak.usual_unit().1);
                refusal.map_or(Ok(value * unit), Err)
            }
            Cell::Peak(..) => Err("a number; percent are of g, in a column pga_g".to_string()),
            Cell::Exceedance | Cell::Occurrence if percent.is_some() => Err(format!(
                "a rate a year, as 0.002; percent are probabilities: call the column {}50{}",
                PROBABILITY.0, PROBABILITY.1
            )),
            Cell::Exceedance | Cell::Occurrence if value < 0.0 => Err("0 or more".to_string()),
            Cell::Exceedance | Cell::Occurrence => Ok(value),
            Cell::ReturnPeriod if percent.is_none() && value > 0.0 => Ok(value.recip()),
            Cell::ReturnPeriod => Err("years above 0".to_string()),
            Cell::ExceedanceIn(years) if value > 0.0 && value < 1.0 => Ok(-libm::log1p(-value) / years),
            Cell::ExceedanceIn(_) if value > 1.0 => {
                Err("a probability above 0 and below 1; if it is in percent, write 10%".to_string())
            }
            Cell::ExceedanceIn(_) => Err("a probability above 0 and below 1".to_string()),
        }
    }
}

/// Reads a hazard: pga_g, pga_m_s2 or pgv_m_s with annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period; or a
/// PGA and a PGV with annual_rate_of_occurrence. The file may have other headings.
///
/// # Errors
/// If the file cannot be read, has other columns, or holds what is no hazard.
pub fn read(path: &Path, headings: &Headings) -> anyhow::Result<Hazard> {
    let read = || of(&text_file::text(path, MOST_MIB, "a hazard")?, headings);
    read().with_context(|| path.display().to_string())
}

fn of(text: &str, headings: &Headings) -> anyhow::Result<Hazard> {
    let is_known = |name: &str| {
        Cell::of(name).is_some() || headings.headings().any(|other| text_file::plain(other) == name)
    };
    let mut table = CsvText::new(text, is_known)?;
    table.rename(headings).map_err(|error| anyhow!(error))?;
    let named = table.headings.clone();
    // Peaks first, PGA before PGV.
    let mut columns: Vec<(usize, Cell)> =
        table.names.iter().enumerate().filter_map(|(at, name)| Some((at, Cell::of(name)?))).collect();
    // Tables of hazard often give both.
    let has_rate = columns.iter().any(|(_, cell)| matches!(cell, Cell::Exceedance | Cell::ExceedanceIn(_)));
    columns.retain(|(_, cell)| !(has_rate && *cell == Cell::ReturnPeriod));
    columns.sort_by_key(|(_, cell)| match cell {
        Cell::Peak(Peak::Pga, _) => 0,
        Cell::Peak(Peak::Pgv, _) => 1,
        _ => 2,
    });
    let cell = |(line, record): &(u64, StringRecord), (at, cell): (usize, Cell)| {
        let text = record.get(at).unwrap_or_default();
        // A heading may say that what is under it is in percent.
        let sign = if named[at].contains('%') && !text.ends_with('%') { "%" } else { "" };
        cell.read(&format!("{text}{sign}"))
            .map_err(|expected| anyhow!("line {line}, column '{}': '{text}'; expected {expected}", named[at]))
    };
    let rows = table.rows().map(|row| row.map_err(|error| anyhow!(error)));
    match columns[..] {
        [
            im @ (_, Cell::Peak(peak, _)),
            rate @ (_, Cell::Exceedance | Cell::ExceedanceIn(_) | Cell::ReturnPeriod),
        ] => {
            let point = |row| Ok((cell(&row, im)?, cell(&row, rate)?));
            let points = rows.map(|row| point(row?)).collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Hazard::Curve(peak, HazardCurve::new(points)?))
        }
        [
            pga @ (_, Cell::Peak(Peak::Pga, _)),
            pgv @ (_, Cell::Peak(Peak::Pgv, _)),
            rate @ (_, Cell::Occurrence),
        ] => {
            let bin = |row| {
                let (pga_m_s2, pgv_m_s) = (cell(&row, pga)?, cell(&row, pgv)?);
                Ok(PairOfPeaks { pga_m_s2, pgv_m_s, annual_rate: cell(&row, rate)? })
            };
            let bins = rows.map(|row| bin(row?)).collect::<anyhow::Result<Vec<_>>>()?;
            match bins.is_empty() {
                true => bail!("no rows; expected bins of PGA and PGV with annual rates"),
                false => Ok(Hazard::Joint(JointHazard { bins })),
            }
        }
        _ => bail!(
            "{}{}; expected pga_g, pga_m_s2 or pgv_m_s with {EXCEEDANCE}, {}50{} or {}, or a PGA and pgv_m_s with \
             {OCCURRENCE}; --columns pga_g=HEADING takes another heading",
            if named.is_empty() { "empty".to_string() } else { format!("columns {}", named.join(", ")) },
            without_unit(&named),
            PROBABILITY.0,
            PROBABILITY.1,
            RETURN_PERIOD.0
        ),
    }
}

/// The first heading of a peak that says no unit, in words; nothing where there is none.
fn without_unit(headings: &[String]) -> String {
    let peaks = [("pga", "g, as pga_g, or m/s2, as pga_m_s2"), ("pgv", "m/s, as pgv_m_s")];
    let lacks = |heading: &String| {
        let plain = text_file::plain(heading);
        let (_, units) = peaks.iter().find(|(peak, _)| plain.split('_').any(|word| word == *peak))?;
        Cell::of(&plain)
            .is_none()
            .then(|| format!("; column '{heading}' has no unit that is known: is it in {units}?"))
    };
    headings.iter().find_map(lacks).unwrap_or_default()
}
