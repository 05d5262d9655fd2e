//! Columns of a table: acceleration, with or without times. Headings and comments name units, time steps and
//! quantities; options of the user must not contradict them.

use super::error::RecordFileError;
use super::header::{expect_step, expect_unit, first_number, given_unit, time_step};
use crate::inputs::{Grid, Heading};
use crate::records::{ReadOptions, RecordedMotion};
use crate::units::{Quantity, Unit};

/// Accepted relative difference of a step of time from the usual one.
const UNEVEN: f64 = 0.05;

/// Reads the motion in a table.
pub fn parse(bytes: &[u8], options: &ReadOptions) -> Result<RecordedMotion, RecordFileError> {
    let sheet = Grid::parse(bytes, None)?;
    let has_numbers = |row: usize| (0..sheet.columns).any(|column| sheet.number(row, column).is_ok());
    let Some(&line) = sheet.lines.first().filter(|_| has_numbers(0)) else {
        let heading = || sheet.headings.first().map(|heading| heading.text.clone());
        let found = sheet.notes.first().cloned().or_else(heading).unwrap_or_default();
        return Err(RecordFileError::Unrecognised { found });
    };
    let notes: Vec<Heading> = sheet.notes.iter().map(|note| Heading::new(note)).collect();
    let quantities = quantities(&sheet);
    let column = match options.column.as_deref() {
        Some("all") => None,
        choice => Some(acceleration(&sheet, &quantities, choice, line)?),
    };
    let samples = numbers(&sheet, column)?;
    if samples.len() < 2 {
        return Err(RecordFileError::Count { announced: 2, found: samples.len() });
    }
    let heading = column.and_then(|column| sheet.headings.get(column));
    let unit = unit(heading, &notes, options, line)?;
    let times = quantities.iter().position(|quantity| *quantity == Some(Quantity::Time));
    let found = match (times, column) {
        (Some(times), Some(column)) => {
            let step = step_of_times(&sheet, times, options.dt_s);
            Some(step.map_err(|refusal| exchanged(&sheet, times, column, refusal))?)
        }
        _ => notes.iter().find_map(step_of_note),
    };
    let expected = "a column of times, or a comment such as dt = 0.005 s";
    let dt_s = options.dt_s.or(found).ok_or(RecordFileError::NoTimeStep { line, expected })?;
    expect_step(options, found.unwrap_or(dt_s), line)?;
    let component = heading.map(|heading| heading.text.clone());
    Ok(RecordedMotion { component, ..RecordedMotion::new(time_step(dt_s, line)?, samples, unit) })
}

/// Reads a column, or all cells as one series; the last row may be short.
fn numbers(sheet: &Grid, column: Option<usize>) -> Result<Vec<f64>, RecordFileError> {
    let columns = column.map_or(0..sheet.columns, |column| column..column + 1);
    let cells = (0..sheet.lines.len()).flat_map(|row| columns.clone().map(move |column| (row, column)));
    let read = cells.filter(|(row, place)| column.is_some() || !sheet.cell(*row, *place).is_empty());
    read.map(|(row, column)| Ok(sheet.number(row, column)?)).collect()
}

/// Finds the quantity of each column from its heading. An unnamed first column that rises is time.
fn quantities(sheet: &Grid) -> Vec<Option<Quantity>> {
    let known = |heading: &Heading| {
        let named = heading.name.split('_').find_map(|word| match word {
            "a" | "ag" => Some(Quantity::Acceleration),
            "t" | "zeit" | "temps" => Some(Quantity::Time),
            _ if word.starts_with("acc") => Some(Quantity::Acceleration),
            _ if word.starts_with("time") => Some(Quantity::Time),
            _ if word.starts_with("vel") => Some(Quantity::Velocity),
            _ if word.starts_with("dis") => Some(Quantity::Length),
            _ => None,
        });
        named.or(heading.unit.map(|unit| unit.quantity))
    };
    let mut quantities: Vec<Option<Quantity>> = sheet.headings.iter().map(known).collect();
    quantities.resize(sheet.columns, None);
    let has_times = quantities.contains(&Some(Quantity::Time));
    let rises = || numbers(sheet, Some(0)).is_ok_and(|times| times.is_sorted_by(|time, next| time < next));
    if sheet.columns > 1 && !has_times && quantities[0].is_none() && rises() {
        quantities[0] = Some(Quantity::Time);
    }
    quantities
}

/// Finds the column of acceleration: the chosen one, the one with that heading, or the only candidate.
fn acceleration(
    sheet: &Grid,
    quantities: &[Option<Quantity>],
    choice: Option<&str>,
    line: usize,
) -> Result<usize, RecordFileError> {
    let of = |wanted: Option<Quantity>| {
        let is = move |column: &usize| quantities[*column] == wanted && !sheet.cell(0, *column).is_empty();
        (0..sheet.columns).filter(is).collect::<Vec<_>>()
    };
    let named = of(Some(Quantity::Acceleration));
    let candidates = match (choice, choice.map(str::parse::<usize>)) {
        (_, Some(Ok(number))) => vec![number.wrapping_sub(1)],
        (Some(name), _) => {
            let is_chosen = |heading: &Heading| heading.text == name || heading.name == name;
            sheet.headings.iter().position(is_chosen).into_iter().collect()
        }
        (None, _) if named.is_empty() => of(None),
        (None, _) => named,
    };
    let texts: Vec<&str> = sheet.headings.iter().map(|heading| heading.text.as_str()).collect();
    let columns = format!("{} columns {}", sheet.columns, texts.join(", "));
    let not = |found: String| Err(RecordFileError::NotAcceleration { line, found });
    match candidates[..] {
        [column] => match quantities.get(column) {
            Some(None | Some(Quantity::Acceleration)) => Ok(column),
            Some(Some(other)) => not(format!("{other:?}").to_lowercase()),
            None => Err(RecordFileError::Column { columns }),
        },
        [] if choice.is_none() => not(columns),
        _ => Err(RecordFileError::Column { columns }),
    }
}

/// Finds the unit in the heading, else in a comment on acceleration or units, else among the options.
fn unit(
    heading: Option<&Heading>,
    notes: &[Heading],
    options: &ReadOptions,
    line: usize,
) -> Result<Unit, RecordFileError> {
    let is_on_samples = |note: &str| ["acc", "unit", "vel", "dis"].iter().any(|word| note.contains(word));
    let note = || notes.iter().filter(|note| is_on_samples(&note.name)).find_map(|note| note.unit);
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
fn step_of_times(sheet: &Grid, column: usize, given: Option<f64>) -> Result<f64, RecordFileError> {
    let unit = sheet.headings.get(column).and_then(|heading| heading.unit);
    let in_s = unit.filter(|unit| unit.quantity == Quantity::Time).map_or(1.0, |unit| unit.si);
    let times: Vec<f64> = numbers(sheet, Some(column))?.into_iter().map(|time| time * in_s).collect();
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut ordered = steps.clone();
    ordered.sort_by(f64::total_cmp);
    let usual = given.unwrap_or(ordered[ordered.len() / 2]);
    // A given step that the decimals cannot represent is off by half a unit of the last one at each end.
    let decimals = |row: usize| sheet.cell(row, column).split(['.', ',']).nth(1).map_or(0, str::len);
    let rounding = given.map_or(0.0, |dt_s| {
        let decimals = (0..sheet.lines.len()).map(decimals).max().unwrap_or(0).min(300);
        let last_digit = in_s * 10f64.powi(-(decimals as i32));
        let in_digits = dt_s / last_digit;
        if (in_digits - in_digits.round()).abs() > 1e-6 * in_digits { last_digit } else { 0.0 }
    });
    let is_uneven = |step: &f64| (step - usual).abs() > rounding + UNEVEN * usual.abs();
    if let Some(at) = steps.iter().position(is_uneven) {
        let line = sheet.lines[at + 1];
        return Err(RecordFileError::UnevenTime { line, found_s: steps[at], expected_s: usual });
    }
    let mean = (times[times.len() - 1] - times[0]) / steps.len() as f64;
    // Removes digits that the file does not have.
    Ok((mean * 1e12).round() / 1e12)
}

/// Replaces the error of uneven times if the column of accelerations has even steps: headings exchanged.
fn exchanged(sheet: &Grid, times: usize, column: usize, refusal: RecordFileError) -> RecordFileError {
    let headings = sheet.headings.get(times).zip(sheet.headings.get(column));
    let has_steps = step_of_times(sheet, column, None).is_ok_and(|step| step > 0.0);
    match headings.filter(|_| has_steps) {
        Some((time, acceleration)) => RecordFileError::Exchanged {
            line: sheet.lines[0],
            time: time.text.clone(),
            acceleration: acceleration.text.clone(),
        },
        None => refusal,
    }
}
