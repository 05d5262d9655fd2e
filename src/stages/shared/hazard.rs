//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or the curves that OpenQuake exports.

use std::path::Path;
use std::str::FromStr;

use anyhow::{Context, bail};

use crate::fragility::Peak;
use crate::hazard::{Hazard, HazardCurve, JointHazard, PairOfPeaks};
use crate::sheet::{Heading, Sheet};
use crate::units::{CM_PER_M, G_M_S2, Quantity};

/// Another heading for a column: `pga_g=PGA`.
#[derive(Debug, Clone, PartialEq)]
pub struct Renamed {
    column: String,
    heading: String,
}

impl FromStr for Renamed {
    type Err = String;

    fn from_str(text: &str) -> Result<Renamed, String> {
        let pair = text.split_once('=').ok_or("expected COLUMN=HEADING, such as pga_g=PGA")?;
        Ok(Renamed { column: pair.0.trim().to_string(), heading: pair.1.trim().to_string() })
    }
}

/// Renames columns as the user requests.
pub fn rename(sheet: &mut Sheet, renamed: &[Renamed]) -> anyhow::Result<()> {
    for Renamed { column, heading } in renamed {
        let Some(found) = sheet.headings.iter_mut().find(|found| found.text == *heading) else {
            bail!("no heading '{heading}'; expected one of {}", headings(sheet));
        };
        *found = Heading::of(column);
    }
    Ok(())
}

/// The headings of a sheet, for messages.
pub fn headings(sheet: &Sheet) -> String {
    sheet.headings.iter().map(|heading| heading.text.as_str()).collect::<Vec<_>>().join(", ")
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    let words: Vec<&str> = heading.name.split('_').collect();
    let unit = heading.unit?;
    let names = |known: &[&str]| known.iter().any(|name| heading.name == *name || words.contains(name));
    match unit.quantity {
        Quantity::Acceleration if names(&["pga", "ag", "peak_ground_acceleration", "ground_motion"]) => {
            Some((Peak::Pga, unit.si))
        }
        Quantity::Velocity if names(&["pgv", "peak_ground_velocity"]) => Some((Peak::Pgv, unit.si)),
        _ => None,
    }
}

/// How a column expresses frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Frequency {
    /// Annual rate of exceedance.
    Rate,
    /// Probability of exceedance in so many years.
    ProbabilityIn(f64),
    /// Years between exceedances.
    ReturnPeriod,
    /// Annual rate of occurrence of a pair of peaks.
    Occurrence,
}

/// More motions a year than any site has that a hazard counts.
const MOST_FREQUENT: f64 = 1000.0;

impl Frequency {
    fn of(heading: &Heading, investigation_years: Option<f64>) -> Option<Frequency> {
        let name = heading.name.as_str();
        let has = |words: &[&str]| words.iter().any(|word| name.split('_').any(|other| other == *word));
        let years = || {
            heading
                .text
                .split(|sign: char| !sign.is_ascii_digit() && sign != '.')
                .find_map(|number| number.parse().ok())
        };
        if has(&["occurrence"]) {
            Some(Frequency::Occurrence)
        } else if name.contains("return_period") || has(&["tr", "rp"]) {
            Some(Frequency::ReturnPeriod)
        } else if has(&["probability", "poe", "aep"]) {
            let annual = || has(&["annual", "aep"]).then_some(1.0);
            years().or_else(annual).or(investigation_years).map(Frequency::ProbabilityIn)
        } else {
            has(&["rate", "frequency", "afe", "afoe", "mafe"]).then_some(Frequency::Rate)
        }
    }

    /// Converts a number to an annual rate; none if the motion is certain, whose rate is unknown.
    fn annual_rate(self, number: f64) -> Result<Option<f64>, &'static str> {
        match self {
            Frequency::Rate | Frequency::Occurrence if (0.0..=MOST_FREQUENT).contains(&number) => {
                Ok(Some(number))
            }
            Frequency::Rate | Frequency::Occurrence => Err("a rate a year from 0 to 1000"),
            Frequency::ReturnPeriod if number > 0.0 => Ok(Some(1.0 / number)),
            Frequency::ReturnPeriod => Err("years above 0"),
            Frequency::ProbabilityIn(years) if (0.0..1.0).contains(&number) => {
                Ok(Some(-(-number).ln_1p() / years))
            }
            Frequency::ProbabilityIn(_) if number == 1.0 => Ok(None),
            Frequency::ProbabilityIn(_) => Err("a probability from 0 to 1, or with a percent sign"),
        }
    }
}

/// Reads the hazard in a CSV file.
pub fn read(path: &Path, renamed: &[Renamed]) -> anyhow::Result<Hazard> {
    let read = || {
        let mut sheet = Sheet::parse(&std::fs::read(path)?)?;
        rename(&mut sheet, renamed)?;
        of(&sheet)
    };
    read().with_context(|| path.display().to_string())
}

fn of(sheet: &Sheet) -> anyhow::Result<Hazard> {
    let investigation_years = note(sheet, "investigation_time=").and_then(|years| years.parse().ok());
    if sheet.headings.iter().any(|heading| heading.text.starts_with("poe-")) {
        return openquake(sheet, investigation_years);
    }
    let columns = || sheet.headings.iter().enumerate();
    let peaks: Vec<_> = columns().filter_map(|(at, heading)| Some((at, peak(heading)?))).collect();
    let frequency =
        columns().find_map(|(at, heading)| Some((at, Frequency::of(heading, investigation_years)?)));
    let pga_and_pgv = || {
        let of = |peak| peaks.iter().find(|(_, (other, _))| *other == peak);
        of(Peak::Pga).zip(of(Peak::Pgv))
    };
    match (frequency, &peaks[..], pga_and_pgv()) {
        (Some(rate @ (_, Frequency::Occurrence)), _, Some((&pga, &pgv))) => joint(sheet, rate, pga, pgv),
        (Some(rate), &[intensity], _) if rate.1 != Frequency::Occurrence => {
            let points = (0..sheet.lines.len()).map(|row| {
                Ok((sheet.number(row, intensity.0)? * intensity.1.1, annual_rate(sheet, row, rate)?))
            });
            Ok(Hazard::Curve(intensity.1.0, curve(points.collect::<anyhow::Result<_>>()?)?))
        }
        _ => bail!(
            "headings {}; expected one of PGA (with g or m/s2) or PGV (with m/s) and one of annual_rate_of_exceedance, \
             probability_of_exceedance_in_50_years or return_period, or PGA and PGV with annual_rate_of_occurrence; --columns \
             pga_g=HEADING takes another one",
            headings(sheet)
        ),
    }
}

fn annual_rate(
    sheet: &Sheet,
    row: usize,
    (column, frequency): (usize, Frequency),
) -> anyhow::Result<Option<f64>> {
    let percent = sheet.headings.get(column).is_some_and(|heading| heading.text.contains('%'));
    let number = sheet.number(row, column)? * if percent { 0.01 } else { 1.0 };
    let is_rate = matches!(frequency, Frequency::Rate | Frequency::Occurrence);
    if is_rate && (percent || sheet.cell(row, column).contains('%')) {
        return Err(sheet
            .refusal(row, column, "a rate a year, such as 0.002; percent are probabilities")
            .into());
    }
    frequency.annual_rate(number).map_err(|expected| sheet.refusal(row, column, expected).into())
}

/// Tables often begin with motions that are certain to come, and end with some that never do: these tell
/// nothing.
fn curve(mut points: Vec<(f64, Option<f64>)>) -> anyhow::Result<HazardCurve> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let known = points.into_iter().filter_map(|(intensity, rate)| Some((intensity, rate?)));
    Ok(HazardCurve::new(known.filter(|(intensity, rate)| *intensity > 0.0 && *rate > 0.0).collect())?)
}

fn joint(
    sheet: &Sheet,
    rate: (usize, Frequency),
    (pga, (_, pga_unit)): (usize, (Peak, f64)),
    (pgv, (_, pgv_unit)): (usize, (Peak, f64)),
) -> anyhow::Result<Hazard> {
    let bin = |row| {
        Ok(PairOfPeaks {
            pga_m_s2: sheet.number(row, pga)? * pga_unit,
            pgv_m_s: sheet.number(row, pgv)? * pgv_unit,
            annual_rate: annual_rate(sheet, row, rate)?.unwrap_or_default(),
        })
    };
    let bins = (0..sheet.lines.len()).map(bin).collect::<anyhow::Result<Vec<_>>>()?;
    match bins.is_empty() {
        true => bail!("no rows; expected bins of PGA and PGV with annual rates"),
        false => Ok(Hazard::Joint(JointHazard { bins })),
    }
}

/// The curve of one site as OpenQuake exports it: a column for each intensity, in g or cm/s, with the
/// probability of exceedance.
fn openquake(sheet: &Sheet, investigation_years: Option<f64>) -> anyhow::Result<Hazard> {
    let (peak, unit) = match note(sheet, "imt=").unwrap_or("PGA").trim_matches('\'') {
        "PGA" => (Peak::Pga, G_M_S2),
        "PGV" => (Peak::Pgv, 1.0 / CM_PER_M),
        other => bail!("a curve of {other}; expected PGA or PGV"),
    };
    let Some(years) = investigation_years else {
        bail!("no investigation_time in the header of OpenQuake; expected the file as it was exported");
    };
    if sheet.lines.len() != 1 {
        bail!("curves of {} sites; keep the row of one", sheet.lines.len());
    }
    let levels = sheet
        .headings
        .iter()
        .enumerate()
        .filter_map(|(at, heading)| Some((at, heading.text.strip_prefix("poe-")?)));
    let points = levels.map(|(at, level)| {
        let intensity: f64 = level.parse().with_context(|| format!("heading poe-{level}"))?;
        Ok((intensity * unit, annual_rate(sheet, 0, (at, Frequency::ProbabilityIn(years)))?))
    });
    Ok(Hazard::Curve(peak, curve(points.collect::<anyhow::Result<_>>()?)?))
}

/// What stands behind a key in the notes of a file.
fn note<'a>(sheet: &'a Sheet, key: &str) -> Option<&'a str> {
    let behind = |text: &'a String| text.split_once(key).map(|(_, rest)| rest);
    let rest = sheet.notes.iter().find_map(behind)?;
    rest.split([',', '"', ' ']).next()
}
