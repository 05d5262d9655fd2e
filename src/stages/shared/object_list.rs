//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context, bail};

use crate::inputs::{Grid, Heading, Renames};
use crate::keyword::Keyword;
use crate::object::{Field, Object, Reason};
use crate::units::{Quantity, Unit};
use crate::warning::{Warning, Warnings};

/// What a column is about.
#[derive(Debug, Clone, PartialEq)]
enum Column {
    /// What is known of an object.
    Known(Field),
    /// The number of such objects.
    Count,
    /// What holds an object.
    Held,
    Unused,
}

/// Headings of names, the best first.
const NAMES: [&str; 6] = ["name", "equipment", "object", "item", "tag", "description"];
/// Names of rows that are no objects.
const TOTALS: [&str; 6] = ["total", "totals", "sum", "subtotal", "mean", "average"];
/// Other headings of options.
const SYNONYMS: [(&str, &str); 6] = [
    ("count", "qty quantity number pieces"),
    ("period", "t1"),
    ("inertia", "inertia-m2"),
    ("friction", "mu"),
    ("width", "w"),
    ("height", "h"),
];
/// Beginnings of headings of what holds an object: anchors, anchored, bracing, castors, ...
const HELD: [&str; 7] = ["anchor", "brac", "fix", "restrain", "castor", "caster", "wheel"];
/// Cells that say that nothing does.
const FREE: [&str; 10] = ["", "no", "n", "none", "false", "0", "-", "free", "unanchored", "free-standing"];

/// Reads a list: the objects of its rows, and warnings about columns that say nothing of them.
pub fn read(path: &Path, renames: &mut Renames) -> anyhow::Result<(Vec<Object>, Warnings)> {
    let mut objects = || {
        let mut grid = Grid::read(path)?;
        renames.apply(&mut grid)?;
        objects(&grid)
    };
    objects().with_context(|| path.display().to_string())
}

fn objects(sheet: &Grid) -> anyhow::Result<(Vec<Object>, Warnings)> {
    let columns: Vec<Column> = sheet.headings.iter().map(meaning).collect();
    let has = |field| columns.contains(&Column::Known(field));
    if !(has(Field::Height) || has(Field::P)) {
        bail!("{}; expected name, width, depth and height, or p, alpha and eta", sheet.found());
    }
    if sheet.lines.is_empty() {
        bail!("no rows; expected one per object");
    }
    let is_unclear = |(heading, column): &(&Heading, &Column)| {
        let has_sign = heading.text.contains(['(', '[', '"', '\'', '%']);
        heading.unit.is_none() && has_sign && **column != Column::Unused
    };
    if let Some((heading, _)) = sheet.headings.iter().zip(&columns).find(is_unclear) {
        bail!("heading '{}': expected m, cm or mm in brackets, or no unit", heading.text);
    }
    for (at, column) in columns.iter().enumerate() {
        if matches!(column, Column::Known(_) | Column::Count) && columns[..at].contains(column) {
            bail!("two columns '{}'; keep one", sheet.headings[at].text);
        }
    }
    let named = NAMES.iter().find_map(|name| sheet.column(&[name]));
    let name = |row: usize| match named.map_or("", |column| sheet.cell(row, column)) {
        "" => format!("line {}", sheet.lines[row]),
        name => name.to_string(),
    };
    let names: Vec<String> = (0..sheet.lines.len()).map(name).collect();
    let mut uses = HashMap::new();
    names.iter().for_each(|name| *uses.entry(name.as_str()).or_insert(0) += 1);
    let listed = |(row, name): (usize, &String)| {
        let is_total = TOTALS.contains(&name.to_lowercase().as_str());
        let name = match uses[name.as_str()] {
            1 => name.clone(),
            _ => format!("{name} (line {})", sheet.lines[row]),
        };
        let held = columns.iter().enumerate().filter(|(_, column)| **column == Column::Held);
        let held = held.filter_map(|(at, _)| held_by(&sheet.headings[at].text, sheet.cell(row, at))).next();
        match object(sheet, &columns, row) {
            Ok(object) if !is_total => Object { name, refused: held, ..object },
            given => {
                let problem = given.err().unwrap_or("a row of totals, not an object".to_string());
                Object { name, refused: Some(Reason::Implausible(problem)), ..Object::default() }
            }
        }
    };
    let is_unused = |(at, column): &(usize, &Column)| **column == Column::Unused && Some(*at) != named;
    let unused = columns.iter().enumerate().filter(is_unused);
    let unused = unused.map(|(at, _)| (Warning::UnusedColumns, sheet.headings[at].text.clone())).collect();
    Ok((names.iter().enumerate().map(listed).collect(), unused))
}

/// Whether a heading says what an object is like or where it stands, p, alpha and eta aside.
pub fn describes_object(heading: &Heading) -> bool {
    let others = [Field::P, Field::Alpha, Field::Eta];
    matches!(meaning(heading), Column::Known(field) if !others.contains(&field))
}

fn meaning(heading: &Heading) -> Column {
    let name = heading.name.replace('_', "-").replace("center", "centre");
    let is_synonym = |(_, others): &&(&str, &str)| others.split(' ').any(|other| other == name);
    let is_count = heading.unit.is_some_and(|unit| unit.quantity == Quantity::Counts);
    let synonym = SYNONYMS.iter().find(is_synonym).map(|(option, _)| *option);
    let name = if is_count { "count" } else { synonym.unwrap_or(&name) };
    match name.parse() {
        Ok(field) => Column::Known(field),
        Err(_) if name == "count" => Column::Count,
        Err(_) if HELD.iter().any(|start| name.starts_with(start)) => Column::Held,
        Err(_) => Column::Unused,
    }
}

fn object(sheet: &Grid, columns: &[Column], row: usize) -> Result<Object, String> {
    let mut object = Object::default();
    // Of one side alone it is the width.
    let width = columns.iter().position(|column| *column == Column::Known(Field::Width));
    let has_width = width.is_some_and(|at| !sheet.cell(row, at).is_empty());
    for (at, column) in columns.iter().enumerate() {
        let (cell, unit) = (sheet.cell(row, at), sheet.headings[at].unit);
        let (name, quantity) = match column {
            _ if cell.is_empty() => continue,
            Column::Known(Field::Depth) if !has_width => ("width", Some(Quantity::Length)),
            Column::Known(field) => (field.as_str(), field.quantity()),
            Column::Count => ("count", None),
            Column::Held | Column::Unused => continue,
        };
        let refuse = |unit: Unit, expected| Err(format!("{name} is in {}; expected {expected}", unit.name));
        let size = match (quantity, unit) {
            (Some(quantity), Some(unit)) if unit.quantity == quantity => unit.si,
            (Some(Quantity::Length), Some(unit)) => return refuse(unit, "m, cm or mm"),
            (_, Some(unit)) if unit.quantity != Quantity::Counts => {
                return refuse(unit, "another unit, or none");
            }
            _ => 1.0,
        };
        let number = sheet.number(row, at).map(|number| (size * number).to_string());
        object.set(name, &number.unwrap_or(cell.to_string()))?;
    }
    Ok(object)
}

/// Why an object with this cell under this heading of anchors is not free to rock.
fn held_by(heading: &str, cell: &str) -> Option<Reason> {
    let [heading, word] = [heading, cell].map(|text| text.trim().to_lowercase());
    let rolls =
        ["castor", "caster", "wheel"].iter().any(|wheels| heading.contains(wheels) || word.contains(wheels));
    match FREE.contains(&word.as_str()) {
        true => None,
        false if rolls => Some(Reason::NotRocking("on castors: it rolls, and does not rock".to_string())),
        false => Some(Reason::NotRocking(format!("{heading}: {word}; it is not free to rock"))),
    }
}
