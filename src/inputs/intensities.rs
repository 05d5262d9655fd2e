//! Tables of intensities: peaks under headings with their units, and what else is known of each motion.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, StringArray};
use rockfrag_core::fragility::Peak;
use rockfrag_core::motion::{Peaks, validate_medians};
use rockfrag_core::warning::{Warning, Warnings};

use super::hazard::{Told, expect_understood, peak};
use super::roles::describes_object;
use super::words::{is_vertical, means};
use super::{Grid, Heading, InputError, Meaning, Reader, Result};
use crate::table::dictionary;

/// Reads the columns of a table: numbers where all cells are, else text. Peaks keep their headings, and are
/// null where they are missing.
pub fn read(path: &Path, reader: &mut Reader) -> Result<Vec<(String, ArrayRef)>> {
    let read = reader.read(path).and_then(|grid| {
        expect_intensities(&grid)?;
        Told::new(&grid, path)?.expect_same(&grid.headings)?;
        let columns = (0..grid.headings.len()).map(|at| column(&grid, at)).collect::<Result<Vec<_>>>()?;
        let (columns, meanings): (Vec<_>, Vec<Meaning>) = columns.into_iter().unzip();
        expect_understood(&grid, &meanings)?;
        reader.tell(path, &grid, meanings);
        Ok(columns)
    });
    read.map_err(|error| error.in_file(path))
}

fn expect_intensities(grid: &Grid) -> Result<()> {
    if let Some(heading) = grid.headings.iter().find(|heading| describes_object(heading)) {
        let found = format!("column '{}', which describes an object", heading.text);
        let expected = "peaks, mw, p_rad_s, alpha_rad and eta: describe one object by options, or list objects \
                        in --structures";
        return Err(InputError::unexpected(found, expected));
    }
    if !grid.has_headings || grid.lines.is_empty() {
        let found = format!("{} rows under {}", grid.lines.len(), grid.found());
        return Err(InputError::unexpected(found, "intensities under pga_g and pgv_m_s"));
    }
    let is_direction = |name: &str| ["comp", "komp", "dir", "chan"].iter().any(|of| name.starts_with(of));
    if let Some(column) = grid.headings.iter().position(|heading| is_direction(&heading.name))
        && let Some(row) = grid.rows().find(|row| is_vertical(grid.cell(*row, column)))
    {
        return Err(grid.refusal(row, column, "horizontal components alone"));
    }
    expect_motions_alone(grid)
}

/// A column under its name, and what it says.
fn column(grid: &Grid, at: usize) -> Result<((String, ArrayRef), Meaning)> {
    let heading = &grid.headings[at];
    let (known, peak) = (known(heading)?, peak(heading));
    // A unit that stands below the heading becomes a part of it.
    let with_unit = heading.unit.map(|unit| format!("{} ({})", heading.text, unit.name));
    let has_own_unit = Heading::new(&heading.text).unit.is_some();
    let text = with_unit.filter(|_| peak.is_some() && !has_own_unit).unwrap_or(heading.text.clone());
    let (name, size) = known.map_or((text, 1.0), |(name, size)| (name.to_string(), size));
    let is_kept = ["place", "distance", "record", "record-number", "earthquake", "remark"];
    let meaning = match (known, peak) {
        (Some((name, _)), _) => Meaning::Known(name.to_string()),
        (_, Some((peak, _))) => Meaning::Known(peak.to_string()),
        _ if dictionary::entry(&heading.text).is_some() => Meaning::Known(heading.text.clone()),
        _ if is_kept.iter().any(|meaning| means(&heading.name, meaning)) => Meaning::Kept,
        _ if grid.rows().all(|row| grid.value(row, at).is_none()) => Meaning::Kept,
        _ => Meaning::NotUnderstood,
    };
    let (cells, meaning): (ArrayRef, Meaning) = match grid.known(Some(at), &name) {
        Err(error) if known.is_some() || peak.is_some() => return Err(error),
        Err(_) => {
            let texts = grid.rows().map(|row| grid.cell(row, at));
            (Arc::new(StringArray::from_iter_values(texts)), Meaning::Kept)
        }
        Ok(numbers) => {
            let numbers = numbers.into_iter().map(|number| number.map(|number| size * number));
            (Arc::new(Float64Array::from_iter(numbers)), meaning)
        }
    };
    Ok(((name, cells), meaning))
}

/// The column that a heading names, and its unit in rad/s, rad or s.
fn known(heading: &Heading) -> Result<Option<(&'static str, f64)>> {
    let columns = ["p_rad_s", "alpha_rad", "tp_s", "tm_s"].map(|column| (column, Heading::new(column)));
    let Some((column, own)) = columns.into_iter().find(|(_, own)| own.name == heading.name) else {
        return Ok(means(&heading.name, "magnitude").then_some(("mw", 1.0)));
    };
    match heading.unit.zip(own.unit) {
        None if !heading.is_scaled && !heading.is_percent => Ok(Some((column, 1.0))),
        Some((unit, own)) if unit.quantity == own.quantity => Ok(Some((column, unit.si))),
        _ => Err(InputError::Units { heading: heading.text.clone(), unit: column.to_string() }),
    }
}

/// Finds the column of a peak by its name, and its unit in m/s2 or m/s.
pub fn column_of_peak<'a>(names: &[&'a str], wanted: Peak) -> Result<(&'a str, f64)> {
    let own = if wanted == Peak::Pga { "pga_m_s2" } else { "pgv_m_s" };
    let found = names.iter().filter_map(|name| {
        let (peak, unit) = peak(&Heading::new(name))?;
        (peak == wanted).then_some((*name, unit))
    });
    let found: Vec<(&str, f64)> = found.collect();
    match (found.iter().find(|(name, _)| *name == own), &found[..]) {
        (Some(column), _) | (None, [column]) => Ok(*column),
        (None, several) => {
            let named: Vec<&str> = several.iter().map(|(name, _)| *name).collect();
            let named = if named.is_empty() { names } else { &named };
            let expected = "one of pga_m_s2 or pga_g, and pgv_m_s; --columns pga_m_s2=HEADING names one";
            Err(InputError::unexpected(format!("columns {}", named.join(", ")), expected))
        }
    }
}

pub fn expect_motions_alone(grid: &Grid) -> Result<()> {
    let mut cells = grid.rows().flat_map(|row| (0..grid.headings.len()).map(move |at| (row, at)));
    let total = cells.find(|(row, at)| {
        let cell = grid.cell(*row, *at);
        cell.starts_with(char::is_alphabetic) && means(cell, "total")
    });
    total.map_or(Ok(()), |(row, at)| Err(grid.refusal(row, at, "motions alone")))
}

pub struct MotionTable {
    /// Peaks as they are given, perhaps beyond any record.
    pub given: Vec<Peaks>,
    pub mw: Vec<Option<f64>>,
    /// Columns of PGA, PGV and magnitude.
    pub columns: Vec<usize>,
}

/// Reads the motions of a table with both peaks, which must show no wrong unit, and warns of those beyond any
/// record.
pub fn motions(grid: &Grid, warnings: &mut Warnings) -> Result<Option<MotionTable>> {
    let headings = || grid.headings.iter().enumerate().filter_map(|(at, heading)| Some((at, peak(heading)?)));
    let [Some((pga, (_, pga_unit))), Some((pgv, (_, pgv_unit)))] =
        [Peak::Pga, Peak::Pgv].map(|wanted| headings().find(|(_, (peak, _))| *peak == wanted))
    else {
        return Ok(None);
    };
    expect_motions_alone(grid)?;
    let magnitude = grid.about("magnitude");
    let both = grid.intensities(pga, pga_unit)?.into_iter().zip(grid.intensities(pgv, pgv_unit)?);
    let given: Vec<Peaks> = both.map(|(pga_m_s2, pgv_m_s)| Peaks { pga_m_s2, pgv_m_s }).collect();
    let mw = grid.known(magnitude, "mw")?;
    validate_medians(given.iter().copied()).map_err(InputError::Implausible)?;
    let beyond = given.iter().filter(|peaks| **peaks != peaks.clamp_to_recorded()).count();
    if beyond > 0 {
        warnings.add(Warning::AtRim, format!("{beyond} of {} rows", given.len()));
    }
    let columns = [Some(pga), Some(pgv), magnitude].into_iter().flatten().collect();
    Ok(Some(MotionTable { given, mw, columns }))
}
