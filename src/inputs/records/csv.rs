//! Columns of a table: accelerations, one motion each, with or without times. Headings and comments name
//! units, time steps and quantities; options of the user must not contradict them.

use chrono::{NaiveTime, Timelike};
use rockfrag_core::motion::measures::peak;
use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::{Quantity, Unit};

use super::ReadOptions;
use super::header::{self, azimuth_of, expect_step, first_number, time_step};
use crate::inputs::words::{is_vertical, joined};
use crate::inputs::{Grid, Heading, InputError, Result};

const DAY_S: f64 = 86400.0;
const HOUR_S: f64 = 3600.0;
/// Notations of the time of day.
const CLOCKS: [&str; 3] = ["%I:%M:%S%.f%p", "%H:%M:%S%.f", "%H:%M:%S:%3f"];
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
/// Words of what is no acceleration over time, or beginnings of four letters or more: spectra, jerk.
const OTHERS: [&str; 7] = ["sa", "psa", "psv", "period", "freq", "spectr", "jerk"];

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
        let (samples, step) = table.wrapped()?;
        return Ok(vec![table.motion(&Heading::new(""), samples, step)?]);
    }
    let columns = match &options.column {
        Some(choice) => vec![table.chosen(choice)?],
        None => table.accelerations()?,
    };
    table.expect_one_series(false, 0)?;
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
    fn new(mut grid: Grid, options: &ReadOptions) -> Result<Samples<'_>> {
        let columns = 0..grid.headings.len();
        if grid.lines.is_empty() || !columns.clone().any(|at| grid.number(0, at).is_ok()) {
            let found = grid.notes.first().or(grid.headings.first().map(|heading| &heading.text));
            return Err(InputError::Unrecognised { found: found.cloned().unwrap_or_default() });
        }
        let names = grid.notes.iter().find_map(|note| names(note, columns.len()));
        if let Some(names) = names.filter(|_| !grid.has_headings) {
            (grid.headings, grid.has_headings) = (names, true);
        }
        let (quantities, line) = (quantities(&grid), grid.lines[0]);
        let times = columns.filter(|at| quantities[*at] == Some(Quantity::Time));
        // Numbers rather than a clock, and a clock rather than a date.
        let times = times.min_by_key(|at| {
            let [first, last] = [0, grid.lines.len() - 1].map(|row| grid.cell(row, *at));
            (first == last, grid.number(0, *at).is_err(), clock_s(first).is_none())
        });
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
        if let Some(heading) = headings.iter().find(|heading| is_other(heading)) {
            return Err(self.not_acceleration(format!("'{}'", heading.text)));
        }
        let quantity = |at: &usize| self.quantities[*at];
        let (columns, has_cell) = (0..self.quantities.len(), |at: &usize| !self.grid.cell(0, *at).is_empty());
        let named: Vec<usize> =
            columns.clone().filter(|at| quantity(at) == Some(Quantity::Acceleration)).collect();
        let unknown: Vec<usize> = columns.filter(|at| quantity(at).is_none() && has_cell(at)).collect();
        if named.len() > 1 && !named.iter().all(|at| is_component(&headings[*at])) {
            // Perhaps one motion in two states: original and matched.
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
        let noted =
            || self.grid.notes.iter().find_map(|note| noted_unit(note)).filter(|_| !heading.is_scaled);
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
            let time = match clock_s(cell) {
                Some(clock) => match times.last().map_or(0.0, |last| last - clock) {
                    // Past midnight, or past the hour where the hour is left out.
                    HOUR_S.. => clock + DAY_S,
                    back if back > 0.5 * HOUR_S => clock + HOUR_S,
                    _ => clock,
                },
                None => in_s * grid.number(row, column)?,
            };
            times.push(time);
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

    /// Reads all cells as one series, and the time step (s) in a comment or above it, behind the number of
    /// samples: `2000 0.01`.
    fn wrapped(&self) -> Result<(Vec<f64>, Option<f64>)> {
        let (grid, columns) = (&self.grid, self.quantities.len());
        let cells = grid.rows().flat_map(|row| (0..columns).map(move |column| (row, column)));
        let filled: Vec<_> = cells.filter(|(row, column)| !grid.cell(*row, *column).is_empty()).collect();
        let above = filled.iter().filter(|(row, _)| *row == 0).count();
        let is_header = above < columns && grid.number(0, 0).ok() == Some((filled.len() - above) as f64);
        let skipped = usize::from(is_header);
        self.expect_one_series(true, skipped)?;
        let step = (is_header && above > 1).then(|| grid.number(0, 1)).transpose()?;
        let samples = filled.iter().filter(|(row, _)| *row >= skipped);
        let samples = samples.map(|(row, column)| grid.number(*row, *column)).collect::<Result<_>>()?;
        Ok((samples, noted_step(&grid.notes).or(step)))
    }

    /// Refuses samples without times among which another line stands, a line of more cells than the first, and
    /// a short line of wrapped ones before the last: another series may begin there, or the file is damaged.
    fn expect_one_series(&self, is_wrapped: bool, skipped: usize) -> Result<()> {
        let (grid, columns) = (&self.grid, self.quantities.len());
        let filled = |row: usize| (0..columns).take_while(|&at| !grid.cell(row, at).is_empty()).count();
        let expected = if is_wrapped || grid.has_headings { columns } else { filled(0) };
        for (row, &line) in grid.lines.iter().enumerate().skip(skipped) {
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

/// The names of columns that a comment has behind a colon: `DataSequence: Time U(+); N(+); E(+)`.
fn names(note: &str, columns: usize) -> Option<Vec<Heading>> {
    let words = note.split_once(':')?.1.split([' ', ';', ',']).filter(|word| !word.is_empty());
    let names: Vec<Heading> = words.map(Heading::new).collect();
    let is_name = |name: &Heading| direction(name).is_some() || quantity(name, false).is_some();
    (names.len() == columns && names.iter().all(is_name)).then_some(names)
}

/// Finds the quantity of each column from its heading. An unnamed first column that rises is time, unless its
/// numbers count the samples.
fn quantities(grid: &Grid) -> Vec<Option<Quantity>> {
    let are_components = grid.headings.iter().any(|heading| matches!(&*heading.name, "l" | "r"));
    let mut quantities: Vec<Option<Quantity>> =
        grid.headings.iter().map(|heading| quantity(heading, are_components)).collect();
    if quantities.len() > 1 && quantities[0].is_none() && !quantities.contains(&Some(Quantity::Time)) {
        let numbers = grid.numbers(0).unwrap_or_default();
        let mut steps = numbers.windows(2).map(|pair| pair[1] - pair[0]).peekable();
        let has_clock = clock_s(grid.cell(0, 0)).is_some();
        quantities[0] = match steps.peek().copied() {
            Some(1.0) if steps.all(|step| step == 1.0) => Some(Quantity::Counts),
            Some(_) if numbers.is_sorted_by(|time, next| time < next) => Some(Quantity::Time),
            _ => Some(Quantity::Time).filter(|_| has_clock),
        };
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

fn is_other(heading: &Heading) -> bool {
    let is = |word: &str, of: &str| word == of || of.len() > 3 && word.starts_with(of);
    heading.name.split('-').any(|word| OTHERS.iter().any(|of| is(word, of)))
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

/// Whether a heading has the name of a component alone, or a number: H1, ax, HNE, acc_2.
fn is_component(heading: &Heading) -> bool {
    let last = heading.bare.trim().rsplit([' ', '_', '.']).next().unwrap_or_default();
    let is_code = last.len() == 3 && last.ends_with(['E', 'N']);
    let is_numbered = last.ends_with(|sign: char| sign.is_ascii_digit());
    direction(heading).is_some() || is_code || is_numbered || matches!(last.len(), 1 | 2)
}

/// Reads the time of day, s, in a cell such as `2020/01/20 20:13:20.01Z` or `8:13:20.01 PM`, or that within
/// the hour in `13:20.01`.
fn clock_s(cell: &str) -> Option<f64> {
    let date = cell[..cell.find(':')?].trim_end_matches(|sign: char| sign.is_ascii_digit());
    let time = cell[date.len()..].replace(',', ".");
    let end = time.find(|sign: char| !sign.is_ascii_digit() && !":.".contains(sign)).unwrap_or(time.len());
    let (clock, zone) = (&time[..end], time[end..].trim());
    let half = Some(zone).filter(|zone| ["am", "pm"].contains(&zone.to_lowercase().as_str()));
    let hour = if clock.matches(':').count() == 1 { "0:" } else { "" };
    let clock = format!("{hour}{clock}{}", half.unwrap_or_default());
    let time = CLOCKS.into_iter().find_map(|format| NaiveTime::parse_from_str(&clock, format).ok())?;
    Some(f64::from(time.num_seconds_from_midnight()) + 1e-9 * f64::from(time.nanosecond()))
}

/// Reads the unit in a comment that speaks of units, acceleration, or what is none.
fn noted_unit(note: &str) -> Option<Unit> {
    let Heading { name, unit, .. } = Heading::new(note);
    let word = || note.split([':', '=']).nth(1)?.split_whitespace().next().and_then(Unit::parse);
    let is_meant = ["acc", "unit", "vel", "displ"].iter().any(|word| name.contains(word));
    unit.or_else(|| word().filter(|_| name.contains("unit"))).filter(|_| is_meant)
}

/// Reads the time step (s) by a comment such as `dt = 0.01 s`, `Sampling rate: 100 sps`, or
/// `SamplingFrequency(Hz)`, perhaps with the number in the same place of the next one.
fn noted_step(notes: &[String]) -> Option<f64> {
    let has = |name: &str, words: &[&str]| words.iter().any(|word| name.contains(word));
    let is_rate = |name: &str| has(name, &["fs-", "hz", "sps", "rate", "freq", "per-s"]);
    let is_step = |name: &str| {
        let is_named = ["dt-", "fs-", "time-step", "time-interval"].iter().any(|key| name.starts_with(key));
        let is_measure = is_rate(name) || has(name, &["interval", "step", "period"]);
        is_named || name.contains("sampl") && is_measure
    };
    notes.iter().enumerate().find_map(|(at, note)| {
        let mut names = note.split(',').map(|cell| joined(cell) + "-").enumerate();
        let (place, name) = names.find(|(_, name)| is_step(name))?;
        let mut cells = notes[at..].iter().take(2).filter_map(|note| note.split(',').nth(place));
        let unit = Heading::new(cells.clone().next()?).unit;
        let number = cells.find_map(first_number).filter(|number| *number > 0.0)?;
        let in_s = unit.filter(|unit| unit.quantity == Quantity::Time).map_or(1.0, |unit| unit.si);
        Some(if is_rate(&name) { number.recip() } else { number * in_s })
    })
}
