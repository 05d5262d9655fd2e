//! Columns of a table: accelerations, one motion each, with or without times. Headings and comments name
//! units, time steps and quantities; options of the user must not contradict them.

use rockfrag_core::motion::measures::peak;
use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::{Quantity, Unit};

use super::ReadOptions;
use super::header::{self, azimuth_of, expect_step, first_number, time_step};
use crate::inputs::words::{is_vertical, joined};
use crate::inputs::{Grid, Heading, InputError, Result};

const DAY_S: f64 = 86400.0;
/// Accepted relative difference of a step of time from the usual one.
const UNEVEN: f64 = 0.05;
/// Relative difference of the peaks of two columns up to which they are one motion, such as in two units.
const SAME_PEAK: f64 = 1e-3;
/// By which factor the peaks of two components in different units may differ.
const FAR_PEAKS: f64 = 5.0;
/// Usual time steps, s: one alone above the samples is none of them.
const USUAL_S: [f64; 9] = [0.001, 0.002, 0.0025, 0.004, 0.005, 0.01, 0.02, 0.04, 0.05];
/// Names of horizontal components without an azimuth.
const HORIZONTAL: [&str; 10] =
    ["L", "T", "R", "LONG", "TRAN", "TRANS", "LONGITUDINAL", "TRANSVERSE", "RADIAL", "TANGENTIAL"];
/// Words of a heading for a motion that stands beside another state of it.
const PROCESSED: [&str; 5] = ["filtered", "corrected", "uncorrected", "raw", "processed"];
/// What is no acceleration over time, and beginnings of words in its headings.
const OTHERS: [(&str, &[&str]); 2] =
    [("a spectrum", &["sa", "psa", "psv", "period", "freq", "spectr"]), ("jerk", &["jerk"])];

struct Samples<'a> {
    grid: Grid,
    quantities: Vec<Option<Quantity>>,
    /// The column of times: of numbers, else of a clock.
    times: Option<usize>,
    /// The line of the first row.
    line: usize,
    options: &'a ReadOptions,
}

pub fn parse(bytes: &[u8], options: &ReadOptions) -> Result<Vec<RecordedMotion>> {
    let table = Samples::new(Grid::parse(bytes, None)?, options)?;
    if options.column.as_deref() == Some("all") {
        let step = noted_step(&table.grid.notes);
        return Ok(vec![table.motion(&Heading::new(""), table.wrapped()?, step)?]);
    }
    let columns = match &options.column {
        Some(choice) => vec![table.chosen(choice)?],
        None => table.accelerations()?,
    };
    table.expect_one_series(false)?;
    let step = table.step()?;
    let mut motions = Vec::<RecordedMotion>::new();
    for column in columns {
        let motion = table.motion(&table.grid.headings[column], table.samples(column, step)?, step)?;
        if motions.iter().any(|other| are_unlike_components(other, &motion)) {
            return Err(table.which_column());
        }
        motions.push(motion);
    }
    Ok(motions)
}

/// Whether two columns cannot both be meant: one motion, such as in two units, two instruments in one
/// direction, or peaks that differ as only those in wrong units do.
fn are_unlike_components(motion: &RecordedMotion, other: &RecordedMotion) -> bool {
    let [pga, other_pga] = [motion, other].map(|motion| peak(&motion.acceleration_m_s2));
    let are_far = motion.unit != other.unit && (pga / other_pga).ln().abs() > FAR_PEAKS.ln();
    (pga - other_pga).abs() < SAME_PEAK * pga
        || motion.origin.azimuth_deg.is_some() && motion.origin.azimuth_deg == other.origin.azimuth_deg
        || are_far && ![motion, other].iter().any(|of| super::is_vertical(&of.origin))
}

impl Samples<'_> {
    fn new(grid: Grid, options: &ReadOptions) -> Result<Samples<'_>> {
        let columns = 0..grid.headings.len();
        if grid.lines.is_empty() || !columns.clone().any(|at| grid.number(0, at).is_ok()) {
            let found = grid.notes.first().or(grid.headings.first().map(|heading| &heading.text));
            return Err(InputError::Unrecognised { found: found.cloned().unwrap_or_default() });
        }
        let (quantities, line) = (quantities(&grid), grid.lines[0]);
        let mut times = columns.filter(|at| quantities[*at] == Some(Quantity::Time));
        let times = times.clone().find(|at| grid.number(0, *at).is_ok()).or(times.next());
        Ok(Samples { grid, quantities, times, line, options })
    }

    /// The column that the user names by its number or heading.
    fn chosen(&self, choice: &str) -> Result<usize> {
        let mut headings = self.grid.headings.iter();
        let column = match choice.parse::<usize>() {
            Ok(number) => number.checked_sub(1),
            Err(_) => headings.position(|heading| heading.text == choice || heading.name == joined(choice)),
        };
        match column.and_then(|at| Some((at, *self.quantities.get(at)?))) {
            Some((at, None | Some(Quantity::Acceleration))) => Ok(at),
            Some((_, Some(other))) => Err(self.not_acceleration(format!("{other:?}").to_lowercase())),
            None => Err(self.which_column()),
        }
    }

    /// Finds the columns of acceleration: those with such a heading, those of directions, or the only one
    /// that may be it.
    fn accelerations(&self) -> Result<Vec<usize>> {
        let headings = &self.grid.headings;
        if let Some((heading, what)) = headings.iter().find_map(|heading| Some((heading, other(heading)?))) {
            return Err(self.not_acceleration(format!("'{}': {what}", heading.text)));
        }
        let quantity = |at: &usize| self.quantities[*at];
        let (columns, has_cell) = (0..self.quantities.len(), |at: &usize| !self.grid.cell(0, *at).is_empty());
        let named: Vec<usize> =
            columns.clone().filter(|at| quantity(at) == Some(Quantity::Acceleration)).collect();
        let unknown: Vec<usize> = columns.filter(|at| quantity(at).is_none() && has_cell(at)).collect();
        let mut words = named.iter().flat_map(|at| headings[*at].name.split('-'));
        if named.len() > 1 && words.any(|word| PROCESSED.contains(&word)) {
            // The same motion before and after.
            return Err(self.which_column());
        }
        let is_direction = |at: &usize| direction(&headings[*at]).is_some();
        let directions: Vec<usize> = unknown.iter().copied().filter(is_direction).collect();
        match (named.is_empty(), directions.len(), unknown.len()) {
            (false, ..) => Ok(named),
            (.., 1) => Ok(unknown),
            (.., 0) => Err(self.not_acceleration(self.grid.found())),
            // One alone may be a number n, or s for a time.
            (_, 2.., _) => Ok(directions),
            _ => Err(self.which_column()),
        }
    }

    /// The motion of samples under a heading, with the time step (s) found in the file.
    fn motion(&self, heading: &Heading, samples: Vec<f64>, found: Option<f64>) -> Result<RecordedMotion> {
        let (options, line) = (self.options, self.line);
        if samples.len() < 2 {
            return Err(InputError::Count { announced: 2, found: samples.len() });
        }
        let unit = self.unit(heading)?;
        let dt_s = time_step(found, options, line)?;
        let (name, direction) = (Some(&*heading.text).filter(|text| !text.is_empty()), direction(heading));
        let component = direction.or(name).map(str::to_string);
        let origin = Origin { component, azimuth_deg: direction.and_then(azimuth_of), ..Origin::default() };
        Ok(RecordedMotion::new(options.dt_s.unwrap_or(dt_s), samples, unit, origin))
    }

    /// Finds the unit in the heading, else in a comment on acceleration or units, else among the options.
    fn unit(&self, heading: &Heading) -> Result<Unit> {
        let (options, line) = (self.options, self.line);
        let notes = self.grid.notes.iter().map(|note| Heading::new(note));
        let mut notes =
            notes.filter(|note| ["acc", "unit", "vel", "dis"].iter().any(|word| note.name.contains(word)));
        let noted = || notes.find_map(|note| note.unit).filter(|_| !heading.is_scaled);
        let is_unknown = heading.is_scaled || heading.text.contains(['(', '[']);
        match heading.unit.or_else(noted) {
            None if is_unknown && options.unit.is_none() => {
                let expected = "one of acceleration, such as cm/s2, without a factor, or --unit";
                Err(InputError::value(line, "unit", &heading.text, expected))
            }
            found => header::unit(found, options, line),
        }
    }

    /// Finds the time step (s) by the column of times, else by a comment, which must agree.
    fn step(&self) -> Result<Option<f64>> {
        let noted = noted_step(&self.grid.notes);
        let Some(times) = self.times else { return Ok(noted) };
        expect_step(noted, self.step_between(times)?, self.line).map(Some)
    }

    /// Computes the mean step (s) of a column of evenly spaced times; rounded times need the step that is given.
    fn step_between(&self, column: usize) -> Result<f64> {
        let (grid, given) = (&self.grid, self.options.dt_s);
        let unit = grid.headings[column].unit.filter(|unit| unit.quantity == Quantity::Time);
        let in_s = unit.map_or(1.0, |unit| unit.si);
        let (mut times, mut decimals) = (Vec::<f64>::new(), 0);
        for row in grid.rows() {
            let cell = grid.cell(row, column);
            times.push(match clock_s(cell) {
                // Past midnight.
                Some(clock) if times.last().is_some_and(|last| clock < last - 0.5 * DAY_S) => clock + DAY_S,
                Some(clock) => clock,
                None => in_s * grid.number(row, column)?,
            });
            decimals = decimals.max(decimals_of(cell));
        }
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut ordered = steps.clone();
        ordered.sort_by(f64::total_cmp);
        let usual = given.or(ordered.get(ordered.len() / 2).copied()).unwrap_or_default();
        // A given step that the decimals cannot represent is off by half a unit of the last one at each end.
        let last_digit = in_s * 10f64.powi(-(decimals.min(300) as i32));
        let in_digits = given.unwrap_or(0.0) / last_digit;
        let is_rounded = (in_digits - in_digits.round()).abs() > 1e-6 * in_digits;
        let most = if is_rounded { last_digit } else { 0.0 } + UNEVEN * usual.abs();
        if let Some(at) = steps.iter().position(|step| (step - usual).abs() > most) {
            let line = grid.lines[at + 1];
            return Err(InputError::UnevenTime { line, found_s: steps[at], expected_s: usual });
        }
        let mean = (times[times.len() - 1] - times[0]) / steps.len() as f64;
        // Removes digits that the file does not have.
        Ok((mean * 1e12).round() / 1e12)
    }

    /// Reads the samples of a column; without headings and times, a number of samples and the time step that
    /// is given may stand above them.
    fn samples(&self, column: usize, step: Option<f64>) -> Result<Vec<f64>> {
        let mut samples = self.grid.numbers(column)?;
        let decimals = |row: usize| decimals_of(self.grid.cell(row, column));
        let mut above = 0;
        while above < 2 && above + 1 < samples.len() && !self.grid.has_headings && step.is_none() {
            let first = samples[above];
            if USUAL_S.contains(&first) && decimals(above) != decimals(above + 1) {
                expect_step(self.options.dt_s, first, self.grid.lines[above])?;
            }
            let is_count = [1, 2].iter().any(|above| first == samples.len() as f64 - f64::from(*above));
            if !is_count && self.options.dt_s != Some(first) {
                break;
            }
            above += 1;
        }
        samples.drain(..above);
        Ok(samples)
    }

    /// Reads all cells as one series.
    fn wrapped(&self) -> Result<Vec<f64>> {
        self.expect_one_series(true)?;
        let rows = self.grid.rows();
        let cells = rows.flat_map(|row| (0..self.quantities.len()).map(move |column| (row, column)));
        let filled = cells.filter(|(row, column)| !self.grid.cell(*row, *column).is_empty());
        filled.map(|(row, column)| self.grid.number(row, column)).collect()
    }

    /// Refuses samples without times among which another line stands, a line of more cells than the first, and
    /// a short line of wrapped ones before the last: another series may begin there, or the file is damaged.
    fn expect_one_series(&self, is_wrapped: bool) -> Result<()> {
        let (grid, columns) = (&self.grid, self.quantities.len());
        let filled = |row: usize| (0..columns).take_while(|&at| !grid.cell(row, at).is_empty()).count();
        let expected = if is_wrapped || grid.has_headings { columns } else { filled(0) };
        for (row, &line) in grid.lines.iter().enumerate() {
            let (found, next) = (filled(row), grid.lines.get(row + 1));
            if found > expected || is_wrapped && found < expected && next.is_some() {
                return Err(InputError::ShortLine { line, found, expected });
            }
            if self.times.is_none() && next.is_some_and(|next| *next != line + 1) {
                return Err(InputError::ShortLine { line: line + 1, found: 0, expected });
            }
        }
        Ok(())
    }

    fn not_acceleration(&self, found: String) -> InputError {
        InputError::NotAcceleration { line: self.line, found }
    }

    fn which_column(&self) -> InputError {
        InputError::Column { columns: self.grid.found() }
    }
}

/// Digits behind the decimal sign.
fn decimals_of(cell: &str) -> usize {
    cell.split(['.', ',']).nth(1).map_or(0, str::len)
}

/// Finds the quantity of each column from its heading. An unnamed first column that rises is time.
fn quantities(grid: &Grid) -> Vec<Option<Quantity>> {
    let are_components = grid.headings.iter().any(|heading| matches!(&*heading.name, "l" | "r"));
    let mut quantities: Vec<Option<Quantity>> =
        grid.headings.iter().map(|heading| quantity(heading, are_components)).collect();
    if quantities.len() > 1 && quantities[0].is_none() && !quantities.contains(&Some(Quantity::Time)) {
        let is_time = clock_s(grid.cell(0, 0)).is_some()
            || grid.numbers(0).is_ok_and(|times| times.is_sorted_by(|time, next| time < next));
        quantities[0] = is_time.then_some(Quantity::Time);
    }
    quantities
}

/// The quantity that a heading names; T beside L or R is a component.
fn quantity(heading: &Heading, are_components: bool) -> Option<Quantity> {
    let own = heading.unit.map(|unit| unit.quantity);
    let named = heading.name.split('-').find_map(|word| match word {
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

/// What a heading is about that is no acceleration over time.
fn other(heading: &Heading) -> Option<&'static str> {
    let has_word = |start: &str| {
        let mut words = heading.name.split('-');
        words.any(|word| word == start || start.len() > 3 && word.starts_with(start))
    };
    OTHERS.into_iter().find(|(_, starts)| starts.iter().any(|start| has_word(start))).map(|(what, _)| what)
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

/// Reads the time of day, s, in a cell such as `2020/01/20 20:13:20.01` or `20:13:20.01Z`.
fn clock_s(cell: &str) -> Option<f64> {
    let (_, time) = cell.rsplit_once([' ', 'T']).unwrap_or(("", cell));
    let mut parts = time.trim_end_matches('Z').split(':').map(|part| part.parse::<f64>().ok());
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next()??);
    Some(3600.0 * hours + 60.0 * minutes + seconds)
}

/// Reads the time step (s) by a comment such as `dt = 0.01 s`, or `SamplingFrequency(Hz): 100`, perhaps with
/// the number in the same place of the next one.
fn noted_step(notes: &[String]) -> Option<f64> {
    notes.iter().enumerate().find_map(|(at, note)| {
        let heading = Heading::new(note);
        if heading.name.starts_with("dt-") {
            return Some(first_number(note)? * heading.unit.map_or(1.0, |unit| unit.si));
        }
        let mut cells = note.split(',').map(str::to_lowercase);
        let place = cells.position(|cell| cell.contains("sampling") && cell.contains("hz"))?;
        let both = [Some(note), notes.get(at + 1)].into_iter().flatten();
        let mut numbers = both.filter_map(|note| note.split(',').nth(place).and_then(first_number));
        numbers.next().filter(|frequency| *frequency > 0.0).map(|frequency| 1.0 / frequency)
    })
}
