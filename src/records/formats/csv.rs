//! Columns of a table: accelerations, one motion each, with or without times. Headings and comments name
//! units, time steps and quantities; options of the user must not contradict them.

use super::error::RecordFileError;
use super::header::{azimuth_of, expect_step, expect_unit, first_number, given_unit, time_step};
use crate::inputs::words::is_vertical;
use crate::inputs::{Grid, Heading};
use crate::motion::measures::peak;
use crate::records::{ReadOptions, RecordedMotion};
use crate::units::{Quantity, Unit};

const DAY_S: f64 = 86400.0;
/// Accepted relative difference of a step of time from the usual one.
const UNEVEN: f64 = 0.05;
/// Relative difference of the peaks of two columns up to which they are one motion, such as in two units.
const SAME_PEAK: f64 = 1e-3;
/// Names of horizontal components without an azimuth.
const HORIZONTAL: [&str; 10] =
    ["L", "T", "R", "LONG", "TRAN", "TRANS", "LONGITUDINAL", "TRANSVERSE", "RADIAL", "TANGENTIAL"];

/// Words of a heading for a motion that stands beside another state of it.
const PROCESSED: [&str; 5] = ["filtered", "corrected", "uncorrected", "raw", "processed"];

/// A table of samples.
struct Samples<'a> {
    grid: Grid,
    /// Comments, and lines above the headings.
    notes: Vec<Heading>,
    /// The line of the first row.
    line: usize,
    options: &'a ReadOptions,
}

/// Reads the motions in a table.
pub fn parse(bytes: &[u8], options: &ReadOptions) -> Result<Vec<RecordedMotion>, RecordFileError> {
    let grid = Grid::parse(bytes, None)?;
    let first = grid.lines.first().filter(|_| (0..grid.columns).any(|column| grid.number(0, column).is_ok()));
    let Some(&line) = first else {
        let heading = grid.headings.first().map(|heading| &heading.text);
        let found = grid.notes.first().or(heading).cloned().unwrap_or_default();
        return Err(RecordFileError::Unrecognised { found });
    };
    let notes = grid.notes.iter().map(|note| Heading::new(note)).collect();
    Samples { grid, notes, line, options }.motions()
}

impl Samples<'_> {
    fn motions(&self) -> Result<Vec<RecordedMotion>, RecordFileError> {
        let noted = self.notes.iter().find_map(noted_step).or_else(|| noted_frequency(&self.grid.notes));
        let choice = self.options.column.as_deref();
        if choice == Some("all") {
            let series = self.series()?;
            self.expect_one_series()?;
            return Ok(vec![self.motion(None, series, noted)?]);
        }
        self.expect_one_series()?;
        let quantities = self.quantities();
        let columns = match choice {
            Some(choice) => vec![self.chosen(choice, &quantities)?],
            None => self.accelerations(&quantities)?,
        };
        let mut found = noted;
        if let Some(times) = self.times(&quantities) {
            let step = self.step(times)?;
            expect_step(&ReadOptions { dt_s: noted, ..ReadOptions::default() }, step, self.line)?;
            found = Some(step);
        }
        let mut motions = Vec::<RecordedMotion>::new();
        for &column in &columns {
            let mut samples = self.numbers(column)?;
            if self.grid.headings.is_empty() && found.is_none() {
                self.expect_no_other_step(column)?;
                drop_header(&mut samples, self.options.dt_s);
            }
            let read = self.motion(Some(column), samples, found)?;
            let pga = peak(&read.acceleration_m_s2);
            let is_same = |other: &RecordedMotion| {
                (peak(&other.acceleration_m_s2) - pga).abs() < SAME_PEAK * pga
                    || read.azimuth_deg.is_some() && other.azimuth_deg == read.azimuth_deg
            };
            if motions.iter().any(is_same) {
                return Err(self.which_column());
            }
            motions.push(read);
        }
        Ok(motions)
    }

    /// The motion of samples from a column, or from all cells, with the time step (s) found in the file.
    fn motion(
        &self,
        column: Option<usize>,
        samples: Vec<f64>,
        found: Option<f64>,
    ) -> Result<RecordedMotion, RecordFileError> {
        let (options, line) = (self.options, self.line);
        if samples.len() < 2 {
            return Err(RecordFileError::Count { announced: 2, found: samples.len() });
        }
        let heading = column.and_then(|column| self.grid.headings.get(column));
        let unit = self.unit(heading)?;
        let expected = "a column of times, or a comment such as dt = 0.005 s";
        let dt_s = options.dt_s.or(found).ok_or(RecordFileError::NoTimeStep { line, expected })?;
        expect_step(options, found.unwrap_or(dt_s), line)?;
        Ok(RecordedMotion {
            component: heading.map(|heading| direction(heading).unwrap_or(&heading.text).to_string()),
            azimuth_deg: heading.and_then(direction).and_then(azimuth_of),
            ..RecordedMotion::new(time_step(dt_s, line)?, samples, unit)
        })
    }

    /// Refuses samples without times among which another line stands: another series may begin there.
    fn expect_one_series(&self) -> Result<(), RecordFileError> {
        let has_times = self.times(&self.quantities()).is_some();
        let gap = self.grid.lines.windows(2).find(|pair| pair[1] != pair[0] + 1).filter(|_| !has_times);
        let short = |pair: &[usize]| RecordFileError::ShortLine {
            line: pair[0] + 1,
            found: 0,
            expected: self.grid.columns,
        };
        gap.map_or(Ok(()), |pair| Err(short(pair)))
    }

    /// Refuses a first line that seems to be a time step: a usual one, written otherwise than the samples.
    fn expect_no_other_step(&self, column: usize) -> Result<(), RecordFileError> {
        const USUAL_S: [f64; 9] = [0.001, 0.002, 0.0025, 0.004, 0.005, 0.01, 0.02, 0.04, 0.05];
        let decimals = |row: usize| self.grid.cell(row, column).split(['.', ',']).nth(1).map(str::len);
        let first = self.grid.number(0, column)?;
        match USUAL_S.contains(&first) && self.grid.lines.len() > 1 && decimals(0) != decimals(1) {
            true => expect_step(self.options, first, self.line),
            false => Ok(()),
        }
    }

    /// Reads a column.
    fn numbers(&self, column: usize) -> Result<Vec<f64>, RecordFileError> {
        (0..self.grid.lines.len()).map(|row| Ok(self.grid.number(row, column)?)).collect()
    }

    /// Reads all cells as one series, of which the last row alone may be short: another one shows that the
    /// file has several series, or is damaged.
    fn series(&self) -> Result<Vec<f64>, RecordFileError> {
        let (grid, mut series) = (&self.grid, Vec::new());
        for (row, &line) in grid.lines.iter().enumerate() {
            let found = (0..grid.columns).take_while(|&column| !grid.cell(row, column).is_empty()).count();
            if found < grid.columns && row + 1 < grid.lines.len() {
                return Err(RecordFileError::ShortLine { line, found, expected: grid.columns });
            }
            for column in 0..found {
                series.push(grid.number(row, column)?);
            }
        }
        Ok(series)
    }

    /// Finds the quantity of each column from its heading. An unnamed first column that rises is time.
    fn quantities(&self) -> Vec<Option<Quantity>> {
        let grid = &self.grid;
        let are_components = grid.headings.iter().any(|heading| matches!(&*heading.name, "l" | "r"));
        let mut quantities: Vec<Option<Quantity>> =
            grid.headings.iter().map(|heading| quantity(heading, are_components)).collect();
        quantities.resize(grid.columns, None);
        let may_be_time = grid.columns > 1 && !quantities.contains(&Some(Quantity::Time));
        if may_be_time && quantities[0].is_none() {
            let is_time = clock_s(grid.cell(0, 0)).is_some()
                || self.numbers(0).is_ok_and(|times| times.is_sorted_by(|time, next| time < next));
            quantities[0] = is_time.then_some(Quantity::Time);
        }
        quantities
    }

    /// The column of times: of numbers, else of a clock.
    fn times(&self, quantities: &[Option<Quantity>]) -> Option<usize> {
        let mut times: Vec<usize> = (0..self.grid.columns).collect();
        times.retain(|&column| quantities[column] == Some(Quantity::Time));
        let numeric = times.iter().find(|&&column| self.grid.number(0, column).is_ok());
        numeric.or(times.first()).copied()
    }

    /// The column that the user names by its number or heading.
    fn chosen(&self, choice: &str, quantities: &[Option<Quantity>]) -> Result<usize, RecordFileError> {
        let mut headings = self.grid.headings.iter();
        let column = match choice.parse::<usize>() {
            Ok(number) => number.checked_sub(1),
            Err(_) => headings.position(|heading| heading.text == choice || heading.name == choice),
        };
        match column.and_then(|column| Some((column, *quantities.get(column)?))) {
            Some((column, None | Some(Quantity::Acceleration))) => Ok(column),
            Some((_, Some(other))) => {
                let found = format!("{other:?}").to_lowercase();
                Err(RecordFileError::NotAcceleration { line: self.line, found })
            }
            None => Err(self.which_column()),
        }
    }

    /// Finds the columns of acceleration: those with such a heading, those of directions, or the only one
    /// that may be it.
    fn accelerations(&self, quantities: &[Option<Quantity>]) -> Result<Vec<usize>, RecordFileError> {
        let (grid, line) = (&self.grid, self.line);
        if let Some(heading) = grid.headings.iter().find(|heading| is_of_spectrum(heading)) {
            let found = format!("'{}': a spectrum", heading.text);
            return Err(RecordFileError::NotAcceleration { line, found });
        }
        let (mut named, mut unknown, mut directions) = (Vec::new(), Vec::new(), Vec::new());
        for column in (0..grid.columns).filter(|&column| !grid.cell(0, column).is_empty()) {
            match quantities[column] {
                Some(Quantity::Acceleration) => named.push(column),
                Some(_) => {}
                None => {
                    unknown.push(column);
                    directions.extend(grid.headings.get(column).and_then(direction).map(|_| column));
                }
            }
        }
        let is_processed = |column: &usize| {
            let words = grid.headings.get(*column).map_or("", |heading| &*heading.name).split('_');
            words.into_iter().any(|word| PROCESSED.contains(&word))
        };
        match (named.is_empty(), directions.len(), unknown.len()) {
            // The same motion before and after.
            (false, ..) if named.len() > 1 && named.iter().any(is_processed) => Err(self.which_column()),
            (false, ..) => Ok(named),
            (.., 1) => Ok(unknown),
            (.., 0) => Err(RecordFileError::NotAcceleration { line, found: self.columns() }),
            // One alone may be a number n, or s for a time.
            (_, 2.., _) => Ok(directions),
            _ => Err(self.which_column()),
        }
    }

    fn columns(&self) -> String {
        let texts: Vec<&str> = self.grid.headings.iter().map(|heading| heading.text.as_str()).collect();
        format!("{} columns {}", self.grid.columns, texts.join(", "))
    }

    fn which_column(&self) -> RecordFileError {
        RecordFileError::Column { columns: self.columns() }
    }

    /// Finds the unit in the heading, else in a comment on acceleration or units, else among the options.
    fn unit(&self, heading: Option<&Heading>) -> Result<Unit, RecordFileError> {
        let (options, line) = (self.options, self.line);
        if let Some(heading) = heading.filter(|heading| heading.is_scaled && options.unit.is_none()) {
            let expected = "a unit without a factor, or --unit";
            return Err(RecordFileError::value(line, "unit", &heading.text, expected));
        }
        let notes = self
            .notes
            .iter()
            .filter(|note| ["acc", "unit", "vel", "dis"].iter().any(|word| note.name.contains(word)));
        let noted = notes.filter_map(|note| note.unit).next();
        match heading.and_then(|heading| heading.unit).or(noted) {
            None => given_unit(options, line),
            Some(unit) if unit.quantity != Quantity::Acceleration => {
                Err(RecordFileError::value(line, "unit", unit.name, "one of acceleration, such as m/s2"))
            }
            Some(unit) => expect_unit(options, unit, line).map(|()| unit),
        }
    }

    /// Computes the mean step (s) of a column of evenly spaced times; rounded times need the step that is given.
    fn step(&self, column: usize) -> Result<f64, RecordFileError> {
        let (grid, given) = (&self.grid, self.options.dt_s);
        let unit = grid.headings.get(column).and_then(|heading| heading.unit);
        let in_s = unit.filter(|unit| unit.quantity == Quantity::Time).map_or(1.0, |unit| unit.si);
        let (mut times, mut decimals) = (Vec::new(), 0);
        for row in 0..grid.lines.len() {
            let cell = grid.cell(row, column);
            let time = match clock_s(cell) {
                // Past midnight.
                Some(clock) if times.last().is_some_and(|last| clock < last - 0.5 * DAY_S) => clock + DAY_S,
                Some(clock) => clock,
                None => in_s * grid.number(row, column)?,
            };
            times.push(time);
            decimals = decimals.max(cell.split(['.', ',']).nth(1).map_or(0, str::len));
        }
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut ordered = steps.clone();
        ordered.sort_by(f64::total_cmp);
        let usual = given.or(ordered.get(ordered.len() / 2).copied()).unwrap_or_default();
        // A given step that the decimals cannot represent is off by half a unit of the last one at each end.
        let last_digit = in_s * 10f64.powi(-(decimals.min(300) as i32));
        let in_digits = given.unwrap_or(0.0) / last_digit;
        let is_rounded = (in_digits - in_digits.round()).abs() > 1e-6 * in_digits;
        let rounding = if is_rounded { last_digit } else { 0.0 };
        let most = rounding + UNEVEN * usual.abs();
        if let Some(at) = steps.iter().position(|step| (step - usual).abs() > most) {
            let line = grid.lines[at + 1];
            return Err(RecordFileError::UnevenTime { line, found_s: steps[at], expected_s: usual });
        }
        let mean = (times[times.len() - 1] - times[0]) / steps.len() as f64;
        // Removes digits that the file does not have.
        Ok((mean * 1e12).round() / 1e12)
    }
}

/// The quantity that a heading names; T beside L or R is a component.
fn quantity(heading: &Heading, are_components: bool) -> Option<Quantity> {
    let own = heading.unit.map(|unit| unit.quantity);
    let named = heading.name.split('_').find_map(|word| match word {
        "t" if own == Some(Quantity::Acceleration) || are_components && own.is_none() => None,
        "a" | "ag" => Some(Quantity::Acceleration),
        "t" | "zeit" | "temps" | "date" | "datetime" | "timestamp" => Some(Quantity::Time),
        _ if word.starts_with("acc") => Some(Quantity::Acceleration),
        _ if word.starts_with("time") || word.ends_with("time") => Some(Quantity::Time),
        _ if word.starts_with("vel") => Some(Quantity::Velocity),
        _ if word.starts_with("dis") => Some(Quantity::Length),
        _ => None,
    });
    named.or(own)
}

fn is_of_spectrum(heading: &Heading) -> bool {
    const SPECTRAL: [&str; 7] = ["sa", "psa", "psv", "period", "periods", "frequency", "freq"];
    heading.name.split('_').any(|word| SPECTRAL.contains(&word) || word.starts_with("spectr"))
}

/// The word of a heading that names a direction: N-S, acc_EW, UD (gal), az, acc 90 deg.
fn direction(heading: &Heading) -> Option<&str> {
    let name = heading.text.split(['(', '[', ',']).next().unwrap_or_default();
    let name = name.trim_matches([' ', '.']);
    let last = name.rsplit([' ', '_', '.']).next().unwrap_or_default();
    if let Some(degrees) = name.strip_suffix('\u{b0}').or(name.strip_suffix("deg")) {
        return degrees.trim().rsplit([' ', '_']).next();
    }
    let lower = last.to_ascii_lowercase();
    let short = ["acceleration", "accel", "acc", "a"].into_iter().find(|start| lower.starts_with(start));
    let short = short.map_or("", |start| &last[start.len()..]);
    // Of several instruments one has numbers: N-S2.
    let unnumbered = name.trim_end_matches(|sign: char| sign.is_ascii_digit());
    [name, last, short, unnumbered].into_iter().find(|word| {
        let is_named = HORIZONTAL.contains(&word.to_ascii_uppercase().as_str()) || is_vertical(word);
        word.parse::<f64>().is_err() && (is_named || azimuth_of(word).is_some())
    })
}

/// Drops the number of samples and the time step if they stand above the samples.
fn drop_header(samples: &mut Vec<f64>, dt_s: Option<f64>) {
    let counts = [1, 2].map(|above| samples.len() as f64 - f64::from(above));
    let first = samples.iter().take(2);
    let length = first.take_while(|value| counts.contains(value) || Some(**value) == dt_s).count();
    samples.drain(..length);
}

/// Reads the time of day, s, in a cell such as `2020/01/20 20:13:20.01` or `20:13:20.01Z`.
fn clock_s(cell: &str) -> Option<f64> {
    let (_, time) = cell.rsplit_once([' ', 'T']).unwrap_or(("", cell));
    let mut parts = time.trim_end_matches('Z').split(':').map(|part| part.parse::<f64>().ok());
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next()??);
    Some(3600.0 * hours + 60.0 * minutes + seconds)
}

/// Reads the time step (s) by a comment such as `SamplingFrequency(Hz): 100`, or with the number in the same
/// place of the next one.
fn noted_frequency(notes: &[String]) -> Option<f64> {
    notes.iter().enumerate().find_map(|(at, note)| {
        let mut cells = note.split(',').map(|cell| cell.to_lowercase());
        let place = cells.position(|cell| cell.contains("sampling") && cell.contains("hz"))?;
        let own = note.split(',').nth(place).and_then(first_number);
        let below = || notes.get(at + 1)?.split(',').nth(place).and_then(first_number);
        own.or_else(below).filter(|frequency| *frequency > 0.0).map(|frequency| 1.0 / frequency)
    })
}

/// Reads the time step (s) in a comment such as `dt = 0.01 s`.
fn noted_step(note: &Heading) -> Option<f64> {
    let value = first_number(&note.text).filter(|_| note.name.starts_with("dt_"))?;
    Some(value * note.unit.map_or(1.0, |unit| unit.si))
}
