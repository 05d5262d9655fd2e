//! Lists of what stood and what fell: objects as in a list of objects, with the PGA and PGV where they stood.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use polars_core::prelude::AnyValue;
use rockfrag_core::fragility::ObservedOutcome;
use rockfrag_core::object::structure_warnings;
use rockfrag_core::warning::{Warning, Warnings};

use crate::inputs::intensities::motions;
use crate::inputs::objects;
use crate::inputs::words::means;
use crate::inputs::{Grid, Heading, InputError};
use crate::pipeline::context::Context;
use crate::table::file::{ParquetTable, is_table};
use crate::table::frame;

/// Reads outcomes from CSV or Parquet; none of responses, which have demands.
pub fn read(path: &Path, context: &Context) -> anyhow::Result<Option<Vec<ObservedOutcome>>> {
    let grid = if path.is_file() && !is_table(path) {
        Grid::read(path)
    } else {
        let table = ParquetTable::open(path)?;
        if table.schema().field_with_name("edp").is_ok() {
            return Ok(None);
        }
        Grid::from_cells(&frame::cells(&frame::read(&table)?, in_full))
    };
    let read = grid.map_err(Into::into).and_then(|grid| outcomes(&grid, path, context));
    read.map(Some).with_context(|| path.display().to_string())
}

fn in_full(value: AnyValue) -> String {
    match value {
        AnyValue::Null => String::new(),
        AnyValue::Float64(number) => number.to_string(),
        other => other.str_value().into_owned(),
    }
}

fn outcomes(grid: &Grid, path: &Path, context: &Context) -> anyhow::Result<Vec<ObservedOutcome>> {
    let mut doubts = Warnings::default();
    let (Some(motions), Some(fell)) = (motions(grid, &mut doubts)?, grid.about("outcome")) else {
        let expected = "objects, and of each pga_g, pgv_m_s and fell (yes or no)";
        bail!("{}; expected {expected}", grid.found());
    };
    let names_outcome =
        |heading: &&Heading| means(&heading.name, "outcome") || means(&heading.name, "upright");
    let outcomes: Vec<&str> =
        grid.headings.iter().filter(names_outcome).map(|heading| heading.text.as_str()).collect();
    let several = format!("columns {}; expected one of what befell each object", outcomes.join(", "));
    ensure!(outcomes.len() < 2, several);
    let earthquake = grid.about("earthquake");
    let others: Vec<usize> = motions.columns.into_iter().chain([fell]).chain(earthquake).collect();
    let (objects, about_list, meanings) = objects::in_rows(grid, &others)?;
    doubts.extend(about_list);
    let (mut earthquakes, mut rows, mut read) = (HashMap::new(), HashMap::new(), Vec::new());
    for (row, object) in objects.into_iter().enumerate() {
        let line = format!("line {}", grid.lines[row]);
        let is_one = object.count.is_none_or(|count| count == 1);
        ensure!(is_one, "{line}: several objects; expected one in each row");
        let sides = object.sides().map_err(|problem| anyhow::anyhow!("{line}: {problem}"))?;
        // What stands on both sides of a base falls over the weaker one, the first.
        let (structure, peaks) = (sides[0].structure.clone(), motions.given[row].clamp_to_recorded());
        structure_warnings(&structure).into_iter().for_each(|warning| doubts.add(warning, line.clone()));
        let fell = has_fallen(grid, row, fell)?;
        ensure!(
            !fell || peaks.pga_m_s2 > structure.uplift_acceleration_m_s2(),
            "{line}: fell, but this PGA does not uplift it: wrong size or PGA, or a rounded base? leave it \
             out"
        );
        let cells = (0..grid.headings.len()).filter(|at| Some(*at) != grid.about("outcome"));
        let cells: Vec<&str> = cells.map(|at| grid.cell(row, at)).collect();
        if let Some(first) = rows.insert(cells, grid.lines[row]).filter(|_| grid.about("name").is_some()) {
            doubts.add(Warning::Repeated, format!("{line} as line {first}"));
        }
        let (name, mw) = (earthquake.map_or("", |column| grid.cell(row, column)), motions.mw[row]);
        let next = earthquakes.len() as u32;
        let (number, first) = *earthquakes.entry(name).or_insert((next, mw));
        if let (Some(first), Some(mw)) = (first, mw)
            && first != mw
            && !name.is_empty()
        {
            bail!("{line}: magnitude {mw}; expected {first}, that of earthquake '{name}' before");
        }
        read.push(ObservedOutcome { structure, peaks, mw, earthquake: number, fell });
    }
    context.tell(doubts, vec![grid.reading(path, meanings)]);
    Ok(read)
}

fn has_fallen(grid: &Grid, row: usize, column: usize) -> Result<bool, InputError> {
    let is_open = ["outcome", "state"].contains(&&*grid.headings[column].name);
    match grid.cell(row, column) {
        cell if is_open && (means(cell, "yes") || means(cell, "free")) => {
            Err(grid.refusal(row, column, "fell or stood"))
        }
        cell if means(cell, "fell") => Ok(true),
        cell if means(cell, "stood") => Ok(false),
        _ => Err(grid.refusal(row, column, "fell or stood, or yes or no")),
    }
}
