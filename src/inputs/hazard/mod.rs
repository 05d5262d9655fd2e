//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;
mod openquake;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Hazard, HazardCurve, PairOfPeaks, PgvPgaRatio, VelocitySource, exceedance};
use rockfrag_core::plausibility::{validate_hazard, validate_spectrum};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{Warning, Warnings};

pub use self::columns::peak;
use self::columns::{Frequency, HazardColumn, Imt, Statistic, noted_statistic};
use super::intensities::{MotionTable, motions};
use super::words::means;
use super::{Grid, Heading, InputError, Reader, Result};
use crate::number::period;

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for. Also returns warnings.
pub fn read(
    paths: &[PathBuf],
    reader: &mut Reader,
    effective_years: Option<f64>,
) -> Result<(Hazard, Warnings)> {
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
    Ok((hazard, found.warnings))
}

/// Whether a heading is of a hazard: it says how often, or OpenQuake wrote it.
pub fn is_of_hazard(heading: &Heading) -> bool {
    let is_exported = ["gmv_", "poe-"].iter().any(|start| heading.text.starts_with(start));
    is_exported || HazardColumn::new(0, heading, Some(1.0)).frequency.is_some()
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
    let spectral = central(Imt::Spectral).filter(|_| pgv.is_none());
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
    let fractiles = find(main.measure, Statistic::Low).zip(find(main.measure, Statistic::High));
    let used = [pga, pgv, spectral, fractiles.map(|(low, _)| low), fractiles.map(|(_, high)| high)];
    let used: Vec<&Curve> = used.into_iter().flatten().collect();
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
    /// About medians.
    warnings: Warnings,
}

impl Found {
    /// Adds what is in a file, by what its headings say.
    fn add(&mut self, path: &Path, reader: &mut Reader, effective_years: Option<f64>) -> Result<()> {
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
            (false, None) if is_exported => return self.add_curve(openquake::probabilities(&grid, path)?),
            (false, None) => {}
        }
        let years = openquake::investigation_years(&grid);
        let columns = (0..).zip(&grid.headings).map(|(at, heading)| HazardColumn::new(at, heading, years));
        let mut columns: Vec<HazardColumn> = columns.collect();
        if columns.iter().all(|column| column.statistic == Statistic::Mean) {
            let statistic = noted_statistic(&grid)?;
            columns.iter_mut().for_each(|column| column.statistic = statistic);
        }
        let occurrence = columns.iter().position(|column| column.frequency == Some(Frequency::Occurrence));
        let is_joint = are_fields || occurrence.is_some();
        if is_joint {
            self.add_motions(&grid, occurrence, effective_years)?;
        } else {
            let before = self.curves.len();
            for values in columns.iter().filter(|column| column.unit.is_some()) {
                for rates in columns.iter().filter(|column| column.frequency.is_some()) {
                    let curve = curve_of(&grid, values, rates, path)?;
                    curve.map_or(Ok(()), |curve| self.add_curve(curve))?;
                }
            }
            if before == self.curves.len() {
                return Err(not_understood(&grid, &columns));
            }
        }
        Ok(())
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
        const NEAR_KM: f64 = 1.0;
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

/// The error of a table without a curve: a spectrum, a row of levels without a measure, or the heading that is
/// not understood first.
fn not_understood(grid: &Grid, columns: &[HazardColumn]) -> InputError {
    let others = columns.iter().filter(|column| !column.is_of_curve());
    let mut others = others.map(|column| &grid.headings[column.at]);
    // OpenQuake's spectra have headings such as `0.002105~PGA`: the probability, and the intensity.
    let is_uniform = grid.headings.iter().any(|heading| heading.text.contains('~'));
    if is_uniform || others.clone().any(|heading| means(&heading.name, "spectral-period")) {
        let found = "a uniform hazard spectrum: one rate, many periods";
        return InputError::unexpected(found, "a hazard curve: PGA, best with SA(1.0 s), at several rates");
    }
    let levels: Vec<f64> = grid.headings.iter().filter_map(|heading| heading.text.parse().ok()).collect();
    if let [first, _, .., last] = levels[..] {
        let found = format!("a column for each level from {first} to {last}");
        let expected = "to know of which measure, and whether rates or probabilities: a row for each level, \
                        under pga_g and annual_rate_of_exceedance";
        return InputError::unexpected(found, expected);
    }
    let mut values = columns.iter().filter(|column| column.unit.is_some());
    let expected = if values.clone().any(|column| column.measure == Some(Imt::Other)) {
        "PGA (with g or m/s2): of spectral accelerations only that at 1 s is of use, beside PGA"
    } else if values.next().is_none() {
        "PGA (with g or m/s2), PGV (with m/s) or SA(1.0 s) (with g), by name or by --columns pga_g=HEADING"
    } else {
        "annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period, by name or by \
         --columns annual_rate_of_exceedance=HEADING"
    };
    let is_unknown = |heading: &&Heading| {
        !(heading.text.is_empty() || means(&heading.name, "place") || means(&heading.name, "magnitude"))
    };
    InputError::not_understood(others.find(is_unknown).map(|heading| &*heading.text), expected, grid.found())
}

/// The curve of a column of values and one of frequencies, if they belong together.
fn curve_of(grid: &Grid, values: &HazardColumn, rates: &HazardColumn, file: &Path) -> Result<Option<Curve>> {
    let (Some(unit), Some(frequency)) = (values.unit, rates.frequency) else { return Ok(None) };
    let measure = match (values.measure, rates.measure) {
        (Some(own), Some(other)) if own != other => return Ok(None),
        // An acceleration without a name has that of its rates.
        (None, Some(Imt::Pgv)) => return Ok(None),
        (own, other) => own.or(other).unwrap_or(Imt::Pga),
    };
    let statistic = match (values.statistic, rates.statistic) {
        (statistic, Statistic::Mean) | (Statistic::Mean, statistic) => statistic,
        (own, other) if own == other => own,
        _ => return Ok(None),
    };
    if measure == Imt::Other {
        return Ok(None);
    }
    let mut points = Vec::new();
    for (row, value) in grid.intensities(values.at, unit)?.into_iter().enumerate() {
        let annual_rate = frequency.annual_rate(grid, row, rates.at)?;
        points.push(CurvePoint { value, annual_rate, row, column: rates.at });
    }
    Curve::new((measure, statistic), points, grid, file).map(Some)
}
