//! Columns of a table: accelerations, one motion each, with or without times. Headings and comments name
//! units, time steps and quantities; options of the user must not contradict them.

use rockfrag_core::records::{HeaderPga, Origin, RecordedMotion};
use rockfrag_core::units::{Quantity, Unit};

use super::ReadOptions;
use super::header::{self, azimuth_of, expect_step, header_pga, number, time_step};
use crate::inputs::heading::number_with_unit;
use crate::inputs::words::{is_vertical, joined, means, says_vertical};
use crate::inputs::{Grid, Heading, InputError, Result};

/// After which clocks begin anew.
const HALF_DAY_S: f64 = 12.0 * 3600.0;
/// Accepted relative difference of a step of time from the usual one.
const UNEVEN: f64 = 0.05;
/// Beginnings of words for horizontal components without an azimuth, which their first letters name, too.
const HORIZONTAL: [&str; 3] = ["long", "tran", "rad"];

struct Samples<'a> {
    grid: Grid,
    quantities: Vec<Option<Quantity>>,
    /// Whether the lines are parts of one series.
    is_wrapped: bool,
    /// The column of times: of numbers, else of a clock.
    times: Option<usize>,
    options: &'a ReadOptions,
}

pub fn parse(bytes: &[u8], options: &ReadOptions) -> Result<Vec<RecordedMotion>> {
    let table = Samples::new(Grid::parse(bytes, None)?, options)?;
    if table.is_wrapped {
        let row = |row| (0..table.filled(row)).map(move |column| (row, column));
        let cells = table.grid.rows().flat_map(row).collect();
        return Ok(vec![table.motion(&Heading::new(""), cells, noted_step(&table.grid.notes))?]);
    }
    let columns = match &options.column {
        Some(choice) => vec![table.chosen(choice)?],
        None => table.accelerations()?,
    };
    let step = table.step()?;
    let mut motions = Vec::<RecordedMotion>::new();
    for column in columns {
        let cells = table.grid.rows().map(|row| (row, column)).collect();
        let motion = table.motion(&table.grid.headings[column], cells, step)?;
        if motions.iter().any(|other| !are_components(other, &motion)) {
            return Err(table.which_column());
        }
        motions.push(motion);
    }
    if let [motion] = &mut motions[..] {
        motion.header_pga = table.grid.notes.iter().find_map(|note| noted_pga(note));
    }
    Ok(motions)
}

/// Whether two columns may be components of one motion: in one unit, different, and not in one direction.
fn are_components(motion: &RecordedMotion, other: &RecordedMotion) -> bool {
    let azimuth = motion.origin.azimuth_deg;
    motion.unit == other.unit
        && motion.acceleration_m_s2 != other.acceleration_m_s2
        && (azimuth.is_none() || azimuth != other.origin.azimuth_deg)
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
        let quantities = quantities(&grid);
        let times = columns.filter(|at| quantities[*at] == Some(Quantity::Time));
        let times = times.min_by_key(|at| grid.number(0, *at).is_err());
        let is_wrapped = options.column.as_deref() == Some("all");
        Ok(Samples { grid, quantities, is_wrapped, times: times.filter(|_| !is_wrapped), options })
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
        if let Some(heading) = headings.iter().find(|heading| is_spectrum(heading)) {
            return Err(self.not_acceleration(format!("'{}'", heading.text)));
        }
        let of = |quantity| (0..headings.len()).filter(move |at| self.quantities[*at] == quantity);
        let named: Vec<usize> = of(Some(Quantity::Acceleration)).collect();
        let unknown: Vec<usize> = of(None).filter(|at| !self.grid.cell(0, *at).is_empty()).collect();
        let directions: Vec<usize> =
            unknown.iter().copied().filter(|at| direction(&headings[*at]).is_some()).collect();
        match (named.len(), unknown.len(), directions.len()) {
            (1, ..) => Ok(named),
            (0, 0, _) => Err(self.not_acceleration(self.grid.found())),
            (0, 1, _) => Ok(unknown),
            // One alone may be a number n, or s for a time.
            (0, _, 2..) => Ok(directions),
            (2.., ..) if named.iter().all(|at| is_component(&headings[*at])) => Ok(named),
            // Perhaps one motion in two states: original and matched.
            _ => Err(self.which_column()),
        }
    }

    /// The motion in cells under a heading, with the time step (s) found in the file.
    fn motion(
        &self,
        heading: &Heading,
        cells: Vec<(usize, usize)>,
        step: Option<f64>,
    ) -> Result<RecordedMotion> {
        let number = |(row, column): &(usize, usize)| self.grid.number(*row, *column);
        let mut samples = cells.iter().map(number).collect::<Result<Vec<f64>>>()?;
        let (above, step_above) = self.above(&samples, &cells, step);
        if samples.len() < above + 2 {
            return Err(InputError::Count { announced: 2, found: samples.len() - above });
        }
        let (row, _) = cells[above];
        self.expect_one_series(row)?;
        samples.drain(..above);
        let line = self.grid.lines[row.saturating_sub(1)];
        let noted = self.grid.notes.iter().find_map(|note| noted_unit(note));
        let is_other = |unit: &Unit| unit.quantity == Quantity::Acceleration && heading.unit != Some(*unit);
        if let Some(unit) = noted.filter(is_other).filter(|_| heading.unit.is_some()) {
            return Err(InputError::Units { heading: heading.text.clone(), unit: unit.name.to_string() });
        }
        let unit = heading.unit.or(noted.filter(|_| !heading.is_scaled));
        let unit = header::unit(unit, self.options, line)?;
        let dt_s = time_step(step.or(step_above), self.options, line)?;
        let are_several =
            self.quantities.iter().filter(|of| **of == Some(Quantity::Acceleration)).count() > 1;
        let noted = self.grid.notes.iter().find_map(|note| noted_component(note)).filter(|_| !are_several);
        let (name, azimuth_deg) = direction(heading).or(noted).unwrap_or((&heading.text, None));
        let component = Some(name.to_string()).filter(|name| !name.is_empty());
        let origin = Origin { component, azimuth_deg, ..Origin::default() };
        Ok(RecordedMotion::new(self.options.dt_s.unwrap_or(dt_s), samples, unit, origin))
    }

    /// Finds how many numbers stand above samples without times, and the time step (s) among them: behind the
    /// number of samples, `2000 0.01`, or alone, if it is the given one, or a usual one in other digits.
    fn above(&self, samples: &[f64], cells: &[(usize, usize)], step: Option<f64>) -> (usize, Option<f64>) {
        let &[first, second, _, ..] = samples else { return (0, None) };
        let is_counted = |above: &usize| first == (samples.len() as f64) - (*above as f64);
        if let Some(above) = (1..=3).find(is_counted).filter(|_| self.times.is_none() && first >= 2.0) {
            return (above, Some(second).filter(|_| above > 1));
        }
        let [digits, others] = [0, 1].map(|at| decimals_of(self.grid.cell(cells[at].0, cells[at].1)));
        let rate = first.recip();
        let is_usual = digits != others && (20.0..=1000.0).contains(&rate) && rate.fract() == 0.0;
        let is_step = (is_usual || self.options.dt_s == Some(first)) && step.is_none();
        let is_step = is_step && !self.grid.has_headings && !self.is_wrapped;
        (usize::from(is_step), Some(first).filter(|_| is_step && self.options.dt_s.is_some()))
    }

    /// Finds the time step (s): the mean of a column of evenly spaced times, else that in a comment, which must
    /// agree. Rounded times need the step that is given.
    fn step(&self) -> Result<Option<f64>> {
        let noted = noted_step(&self.grid.notes);
        let Some(column) = self.times else { return Ok(noted) };
        let (grid, given) = (&self.grid, self.options.dt_s);
        let unit = grid.headings[column].unit.filter(|unit| unit.quantity == Quantity::Time);
        let in_s = unit.map_or(1.0, |unit| unit.si);
        let mut times = Vec::<f64>::new();
        for row in grid.rows() {
            times.push(match (clock_s(grid.cell(row, column)), times.last()) {
                (Some(clock), Some(last)) => last + (clock - last).rem_euclid(HALF_DAY_S),
                (Some(clock), None) => clock,
                (None, _) => in_s * grid.number(row, column)?,
            });
        }
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let usual = given.or(steps.first().copied()).unwrap_or_default();
        // A given step that the decimals cannot represent is off by half a unit of the last one at each end.
        let decimals = grid.rows().map(|row| decimals_of(grid.cell(row, column))).max().unwrap_or(0);
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
        expect_step(noted, (mean * 1e12).round() / 1e12, grid.lines[0]).map(Some)
    }

    /// Refuses samples without times among which another line stands, a line of more cells than the first, and
    /// a short line of wrapped ones before the last: another series may begin there, or the file is damaged.
    fn expect_one_series(&self, first: usize) -> Result<()> {
        let lines = &self.grid.lines;
        let expected = if self.grid.has_headings { self.quantities.len() } else { self.filled(first) };
        for (row, &line) in lines.iter().enumerate().skip(first) {
            let (found, next) = (self.filled(row), lines.get(row + 1));
            if found > expected || self.is_wrapped && found < expected && next.is_some() {
                return Err(InputError::ShortLine { line, found, expected });
            }
            if self.times.is_none() && next.is_some_and(|next| *next != line + 1) {
                return Err(InputError::ShortLine { line: line + 1, found: 0, expected });
            }
        }
        Ok(())
    }

    /// The number of cells of a row up to the first empty one.
    fn filled(&self, row: usize) -> usize {
        (0..self.quantities.len()).take_while(|at| !self.grid.cell(row, *at).is_empty()).count()
    }

    fn not_acceleration(&self, found: String) -> InputError {
        InputError::NotAcceleration { line: self.grid.lines[0], found }
    }

    fn which_column(&self) -> InputError {
        InputError::Column { columns: self.grid.found() }
    }
}

fn decimals_of(cell: &str) -> usize {
    cell.split(['.', ',']).nth(1).map_or(0, str::len)
}

/// The names of columns that a comment has behind a colon: `DataSequence: Time U(+); N(+); E(+)`.
fn names(note: &str, columns: usize) -> Option<Vec<Heading>> {
    let words = note.split_once(':')?.1.split([' ', ';', ',']).filter(|word| !word.is_empty());
    let names: Vec<Heading> = words.map(Heading::new).collect();
    let is_name = |name: &Heading| direction(name).is_some() || quantity(name).is_some();
    (names.len() == columns && names.iter().all(is_name)).then_some(names)
}

/// Finds the quantity of each column from its heading. Of others the first that rises, or has a clock, is time
/// where no heading says it, unless its numbers count the samples.
fn quantities(grid: &Grid) -> Vec<Option<Quantity>> {
    let mut quantities: Vec<Option<Quantity>> = grid.headings.iter().map(quantity).collect();
    let mut is_timed = quantities.len() < 2 || quantities.contains(&Some(Quantity::Time));
    for (at, quantity) in quantities.iter_mut().enumerate().filter(|(_, known)| known.is_none()) {
        let numbers = if is_timed { Vec::new() } else { grid.numbers(at).unwrap_or_default() };
        let rises = numbers.len() > 1 && numbers.is_sorted_by(|time, next| time < next);
        if rises && numbers.windows(2).all(|pair| pair[1] - pair[0] == 1.0) {
            *quantity = Some(Quantity::Counts);
        } else if rises || !is_timed && clock_s(grid.cell(0, at)).is_some() {
            (*quantity, is_timed) = (Some(Quantity::Time), true);
        }
    }
    quantities
}

fn quantity(heading: &Heading) -> Option<Quantity> {
    let named = heading.name.split('-').find_map(|word| match word {
        "a" | "ag" => Some(Quantity::Acceleration),
        _ if word.starts_with("acc") => Some(Quantity::Acceleration),
        _ if word.starts_with("time") || word.ends_with("time") => Some(Quantity::Time),
        _ if word.starts_with("vel") => Some(Quantity::Velocity),
        _ if word.starts_with("dis") => Some(Quantity::Length),
        _ => None,
    });
    named.or(heading.unit.map(|unit| unit.quantity))
}

fn is_spectrum(heading: &Heading) -> bool {
    let of = |word: &str| ["period", "freq", "spectr"].iter().any(|start| word.starts_with(start));
    heading.name.split('-').any(|word| matches!(word, "sa" | "psa" | "psv") || of(word))
}

/// The word of a heading that names a direction, and its azimuth (degrees): N-S, acc_EW, UD (gal), az, N-S2,
/// acc 90 deg.
fn direction(heading: &Heading) -> Option<(&str, Option<f64>)> {
    let name = heading.text.split(['(', '[', ',']).next()?.trim_matches([' ', '.']);
    if let Some(degrees) = name.strip_suffix('\u{b0}').or(name.strip_suffix("deg")) {
        let degrees = degrees.trim().rsplit([' ', '_']).next()?;
        return Some((degrees, azimuth_of(degrees)));
    }
    let last = name.rsplit([' ', '_', '.']).next()?;
    let letters = last.trim_start_matches(['A', 'a', 'C', 'c']);
    [name, last, letters].into_iter().find_map(|word| {
        let azimuth = azimuth_of(word.trim_end_matches(|sign: char| sign.is_ascii_digit()));
        let lower = word.to_lowercase();
        let is_horizontal = HORIZONTAL.iter().any(|of| lower.starts_with(of) || lower == of[..1]);
        (azimuth.is_some() || is_horizontal || is_vertical(word)).then_some((word, azimuth))
    })
}

/// Whether a heading has the name of a component alone, or a number: H1, ax, HNE, acc_2.
fn is_component(heading: &Heading) -> bool {
    let last = heading.bare.trim().rsplit([' ', '_', '.']).next().unwrap_or_default();
    let is_code = last.len() == 3 && last.ends_with(['E', 'N']) || matches!(last.len(), 1 | 2);
    is_code || last.ends_with(|sign: char| sign.is_ascii_digit()) || direction(heading).is_some()
}

/// Reads the seconds of the day in a cell such as `2020/01/20 20:13:20.01Z`, `8:13:20:010 PM` or
/// `13:20.01`.
fn clock_s(cell: &str) -> Option<f64> {
    let behind = |sign: char| !sign.is_ascii_digit() && !":.,".contains(sign);
    let time = cell.split(behind).find(|part| part.contains(':'))?.replace(',', ".");
    // Behind a third colon are thousandths.
    let time = match time.match_indices(':').nth(2) {
        Some((at, _)) => format!("{}.{}", &time[..at], &time[at + 1..]),
        None => time,
    };
    time.split(':').try_fold(0.0, |sum, part| Some(60.0 * sum + part.parse::<f64>().ok()?))
}

/// Reads the unit in a comment that speaks of units, acceleration, or what is none.
fn noted_unit(note: &str) -> Option<Unit> {
    let Heading { name, unit, .. } = Heading::new(note);
    let word = || note.split([':', '=']).nth(1)?.split_whitespace().next().and_then(Unit::parse);
    let is_meant = ["acc", "unit", "vel", "displ"].iter().any(|word| name.contains(word));
    unit.or_else(|| word().filter(|_| name.contains("unit")))
        .filter(|_| is_meant && noted_pga(note).is_none())
}

/// Reads the peak in a comment such as `PGA = 0.6 g` or `PGA (g): 0.6`.
fn noted_pga(note: &str) -> Option<HeaderPga> {
    let (key, value) = note.split_once([':', '='])?;
    let unit =
        Heading::new(key).unit.or_else(|| Heading::new(value).unit.or(Some(number_with_unit(value)?.1)));
    header_pga(value, unit.filter(|_| means(&Heading::new(key).name, "pga"))?.si)
}

/// Finds the direction in a comment such as `Component: UP` or `Vertical motion`.
fn noted_component(note: &str) -> Option<(&str, Option<f64>)> {
    let (key, value) = note.split_once([':', '=']).unwrap_or_default();
    let is_named = ["component", "channel", "direction"].iter().any(|of| joined(key).ends_with(of));
    let of_value = azimuth_of(value).is_some() || is_vertical(value.trim());
    let named = is_named && of_value;
    named.then(|| (value.trim(), azimuth_of(value))).or(says_vertical(note).then_some(("vertical", None)))
}

/// Reads the time step (s) in a comment such as `dt = 0.01 s`, `Sampling rate: 100 sps`, or
/// `SamplingFrequency(Hz)`, perhaps with the number alone in the next one.
fn noted_step(notes: &[String]) -> Option<f64> {
    let has = |name: &str, words: &[&str]| words.iter().any(|word| name.contains(word));
    let is_rate = |name: &str| name.starts_with("fs-") || has(name, &["hz", "sps", "rate", "freq", "per-s"]);
    notes.iter().enumerate().find_map(|(at, note)| {
        let of_samples = note.split(',').map(|cell| (cell, joined(cell) + "-")).find(|(_, name)| {
            let is_named =
                ["dt-", "fs-", "time-step", "time-interval"].iter().any(|key| name.starts_with(key));
            let is_measure = is_rate(name) || has(name, &["interval", "step", "period"]);
            is_named || name.contains("sampl") && is_measure
        });
        let (cell, name) = of_samples?;
        let value = number(cell).or_else(|| notes.get(at + 1)?.trim_matches(['#', ' ']).parse().ok());
        let value = value.filter(|value| *value > 0.0)?;
        let unit = Heading::new(cell).unit.filter(|unit| unit.quantity == Quantity::Time);
        Some(if is_rate(&name) { value.recip() } else { value * unit.map_or(1.0, |unit| unit.si) })
    })
}
