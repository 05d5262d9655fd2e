//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;
mod openquake;
mod said;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Hazard, HazardCurve, PairOfPeaks, PgvPgaRatio, VelocitySource, exceedance};
use rockfrag_core::plausibility::{validate_hazard, validate_spectrum};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{Warning, Warnings};

use self::columns::{Frequency, HazardColumn, Imt, Statistic};
pub use self::columns::{contradict, peak};
use self::said::Said;
use super::intensities::{MotionTable, motions};
use super::words::means;
use super::{Grid, Heading, InputError, Meaning, Reader, Result};
use crate::number::period;
use crate::source;

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for. Warnings are about medians and motions beyond any record.
pub fn read(paths: &[PathBuf], reader: &mut Reader, effective_years: Option<f64>) -> Result<Hazard> {
    let mut found = Found::default();
    for path in paths {
        found.add(path, reader, effective_years).map_err(|error| error.in_file(path))?;
    }
    let hazard = match found.joint {
        Some(_) if paths.len() > 1 => {
            return Err(InputError::unexpected("a hazard of PGA and PGV together among others", "it alone"));
        }
        Some(bins) => Hazard::Joint(bins),
        None => joined(&found.curves, &mut found.warnings)?,
    };
    reader.warnings.extend(found.warnings);
    Ok(hazard)
}

/// Whether a heading is of a hazard: it says how often, or OpenQuake wrote it.
pub fn is_of_hazard(heading: &Heading) -> bool {
    let is_exported = ["gmv_", "poe-"].iter().any(|start| heading.text.starts_with(start));
    is_exported || HazardColumn::new(0, heading, &Said::in_years(1.0)).frequency.is_some()
}

/// A point of a curve, and the cell of its rate.
struct CurvePoint {
    /// In m/s2 or m/s.
    value: f64,
    /// None of a motion that is certain.
    annual_rate: Option<f64>,
    row: usize,
    column: usize,
}

struct Curve {
    measure: Imt,
    statistic: Statistic,
    curve: HazardCurve,
    file: String,
}

impl Curve {
    /// Makes a curve, which some place on earth can have. Tables often begin with motions that are certain to
    /// come, and end with some that never do: these tell nothing.
    fn new(of: (Imt, Statistic), mut points: Vec<CurvePoint>, grid: &Grid, file: &Path) -> Result<Curve> {
        let (measure, statistic) = of;
        points.retain(|point| point.value != 0.0);
        points.sort_by(|a, b| a.value.total_cmp(&b.value));
        for pair in points.windows(2) {
            let [before, rate] = [0, 1].map(|at: usize| pair[at].annual_rate.unwrap_or(f64::INFINITY));
            let expected = match rate > before {
                _ if pair[0].value == pair[1].value => "one row of each intensity",
                true => "motions no more frequent than weaker ones",
                false => continue,
            };
            return Err(grid.refusal(pair[1].row, pair[1].column, expected));
        }
        let known = points.iter().filter_map(|point| Some((point.value, point.annual_rate?)));
        let curve = HazardCurve::new(known.filter(|(_, rate)| *rate > 0.0).collect())?;
        let unit = if measure == Imt::Pgv { 1.0 } else { G_M_S2 };
        let points: Vec<_> = curve.points().iter().map(|(value, rate)| (value / unit, *rate)).collect();
        validate_hazard(&measure.to_string(), &points).map_err(InputError::Implausible)?;
        Ok(Curve { measure, statistic, curve, file: file.display().to_string() })
    }
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: &[Curve], warnings: &mut Warnings) -> Result<Hazard> {
    let find = |measure: Imt, statistic: Statistic| {
        curves.iter().find(|curve| (curve.measure, curve.statistic) == (measure, statistic))
    };
    let central = |measure| find(measure, Statistic::Mean).or(find(measure, Statistic::Median));
    let (pga, pgv) = (central(Imt::Pga), central(Imt::Pgv));
    let spectral = central(Imt::SA_1S).filter(|_| pgv.is_none());
    let (main, mut hazard) = match (pga, pgv, spectral) {
        (Some(pga), None, Some(spectral)) if pga.curve == spectral.curve => {
            return Err(InputError::unexpected("SA(1.0 s) as PGA, at all rates", "the curves of both"));
        }
        (Some(pga), None, Some(spectral)) => {
            let points = spectral.curve.points().iter();
            validate_spectrum(points.map(|(sa, rate)| sa / pga.curve.intensity(*rate)))
                .map_err(|error| InputError::Implausible(error).in_file(Path::new(&spectral.file)))?;
            (pga, Hazard::with_spectrum(pga.curve.clone(), &spectral.curve)?)
        }
        (Some(pga), ..) => (pga, Hazard::over(Peak::Pga, pga.curve.clone())),
        (None, Some(pgv), _) => (pgv, Hazard::over(Peak::Pgv, pgv.curve.clone())),
        (.., Some(_)) => return Err(InputError::unexpected("SA(1.0 s) without PGA", "the curve of PGA too")),
        _ => return Err(InputError::unexpected("fractiles alone", "the mean curve too")),
    };
    let of_main = [Statistic::Low, Statistic::High].map(|statistic| find(main.measure, statistic));
    if let [Some(one), None] | [None, Some(one)] = of_main {
        let found = format!("{} ({}) of {} alone", one.measure, one.statistic, one.file);
        return Err(InputError::unexpected(found, "both the 16 % and the 84 % curve, or neither"));
    }
    let fractiles = of_main[0].zip(of_main[1]);
    let used: Vec<&Curve> = [pga, pgv, spectral].into_iter().flatten().collect();
    for curve in used.iter().filter(|curve| curve.statistic == Statistic::Median) {
        warnings.add(Warning::MedianHazard, curve.file.clone());
    }
    if let Hazard::Curve(hazard) = &mut hazard {
        let is_median = used.iter().any(|curve| curve.statistic == Statistic::Median);
        hazard.warnings.extend(is_median.then_some(Warning::MedianHazard));
        hazard.fractiles = fractiles.map(|(low, high)| [low.curve.clone(), high.curve.clone()]);
        if let (Some(pga), Some(pgv)) = (pga, pgv) {
            hazard.pgv_pga = Some(PgvPgaRatio::by_curves(&pga.curve, &pgv.curve, VelocitySource::Pgv)?);
        }
    }
    Ok(hazard)
}

#[derive(Default)]
struct Found {
    curves: Vec<Curve>,
    joint: Option<Vec<PairOfPeaks>>,
    /// What rows and comments say of the site.
    site: BTreeMap<String, String>,
    /// About medians, and motions beyond any record.
    warnings: Warnings,
}

impl Found {
    /// Adds what is in a file: each of its columns has one role, or it is refused.
    fn add(&mut self, path: &Path, reader: &mut Reader, effective_years: Option<f64>) -> Result<()> {
        expect_table(path)?;
        let mut grid = reader.read(path)?;
        self.expect_one_site(&grid)?;
        let [are_fields, is_exported] =
            ["gmv_", "poe-"].map(|start| grid.headings.iter().any(|heading| heading.text.starts_with(start)));
        match (are_fields, effective_years) {
            (true, None) => {
                let expected = "--effective-years: investigation time x stochastic event sets x branches";
                return Err(InputError::unexpected("ground-motion fields of OpenQuake", expected));
            }
            (true, _) => openquake::name_fields(&mut grid),
            (false, Some(_)) => {
                let expected = "ground-motion fields of OpenQuake (gmv_PGA, gmv_PGV) with it";
                return Err(InputError::unexpected("--effective-years", expected));
            }
            (false, None) => {}
        }
        let mut said = if is_exported { Said::default() } else { Said::new(&grid)? };
        let columns = (0..).zip(&grid.headings).map(|(at, heading)| HazardColumn::new(at, heading, &said));
        let mut columns: Vec<HazardColumn> = columns.collect();
        let occurrence = columns.iter().position(|column| column.frequency == Some(Frequency::Occurrence));
        let is_joint = are_fields || occurrence.is_some();
        let others = columns.iter().map(|column| said.meaning(&grid, column, is_joint));
        let mut meanings = others.collect::<Result<Vec<Meaning>>>()?;
        let exported = if is_exported { Some(openquake::probabilities(&grid, path)?) } else { None };
        let are_named = columns.iter().any(|column| column.frequency.and(column.measure).is_some());
        for column in columns.iter_mut().filter(|column| column.is_of_curve()) {
            if column.unit.is_some() && !are_named {
                column.measure = Some(said.measure(column.measure, path)?);
            }
            let poe =
                exported.as_ref().map(|curve| format!("probability, {}, {}", curve.measure, curve.statistic));
            meanings[column.at] = Meaning::Known(poe.unwrap_or(column.to_string()));
        }
        if let Some(curve) = exported {
            self.add_curve(curve)?;
        } else if is_joint {
            self.add_motions(&grid, occurrence, effective_years)?;
        } else {
            self.add_curves(&grid, &columns, &said, path)?;
        }
        expect_understood(&grid, &meanings)?;
        for column in columns.iter().filter(|column| column.frequency.is_some()) {
            grid.headings[column.at].unit = None;
        }
        reader.tell(path, &grid, meanings);
        Ok(())
    }

    /// Adds the curves of columns of values and of frequencies.
    fn add_curves(&mut self, grid: &Grid, columns: &[HazardColumn], said: &Said, file: &Path) -> Result<()> {
        let pairs = pairs(columns);
        let named: Vec<_> = pairs.iter().map(|[values, rates]| values.named_with(rates)).collect();
        let measures: Vec<Imt> = named.iter().filter_map(|named| (*named)?.0).collect();
        said.expect_one_of(&measures)?;
        let are_unnamed = columns.iter().all(|column| column.statistic.is_none());
        let told = said.statistic.filter(|told| are_unnamed || *told == Statistic::Median);
        let (before, mut other) = (self.curves.len(), None);
        let mut single = Vec::from_iter(columns.iter().filter(|column| column.is_of_curve()));
        for ([values, rates], named) in pairs.iter().zip(named) {
            let Some((measure, statistic)) = named else { continue };
            single.retain(|column| ![values.at, rates.at].contains(&column.at));
            let measure = said.measure(measure, file)?;
            match measure {
                Imt::Pga | Imt::Pgv | Imt::SA_1S => {
                    let of = (measure, statistic.or(told).unwrap_or(Statistic::Mean));
                    self.add_curve(Curve::new(of, points(grid, values, rates)?, grid, file)?)?;
                }
                Imt::Spectral(_) => other = Some(measure),
            }
        }
        if before == self.curves.len() {
            let expected = "that of PGA: of spectral accelerations only SA(1.0 s) is of use, beside PGA";
            let refusal = |of: Imt| InputError::unexpected(format!("a curve of {of}"), expected);
            return Err(other.map_or_else(|| not_understood(grid, columns), refusal));
        }
        let expected = "a column of rates, probabilities or return periods beside each of values";
        let found = single.first().map(|column| grid.headings[column.at].text.clone());
        found.map_or(Ok(()), |found| Err(InputError::unexpected(found, expected)))
    }

    /// Adds motions with PGA and PGV, their magnitudes, and their annual rates of occurrence: in a column, or
    /// equal in so many effective years.
    fn add_motions(&mut self, grid: &Grid, occurrence: Option<usize>, years: Option<f64>) -> Result<()> {
        let Some(MotionTable { given, mw, .. }) = motions(grid, &mut self.warnings)? else {
            let found = format!("rates of occurrence without PGA and PGV: {}", grid.found());
            return Err(InputError::unexpected(found, "both, or rates of exceedance"));
        };
        if given.is_empty() {
            return Err(InputError::unexpected("no rows", "motions with PGA and PGV"));
        }
        let (mut bins, mut lines) = (Vec::new(), BTreeMap::new());
        for (row, line) in grid.lines.iter().enumerate() {
            let annual_rate = match (occurrence, years) {
                (Some(at), None) => Frequency::Occurrence.annual_rate(grid, row, at)?.unwrap_or_default(),
                (_, years) => 1.0 / years.unwrap_or(f64::INFINITY),
            };
            let same = [given[row].pga_m_s2, given[row].pgv_m_s, mw[row].unwrap_or(0.0)].map(f64::to_bits);
            if let Some(first) = lines.insert(same, line).filter(|_| years.is_none()) {
                let found = format!("lines {first} and {line}: the same PGA, PGV and magnitude");
                return Err(InputError::unexpected(found, "one row of each bin"));
            }
            bins.push(PairOfPeaks { peaks: given[row].clamp_to_recorded(), annual_rate, mw: mw[row] });
        }
        validate_hazard("PGA", &exceedance(&bins, |bin| bin.peaks.pga_m_s2 / G_M_S2))
            .and_then(|()| validate_hazard("PGV", &exceedance(&bins, |bin| bin.peaks.pgv_m_s)))
            .map_err(InputError::Implausible)?;
        self.joint = Some(bins);
        Ok(())
    }

    /// Adds a curve, unless another column of its file has said the same.
    fn add_curve(&mut self, curve: Curve) -> Result<()> {
        const SAME: f64 = 0.1;
        let same = (curve.measure, curve.statistic);
        let Some(known) = self.curves.iter().find(|known| (known.measure, known.statistic) == same) else {
            self.curves.push(curve);
            return Ok(());
        };
        let (measure, first, second) = (curve.measure, &known.file, &curve.file);
        let mut points = curve.curve.points().iter();
        let other = points.find(|(value, rate)| (known.curve.exceedance(*value) / rate).ln().abs() > SAME);
        let found = match other {
            _ if first != second => format!("two curves of {measure}: {first} and {second}"),
            None => return Ok(()),
            Some((_, rate)) => {
                let years = period(1.0 / rate);
                format!("two columns of {measure} that contradict, one of them once in {years} years")
            }
        };
        Err(InputError::unexpected(found, "one"))
    }

    /// Checks that rows and comments are about the site of those before, in this file and in others.
    fn expect_one_site(&mut self, grid: &Grid) -> Result<()> {
        const SAME: f64 = 1e-4;
        /// North and east.
        const NEAR_KM: f64 = 1.5;
        const KM_PER_DEGREE: f64 = 111.2;
        let keys = ["lat", "lon", "latitude", "longitude", "vs30"].into_iter();
        let noted = keys.filter_map(|key| Some((key, openquake::noted(grid, key)?)));
        let places = grid.headings.iter().enumerate().filter(|(_, heading)| means(&heading.name, "place"));
        let in_rows =
            places.flat_map(|(at, heading)| grid.rows().map(move |row| (&*heading.name, grid.cell(row, at))));
        let mut told: Vec<(&str, &str)> = noted.chain(in_rows).collect();
        // A degree of longitude depends on the latitude.
        told.sort_by_key(|(key, _)| !key.starts_with("lat"));
        for (key, value) in told {
            let key = if key.starts_with("lat") || key.starts_with("lon") { &key[..3] } else { key };
            let lat = self.site.get("lat").and_then(|lat| lat.parse().ok()).unwrap_or(0.0_f64);
            let known = self.site.entry(key.to_string()).or_insert(value.to_string());
            let is_same = match (known.parse::<f64>(), value.parse::<f64>()) {
                (Ok(known), Ok(value)) => {
                    let most = match key {
                        "lat" => NEAR_KM / KM_PER_DEGREE,
                        "lon" => NEAR_KM / (KM_PER_DEGREE * lat.to_radians().cos().max(0.01)),
                        _ => SAME * value.abs(),
                    };
                    (known - value).abs() <= most
                }
                _ => known.eq_ignore_ascii_case(value),
            };
            if !is_same {
                return Err(InputError::unexpected(format!("{key} {known} and {value}"), "one site"));
            }
        }
        Ok(())
    }
}

/// Refuses what holds no table, by what it is.
fn expect_table(path: &Path) -> Result<()> {
    let (file, _) = source::split_sheet(path);
    let bytes = source::read(&file).unwrap_or_default();
    let found = match bytes.trim_ascii_start() {
        [b'{' | b'[', ..] => "JSON, as of a web service",
        start if start.starts_with(b"<?xml") || start.starts_with(b"<nrml") => "XML, as OpenQuake's NRML",
        _ => return Ok(()),
    };
    Err(InputError::unexpected(found, "the same curve as CSV: intensities in g under pga_g, rates under AFE"))
}

/// Refuses columns without a role.
pub fn expect_understood(grid: &Grid, meanings: &[Meaning]) -> Result<()> {
    let unknown =
        grid.headings.iter().zip(meanings).filter(|(_, meaning)| **meaning == Meaning::NotUnderstood);
    let unknown: Vec<&str> = unknown.map(|(heading, _)| heading.text.as_str()).collect();
    if unknown.is_empty() {
        return Ok(());
    }
    let expected = "columns that say a peak, a rate or a place; --ignore HEADING,... leaves others out";
    Err(InputError::not_understood(Some(&unknown.join(",")), expected, grid.found()))
}

/// Columns of values, each with those of frequencies that may belong to it: those before or behind it up to
/// the next, where each has its own, else all.
fn pairs(columns: &[HazardColumn]) -> Vec<[&HazardColumn; 2]> {
    let of_curves: Vec<&HazardColumn> = columns.iter().filter(|column| column.is_of_curve()).collect();
    for ordered in [of_curves.clone(), of_curves.iter().rev().copied().collect()] {
        let blocks: Vec<_> = ordered.chunk_by(|_, next| next.unit.is_none()).collect();
        if blocks.iter().all(|block| block[0].unit.is_some() && block.len() > 1) {
            return blocks
                .iter()
                .flat_map(|block| block[1..].iter().map(|rates| [block[0], *rates]))
                .collect();
        }
    }
    let (values, rates): (Vec<_>, Vec<_>) = of_curves.into_iter().partition(|column| column.unit.is_some());
    values.iter().flat_map(|values| rates.iter().map(|rates| [*values, *rates])).collect()
}

/// The error of a table without a curve, with the heading that is not understood first.
fn not_understood(grid: &Grid, columns: &[HazardColumn]) -> InputError {
    let expected = "a row for each intensity: PGA (g), PGV (m/s) or SA(1.0 s) (g), and \
                    annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period; \
                    --columns pga_g=HEADING names one";
    let is_unknown = |column: &&HazardColumn| {
        let heading = &grid.headings[column.at];
        !(column.is_of_curve() || heading.text.is_empty() || means(&heading.name, "place"))
    };
    let unknown = columns.iter().find(is_unknown).map(|column| &*grid.headings[column.at].text);
    InputError::not_understood(unknown, expected, grid.found())
}

/// The points of a column of values and one of frequencies.
fn points(grid: &Grid, values: &HazardColumn, rates: &HazardColumn) -> Result<Vec<CurvePoint>> {
    let (unit, frequency) = (values.unit.unwrap_or(f64::NAN), rates.frequency.unwrap_or(Frequency::Rate));
    let points = grid.intensities(values.at, unit)?.into_iter().enumerate().map(|(row, value)| {
        let annual_rate = frequency.annual_rate(grid, row, rates.at)?;
        Ok(CurvePoint { value, annual_rate, row, column: rates.at })
    });
    points.collect()
}
