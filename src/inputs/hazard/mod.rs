//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;
mod openquake;
mod told;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Hazard, HazardCurve, PairOfPeaks, PgvPgaRatio, VelocitySource, exceedance};
use rockfrag_core::plausibility::{validate_hazard, validate_spectrum};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{Warning, Warnings};

use self::columns::{Frequency, Imt, Phrase, Statistic};
pub use self::columns::{contradict, peak};
pub use self::told::Told;
use self::told::noted;
use super::intensities::{MotionTable, motions};
use super::words::means;
use super::{Grid, Heading, InputError, Meaning, Reader, Result};

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
    let told = Told { years: Some(1.0), ..Told::default() };
    // t and time (s) are of a record.
    let is_time = heading.name.len() < 2 || heading.unit.is_some_and(|unit| unit.name == "s");
    is_exported || !is_time && Phrase::of(heading, &told).frequency.is_some()
}

struct Curve {
    measure: Imt,
    statistic: Statistic,
    curve: HazardCurve,
    file: String,
}

impl Curve {
    /// Makes a curve, which some place on earth can have, of columns of values and of frequencies. Tables may
    /// begin with motions that are certain to come, and end with some that never do: these tell nothing.
    fn new(
        of: (Imt, Statistic),
        [at, rates]: [usize; 2],
        columns: &[Phrase],
        grid: &Grid,
        file: &Path,
    ) -> Result<Curve> {
        let unit = columns[at].of_values.unwrap_or(f64::NAN);
        let frequency = columns[rates].frequency.unwrap_or(Frequency::Rate);
        let points = grid.intensities(at, unit)?.into_iter().zip(grid.rows());
        let points = points.map(|(value, row)| Ok((value, frequency.annual_rate(grid, row, rates)?, row)));
        let mut points = points.collect::<Result<Vec<(f64, f64, usize)>>>()?;
        points.retain(|(value, ..)| *value != 0.0);
        points.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
        let is_wrong = |pair: &&[(f64, f64, usize)]| pair[1].0 == pair[0].0 || pair[1].1 > pair[0].1;
        if let Some(pair) = points.windows(2).find(is_wrong) {
            let expected = "one row of each intensity, and none more frequent than weaker ones";
            return Err(grid.refusal(pair[1].2, rates, expected));
        }
        let known = points.into_iter().map(|(value, rate, _)| (value, rate));
        let known = known.filter(|(_, rate)| *rate > 0.0 && rate.is_finite()).collect();
        Curve::of_points(of, known, file)
    }

    /// Of intensities in SI units with their annual rates.
    fn of_points(
        (measure, statistic): (Imt, Statistic),
        points: Vec<(f64, f64)>,
        file: &Path,
    ) -> Result<Curve> {
        let (curve, unit) = (HazardCurve::new(points)?, measure.unit());
        let points: Vec<_> = curve.points().iter().map(|(value, rate)| (value / unit, *rate)).collect();
        validate_hazard(&measure.to_string(), &points).map_err(InputError::Implausible)?;
        Ok(Curve { measure, statistic, curve, file: file.display().to_string() })
    }
}

/// The hazard of mean curves: `pga` and `sa_1s` in g, `pgv` in m/s, with annual rates.
pub fn of_points(curves: Vec<(&str, Vec<(f64, f64)>)>) -> Result<Hazard> {
    let curve = |(name, points): (&str, Vec<(f64, f64)>)| {
        let measure = match name {
            "pga" => Imt::Pga,
            "pgv" => Imt::Pgv,
            _ => Imt::SA_1S,
        };
        let points = points.into_iter().map(|(value, rate)| (value * measure.unit(), rate)).collect();
        let curve = Curve::of_points((measure, Statistic::Mean), points, Path::new(name));
        curve.map_err(|error| error.in_file(Path::new(name)))
    };
    let curves = curves.into_iter().map(curve).collect::<Result<Vec<_>>>()?;
    joined(&curves, &mut Warnings::default())
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: &[Curve], warnings: &mut Warnings) -> Result<Hazard> {
    let find = |measure, statistic| {
        curves.iter().find(|curve| curve.measure == measure && curve.statistic == statistic)
    };
    let central = |measure| find(measure, Statistic::Mean).or(find(measure, Statistic::Median));
    let (pga, pgv) = (central(Imt::Pga), central(Imt::Pgv));
    let spectral = central(Imt::SA_1S).filter(|_| pgv.is_none());
    let Some(main) = pga.or(pgv) else {
        let found = if spectral.is_some() { "SA(1.0 s) without PGA" } else { "fractiles alone" };
        return Err(InputError::unexpected(found, "the mean curve of PGA too"));
    };
    let mut hazard = match (pga, spectral) {
        (Some(pga), Some(spectral)) => {
            if pga.curve == spectral.curve {
                return Err(InputError::unexpected("SA(1.0 s) as PGA, at all rates", "the curves of both"));
            }
            let points = spectral.curve.points().iter();
            validate_spectrum(points.map(|(sa, rate)| sa / pga.curve.intensity(*rate)))
                .map_err(|error| InputError::Implausible(error).in_file(Path::new(&spectral.file)))?;
            Hazard::with_spectrum(pga.curve.clone(), &spectral.curve)?
        }
        (Some(pga), None) => Hazard::over(Peak::Pga, pga.curve.clone()),
        (None, _) => Hazard::over(Peak::Pgv, main.curve.clone()),
    };
    let [low, high] = [Statistic::Low, Statistic::High]
        .map(|statistic| find(main.measure, statistic).map(|curve| curve.curve.clone()));
    if low.is_some() != high.is_some() {
        let found = format!("one fractile of {}", main.measure);
        return Err(InputError::unexpected(found, "both the 16 % and the 84 % curve, or neither"));
    }
    let medians = [pga, pgv, spectral].into_iter().flatten();
    let medians: Vec<&Curve> = medians.filter(|curve| curve.statistic == Statistic::Median).collect();
    if let Hazard::Curve(hazard) = &mut hazard {
        hazard.warnings.extend(medians.first().map(|_| Warning::MedianHazard));
        hazard.fractiles = low.zip(high).map(<[HazardCurve; 2]>::from);
        if let (Some(pga), Some(pgv)) = (pga, pgv) {
            hazard.pgv_pga = Some(PgvPgaRatio::by_curves(&pga.curve, &pgv.curve, VelocitySource::Pgv)?);
        }
    }
    medians.iter().for_each(|curve| warnings.add(Warning::MedianHazard, curve.file.clone()));
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
        let mut grid = reader.read(path)?;
        self.expect_one_site(&grid)?;
        let [are_fields, is_exported] =
            ["gmv_", "poe-"].map(|start| grid.headings.iter().any(|heading| heading.text.starts_with(start)));
        if are_fields != effective_years.is_some() {
            let found = if are_fields { "ground-motion fields alone" } else { "--effective-years alone" };
            let expected = "ground-motion fields of OpenQuake (gmv_PGA, gmv_PGV) with --effective-years: \
                            investigation time x stochastic event sets x branches";
            return Err(InputError::unexpected(found, expected));
        }
        openquake::name_fields(&mut grid);
        let mut told = Told::new(&grid, path)?;
        if is_exported {
            grid = openquake::curve(&grid, &mut told)?;
        }
        told.expect_same(&grid.headings)?;
        let mut columns: Vec<Phrase> =
            grid.headings.iter().map(|heading| Phrase::of(heading, &told)).collect();
        let occurrence = columns.iter().position(|column| column.frequency == Some(Frequency::Occurrence));
        let is_joint = are_fields || occurrence.is_some();
        let meanings = columns.iter().enumerate().map(|(at, column)| match column.is_of_curve() {
            true => Meaning::Known(String::new()),
            false => told.meaning(&grid, at, is_joint),
        });
        let mut meanings: Vec<Meaning> = meanings.collect();
        expect_understood(&grid, &meanings)?;
        let are_named = columns.iter().any(|column| column.frequency.is_some() && column.measure().is_some());
        for (at, column) in columns.iter_mut().enumerate().filter(|(_, column)| column.is_of_curve()) {
            if column.of_values.is_none() {
                // Not the years of a return period.
                grid.headings[at].unit = None;
            } else if !are_named {
                column.measures = vec![told.measure(column.measure())?];
            }
            meanings[at] = Meaning::Known(column.meaning());
        }
        match is_joint {
            true => self.add_motions(&grid, occurrence, effective_years)?,
            false => self.add_curves(&grid, &columns, &told, path)?,
        }
        reader.tell(path, &grid, meanings);
        Ok(())
    }

    fn add_curves(&mut self, grid: &Grid, columns: &[Phrase], told: &Told, file: &Path) -> Result<()> {
        let pairs = pairs(columns);
        let named = pairs.iter().map(|pair| pair.iter().find_map(|at| columns[*at].measure()));
        let imts: Vec<Imt> = named.clone().flatten().collect();
        let is_told = told.measures.iter().any(|told| imts.iter().any(|named| named.may_be(*told)));
        if let (Some(named), Some(told), false) = (imts.first(), told.measures.first(), is_told) {
            let found = format!("{named} in a heading and {told} in a comment or name");
            return Err(InputError::unexpected(found, "one of them"));
        }
        let are_unnamed = columns.iter().all(|column| column.statistic.is_none());
        let statistic = told.statistic.filter(|told| are_unnamed || *told == Statistic::Median);
        let (before, mut other) = (self.curves.len(), None);
        for (named, pair) in named.zip(&pairs) {
            match told.measure(named)? {
                measure @ (Imt::Pga | Imt::Pgv | Imt::SA_1S) => {
                    let own = pair.iter().find_map(|at| columns[*at].statistic);
                    let of = (measure, own.or(statistic).unwrap_or(Statistic::Mean));
                    self.add_curve(Curve::new(of, *pair, columns, grid, file)?)?;
                }
                measure => other = Some(measure),
            }
        }
        if let Some(of) = other.filter(|_| before == self.curves.len()) {
            let expected = "that of PGA: of spectral accelerations only SA(1.0 s) is of use, beside PGA";
            return Err(InputError::unexpected(format!("a curve of {of}"), expected));
        }
        let is_single =
            |at: &usize| columns[*at].is_of_curve() && !pairs.iter().flatten().any(|paired| paired == at);
        match (0..columns.len()).find(is_single) {
            Some(at) => Err(InputError::unexpected(grid.headings[at].text.clone(), UNDERSTOOD)),
            None if pairs.is_empty() => Err(InputError::unexpected(grid.found(), UNDERSTOOD)),
            None => Ok(()),
        }
    }

    /// Adds motions with PGA and PGV, their magnitudes, and their annual rates of occurrence: in a column, or
    /// equal in so many effective years.
    fn add_motions(&mut self, grid: &Grid, occurrence: Option<usize>, years: Option<f64>) -> Result<()> {
        let table = motions(grid, &mut self.warnings)?.filter(|table| !table.given.is_empty());
        let Some(MotionTable { given, mw, .. }) = table else {
            let found = format!("{} rows under {}", grid.lines.len(), grid.found());
            return Err(InputError::unexpected(found, "motions with PGA and PGV, or rates of exceedance"));
        };
        let (mut bins, mut lines) = (Vec::new(), BTreeMap::new());
        for (row, line) in grid.lines.iter().enumerate() {
            let annual_rate = match (occurrence, years) {
                (Some(at), None) => Frequency::Occurrence.annual_rate(grid, row, at)?,
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
        let mut known = self.curves.iter();
        let known = known.find(|known| known.measure == curve.measure && known.statistic == curve.statistic);
        let Some(known) = known else {
            self.curves.push(curve);
            return Ok(());
        };
        let is_same = |(value, rate): &(f64, f64)| (known.curve.exceedance(*value) / rate).ln().abs() <= SAME;
        if known.file == curve.file && curve.curve.points().iter().all(is_same) {
            return Ok(());
        }
        let found = format!("two curves of {}: {} and {}", curve.measure, known.file, curve.file);
        Err(InputError::unexpected(found, "one, or columns that do not contradict each other"))
    }

    /// Checks that rows and comments are about the site of those before, in this file and in others.
    fn expect_one_site(&mut self, grid: &Grid) -> Result<()> {
        /// Of latitude, 1.5 km.
        const NEAR_DEGREES: f64 = 0.0135;
        let keys = ["lat", "lon", "latitude", "longitude", "vs30"].into_iter();
        let noted = keys.filter_map(|key| Some((key, noted(grid, key)?)));
        let places = grid.headings.iter().enumerate().filter(|(_, heading)| means(&heading.name, "place"));
        let in_rows =
            places.flat_map(|(at, heading)| grid.rows().map(move |row| (&*heading.name, grid.cell(row, at))));
        for (key, value) in noted.chain(in_rows) {
            let is_degree = key.starts_with("lat") || key.starts_with("lon");
            let key = if is_degree { &key[..3] } else { key };
            let known = self.site.entry(key.to_string()).or_insert(value.to_string());
            let is_same = match (known.parse::<f64>(), value.parse::<f64>()) {
                (Ok(known), Ok(value)) => (known - value).abs() <= if is_degree { NEAR_DEGREES } else { 0.0 },
                _ => known.eq_ignore_ascii_case(value),
            };
            if !is_same {
                return Err(InputError::unexpected(format!("{key} {known} and {value}"), "one site"));
            }
        }
        Ok(())
    }
}

const UNDERSTOOD: &str = "a peak with its unit (pga_g, PGV (m/s)), its rates (AFE, PoE in 50 years, return \
                          period) or a place: --columns pga_g=HEADING names one, --ignore HEADING,... leaves \
                          others out";

pub fn expect_understood(grid: &Grid, meanings: &[Meaning]) -> Result<()> {
    let columns = grid.headings.iter().zip(meanings);
    let unknown = columns.filter(|(_, meaning)| **meaning == Meaning::NotUnderstood);
    let unknown: Vec<&str> = unknown.map(|(heading, _)| heading.text.as_str()).collect();
    if unknown.is_empty() { Ok(()) } else { Err(grid.not_understood(&unknown, UNDERSTOOD)) }
}

/// Columns of values, each with those of frequencies that may belong to it: those before or behind it up to
/// the next, where each has its own, else all.
fn pairs(columns: &[Phrase]) -> Vec<[usize; 2]> {
    let are_values = |at: &usize| columns[*at].of_values.is_some();
    let mut of_curves: Vec<usize> = (0..columns.len()).filter(|at| columns[*at].is_of_curve()).collect();
    if !of_curves.first().is_some_and(are_values) {
        of_curves.reverse();
    }
    let blocks: Vec<&[usize]> = of_curves.chunk_by(|_, next| !are_values(next)).collect();
    let have_own = blocks.iter().all(|block| are_values(&block[0]) && block.len() > 1);
    let blocks = if have_own { blocks } else { vec![&of_curves[..]] };
    let pairs = blocks.into_iter().flat_map(|block| {
        let (values, rates): (Vec<usize>, Vec<usize>) = block.iter().partition(|at| are_values(at));
        values.into_iter().flat_map(move |at| rates.clone().into_iter().map(move |rates| [at, rates]))
    });
    pairs.filter(|[at, rates]| !columns[*at].contradicts(&columns[*rates])).collect()
}
