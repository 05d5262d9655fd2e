//! Columns of a table: accelerations, one motion each, with or without times. Headings and comments name
//! units, time steps and quantities; options of the user must not contradict them.

use super::error::RecordFileError;
use super::header::{azimuth_of, expect_step, expect_unit, first_number, given_unit, time_step};
use crate::inputs::{Grid, Heading};
use crate::motion::measures::peak;
use crate::records::{ReadOptions, RecordedMotion, is_vertical};
use crate::units::{Quantity, Unit};

/// Accepted relative difference of a step of time from the usual one.
const UNEVEN: f64 = 0.05;
/// Relative difference of the peaks of two columns up to which they are one motion, such as in two units.
const SAME_PEAK: f64 = 1e-3;

/// Reads the motions in a table.
pub fn parse(bytes: &[u8], options: &ReadOptions) -> Result<Vec<RecordedMotion>, RecordFileError> {
    let grid = Grid::parse(bytes, None)?;
    let has_numbers = |row: usize| (0..grid.columns).any(|column| grid.number(row, column).is_ok());
    let Some(&line) = grid.lines.first().filter(|_| has_numbers(0)) else {
        let heading = grid.headings.first().map(|heading| &heading.text);
        let found = grid.notes.first().or(heading).cloned().unwrap_or_default();
        return Err(RecordFileError::Unrecognised { found });
    };
    let notes: Vec<Heading> = grid.notes.iter().map(|note| Heading::new(note)).collect();
    if options.column.as_deref() == Some("all") {
        let samples = series(&grid)?;
        return Ok(vec![motion(&grid, None, samples, notes.iter().find_map(step_of_note), options)?]);
    }
    let quantities = quantities(&grid);
    let columns = accelerations(&grid, &quantities, options.column.as_deref(), line)?;
    let found = match times(&grid, &quantities) {
        Some(times) => {
            let step = step_of_times(&grid, times, options.dt_s);
            Some(step.map_err(|refusal| exchanged(&grid, times, columns[0], refusal))?)
        }
        None => notes.iter().find_map(step_of_note),
    };
    let mut motions = Vec::<RecordedMotion>::new();
    for &column in &columns {
        let mut samples = numbers(&grid, column)?;
        if grid.headings.is_empty() && found.is_none() {
            drop_header(&mut samples, options.dt_s);
        }
        let read = motion(&grid, Some(column), samples, found, options)?;
        let pga = peak(&read.acceleration_m_s2);
        let is_same = |other: &RecordedMotion| (peak(&other.acceleration_m_s2) - pga).abs() < SAME_PEAK * pga;
        if motions.iter().any(is_same) {
            return Err(column_error(&grid));
        }
        motions.push(read);
    }
    Ok(motions)
}

/// The motion of samples from a column, or from all cells, with the time step (s) found in the file.
fn motion(
    grid: &Grid,
    column: Option<usize>,
    samples: Vec<f64>,
    found: Option<f64>,
    options: &ReadOptions,
) -> Result<RecordedMotion, RecordFileError> {
    let line = grid.lines[0];
    if samples.len() < 2 {
        return Err(RecordFileError::Count { announced: 2, found: samples.len() });
    }
    let heading = column.and_then(|column| grid.headings.get(column));
    let unit = unit(heading, &grid.notes, options, line)?;
    let expected = "a column of times, or a comment such as dt = 0.005 s";
    let dt_s = options.dt_s.or(found).ok_or(RecordFileError::NoTimeStep { line, expected })?;
    expect_step(options, found.unwrap_or(dt_s), line)?;
    Ok(RecordedMotion {
        component: heading.map(|heading| direction(heading).unwrap_or(&heading.text).to_string()),
        azimuth_deg: heading.and_then(direction).and_then(azimuth_of),
        ..RecordedMotion::new(time_step(dt_s, line)?, samples, unit)
    })
}

/// The word of a heading that names a direction: N-S, acc_EW, UD (gal), acc 90 deg.
fn direction(heading: &Heading) -> Option<&str> {
    let name = heading.text.split(['(', '[', ',']).next().unwrap_or_default().trim();
    let degrees = name.strip_suffix('\u{b0}').or(name.strip_suffix("deg"));
    let words = [name, name.rsplit([' ', '_', '.']).next().unwrap_or_default()];
    let named = words
        .into_iter()
        .find(|word| word.parse::<f64>().is_err() && (azimuth_of(word).is_some() || is_vertical(word)));
    degrees.and_then(|degrees| degrees.trim().rsplit([' ', '_']).next()).or(named)
}

/// Reads a column.
fn numbers(grid: &Grid, column: usize) -> Result<Vec<f64>, RecordFileError> {
    (0..grid.lines.len()).map(|row| Ok(grid.number(row, column)?)).collect()
}

/// Reads all cells as one series, of which the last row alone may be short: another one shows that the file
/// has several series, or is damaged.
fn series(grid: &Grid) -> Result<Vec<f64>, RecordFileError> {
    let filled =
        |row: usize| (0..grid.columns).take_while(|&column| !grid.cell(row, column).is_empty()).count();
    let mut series = Vec::new();
    for (row, &line) in grid.lines.iter().enumerate() {
        let found = filled(row);
        if found < grid.columns && row + 1 < grid.lines.len() {
            return Err(RecordFileError::ShortLine { line, found, expected: grid.columns });
        }
        for column in 0..found {
            series.push(grid.number(row, column)?);
        }
    }
    Ok(series)
}

/// Drops the number of samples and the time step if they stand above the samples.
fn drop_header(samples: &mut Vec<f64>, dt_s: Option<f64>) {
    let counts = [1, 2].map(|above| samples.len() as f64 - f64::from(above));
    let is_header = |value: &&f64| counts.contains(*value) || Some(**value) == dt_s;
    let length = samples.iter().take(2).take_while(is_header).count();
    samples.drain(..length);
}

/// Finds the quantity of each column from its heading. An unnamed first column that rises is time.
fn quantities(grid: &Grid) -> Vec<Option<Quantity>> {
    let known = |heading: &Heading| {
        let named = heading.name.split('_').find_map(|word| match word {
            "a" | "ag" => Some(Quantity::Acceleration),
            "t" | "zeit" | "temps" | "date" | "datetime" | "timestamp" => Some(Quantity::Time),
            _ if word.starts_with("acc") => Some(Quantity::Acceleration),
            _ if word.starts_with("time") || word.ends_with("time") => Some(Quantity::Time),
            _ if word.starts_with("vel") => Some(Quantity::Velocity),
            _ if word.starts_with("dis") => Some(Quantity::Length),
            _ => None,
        });
        named.or(heading.unit.map(|unit| unit.quantity))
    };
    let mut quantities: Vec<Option<Quantity>> = grid.headings.iter().map(known).collect();
    quantities.resize(grid.columns, None);
    let has_times = quantities.contains(&Some(Quantity::Time));
    let rises = || numbers(grid, 0).is_ok_and(|times| times.is_sorted_by(|time, next| time < next));
    if grid.columns > 1
        && !has_times
        && quantities[0].is_none()
        && (clock_s(grid.cell(0, 0)).is_some() || rises())
    {
        quantities[0] = Some(Quantity::Time);
    }
    quantities
}

/// The column of times: of numbers, else of a clock.
fn times(grid: &Grid, quantities: &[Option<Quantity>]) -> Option<usize> {
    let times = || (0..grid.columns).filter(|&column| quantities[column] == Some(Quantity::Time));
    times().find(|&column| grid.number(0, column).is_ok()).or(times().next())
}

/// Reads the time of day, s, in a cell such as `2020/01/20 20:13:20.01` or `20:13:20.01Z`.
fn clock_s(cell: &str) -> Option<f64> {
    let (_, time) = cell.rsplit_once([' ', 'T']).unwrap_or(("", cell));
    let mut parts = time.trim_end_matches('Z').split(':').map(|part| part.parse::<f64>().ok());
    let (hours, minutes, seconds) = (parts.next()??, parts.next()??, parts.next()??);
    Some(3600.0 * hours + 60.0 * minutes + seconds)
}

/// Finds the columns of acceleration: the chosen one, those with such a heading, those of directions, or the
/// only one that may be it.
fn accelerations(
    grid: &Grid,
    quantities: &[Option<Quantity>],
    choice: Option<&str>,
    line: usize,
) -> Result<Vec<usize>, RecordFileError> {
    let of = |wanted: Option<Quantity>| {
        let is = move |column: &usize| quantities[*column] == wanted && !grid.cell(0, *column).is_empty();
        (0..grid.columns).filter(is).collect::<Vec<_>>()
    };
    let not = |found: String| Err(RecordFileError::NotAcceleration { line, found });
    if let Some(choice) = choice {
        let is_chosen = |heading: &Heading| heading.text == choice || heading.name == choice;
        let column = match choice.parse::<usize>() {
            Ok(number) => Some(number.wrapping_sub(1)),
            Err(_) => grid.headings.iter().position(is_chosen),
        };
        return match column.and_then(|column| Some((column, *quantities.get(column)?))) {
            Some((column, None | Some(Quantity::Acceleration))) => Ok(vec![column]),
            Some((_, Some(other))) => not(format!("{other:?}").to_lowercase()),
            None => Err(column_error(grid)),
        };
    }
    let (named, unknown) = (of(Some(Quantity::Acceleration)), of(None));
    let directions = unknown
        .iter()
        .copied()
        .filter(|&column| grid.headings.get(column).is_some_and(|heading| direction(heading).is_some()));
    let directions: Vec<usize> = directions.collect();
    match (named.is_empty(), directions.len(), unknown.len()) {
        (false, ..) => Ok(named),
        (.., 1) => Ok(unknown),
        (.., 0) => not(columns(grid)),
        // One alone may be a number n, or s for a time.
        (_, 2.., _) => Ok(directions),
        _ => Err(column_error(grid)),
    }
}

fn columns(grid: &Grid) -> String {
    let texts: Vec<&str> = grid.headings.iter().map(|heading| heading.text.as_str()).collect();
    format!("{} columns {}", grid.columns, texts.join(", "))
}

fn column_error(grid: &Grid) -> RecordFileError {
    RecordFileError::Column { columns: columns(grid) }
}

/// Finds the unit in the heading, else in a comment on acceleration or units, else among the options.
fn unit(
    heading: Option<&Heading>,
    notes: &[String],
    options: &ReadOptions,
    line: usize,
) -> Result<Unit, RecordFileError> {
    if let Some(heading) = heading.filter(|heading| heading.is_scaled && options.unit.is_none()) {
        let expected = "a unit without a factor, or --unit";
        return Err(RecordFileError::value(line, "unit", &heading.text, expected));
    }
    let is_on_samples =
        |note: &Heading| ["acc", "unit", "vel", "dis"].iter().any(|word| note.name.contains(word));
    let note =
        || notes.iter().map(|note| Heading::new(note)).filter(is_on_samples).find_map(|note| note.unit);
    let Some(found) = heading.and_then(|heading| heading.unit).or_else(note) else {
        return given_unit(options, line);
    };
    if found.quantity != Quantity::Acceleration {
        return Err(RecordFileError::value(line, "unit", found.name, "one of acceleration, such as m/s2"));
    }
    expect_unit(options, found, line)?;
    Ok(found)
}

/// Reads the time step (s) in a comment such as `dt = 0.01 s`.
fn step_of_note(note: &Heading) -> Option<f64> {
    let value = first_number(&note.text).filter(|_| note.name.starts_with("dt_"))?;
    Some(value * note.unit.map_or(1.0, |unit| unit.si))
}

/// Computes the mean step (s) of a column of evenly spaced times; rounded times need the `given` step.
fn step_of_times(grid: &Grid, column: usize, given: Option<f64>) -> Result<f64, RecordFileError> {
    let unit = grid.headings.get(column).and_then(|heading| heading.unit);
    let in_s = unit.filter(|unit| unit.quantity == Quantity::Time).map_or(1.0, |unit| unit.si);
    let time = |row: usize| match clock_s(grid.cell(row, column)) {
        Some(time) => Ok(time),
        None => Ok(in_s * grid.number(row, column)?),
    };
    let times = (0..grid.lines.len()).map(time).collect::<Result<Vec<f64>, RecordFileError>>()?;
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut ordered = steps.clone();
    ordered.sort_by(f64::total_cmp);
    let usual = given.or(ordered.get(ordered.len() / 2).copied()).unwrap_or_default();
    // A given step that the decimals cannot represent is off by half a unit of the last one at each end.
    let decimals = |row: usize| grid.cell(row, column).split(['.', ',']).nth(1).map_or(0, str::len);
    let rounding = given.map_or(0.0, |dt_s| {
        let decimals = (0..grid.lines.len()).map(decimals).max().unwrap_or(0).min(300);
        let last_digit = in_s * 10f64.powi(-(decimals as i32));
        let in_digits = dt_s / last_digit;
        if (in_digits - in_digits.round()).abs() > 1e-6 * in_digits { last_digit } else { 0.0 }
    });
    let is_uneven = |step: &f64| (step - usual).abs() > rounding + UNEVEN * usual.abs();
    if let Some(at) = steps.iter().position(is_uneven) {
        let line = grid.lines[at + 1];
        return Err(RecordFileError::UnevenTime { line, found_s: steps[at], expected_s: usual });
    }
    let mean = (times[times.len() - 1] - times[0]) / steps.len() as f64;
    // Removes digits that the file does not have.
    Ok((mean * 1e12).round() / 1e12)
}

/// Replaces the error of uneven times if the column of accelerations has even steps: headings exchanged.
fn exchanged(grid: &Grid, times: usize, column: usize, refusal: RecordFileError) -> RecordFileError {
    let headings = grid.headings.get(times).zip(grid.headings.get(column));
    let has_steps = step_of_times(grid, column, None).is_ok_and(|step| step > 0.0);
    match headings.filter(|_| has_steps) {
        Some((time, acceleration)) => RecordFileError::Exchanged {
            line: grid.lines[0],
            time: time.text.clone(),
            acceleration: acceleration.text.clone(),
        },
        None => refusal,
    }
}
