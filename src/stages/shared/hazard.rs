//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Context, bail};

use crate::fragility::Peak;
use crate::hazard::{Hazard, HazardCurve, JointHazard, PairOfPeaks, PeakHazard};
use crate::hazard::{Velocity, VelocitySource, velocity_of_spectrum};
use crate::plausibility::judge_hazard;
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
        Quantity::Acceleration if names(&["pga", "ag", "a_g", "a", "peak_ground_acceleration", "ground_motion"]) => {
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
        } else if ["return_period", "ritorno", "t_r"].iter().any(|part| name.contains(part)) || has(&["tr", "rp"]) {
            Some(Frequency::ReturnPeriod)
        } else if has(&["probability", "poe", "aep"]) {
            let annual = || has(&["annual", "aep"]).then_some(1.0);
            years().or_else(annual).or(investigation_years).map(Frequency::ProbabilityIn)
        } else {
            has(&["rate", "frequency", "frequenza", "afe", "afoe", "mafe"]).then_some(Frequency::Rate)
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

/// Which of several curves of an intensity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Statistic {
    Mean,
    Median,
    Low,
    High,
}

/// What a curve of a file is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Intensity {
    Peak(Peak),
    /// Spectral acceleration at 1 s.
    Spectral,
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Content {
    /// With the unit in m/s2 or m/s.
    Intensity(Intensity, f64),
    /// Spectral acceleration at another period.
    OtherSpectral,
    Frequency(Frequency),
    Magnitude,
    Period,
    Unknown,
}

/// A curve, and the file that it is from.
struct Found {
    intensity: Intensity,
    statistic: Statistic,
    curve: HazardCurve,
    file: String,
}

/// What a file holds.
enum Contents {
    Curves(Vec<Found>),
    Joint(JointHazard),
}

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for.
pub fn read(
    paths: &[PathBuf],
    renamed: &[Renamed],
    effective_years: Option<f64>,
) -> anyhow::Result<Hazard> {
    let (mut curves, mut joint, mut unused) = (Vec::new(), Vec::new(), renamed.to_vec());
    for path in paths {
        let mut contents = || {
            let mut sheet = Sheet::parse(&std::fs::read(path)?)?;
            let is_here = |wanted: &&Renamed| sheet.headings.iter().any(|found| found.text == wanted.heading);
            let here: Vec<Renamed> = match paths {
                [_] => renamed.to_vec(),
                _ => renamed.iter().filter(is_here).cloned().collect(),
            };
            rename(&mut sheet, &here)?;
            unused.retain(|wanted| !here.contains(wanted));
            contents(&sheet, path, effective_years)
        };
        match contents().with_context(|| path.display().to_string())? {
            Contents::Curves(found) => curves.extend(found),
            Contents::Joint(hazard) => joint.push(hazard),
        }
    }
    if let Some(wanted) = unused.first() {
        bail!("no heading '{}' in any file of the hazard", wanted.heading);
    }
    match (joint.pop(), paths) {
        (Some(joint), [path]) => {
            judge_joint(&joint).with_context(|| path.display().to_string())?;
            Ok(Hazard::Joint(joint))
        }
        (Some(_), _) => bail!("a hazard of PGA and PGV together among others; expected it alone"),
        (None, _) => joined(curves),
    }
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: Vec<Found>) -> anyhow::Result<Hazard> {
    for found in &curves {
        let name = found.intensity.name();
        let is_same = |other: &&Found| {
            (other.intensity, other.statistic) == (found.intensity, found.statistic)
        };
        if let [first, second, ..] = curves.iter().filter(is_same).collect::<Vec<_>>()[..] {
            bail!("two curves of {name}: {} and {}; expected one", first.file, second.file);
        }
        judge_curve(found)?;
    }
    let of = |intensity: Intensity, statistic: Statistic| {
        let is_it = |found: &&Found| (found.intensity, found.statistic) == (intensity, statistic);
        curves.iter().find(is_it).map(|found| &found.curve)
    };
    let mean = |intensity: Intensity| of(intensity, Statistic::Mean).or(of(intensity, Statistic::Median));
    let [pga, pgv, spectral] =
        [Intensity::Peak(Peak::Pga), Intensity::Peak(Peak::Pgv), Intensity::Spectral].map(mean);
    let (peak, curve, velocity) = match (pga, pgv, spectral) {
        (Some(pga), Some(pgv), _) => {
            (Peak::Pga, pga, Some(Velocity::of_curves(pga, pgv, VelocitySource::Velocity)?))
        }
        (Some(pga), None, Some(spectral)) => {
            let pgv = velocity_of_spectrum(spectral);
            (Peak::Pga, pga, Some(Velocity::of_curves(pga, &pgv, VelocitySource::Spectrum)?))
        }
        (Some(pga), None, None) => (Peak::Pga, pga, None),
        (None, Some(pgv), _) => (Peak::Pgv, pgv, None),
        (None, None, Some(_)) => bail!("SA(1.0 s) alone; expected the curve of PGA too"),
        (None, None, None) => bail!("fractiles alone; expected the mean curve too"),
    };
    let fractile = |statistic: Statistic| of(Intensity::Peak(peak), statistic).cloned();
    let fractiles = fractile(Statistic::Low).zip(fractile(Statistic::High)).map(|(low, high)| [low, high]);
    Ok(Hazard::Curve(PeakHazard { peak, curve: curve.clone(), fractiles, velocity }))
}

fn judge_curve(found: &Found) -> anyhow::Result<()> {
    let unit = match found.intensity {
        Intensity::Peak(Peak::Pgv) => 1.0,
        _ => G_M_S2,
    };
    let points: Vec<(f64, f64)> = found.curve.points().iter().map(|(im, rate)| (im / unit, *rate)).collect();
    judge_hazard(found.intensity == Intensity::Peak(Peak::Pgv), &points)
        .with_context(|| found.file.clone())
}

fn judge_joint(joint: &JointHazard) -> anyhow::Result<()> {
    judge_hazard(false, &joint.exceedance(|bin| bin.pga_m_s2 / G_M_S2))?;
    Ok(judge_hazard(true, &joint.exceedance(|bin| bin.pgv_m_s))?)
}

impl Intensity {
    fn name(self) -> &'static str {
        match self {
            Intensity::Peak(Peak::Pga) => "PGA",
            Intensity::Peak(Peak::Pgv) => "PGV",
            Intensity::Spectral => "SA(1.0 s)",
        }
    }

    /// By the name that OpenQuake gives it, with its unit in m/s2 or m/s.
    fn of_openquake(name: &str) -> Option<(Intensity, f64)> {
        match name {
            "PGA" => Some((Intensity::Peak(Peak::Pga), G_M_S2)),
            "PGV" => Some((Intensity::Peak(Peak::Pgv), 1.0 / CM_PER_M)),
            "SA(1.0)" => Some((Intensity::Spectral, G_M_S2)),
            _ => None,
        }
    }
}

/// What a heading says of its column, and of which curve it is.
fn content(heading: &Heading, investigation_years: Option<f64>) -> (Content, Statistic) {
    const STATISTICS: [(Statistic, &[&str]); 3] = [
        (Statistic::Low, &["16", "0.16", "p16", "16th"]),
        (Statistic::High, &["84", "0.84", "p84", "84th"]),
        (Statistic::Median, &["median", "p50", "50th", "0.5"]),
    ];
    let words = || heading.text.split(['_', ' ', '(', ')', '[', ']', '-', '%']);
    let named = STATISTICS.iter().find_map(|(statistic, names)| {
        words().find(|word| names.contains(&word.to_lowercase().as_str())).map(|word| (*statistic, word))
    });
    let (statistic, heading) = match named {
        Some((statistic, word)) => {
            let rest = heading.text.replacen(word, "", 1);
            (statistic, Heading::of(rest.trim_matches(['_', ' '])))
        }
        None => (Statistic::Mean, heading.clone()),
    };
    if let Some((peak, unit)) = peak(&heading) {
        return (Content::Intensity(Intensity::Peak(peak), unit), statistic);
    }
    let content = match Frequency::of(&heading, investigation_years) {
        Some(frequency) => Content::Frequency(frequency),
        None => other_content(&heading),
    };
    (content, statistic)
}

fn other_content(heading: &Heading) -> Content {
    let name = heading.name.as_str();
    let rest = ["spectral_acceleration", "psa", "sa", "s"].iter().find_map(|start| name.strip_prefix(start));
    let acceleration = heading.unit.filter(|unit| unit.quantity == Quantity::Acceleration);
    match (name, rest.map(|rest| rest.trim_matches('_').trim_end_matches(['s', '_'])), acceleration) {
        ("mw" | "magnitude" | "m" | "mag", ..) => Content::Magnitude,
        ("t" | "period" | "periods" | "periodo", ..) => Content::Period,
        (_, Some("1" | "1_0" | "1_00"), Some(unit)) => Content::Intensity(Intensity::Spectral, unit.si),
        (_, Some(_), Some(_)) => Content::OtherSpectral,
        _ => Content::Unknown,
    }
}

/// Reads what a file holds.
fn contents(sheet: &Sheet, path: &Path, effective_years: Option<f64>) -> anyhow::Result<Contents> {
    let file = path.display().to_string();
    let years = note(sheet, "investigation_time=").and_then(|years| years.parse().ok());
    let starts = |start: &str| sheet.headings.iter().any(|heading| heading.text.starts_with(start));
    if starts("gmv_") {
        return fields(sheet, effective_years).map(Contents::Joint);
    }
    if starts("poe-") {
        return openquake(sheet, years, file).map(|found| Contents::Curves(vec![found]));
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
    // Of columns that say the same in several ways the first counts.
    let mut known = Vec::new();
    frequencies.retain(|(_, statistic)| {
        let is_new = !known.contains(statistic);
        known.push(*statistic);
        is_new
    });
    if intensities.is_empty() || frequencies.is_empty() {
        let other = if has(|content| *content == Content::OtherSpectral) {
            "; of spectral accelerations only that at 1 s is of use"
        } else {
            ""
        };
        bail!(
            "headings {}; expected PGA (with g or m/s2), PGV (with m/s) or SA(1.0 s) (with g), and \
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
            let point = |row| Ok((sheet.number(row, at)? * unit, annual_rate(sheet, row, rate)?));
            let points = (0..sheet.lines.len()).map(point).collect::<anyhow::Result<_>>()?;
            found.push(Found { intensity, statistic, curve: curve(points)?, file: file.clone() });
        }
    }
    Ok(Contents::Curves(found))
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
    bins((0..sheet.lines.len()).map(bin).collect::<anyhow::Result<Vec<_>>>()?)
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
        bail!("headings {}; expected gmv_PGA and gmv_PGV", headings(sheet));
    };
    let site = column("site_id").or(column("custom_site_id"));
    if let Some(site) = site
        && (0..sheet.lines.len()).any(|row| sheet.cell(row, site) != sheet.cell(0, site))
    {
        bail!("ground-motion fields of several sites; keep the rows of one");
    }
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
