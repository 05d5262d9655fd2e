//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

use self::columns::{Content, Frequency, Intensity, Statistic, content};
pub use self::columns::{headings, peak, rename, renamed};
use crate::fragility::Peak;
use crate::hazard::{Hazard, HazardCurve, PairOfPeaks, PeakHazard, PgvPgaRatio, VelocitySource};
use crate::hazard::{exceedance, velocity_of_spectrum};
use crate::plausibility::{MAGNITUDES, judge_hazard};
use crate::sheet::{Heading, Sheet};
use crate::units::{CM_PER_M, G_M_S2};
use crate::warning::{Warning, Warnings};

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for. Also returns warnings about columns that are not used.
pub fn read(
    paths: &[PathBuf],
    renamed: &[(String, String)],
    effective_years: Option<f64>,
) -> anyhow::Result<(Hazard, Warnings)> {
    let (mut found, mut missing) = (Found::default(), renamed.to_vec());
    for path in paths {
        let mut add = || {
            let mut sheet = Sheet::parse(&std::fs::read(path)?)?;
            let has = |heading: &String| sheet.headings.iter().any(|found| found.text == *heading);
            let here = renamed.iter().filter(|(_, heading)| paths.len() == 1 || has(heading));
            let here: Vec<(String, String)> = here.cloned().collect();
            rename(&mut sheet, &here)?;
            missing.retain(|wanted| !here.contains(wanted));
            found.add(&sheet, path, effective_years)
        };
        add().with_context(|| path.display().to_string())?;
    }
    if let Some((_, heading)) = missing.first() {
        bail!("no heading '{heading}' in any file of the hazard");
    }
    let hazard = match (found.joint.pop(), paths) {
        (Some(bins), [path]) => {
            let of_pga = judge_hazard(false, &exceedance(&bins, |bin| bin.pga_m_s2 / G_M_S2));
            let of_both = of_pga.and_then(|()| judge_hazard(true, &exceedance(&bins, |bin| bin.pgv_m_s)));
            of_both.with_context(|| path.display().to_string())?;
            Hazard::Joint(bins)
        }
        (Some(_), _) => bail!("a hazard of PGA and PGV together among others; expected it alone"),
        (None, _) => Hazard::Curve(joined(&found.curves)?),
    };
    Ok((hazard, found.unused))
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: &[Curve]) -> anyhow::Result<PeakHazard> {
    let of = |intensity: Intensity, statistic: Statistic| {
        curves.iter().filter(move |found| (found.intensity, found.statistic) == (intensity, statistic))
    };
    for found in curves {
        if let [first, second, ..] = of(found.intensity, found.statistic).collect::<Vec<_>>()[..] {
            let name = match found.intensity {
                Intensity::Peak(peak) => peak.to_string().to_uppercase(),
                Intensity::Spectral => "SA(1.0 s)".to_string(),
            };
            bail!("two curves of {name}: {} and {}; expected one", first.file, second.file);
        }
        let is_velocity = found.intensity == Intensity::Peak(Peak::Pgv);
        let unit = if is_velocity { 1.0 } else { G_M_S2 };
        let points = found.curve.points().iter().map(|(im, rate)| (im / unit, *rate));
        judge_hazard(is_velocity, &points.collect::<Vec<_>>()).with_context(|| found.file.clone())?;
    }
    let of = |intensity, statistic| of(intensity, statistic).next().map(|found| &found.curve);
    let [pga, pgv, spectral] = [Intensity::Peak(Peak::Pga), Intensity::Peak(Peak::Pgv), Intensity::Spectral]
        .map(|intensity| of(intensity, Statistic::Mean).or(of(intensity, Statistic::Median)));
    let (peak, curve, velocity) = match (pga, pgv, spectral) {
        (Some(pga), Some(pgv), _) => {
            (Peak::Pga, pga, Some(PgvPgaRatio::of_curves(pga, pgv, VelocitySource::Velocity)?))
        }
        (Some(pga), None, Some(spectral)) => {
            let pgv = velocity_of_spectrum(pga, spectral);
            (Peak::Pga, pga, Some(PgvPgaRatio::of_curves(pga, &pgv, VelocitySource::Spectrum)?))
        }
        (Some(pga), None, None) => (Peak::Pga, pga, None),
        (None, _, Some(_)) => bail!("SA(1.0 s) without PGA; expected the curve of PGA too"),
        (None, Some(pgv), None) => (Peak::Pgv, pgv, None),
        (None, None, None) => bail!("fractiles alone; expected the mean curve too"),
    };
    let fractile = |statistic| of(Intensity::Peak(peak), statistic).cloned();
    let fractiles = fractile(Statistic::Low).zip(fractile(Statistic::High)).map(|(low, high)| [low, high]);
    Ok(PeakHazard { peak, curve: curve.clone(), fractiles, velocity })
}

/// A curve, and the file that it is from.
struct Curve {
    intensity: Intensity,
    statistic: Statistic,
    curve: HazardCurve,
    file: String,
}

#[derive(Default)]
struct Found {
    curves: Vec<Curve>,
    joint: Vec<Vec<PairOfPeaks>>,
    /// About columns that say nothing of the curves.
    unused: Warnings,
}

impl Found {
    fn add(&mut self, sheet: &Sheet, path: &Path, effective_years: Option<f64>) -> anyhow::Result<()> {
        let file = path.display().to_string();
        let years = note(sheet, "investigation_time=").and_then(|years| years.parse().ok());
        let starts = |start: &str| sheet.headings.iter().any(|heading| heading.text.starts_with(start));
        one_site(sheet)?;
        if starts("gmv_") {
            self.joint.push(fields(sheet, effective_years)?);
            return Ok(());
        }
        if effective_years.is_some() {
            bail!("--effective-years is for ground-motion fields of OpenQuake (gmv_PGA, gmv_PGV)");
        }
        if starts("poe-") {
            self.curves.push(openquake(sheet, years, file)?);
            return Ok(());
        }
        self.add_columns(sheet, years, file)
    }

    /// Adds the curves of a table, or its joint hazard, by what its headings say.
    fn add_columns(&mut self, sheet: &Sheet, years: Option<f64>, file: String) -> anyhow::Result<()> {
        let (mut intensities, mut frequencies, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for (at, heading) in sheet.headings.iter().enumerate() {
            match content(heading, years) {
                (Content::Intensity(intensity, unit), statistic) => {
                    intensities.push((at, intensity, unit, statistic));
                }
                (Content::Frequency(frequency), statistic) => frequencies.push((at, frequency, statistic)),
                (other, _) => others.push((at, other)),
            }
        }
        let place = |wanted| others.iter().find(|(_, content)| *content == wanted).map(|(at, _)| *at);
        // OpenQuake's spectra have headings such as `0.002105~PGA`: the probability, and the intensity.
        let is_uniform = sheet.headings.iter().any(|heading| heading.text.contains('~'));
        if is_uniform || (place(Content::Period).is_some() && frequencies.is_empty()) {
            bail!(
                "a uniform hazard spectrum: one rate, many periods; expected a hazard curve: PGA, best with \
                 SA(1.0 s), at several rates"
            );
        }
        let occurrence = frequencies.iter().find(|(_, of, _)| *of == Frequency::Occurrence);
        let is_unused = |(at, content): &&(usize, Content)| {
            (*content == Content::Unknown || (*content == Content::Magnitude && occurrence.is_none()))
                && sheet.number(0, *at).is_ok()
                && !PLACES.contains(&sheet.headings[*at].name.as_str())
        };
        let unused = others.iter().filter(is_unused).map(|(at, _)| sheet.headings[*at].text.clone());
        self.unused.extend(unused.map(|heading| (Warning::UnusedColumns, heading)).collect());
        if let Some((rate, ..)) = occurrence {
            self.joint.push(joint(sheet, *rate, &intensities, place(Content::Magnitude))?);
            return Ok(());
        }
        let frequencies = without_repetition(sheet, frequencies)?;
        if intensities.is_empty() || frequencies.is_empty() {
            let other = place(Content::OtherSpectral)
                .map_or("", |_| "; of spectral accelerations only that at 1 s is of use");
            bail!(
                "{}; expected PGA (with g or m/s2), PGV (with m/s) or SA(1.0 s) (with g), and \
                 annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period{other}; \
                 --columns pga_g=HEADING takes another heading",
                headings(sheet)
            );
        }
        for &(at, intensity, unit, of_intensity) in &intensities {
            for &(rate, frequency, of_rate) in &frequencies {
                let statistic = match (of_intensity, of_rate) {
                    (statistic, Statistic::Mean) | (Statistic::Mean, statistic) => statistic,
                    _ => continue,
                };
                let point = |row| match sheet.number(row, at)? {
                    value @ 0.0.. => Ok((value * unit, frequency.annual_rate(sheet, row, rate)?)),
                    _ => Err(sheet.refusal(row, at, "an intensity of 0 or more").into()),
                };
                let points = (0..sheet.lines.len()).map(point).collect::<anyhow::Result<_>>()?;
                self.curves.push(Curve { intensity, statistic, curve: curve(points)?, file: file.clone() });
            }
        }
        Ok(())
    }
}

/// Columns of rates, without those that say the same in another way, of which the first counts; others are
/// refused.
fn without_repetition(
    sheet: &Sheet,
    all: Vec<(usize, Frequency, Statistic)>,
) -> anyhow::Result<Vec<(usize, Frequency, Statistic)>> {
    const SAME: f64 = 0.1;
    let mut kept: Vec<(usize, Frequency, Statistic)> = Vec::new();
    for (at, frequency, statistic) in all {
        let Some(&(first, known, _)) = kept.iter().find(|(.., known)| *known == statistic) else {
            kept.push((at, frequency, statistic));
            continue;
        };
        for row in 0..sheet.lines.len() {
            let rates = known.annual_rate(sheet, row, first)?.zip(frequency.annual_rate(sheet, row, at)?);
            if rates.is_some_and(|(a, b)| (a - b).abs() > SAME * a.max(b)) {
                let [first, other] = [first, at].map(|at| sheet.headings[at].text.as_str());
                bail!("line {}: '{first}' and '{other}' contradict; keep one", sheet.lines[row]);
            }
        }
    }
    Ok(kept)
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
    rate: usize,
    intensities: &[(usize, Intensity, f64, Statistic)],
    mw: Option<usize>,
) -> anyhow::Result<Vec<PairOfPeaks>> {
    let of = |peak: Peak| {
        let found = intensities.iter().find(|(_, intensity, ..)| *intensity == Intensity::Peak(peak));
        found.map(|&(at, _, unit, _)| (at, unit))
    };
    let Some(((pga, pga_unit), (pgv, pgv_unit))) = of(Peak::Pga).zip(of(Peak::Pgv)) else {
        bail!("rates of occurrence without PGA and PGV; expected both, or rates of exceedance");
    };
    let magnitude = |row: usize, column: usize| match sheet.number(row, column)? {
        mw if MAGNITUDES.contains(&mw) => Ok(mw),
        _ => Err(sheet.refusal(row, column, "a moment magnitude")),
    };
    let bins = of_rows(sheet, |row| {
        Ok(PairOfPeaks {
            pga_m_s2: sheet.number(row, pga)? * pga_unit,
            pgv_m_s: sheet.number(row, pgv)? * pgv_unit,
            annual_rate: Frequency::Occurrence.annual_rate(sheet, row, rate)?.unwrap_or_default(),
            mw: mw.map(|mw| magnitude(row, mw)).transpose()?,
        })
    })?;
    let mut known = BTreeMap::new();
    for (bin, line) in bins.iter().zip(&sheet.lines) {
        let same = [bin.pga_m_s2, bin.pgv_m_s, bin.mw.unwrap_or(0.0)].map(f64::to_bits);
        if let Some(first) = known.insert(same, line) {
            bail!("lines {first} and {line}: the same PGA, PGV and magnitude; expected one row of each bin");
        }
    }
    Ok(bins)
}

/// The motions of all rows.
fn of_rows(
    sheet: &Sheet,
    bin: impl Fn(usize) -> anyhow::Result<PairOfPeaks>,
) -> anyhow::Result<Vec<PairOfPeaks>> {
    match (0..sheet.lines.len()).map(bin).collect::<anyhow::Result<Vec<_>>>()? {
        bins if bins.is_empty() => bail!("no rows; expected motions with PGA and PGV"),
        bins => Ok(bins),
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
fn fields(sheet: &Sheet, effective_years: Option<f64>) -> anyhow::Result<Vec<PairOfPeaks>> {
    let Some(years) = effective_years else {
        bail!(
            "ground-motion fields of OpenQuake; expected --effective-years: investigation time x stochastic \
             event sets x branches"
        );
    };
    let column = |name: &str| sheet.headings.iter().position(|heading| heading.text == name);
    let Some((pga, pgv)) = column("gmv_PGA").zip(column("gmv_PGV")) else {
        bail!("{}; expected gmv_PGA and gmv_PGV", headings(sheet));
    };
    of_rows(sheet, |row| {
        let (pga_m_s2, pgv_m_s) = (sheet.number(row, pga)? * G_M_S2, sheet.number(row, pgv)? / CM_PER_M);
        Ok(PairOfPeaks { pga_m_s2, pgv_m_s, annual_rate: 1.0 / years, mw: None })
    })
}

/// The curve of one site as OpenQuake exports it: a column for each intensity, in g or cm/s, with the
/// probability of exceedance.
fn openquake(sheet: &Sheet, investigation_years: Option<f64>, file: String) -> anyhow::Result<Curve> {
    let Some(name) = note(sheet, "imt=").map(|name| name.trim_matches('\'')) else {
        bail!("no imt in the header of OpenQuake: a curve of what? Expected the file as it was exported");
    };
    let (intensity, unit) = match name {
        "PGA" => (Intensity::Peak(Peak::Pga), G_M_S2),
        "PGV" => (Intensity::Peak(Peak::Pgv), 1.0 / CM_PER_M),
        "SA(1.0)" => (Intensity::Spectral, G_M_S2),
        _ => bail!("a curve of {name}; expected PGA, PGV or SA(1.0)"),
    };
    let Some(years) = investigation_years else {
        bail!("no investigation_time in the header of OpenQuake; expected the file as it was exported");
    };
    let statistic = match note(sheet, "kind=").map(|kind| kind.trim_matches('\'')) {
        Some("quantile-0.16") => Statistic::Low,
        Some("quantile-0.84") => Statistic::High,
        Some("quantile-0.5") => Statistic::Median,
        Some(other) if other.starts_with("quantile-") || other == "max" => {
            bail!("a curve of {other}; expected the mean, or quantiles 0.16 and 0.84 beside it")
        }
        _ => Statistic::Mean,
    };
    if sheet.lines.len() != 1 {
        bail!("curves of {} sites; keep the row of one", sheet.lines.len());
    }
    let mut points = Vec::new();
    for (at, heading) in sheet.headings.iter().enumerate() {
        let Some(level) = heading.text.strip_prefix("poe-") else { continue };
        let intensity: f64 = level.parse().with_context(|| format!("heading {}", heading.text))?;
        points.push((intensity * unit, Frequency::ProbabilityIn(years).annual_rate(sheet, 0, at)?));
    }
    Ok(Curve { intensity, statistic, curve: curve(points)?, file })
}

/// What stands behind a key in the notes of a file.
fn note<'a>(sheet: &'a Sheet, key: &str) -> Option<&'a str> {
    let rest = sheet.notes.iter().find_map(|text| text.split_once(key).map(|(_, rest)| rest))?;
    rest.split([',', '"', ' ']).next()
}
