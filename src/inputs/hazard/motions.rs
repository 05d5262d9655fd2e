//! Motions in the rows of a table, by their peaks.

use rockfrag_core::fragility::Peak;
use rockfrag_core::motion::{Peaks, validate_medians};
use rockfrag_core::warning::{Warning, Warnings};

use super::columns::peak;
use crate::inputs::words::means;
use crate::inputs::{Grid, InputError};

/// Refuses a row of totals or means.
pub fn expect_motions_alone(grid: &Grid) -> Result<(), InputError> {
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
pub fn motions(grid: &Grid, warnings: &mut Warnings) -> Result<Option<MotionTable>, InputError> {
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
