//! What a file of a hazard holds: curves or joint rates in columns, and what OpenQuake exports.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, bail};

use super::columns::{Content, Frequency, Intensity, Statistic, content, headings};
use crate::fragility::Peak;
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks};
use crate::sheet::{Heading, Sheet};
use crate::units::{CM_PER_M, G_M_S2};

/// A curve, and the file that it is from.
pub struct Found {
    pub intensity: Intensity,
    pub statistic: Statistic,
    pub curve: HazardCurve,
    pub file: String,
}

/// What a file holds.
pub enum Contents {
    /// Curves, and the headings of columns that say nothing of them.
    Curves(Vec<Found>, Vec<String>),
    Joint(JointHazard),
}

/// Reads what a file holds.
pub fn contents(sheet: &Sheet, path: &Path, effective_years: Option<f64>) -> anyhow::Result<Contents> {
    let file = path.display().to_string();
    let years = note(sheet, "investigation_time=").and_then(|years| years.parse().ok());
    let starts = |start: &str| sheet.headings.iter().any(|heading| heading.text.starts_with(start));
    one_site(sheet)?;
    if starts("gmv_") {
        return fields(sheet, effective_years).map(Contents::Joint);
    }
    if effective_years.is_some() {
        bail!("--effective-years is for ground-motion fields of OpenQuake (gmv_PGA, gmv_PGV)");
    }
    if starts("poe-") {
        return openquake(sheet, years, file).map(|found| Contents::Curves(vec![found], Vec::new()));
    }
    let columns: Vec<(usize, Content, Statistic)> = sheet
        .headings
        .iter()
        .enumerate()
        .map(|(at, heading)| {
            let (content, statistic) = content(heading, years);
            (at, content, statistic)
        })
        .collect();
    let has = |wanted: fn(&Content) -> bool| columns.iter().any(|(_, content, _)| wanted(content));
    let has_frequency = has(|content| matches!(content, Content::Frequency(_)));
    let is_uniform = sheet.headings.iter().any(|heading| heading.text.contains('~'));
    if is_uniform || (has(|content| *content == Content::Period) && !has_frequency) {
        bail!(
            "a uniform hazard spectrum: one rate, many periods; expected a hazard curve: PGA, best with SA(1.0 s), at \
             several rates"
        );
    }
    let intensities = columns.iter().filter_map(|&(at, content, statistic)| match content {
        Content::Intensity(intensity, unit) => Some((at, intensity, unit, statistic)),
        _ => None,
    });
    let intensities: Vec<(usize, Intensity, f64, Statistic)> = intensities.collect();
    let frequencies = columns.iter().filter_map(|&(at, content, statistic)| match content {
        Content::Frequency(frequency) => Some(((at, frequency), statistic)),
        _ => None,
    });
    let mut frequencies: Vec<((usize, Frequency), Statistic)> = frequencies.collect();
    if let Some((rate, _)) = frequencies.iter().find(|((_, of), _)| *of == Frequency::Occurrence) {
        let mw = columns.iter().find(|(_, content, _)| *content == Content::Magnitude).map(|(at, ..)| *at);
        return joint(sheet, *rate, &intensities, mw).map(Contents::Joint);
    }
    one_frequency(sheet, &mut frequencies)?;
    if intensities.is_empty() || frequencies.is_empty() {
        let other = if has(|content| *content == Content::OtherSpectral) {
            "; of spectral accelerations only that at 1 s is of use"
        } else {
            ""
        };
        bail!(
            "{}; expected PGA (with g or m/s2), PGV (with m/s) or SA(1.0 s) (with g), and \
             annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period{other}; --columns \
             pga_g=HEADING takes another heading",
            headings(sheet)
        );
    }
    let mut found = Vec::new();
    for &(at, intensity, unit, of_intensity) in &intensities {
        for &(rate, of_rate) in &frequencies {
            let statistic = match (of_intensity, of_rate) {
                (statistic, Statistic::Mean) | (Statistic::Mean, statistic) => statistic,
                _ => continue,
            };
            let point = |row| match sheet.number(row, at)? {
                0.0.. => Ok((sheet.number(row, at)? * unit, annual_rate(sheet, row, rate)?)),
                _ => Err(sheet.refusal(row, at, "an intensity of 0 or more").into()),
            };
            let points = (0..sheet.lines.len()).map(point).collect::<anyhow::Result<_>>()?;
            found.push(Found { intensity, statistic, curve: curve(points)?, file: file.clone() });
        }
    }
    let is_unused = |&&(at, content, _): &&(usize, Content, Statistic)| {
        matches!(content, Content::Unknown | Content::Magnitude) && sheet.number(0, at).is_ok()
    };
    let unused = columns.iter().filter(is_unused).map(|&(at, ..)| &sheet.headings[at]);
    let unused = unused.filter(|heading| !PLACES.contains(&heading.name.as_str()));
    Ok(Contents::Curves(found, unused.map(|heading| heading.text.clone()).collect()))
}

/// Of columns that say the same in several ways the first counts; others are refused.
fn one_frequency(sheet: &Sheet, columns: &mut Vec<((usize, Frequency), Statistic)>) -> anyhow::Result<()> {
    const SAME: f64 = 0.1;
    let all = std::mem::take(columns);
    for (column, statistic) in all {
        let Some((first, _)) = columns.iter().find(|(_, known)| *known == statistic) else {
            columns.push((column, statistic));
            continue;
        };
        for row in 0..sheet.lines.len() {
            let rates = annual_rate(sheet, row, *first)?.zip(annual_rate(sheet, row, column)?);
            if rates.is_some_and(|(a, b)| (a - b).abs() > SAME * a.max(b)) {
                let [first, other] = [first.0, column.0].map(|at| sheet.headings[at].text.as_str());
                bail!("line {}: '{first}' and '{other}' contradict; keep one", sheet.lines[row]);
            }
        }
    }
    Ok(())
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
    Ok(HazardCurve::new(known.filter(|(intensity, rate)| *intensity != 0.0 && *rate > 0.0).collect())?)
}

/// Bins of PGA and PGV with rates of occurrence, and their magnitudes.
fn joint(
    sheet: &Sheet,
    rate: (usize, Frequency),
    intensities: &[(usize, Intensity, f64, Statistic)],
    mw: Option<usize>,
) -> anyhow::Result<JointHazard> {
    let of = |peak: Peak| {
        let found = intensities.iter().find(|(_, intensity, ..)| *intensity == Intensity::Peak(peak));
        found.map(|&(at, _, unit, _)| (at, unit))
    };
    let Some(((pga, pga_unit), (pgv, pgv_unit))) = of(Peak::Pga).zip(of(Peak::Pgv)) else {
        bail!("rates of occurrence without PGA and PGV; expected both, or rates of exceedance");
    };
    let bin = |row| {
        Ok(PairOfPeaks {
            pga_m_s2: sheet.number(row, pga)? * pga_unit,
            pgv_m_s: sheet.number(row, pgv)? * pgv_unit,
            annual_rate: annual_rate(sheet, row, rate)?.unwrap_or_default(),
            mw: mw.map(|mw| magnitude(sheet, row, mw)).transpose()?,
        })
    };
    let bins = bins((0..sheet.lines.len()).map(bin).collect::<anyhow::Result<Vec<_>>>()?)?;
    let mut known = BTreeMap::new();
    for (bin, line) in bins.bins.iter().zip(&sheet.lines) {
        let same = [bin.pga_m_s2, bin.pgv_m_s, bin.mw.unwrap_or(0.0)].map(f64::to_bits);
        if let Some(first) = known.insert(same, line) {
            bail!("lines {first} and {line}: the same PGA, PGV and magnitude; expected one row of each bin");
        }
    }
    Ok(bins)
}

fn magnitude(sheet: &Sheet, row: usize, column: usize) -> anyhow::Result<f64> {
    let mw = sheet.number(row, column)?;
    match (3.0..=10.0).contains(&mw) {
        true => Ok(mw),
        false => Err(sheet.refusal(row, column, "a moment magnitude").into()),
    }
}

fn bins(bins: Vec<PairOfPeaks>) -> anyhow::Result<JointHazard> {
    match bins.is_empty() {
        true => bail!("no rows; expected motions with PGA and PGV"),
        false => Ok(JointHazard { bins }),
    }
}

/// Headings of the place of a site.
const PLACES: [&str; 8] =
    ["site", "site_id", "custom_site_id", "lon", "lat", "longitude", "latitude", "location"];

/// Checks that no column of places has two.
fn one_site(sheet: &Sheet) -> anyhow::Result<()> {
    let is_place = |(_, heading): &(usize, &Heading)| PLACES.contains(&heading.name.as_str());
    for (at, heading) in sheet.headings.iter().enumerate().filter(is_place) {
        if (0..sheet.lines.len()).any(|row| sheet.cell(row, at) != sheet.cell(0, at)) {
            bail!("column '{}': rows of several sites; keep those of one", heading.text);
        }
    }
    Ok(())
}

/// Ground-motion fields of one site as OpenQuake exports them: PGA in g and PGV in cm/s of each event.
fn fields(sheet: &Sheet, effective_years: Option<f64>) -> anyhow::Result<JointHazard> {
    let Some(years) = effective_years else {
        bail!(
            "ground-motion fields of OpenQuake; expected --effective-years: investigation time x stochastic event sets x \
             branches"
        );
    };
    let column = |name: &str| sheet.headings.iter().position(|heading| heading.text == name);
    let Some((pga, pgv)) = column("gmv_PGA").zip(column("gmv_PGV")) else {
        bail!("{}; expected gmv_PGA and gmv_PGV", headings(sheet));
    };
    let bin = |row| {
        Ok(PairOfPeaks {
            pga_m_s2: sheet.number(row, pga)? * G_M_S2,
            pgv_m_s: sheet.number(row, pgv)? / CM_PER_M,
            annual_rate: 1.0 / years,
            mw: None,
        })
    };
    bins((0..sheet.lines.len()).map(bin).collect::<anyhow::Result<Vec<_>>>()?)
}

/// The curve of one site as OpenQuake exports it: a column for each intensity, in g or cm/s, with the
/// probability of exceedance.
fn openquake(sheet: &Sheet, investigation_years: Option<f64>, file: String) -> anyhow::Result<Found> {
    let Some(name) = note(sheet, "imt=").map(|name| name.trim_matches('\'')) else {
        bail!("no imt in the header of OpenQuake: a curve of what? Expected the file as it was exported");
    };
    let Some((intensity, unit)) = Intensity::of_openquake(name) else {
        bail!("a curve of {name}; expected PGA, PGV or SA(1.0)");
    };
    let Some(years) = investigation_years else {
        bail!("no investigation_time in the header of OpenQuake; expected the file as it was exported");
    };
    let statistic = match note(sheet, "kind=").map(|kind| kind.trim_matches('\'')) {
        Some("quantile-0.16") => Statistic::Low,
        Some("quantile-0.84") => Statistic::High,
        Some("quantile-0.5") => Statistic::Median,
        _ => Statistic::Mean,
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
    let curve = curve(points.collect::<anyhow::Result<_>>()?)?;
    Ok(Found { intensity, statistic, curve, file })
}

/// What stands behind a key in the notes of a file.
fn note<'a>(sheet: &'a Sheet, key: &str) -> Option<&'a str> {
    let behind = |text: &'a String| text.split_once(key).map(|(_, rest)| rest);
    let rest = sheet.notes.iter().find_map(behind)?;
    rest.split([',', '"', ' ']).next()
}
