//! Hazard in CSV files: a column for each peak that it knows, and one of annual rates, of probabilities in some years or of return periods.

use std::path::Path;

use anyhow::{Context, anyhow, bail};
use csv::StringRecord;

use crate::fragility::Peak;
use crate::hazard::{HazardCurve, HazardError, JointHazard, PairOfPeaks};
use crate::table::schema::headings::{Headings, NO_SPECTRAL, is_spectral};
use crate::table::store::text_file::{self, CsvText};
use crate::units::G_M_S2;

/// What the file may call an intensity: the peak, and the size of its unit in m/s2 or m/s.
const INTENSITIES: [(&str, Peak, f64); 3] =
    [("pga_g", Peak::Pga, G_M_S2), ("pga_m_s2", Peak::Pga, 1.0), ("pgv_m_s", Peak::Pgv, 1.0)];
const EXCEEDANCE: &str = "annual_rate_of_exceedance";
const OCCURRENCE: &str = "annual_rate_of_occurrence";
/// What else tables of hazard call annual rates of exceedance, after a `mean_`, if any, and before a unit,
const RATES: [&str; 7] = [
    EXCEEDANCE,
    "annual_frequency_of_exceedance",
    "annual_exceedance_rate",
    "annual_exceedance_frequency",
    "rate_of_exceedance",
    "frequency_of_exceedance",
    "afe",
];
/// one of these.
const PER_YEAR: [&str; 5] = ["_1_yr", "_1_year", "_1_a", "_per_year", "_per_yr"];
/// `probability_of_exceedance_in_50_years`, or of any other time, and other words for it.
const PROBABILITY: (&str, &str) = ("probability_of_exceedance_in_", "_years");
const PROBABILITIES: [&str; 3] = [PROBABILITY.0, "poe_in_", "poe_"];
/// Probabilities in one year.
const IN_ONE_YEAR: [&str; 3] = ["annual_probability_of_exceedance", "annual_exceedance_probability", "aep"];

/// `return_period`, or `return_period_` with one of these units.
const RETURN_PERIOD: &str = "return_period";
const YEARS: [&str; 6] = ["years", "year", "yrs", "yr", "y", "a"];

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
pub enum Cell {
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
    pub fn of(name: &str) -> Option<Cell> {
        let of_peak =
            |&(known, peak, unit): &(&str, Peak, f64)| (known == name).then_some(Cell::Peak(peak, unit));
        let years = || {
            let time = PROBABILITIES.iter().find_map(|begin| name.strip_prefix(begin))?;
            let number = YEARS.iter().find_map(|unit| time.strip_suffix(unit))?;
            let years: f64 = number.trim_end_matches('_').parse().ok()?;
            (years > 0.0 && years.is_finite()).then_some(Cell::ExceedanceIn(years))
        };
        let period = || {
            let unit = name.strip_prefix(RETURN_PERIOD)?;
            let is_known =
                unit.is_empty() || unit.strip_prefix('_').is_some_and(|unit| YEARS.contains(&unit));
            is_known.then_some(Cell::ReturnPeriod)
        };
        let rate = || {
            let name = name.strip_prefix("mean_").unwrap_or(name);
            let name = PER_YEAR.iter().find_map(|unit| name.strip_suffix(unit)).unwrap_or(name);
            let in_one_year = IN_ONE_YEAR.contains(&name).then_some(Cell::ExceedanceIn(1.0));
            RATES.contains(&name).then_some(Cell::Exceedance).or(in_one_year)
        };
        match name {
            OCCURRENCE => Some(Cell::Occurrence),
            _ => INTENSITIES.iter().find_map(of_peak).or_else(years).or_else(period).or_else(rate),
        }
    }

    /// The peak (m/s2 or m/s) or the annual rate that a text says; otherwise what was expected.
    pub fn read(self, text: &str) -> Result<f64, String> {
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
            // What is certain has no rate that is known.
            Cell::ExceedanceIn(_) if value == 1.0 => Ok(f64::INFINITY),
            Cell::ExceedanceIn(years) if (0.0..1.0).contains(&value) => Ok(-libm::log1p(-value) / years),
            Cell::ExceedanceIn(_) if value > 1.0 => {
                Err("a probability from 0 to 1; if it is in percent, write 10%".to_string())
            }
            Cell::ExceedanceIn(_) => Err("a probability from 0 to 1".to_string()),
        }
    }
}

/// Reads a hazard: pga_g, pga_m_s2 or pgv_m_s with annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period; or a
/// PGA and a PGV with annual_rate_of_occurrence. The file may have other headings.
///
/// # Errors
/// If the file cannot be read, has other columns, or holds what is no hazard.
pub fn read(path: &Path, headings: &Headings) -> anyhow::Result<Hazard> {
    read_and_tell(path, headings, |_| ())
}

/// The same, and tells which rows were left out.
///
/// # Errors
/// As [`read`].
pub fn read_and_tell(path: &Path, headings: &Headings, note: impl Fn(&str)) -> anyhow::Result<Hazard> {
    let note = |left_out: &str| note(&format!("{}: {left_out}", path.display()));
    let read = || of(&text_file::text(path, MOST_MIB, "a hazard")?, headings, &note);
    read().with_context(|| path.display().to_string())
}

/// A row of a curve.
struct Point {
    line: u64,
    /// m/s2 or m/s.
    intensity: f64,
    annual_rate: f64,
    /// As it stands in the file.
    words: String,
}

impl Point {
    fn is_usual(&self) -> bool {
        self.intensity > 0.0 && self.annual_rate > 0.0 && self.annual_rate.is_finite()
    }

    fn refusal(&self, expected: &str) -> anyhow::Error {
        anyhow!("line {}: {}; expected {expected}", self.line, self.words)
    }
}

/// The curve of these rows. Tables often begin with motions that are certain to come and end with some that never do: such rows
/// are left out, with a note.
fn curve(mut points: Vec<Point>, note: &impl Fn(&str)) -> anyhow::Result<HazardCurve> {
    let usual = || points.iter().filter(|point| point.is_usual()).map(|point| point.intensity);
    let (least, largest) = (usual().fold(f64::INFINITY, f64::min), usual().fold(0.0, f64::max));
    let lines = |points: &mut dyn Iterator<Item = &Point>| {
        let lines: Vec<String> = points.map(|point| point.line.to_string()).collect();
        (!lines.is_empty()).then(|| lines.join(", "))
    };
    let is_weak = |point: &&Point| !point.is_usual() && point.intensity < least;
    let is_strong =
        |point: &&Point| !point.is_usual() && point.intensity > largest && point.annual_rate == 0.0;
    if let Some(point) = points.iter().find(|point| !point.is_usual() && !is_weak(point) && !is_strong(point))
    {
        let expected = match point.annual_rate {
            0.0 => "a rate above 0, since stronger motions have one: delete the row",
            _ => "a probability below 1, since weaker motions have one: delete the row",
        };
        return Err(point.refusal(expected));
    }
    for (lines, what) in [
        (lines(&mut points.iter().filter(is_weak)), "weak"),
        (lines(&mut points.iter().filter(is_strong)), "strong"),
    ] {
        if let Some(lines) = lines {
            note(&format!("left out, as too {what} to have a rate: line {lines}"));
        }
    }
    points.retain(Point::is_usual);
    let values = points.iter().map(|point| (point.intensity, point.annual_rate)).collect();
    HazardCurve::new(values).map_err(|error| match error {
        HazardError::NotPositive { point, .. } => points[point].refusal("both above 0"),
        HazardError::Unordered { point } => points[point].refusal(&format!(
            "a larger intensity than before, and no larger rate: before it stand {}",
            points[point - 1].words
        )),
        error => error.into(),
    })
}

fn of(text: &str, headings: &Headings, note: &impl Fn(&str)) -> anyhow::Result<Hazard> {
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
            let words = |record: &StringRecord, (at, _): (usize, Cell)| {
                format!("{} {}", named[at], record.get(at).unwrap_or_default())
            };
            let point = |row: (u64, StringRecord)| {
                let (intensity, annual_rate) = (cell(&row, im)?, cell(&row, rate)?);
                let (line, record) = row;
                let words = format!("{} with {}", words(&record, im), words(&record, rate));
                Ok(Point { line, intensity, annual_rate, words })
            };
            let points = rows.map(|row| point(row?)).collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Hazard::Curve(peak, curve(points, note)?))
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
            "{}{}; expected pga_g, pga_m_s2 or pgv_m_s with {EXCEEDANCE}, {}50{} or {RETURN_PERIOD}, or a PGA and \
             pgv_m_s with {OCCURRENCE}; {}",
            if named.is_empty() { "empty".to_string() } else { format!("columns {}", named.join(", ")) },
            spectral(&named).unwrap_or_else(|| without_unit(&named)),
            PROBABILITY.0,
            PROBABILITY.1,
            hint(&columns, &named),
        ),
    }
}

/// That a heading is of a spectral acceleration, if one is.
fn spectral(headings: &[String]) -> Option<String> {
    let heading = headings.iter().find(|heading| is_spectral(heading))?;
    Some(format!("; '{heading}' is a spectral acceleration, and {NO_SPECTRAL}"))
}

/// How to name the columns that are missing, by the headings that nothing is known of.
fn hint(columns: &[(usize, Cell)], headings: &[String]) -> String {
    let is_peak = |(_, cell): &(usize, Cell)| matches!(cell, Cell::Peak(..));
    let missing = [("pga_g", columns.iter().any(is_peak)), (EXCEEDANCE, !columns.iter().all(is_peak))];
    let known = |at: &usize| columns.iter().any(|(other, _)| other == at);
    let unknown: Vec<&String> = (0..headings.len())
        .filter(|at| !known(at))
        .map(|at| &headings[at])
        .filter(|name| !is_spectral(name))
        .collect();
    let missing = missing.iter().filter(|(_, is_there)| !is_there).map(|(name, _)| *name);
    let pairs: Vec<String> = match unknown[..] {
        // Of one column that is missing the one heading that is left may be the name.
        [heading] => missing.map(|name| format!("{name}={heading}")).collect(),
        _ => missing.map(|name| format!("{name}=HEADING")).collect(),
    };
    match pairs.join(",") {
        pairs if pairs.is_empty() => "keep one column of each".to_string(),
        pairs if pairs.contains(' ') => format!("--columns \"{pairs}\" takes another heading"),
        pairs => format!("--columns {pairs} takes another heading"),
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
