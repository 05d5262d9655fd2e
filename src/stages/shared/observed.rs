//! Lists of what stood and what fell: objects as in a list of objects, with the PGA and PGV where they stood.

use std::path::Path;

use anyhow::{Context, bail};

use crate::fragility::{ObservedOutcome, Peak};
use crate::inputs::hazard::peak;
use crate::inputs::words::means;
use crate::inputs::{Grid, InputError, objects};
use crate::motion::{Peaks, judge_medians};
use crate::plausibility::MAGNITUDES;
use crate::table::file::{Table, is_table};
use crate::table::frame::{self, Format};
use crate::warning::Warnings;

/// Whether a file holds outcomes, not responses, which have demands.
pub fn is_list(path: &Path) -> anyhow::Result<bool> {
    Ok(is_text(path) || Table::open(path)?.schema().field_with_name("edp").is_err())
}

fn is_text(path: &Path) -> bool {
    path.is_file() && !is_table(path)
}

/// Reads outcomes from CSV or Parquet, and what of it is not used.
pub fn read(path: &Path) -> anyhow::Result<(Vec<ObservedOutcome>, Warnings)> {
    let grid = match is_text(path) {
        true => Grid::read(path),
        false => {
            let text = frame::show(&frame::read(&Table::open(path)?, usize::MAX)?, Format::Csv)?;
            Grid::parse(text.as_bytes(), None)
        }
    };
    grid.map_err(Into::into).and_then(|grid| outcomes(&grid)).with_context(|| path.display().to_string())
}

fn outcomes(sheet: &Grid) -> anyhow::Result<(Vec<ObservedOutcome>, Warnings)> {
    let peaks: Vec<_> = sheet.headings.iter().map(peak).collect();
    let [pga, pgv] = [Peak::Pga, Peak::Pgv]
        .map(|wanted| peaks.iter().position(|found| found.is_some_and(|(peak, _)| peak == wanted)));
    let (Some(pga), Some(pgv), Some(fell)) = (pga, pgv, sheet.about("outcome")) else {
        let expected = "objects, and of each pga_g, pgv_m_s and fell (yes or no)";
        bail!("{}; expected {expected}", sheet.found());
    };
    let peak_in = |row: usize, column: usize| {
        let unit = peaks[column].map_or(1.0, |(_, unit)| unit);
        sheet
            .within(row, column, &(f64::MIN_POSITIVE..=f64::MAX), "a number above 0")
            .map(|value| unit * value)
    };
    let (magnitude, earthquake) = (sheet.about("magnitude"), sheet.about("earthquake"));
    let others: Vec<usize> =
        [Some(pga), Some(pgv), Some(fell), magnitude, earthquake].into_iter().flatten().collect();
    let (objects, unused) = objects::in_rows(sheet, &others)?;
    let mut earthquakes: Vec<&str> = Vec::new();
    let mut read = Vec::new();
    for (row, object) in objects.into_iter().enumerate() {
        let line = format!("line {}", sheet.lines[row]);
        if object.count.is_some_and(|count| count != 1) {
            bail!("{line}: several objects; expected one in each row");
        }
        let sides = object.sides().map_err(|problem| anyhow::anyhow!("{line}: {problem}"))?;
        // What stands on both sides of a base falls over the weaker one, the first.
        let structure = sides[0].structure.clone();
        let peaks = Peaks { pga_m_s2: peak_in(row, pga)?, pgv_m_s: peak_in(row, pgv)? }.at_rim();
        let fell = has_fallen(sheet, row, fell)?;
        if fell && peaks.pga_m_s2 <= structure.uplift_acceleration_m_s2() {
            bail!(
                "{line}: fell, but this PGA does not uplift it: wrong size or PGA, or a rounded base? \
                 leave it out"
            );
        }
        let name = earthquake.map_or("", |column| sheet.cell(row, column));
        let known = earthquakes.iter().position(|other| *other == name);
        if known.is_none() {
            earthquakes.push(name);
        }
        let mw = magnitude.filter(|column| !sheet.cell(row, *column).is_empty());
        read.push(ObservedOutcome {
            structure,
            peaks,
            mw: mw.map(|at| sheet.within(row, at, &MAGNITUDES, "a magnitude from 1 to 9.9")).transpose()?,
            earthquake: known.unwrap_or(earthquakes.len() - 1) as u32,
            fell,
        });
    }
    judge_medians(read.iter().map(|outcome| outcome.peaks))?;
    Ok((read, unused))
}

fn has_fallen(sheet: &Grid, row: usize, column: usize) -> Result<bool, InputError> {
    let is_open = ["outcome", "state"].contains(&&*sheet.headings[column].name);
    match sheet.cell(row, column) {
        cell if is_open && (means(cell, "yes") || means(cell, "free")) => {
            Err(sheet.refusal(row, column, "fell or stood"))
        }
        cell if means(cell, "fell") => Ok(true),
        cell if means(cell, "stood") => Ok(false),
        _ => Err(sheet.refusal(row, column, "fell or stood, or yes or no")),
    }
}
