//! Lists of what stood and what fell: objects as in a list of objects, with the PGA and PGV where they stood.

use std::path::Path;

use anyhow::{Context, bail};

use crate::fragility::{ObservedOutcome, Peak};
use crate::inputs::hazard::peak;
use crate::inputs::{Grid, InputError, objects};
use crate::motion::Peaks;
use crate::plausibility::{MAGNITUDES, at_rim, judge_medians};
use crate::table::file::{Table, is_table};
use crate::table::frame::{self, Format};

/// Headings of what happened.
const OUTCOME: [&str; 6] = ["fell", "fallen", "toppled", "overturned", "outcome", "state"];
const FELL: &str = "1 yes y true fell fallen toppled overturned overturning";
const STOOD: &str = "0 no n false stood standing stands upright";
const MAGNITUDE: [&str; 3] = ["mw", "m", "magnitude"];
const EARTHQUAKE: [&str; 2] = ["earthquake", "event"];

/// Whether a file holds outcomes, not responses, which have demands.
pub fn is_list(path: &Path) -> anyhow::Result<bool> {
    Ok(is_text(path) || Table::open(path)?.schema().field_with_name("edp").is_err())
}

fn is_text(path: &Path) -> bool {
    path.is_file() && !is_table(path)
}

/// Reads outcomes from CSV or Parquet.
pub fn read(path: &Path) -> anyhow::Result<Vec<ObservedOutcome>> {
    let grid = match is_text(path) {
        true => Grid::read(path),
        false => {
            let text = frame::show(&frame::read(&Table::open(path)?, usize::MAX)?, Format::Csv)?;
            Grid::parse(text.as_bytes(), None)
        }
    };
    grid.map_err(Into::into).and_then(|grid| outcomes(&grid)).with_context(|| path.display().to_string())
}

fn outcomes(sheet: &Grid) -> anyhow::Result<Vec<ObservedOutcome>> {
    let objects = objects::of_rows(sheet)?;
    let [pga, pgv] = [Peak::Pga, Peak::Pgv].map(|wanted| {
        let mut peaks = sheet.headings.iter().map(peak).enumerate();
        peaks.find_map(|(column, found)| {
            found.filter(|found| found.0 == wanted).map(|(_, unit)| (column, unit))
        })
    });
    let (Some(pga), Some(pgv), Some(fell)) = (pga, pgv, sheet.column(&OUTCOME)) else {
        bail!("expected objects with pga_g, pgv_m_s and fell (yes or no), each");
    };
    let (magnitude, earthquake) = (sheet.column(&MAGNITUDE), sheet.column(&EARTHQUAKE));
    let mut earthquakes: Vec<&str> = Vec::new();
    let mut read = Vec::new();
    for (row, object) in objects.into_iter().enumerate() {
        let line = format!("line {}", sheet.lines[row]);
        let sides = object.sides().map_err(|problem| anyhow::anyhow!("{line}: {problem}"))?;
        // What stands on both sides of a base falls over the weaker one, the first.
        let structure = sides[0].structure.clone();
        let (pga_m_s2, pgv_m_s) = (peak_in(sheet, row, pga)?, peak_in(sheet, row, pgv)?);
        let peaks = at_rim(Peaks { pga_m_s2, pgv_m_s });
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
            mw: mw.map(|column| magnitude_in(sheet, row, column)).transpose()?,
            earthquake: known.unwrap_or(earthquakes.len() - 1) as u32,
            fell,
        });
    }
    judge_medians(read.iter().map(|outcome| outcome.peaks))?;
    Ok(read)
}

fn peak_in(sheet: &Grid, row: usize, (column, unit): (usize, f64)) -> Result<f64, InputError> {
    let value = unit * sheet.number(row, column)?;
    if value > 0.0 { Ok(value) } else { Err(sheet.refusal(row, column, "a number above 0")) }
}

fn magnitude_in(sheet: &Grid, row: usize, column: usize) -> Result<f64, InputError> {
    let mw = sheet.number(row, column)?;
    let is_known = MAGNITUDES.contains(&mw);
    if is_known { Ok(mw) } else { Err(sheet.refusal(row, column, "a magnitude from 1 to 9.9")) }
}

fn has_fallen(sheet: &Grid, row: usize, column: usize) -> Result<bool, InputError> {
    let word = sheet.cell(row, column).to_lowercase();
    match [FELL, STOOD].map(|words| words.split(' ').any(|other| other == word)) {
        [true, _] => Ok(true),
        [_, true] => Ok(false),
        _ => Err(sheet.refusal(row, column, "fell or stood, or yes or no")),
    }
}
