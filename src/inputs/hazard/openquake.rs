//! What OpenQuake exports for one site, as tables of others have it.

use super::told::{Told, noted};
use crate::inputs::{Grid, Heading, InputError, Result};

/// Gives the columns of ground-motion fields headings with their units: PGA in g, PGV in cm/s.
pub fn name_fields(grid: &mut Grid) {
    for heading in &mut grid.headings {
        let Some(imt) = heading.text.strip_prefix("gmv_") else { continue };
        *heading = Heading::new(&format!("{imt} ({})", if imt == "PGV" { "cm/s" } else { "g" }));
    }
}

/// The table of a curve with a column for each level. What is not known to be the mean is not taken for it.
pub fn curve(grid: &Grid, told: &mut Told) -> Result<Grid> {
    told.qualify(&Heading::new("kind"), noted(grid, "kind").unwrap_or("unknown"))?;
    let (Some(imt), Some(years), 1) = (noted(grid, "imt"), told.years, grid.lines.len()) else {
        let found = format!("{} rows under {}", grid.lines.len(), grid.notes.join(" "));
        return Err(InputError::unexpected(found, "one row under imt and investigation_time"));
    };
    let unit = if imt == "PGV" { "cm/s" } else { "g" };
    let is_level = |at: &usize| grid.headings[*at].text.starts_with("poe-");
    let (levels, others): (Vec<usize>, Vec<usize>) = (0..grid.headings.len()).partition(is_level);
    let row = |first: String, second: String, of_others: &dyn Fn(usize) -> String| {
        [first, second].into_iter().chain(others.iter().map(|at| of_others(*at))).collect::<Vec<String>>()
    };
    let heading = |at: usize| grid.headings[at].text.clone();
    let cell = |at: usize| grid.cell(0, at).to_string();
    let mut rows = vec![row(format!("{imt} ({unit})"), format!("PoE in {years} years"), &heading)];
    rows.extend(levels.iter().map(|at| row(heading(*at).replace("poe-", ""), cell(*at), &cell)));
    let mut table = Grid::from_cells(&rows)?;
    table.notes.clone_from(&grid.notes);
    Ok(table)
}
