//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;
mod openquake;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub use self::columns::peak;
use self::columns::{Content, Frequency, Intensity, Statistic, content};
use super::{Grid, Heading, InputError, Renames};
use crate::fragility::Peak;
use crate::hazard::{Hazard, HazardCurve, PairOfPeaks, PeakHazard, PgvPgaRatio, VelocitySource};
use crate::hazard::{exceedance, velocity_of_spectrum};
use crate::motion::Peaks;
use crate::plausibility::{MAGNITUDES, at_rim, judge_hazard, judge_medians};
use crate::units::G_M_S2;
use crate::warning::{Warning, Warnings};

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for. Also returns warnings about columns that are not used.
pub fn read(
    paths: &[PathBuf],
    renames: &mut Renames,
    effective_years: Option<f64>,
) -> Result<(Hazard, Warnings), InputError> {
    let mut found = Found::default();
    for path in paths {
        let mut add = || {
            let mut grid = Grid::read(path)?;
            renames.apply(&mut grid)?;
            found.add(&grid, path, effective_years)
        };
        add().map_err(|error| error.of(path))?;
    }
    let hazard = match (found.joint.pop(), paths) {
        (Some(bins), [path]) => {
            let of_pga = judge_hazard(false, &exceedance(&bins, |bin| bin.peaks.pga_m_s2 / G_M_S2));
            let of_both =
                of_pga.and_then(|()| judge_hazard(true, &exceedance(&bins, |bin| bin.peaks.pgv_m_s)));
            of_both.map_err(|error| InputError::from(error).of(path))?;
            Hazard::Joint(bins)
        }
        (Some(_), _) => {
            let found = "a hazard of PGA and PGV together among others".to_string();
            return Err(InputError::Missing { found, expected: "it alone" });
        }
        (None, _) => Hazard::Curve(joined(&found.curves, &mut found.warnings)?),
    };
    Ok((hazard, found.warnings))
}

/// A curve, and the file that it is from.
struct Curve {
    intensity: Intensity,
    statistic: Statistic,
    curve: HazardCurve,
    file: String,
}

/// The only curve of an intensity.
fn only(curves: &[Curve], intensity: Intensity, statistic: Statistic) -> Result<Option<&Curve>, InputError> {
    let mut same = curves.iter().filter(|curve| (curve.intensity, curve.statistic) == (intensity, statistic));
    match (same.next(), same.next()) {
        (Some(first), Some(second)) => {
            let name = match intensity {
                Intensity::Peak(peak) => peak.to_string().to_uppercase(),
                _ => "SA(1.0 s)".to_string(),
            };
            let found = format!("two curves of {name}: {} and {}", first.file, second.file);
            Err(InputError::Missing { found, expected: "one" })
        }
        (first, _) => Ok(first),
    }
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: &[Curve], warnings: &mut Warnings) -> Result<PeakHazard, InputError> {
    use Intensity::Spectral;
    const PGA: Intensity = Intensity::Peak(Peak::Pga);
    const PGV: Intensity = Intensity::Peak(Peak::Pgv);
    let missing = |found: &str, expected| Err(InputError::Missing { found: found.to_string(), expected });
    for Curve { intensity, statistic, curve, file } in curves {
        only(curves, *intensity, *statistic)?;
        let is_velocity = *intensity == PGV;
        let unit = if is_velocity { 1.0 } else { G_M_S2 };
        let points: Vec<_> = curve.points().iter().map(|(im, rate)| (im / unit, *rate)).collect();
        judge_hazard(is_velocity, &points).map_err(|error| InputError::from(error).of(Path::new(file)))?;
    }
    let mut central = |intensity| -> Result<Option<&HazardCurve>, InputError> {
        if let Some(mean) = only(curves, intensity, Statistic::Mean)? {
            return Ok(Some(&mean.curve));
        }
        let median = only(curves, intensity, Statistic::Median)?;
        warnings
            .extend(median.map(|curve| (Warning::MedianHazard, curve.file.clone())).into_iter().collect());
        Ok(median.map(|curve| &curve.curve))
    };
    let (peak, curve, velocity) = match (central(PGA)?, central(PGV)?, central(Spectral)?) {
        (Some(pga), Some(pgv), _) => {
            (Peak::Pga, pga, Some(PgvPgaRatio::by_curves(pga, pgv, VelocitySource::Velocity)?))
        }
        (Some(pga), None, Some(spectral)) => {
            let pgv = velocity_of_spectrum(pga, spectral);
            (Peak::Pga, pga, Some(PgvPgaRatio::by_curves(pga, &pgv, VelocitySource::Spectrum)?))
        }
        (Some(pga), None, None) => (Peak::Pga, pga, None),
        (None, _, Some(_)) => return missing("SA(1.0 s) without PGA", "the curve of PGA too"),
        (None, Some(pgv), None) => (Peak::Pgv, pgv, None),
        (None, None, None) => return missing("fractiles alone", "the mean curve too"),
    };
    let low = only(curves, Intensity::Peak(peak), Statistic::Low)?;
    let high = only(curves, Intensity::Peak(peak), Statistic::High)?;
    let fractiles = low.zip(high).map(|(low, high)| [low.curve.clone(), high.curve.clone()]);
    Ok(PeakHazard { peak, curve: curve.clone(), fractiles, velocity })
}

/// A column of intensities, with its unit in m/s2 or m/s.
struct IntensityColumn {
    at: usize,
    intensity: Intensity,
    unit: f64,
    statistic: Statistic,
    /// Whether its heading names no measure: `Ground Motion (g)`.
    is_general: bool,
}

/// A column of frequencies, and the intensity that its heading names.
struct FrequencyColumn {
    at: usize,
    frequency: Frequency,
    of: Option<Intensity>,
    statistic: Statistic,
}

/// The columns of a table by what they say.
#[derive(Default)]
struct Columns {
    intensities: Vec<IntensityColumn>,
    frequencies: Vec<FrequencyColumn>,
    magnitude: Option<usize>,
    period: Option<usize>,
    unknown: Vec<usize>,
}

impl Columns {
    fn new(grid: &Grid) -> Columns {
        let (years, mut columns) = (openquake::investigation_years(grid), Columns::default());
        for (at, heading) in grid.headings.iter().enumerate() {
            match content(heading, years) {
                (Content::Intensity(intensity, unit), statistic) => {
                    let is_named = |word: &str| matches!(word, "pga" | "pgv" | "ag" | "sa");
                    let is_general = !heading.name.split('_').any(is_named);
                    let column = IntensityColumn { at, intensity, unit, statistic, is_general };
                    columns.intensities.push(column);
                }
                (Content::Frequency(frequency, of), statistic) => {
                    columns.frequencies.push(FrequencyColumn { at, frequency, of, statistic });
                }
                (Content::Magnitude, _) => columns.magnitude = Some(at),
                (Content::Period, _) => columns.period = Some(at),
                (Content::Unknown, _) => columns.unknown.push(at),
            }
        }
        columns
    }

    /// The column of a peak, and its unit.
    fn peak(&self, peak: Peak) -> Option<(usize, f64)> {
        let found = self.intensities.iter().find(|column| column.intensity == Intensity::Peak(peak));
        found.map(|column| (column.at, column.unit))
    }
}

#[derive(Default)]
struct Found {
    curves: Vec<Curve>,
    joint: Vec<Vec<PairOfPeaks>>,
    /// About columns that say nothing of the curves, and about medians.
    warnings: Warnings,
}

impl Found {
    fn add(&mut self, grid: &Grid, path: &Path, effective_years: Option<f64>) -> Result<(), InputError> {
        let file = path.display().to_string();
        let starts = |start: &str| grid.headings.iter().any(|heading| heading.text.starts_with(start));
        one_site(grid)?;
        if starts("gmv_") {
            let bins = openquake::fields(grid, effective_years)?;
            return self.add_joint(bins, file);
        }
        if effective_years.is_some() {
            return Err(InputError::Missing {
                found: "--effective-years".to_string(),
                expected: "ground-motion fields of OpenQuake (gmv_PGA, gmv_PGV) with it",
            });
        }
        if starts("poe-") {
            self.curves.push(openquake::probabilities(grid, &file)?);
            return Ok(());
        }
        self.add_columns(grid, file)
    }

    /// Adds motions with both peaks; those beyond any record count at the rim.
    fn add_joint(&mut self, mut bins: Vec<PairOfPeaks>, file: String) -> Result<(), InputError> {
        judge_medians(bins.iter().map(|bin| bin.peaks))?;
        let mut beyond = 0;
        for bin in &mut bins {
            let peaks = at_rim(bin.peaks);
            beyond += usize::from(peaks != bin.peaks);
            bin.peaks = peaks;
        }
        let rim =
            (beyond > 0).then(|| (Warning::AtRim, format!("{beyond} of {} rows of {file}", bins.len())));
        self.warnings.extend(rim.into_iter().collect());
        self.joint.push(bins);
        Ok(())
    }

    /// Adds the curves of a table, or its joint hazard, by what its headings say.
    fn add_columns(&mut self, grid: &Grid, file: String) -> Result<(), InputError> {
        let mut columns = Columns::new(grid);
        refuse_other_tables(grid, &columns)?;
        let occurrence = columns.frequencies.iter().find(|column| column.frequency == Frequency::Occurrence);
        let magnitude = columns.magnitude.filter(|_| occurrence.is_none());
        let is_told =
            |at: &usize| grid.number(0, *at).is_ok() && !PLACES.contains(&grid.headings[*at].name.as_str());
        let unused = columns.unknown.iter().copied().chain(magnitude);
        if let Some(rate) = occurrence.map(|column| column.at) {
            self.add_joint(joint(grid, rate, &columns)?, file)?;
        } else {
            columns.frequencies = without_repetition(grid, std::mem::take(&mut columns.frequencies))?;
            let before = self.curves.len();
            for intensity in &columns.intensities {
                for frequency in &columns.frequencies {
                    self.curves.extend(curve_of(grid, intensity, frequency, &file)?);
                }
            }
            if before == self.curves.len() {
                return Err(not_understood(grid, &columns));
            }
        }
        let unused = unused.filter(|at| !grid.lines.is_empty() && is_told(at));
        let unused = unused.map(|at| (Warning::UnusedColumns, grid.headings[at].text.clone()));
        self.warnings.extend(unused.collect());
        Ok(())
    }
}

/// Refuses a spectrum, and a row of levels without a measure.
fn refuse_other_tables(grid: &Grid, columns: &Columns) -> Result<(), InputError> {
    // OpenQuake's spectra have headings such as `0.002105~PGA`: the probability, and the intensity.
    let is_uniform = grid.headings.iter().any(|heading| heading.text.contains('~'));
    if is_uniform || (columns.period.is_some() && columns.frequencies.is_empty()) {
        return Err(InputError::Missing {
            found: "a uniform hazard spectrum: one rate, many periods".to_string(),
            expected: "a hazard curve: PGA, best with SA(1.0 s), at several rates",
        });
    }
    let levels: Vec<f64> = grid.headings.iter().filter_map(|heading| heading.text.parse().ok()).collect();
    if let [first, .., last] = levels[..]
        && levels.len() > 2
        && columns.frequencies.is_empty()
    {
        let found = format!("a column for each level from {first} to {last}");
        let expected = "to know of which measure, and whether rates or probabilities: a row for each level, \
                        under pga_g and annual_rate_of_exceedance";
        return Err(InputError::Missing { found, expected });
    }
    Ok(())
}

/// The error of a table without intensities or frequencies: the heading that is not understood first.
fn not_understood(grid: &Grid, columns: &Columns) -> InputError {
    let expected = match columns.intensities.iter().any(|column| column.intensity == Intensity::Other) {
        true => "PGA (with g or m/s2): of spectral accelerations only that at 1 s is of use, beside PGA",
        false if columns.intensities.is_empty() => {
            "PGA (with g or m/s2), PGV (with m/s) or SA(1.0 s) (with g), by name or by --columns \
             pga_g=HEADING"
        }
        false => {
            "annual_rate_of_exceedance, probability_of_exceedance_in_50_years or return_period, by name or by \
             --columns annual_rate_of_exceedance=HEADING"
        }
    };
    let is_place = |heading: &Heading| PLACES.contains(&heading.name.as_str());
    let unknown = columns.unknown.iter().map(|at| &grid.headings[*at]).find(|heading| !is_place(heading));
    match unknown {
        Some(heading) => InputError::Heading { heading: heading.text.clone(), expected, found: grid.found() },
        None => InputError::Missing { found: grid.found(), expected },
    }
}

/// The curve of a column of intensities and one of frequencies, if they belong together.
fn curve_of(
    grid: &Grid,
    intensities: &IntensityColumn,
    frequencies: &FrequencyColumn,
    file: &str,
) -> Result<Option<Curve>, InputError> {
    let IntensityColumn { at, unit, .. } = *intensities;
    let intensity = match frequencies.of {
        Some(of) if of != intensities.intensity => {
            let is_acceleration = intensities.intensity == Intensity::Peak(Peak::Pga);
            Some(of).filter(|_| intensities.is_general && is_acceleration)
        }
        _ => Some(intensities.intensity),
    };
    let intensity = intensity.filter(|intensity| *intensity != Intensity::Other);
    let statistic = match (intensities.statistic, frequencies.statistic) {
        (statistic, Statistic::Mean) | (Statistic::Mean, statistic) => Some(statistic),
        _ => None,
    };
    let Some((intensity, statistic)) = intensity.zip(statistic) else { return Ok(None) };
    let point = |row| match grid.number(row, at)? {
        value @ 0.0.. => Ok((value * unit, frequencies.frequency.annual_rate(grid, row, frequencies.at)?)),
        _ => Err(grid.refusal(row, at, "an intensity of 0 or more")),
    };
    let points = (0..grid.lines.len()).map(point).collect::<Result<Vec<_>, _>>()?;
    Ok(Some(Curve { intensity, statistic, curve: curve(points)?, file: file.to_string() }))
}

/// Columns of rates, without those that say the same in another way, of which the first counts; others are
/// refused.
fn without_repetition(grid: &Grid, all: Vec<FrequencyColumn>) -> Result<Vec<FrequencyColumn>, InputError> {
    const SAME: f64 = 0.1;
    let mut kept: Vec<FrequencyColumn> = Vec::new();
    for column in all {
        let is_same = |known: &&FrequencyColumn| (known.statistic, known.of) == (column.statistic, column.of);
        let Some(known) = kept.iter().find(is_same) else {
            kept.push(column);
            continue;
        };
        for row in 0..grid.lines.len() {
            let first = known.frequency.annual_rate(grid, row, known.at)?;
            let rates = first.zip(column.frequency.annual_rate(grid, row, column.at)?);
            if rates.is_some_and(|(a, b)| (a - b).abs() > SAME * a.max(b)) {
                let [first, other] = [known.at, column.at].map(|at| grid.headings[at].text.clone());
                return Err(InputError::Contradiction { line: grid.lines[row], first, other });
            }
        }
    }
    Ok(kept)
}

/// Tables often begin with motions that are certain to come, and end with some that never do: these tell
/// nothing.
fn curve(mut points: Vec<(f64, Option<f64>)>) -> Result<HazardCurve, InputError> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let known = points.into_iter().filter_map(|(intensity, rate)| Some((intensity, rate?)));
    Ok(HazardCurve::new(known.filter(|(intensity, rate)| *intensity != 0.0 && *rate > 0.0).collect())?)
}

/// Bins of PGA and PGV with rates of occurrence, and their magnitudes.
fn joint(grid: &Grid, rate: usize, columns: &Columns) -> Result<Vec<PairOfPeaks>, InputError> {
    let Some(((pga, pga_unit), (pgv, pgv_unit))) = columns.peak(Peak::Pga).zip(columns.peak(Peak::Pgv))
    else {
        let found = "rates of occurrence without PGA and PGV".to_string();
        return Err(InputError::Missing { found, expected: "both, or rates of exceedance" });
    };
    let magnitude = |row: usize, column: usize| match grid.number(row, column)? {
        mw if MAGNITUDES.contains(&mw) => Ok(mw),
        _ => Err(grid.refusal(row, column, "a moment magnitude")),
    };
    let bins = pairs(grid, |row| {
        Ok(PairOfPeaks {
            peaks: Peaks {
                pga_m_s2: grid.number(row, pga)? * pga_unit,
                pgv_m_s: grid.number(row, pgv)? * pgv_unit,
            },
            annual_rate: Frequency::Occurrence.annual_rate(grid, row, rate)?.unwrap_or_default(),
            mw: columns.magnitude.map(|mw| magnitude(row, mw)).transpose()?,
        })
    })?;
    let mut known = BTreeMap::new();
    for (bin, line) in bins.iter().zip(&grid.lines) {
        let same = [bin.peaks.pga_m_s2, bin.peaks.pgv_m_s, bin.mw.unwrap_or(0.0)].map(f64::to_bits);
        if let Some(first) = known.insert(same, line) {
            let found = format!("lines {first} and {line}: the same PGA, PGV and magnitude");
            return Err(InputError::Missing { found, expected: "one row of each bin" });
        }
    }
    Ok(bins)
}

/// The motions of all rows.
fn pairs(
    grid: &Grid,
    bin: impl Fn(usize) -> Result<PairOfPeaks, InputError>,
) -> Result<Vec<PairOfPeaks>, InputError> {
    match (0..grid.lines.len()).map(bin).collect::<Result<Vec<_>, _>>()? {
        bins if bins.is_empty() => {
            Err(InputError::Missing { found: "no rows".to_string(), expected: "motions with PGA and PGV" })
        }
        bins => Ok(bins),
    }
}

/// Headings of the place of a site.
const PLACES: [&str; 9] =
    ["site", "site_id", "custom_site_id", "lon", "lat", "longitude", "latitude", "location", "name"];

/// Checks that no column of places has two.
fn one_site(grid: &Grid) -> Result<(), InputError> {
    for (at, heading) in grid.headings.iter().enumerate() {
        let is_place = PLACES.contains(&heading.name.as_str());
        if is_place && (0..grid.lines.len()).any(|row| grid.cell(row, at) != grid.cell(0, at)) {
            let found = format!("column '{}': rows of several sites", heading.text);
            return Err(InputError::Missing { found, expected: "those of one" });
        }
    }
    Ok(())
}
