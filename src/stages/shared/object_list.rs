//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::path::Path;

use anyhow::Context;
use clap::CommandFactory;

use super::hazard::headings;
use super::spec::{Reason, Shape, Spec};
use crate::sheet::{Heading, Sheet};
use crate::units::Quantity;

/// What a column is about.
#[derive(Debug, Clone, PartialEq)]
enum Column {
    /// An option, and the quantity that it has a unit of.
    Option(String, Option<Quantity>),
    /// What holds an object.
    Held,
    Unused,
}

/// Headings of names, the best first.
const NAMES: [&str; 6] = ["name", "equipment", "object", "item", "tag", "description"];
/// Names of rows that are no objects.
const TOTALS: [&str; 6] = ["total", "totals", "sum", "subtotal", "mean", "average"];
/// Other headings of numbers.
const SYNONYMS: [(&str, &str); 9] = [
    ("qty", "count"),
    ("quantity", "count"),
    ("number", "count"),
    ("pieces", "count"),
    ("t1", "period"),
    ("inertia-m2", "inertia"),
    ("mu", "friction"),
    ("w", "width"),
    ("h", "height"),
];
/// Beginnings of headings of what holds an object: anchors, anchored, bracing, castors, ...
const HELD: [&str; 7] = ["anchor", "brac", "fix", "restrain", "castor", "caster", "wheel"];
/// Cells that say that nothing does.
const FREE: [&str; 10] = ["", "no", "n", "none", "false", "0", "-", "free", "unanchored", "free-standing"];

/// Reads a list: the objects of its rows, and the headings of columns that say nothing of them.
pub fn read(path: &Path) -> anyhow::Result<(Vec<Spec>, Vec<String>)> {
    let place = || path.display().to_string();
    let sheet = Sheet::parse(&std::fs::read(path).with_context(place)?).with_context(place)?;
    let columns: Vec<Column> = sheet.headings.iter().map(meaning).collect();
    let has = |name: &str| columns.iter().any(|column| matches!(column, Column::Option(of, _) if of == name));
    let texts = || sheet.headings.iter().map(|heading| heading.text.clone());
    if !(has("height") || has("p")) {
        anyhow::bail!(
            "{}: {}; expected name, width, depth and height, or p, alpha and eta",
            place(),
            headings(&sheet)
        );
    }
    if sheet.lines.is_empty() {
        anyhow::bail!("{}: no rows; expected one per object", place());
    }
    let unclear = |heading: &&Heading| {
        heading.unit.is_none()
            && heading.text.contains(['(', '[', '"', '\'', '%'])
            && meaning(heading) != Column::Unused
    };
    if let Some(heading) = sheet.headings.iter().find(unclear) {
        anyhow::bail!(
            "{}: heading '{}': expected m, cm or mm in brackets, or no unit",
            place(),
            heading.text
        );
    }
    let option = |column: &Column| matches!(column, Column::Option(..)).then(|| column.clone());
    for (at, column) in columns.iter().enumerate().filter_map(|(at, column)| Some((at, option(column)?))) {
        if columns[..at].contains(&column) {
            anyhow::bail!("{}: two columns '{}'; keep one", place(), sheet.headings[at].text);
        }
    }
    let named = NAMES.iter().find_map(|name| sheet.column(&[name]));
    let name = |row: usize| match named.map_or("", |column| sheet.cell(row, column)) {
        "" => format!("line {}", sheet.lines[row]),
        name => name.to_string(),
    };
    let rows = 0..sheet.lines.len();
    let names: Vec<String> = rows.clone().map(name).collect();
    let spec = |row: usize| {
        let name = match names.iter().filter(|name| **name == names[row]).count() {
            1 => names[row].clone(),
            _ => format!("{} (line {})", names[row], sheet.lines[row]),
        };
        let held = columns.iter().enumerate().filter(|(_, column)| **column == Column::Held);
        let held = held.filter_map(|(at, _)| held_by(&sheet.headings[at].text, sheet.cell(row, at))).next();
        match spec(&sheet, &columns, row) {
            Ok(_) if TOTALS.contains(&names[row].to_lowercase().as_str()) => {
                let refused = Some(Reason::Implausible("a row of totals, not an object".to_string()));
                Spec { name, refused, ..Spec::from(Shape::default()) }
            }
            Ok(spec) => Spec { name, refused: held, ..spec },
            Err(problem) => {
                Spec { name, refused: Some(Reason::Implausible(problem)), ..Spec::from(Shape::default()) }
            }
        }
    };
    let unused = texts().enumerate().filter(|(at, _)| columns[*at] == Column::Unused && Some(*at) != named);
    Ok((rows.map(spec).collect(), unused.map(|(_, text)| text).collect()))
}

/// Whether a heading says what an object is like or where it stands, p, alpha and eta aside.
pub fn describes_object(heading: &Heading) -> bool {
    let others = ["p", "alpha", "eta", "count"];
    matches!(meaning(heading), Column::Option(name, _) if !others.contains(&name.as_str()))
}

fn meaning(heading: &Heading) -> Column {
    let name = heading.name.replace('_', "-").replace("center", "centre");
    let synonym = SYNONYMS.iter().find(|(other, _)| *other == name).map(|(_, name)| *name);
    let is_count = heading.unit.is_some_and(|unit| unit.quantity == Quantity::Counts);
    let name = if is_count { "count" } else { synonym.unwrap_or(&name) };
    let command = Spec::command();
    let option = command.get_arguments().find(|option| option.get_long() == Some(name) && name != "name");
    match option.and_then(|option| option.get_value_names()).map(|names| names[0].as_str()) {
        Some("M") => Column::Option(name.to_string(), Some(Quantity::Length)),
        Some("S") => Column::Option(name.to_string(), Some(Quantity::Time)),
        Some("RAD") => Column::Option(name.to_string(), Some(Quantity::Angle)),
        Some("RAD/S") => Column::Option(name.to_string(), Some(Quantity::AngularFrequency)),
        Some(_) => Column::Option(name.to_string(), None),
        None if HELD.iter().any(|start| name.starts_with(start)) => Column::Held,
        None => Column::Unused,
    }
}

fn spec(sheet: &Sheet, columns: &[Column], row: usize) -> Result<Spec, String> {
    let mut pairs: Vec<(String, String)> = Vec::new();
    for (at, column) in columns.iter().enumerate() {
        let (cell, unit) = (sheet.cell(row, at), sheet.headings[at].unit);
        let Column::Option(name, quantity) = column else { continue };
        let size = match (quantity, unit) {
            _ if cell.is_empty() => continue,
            (Some(quantity), Some(unit)) if unit.quantity == *quantity => unit.si,
            (Some(Quantity::Length), Some(unit)) => {
                return Err(format!("{name} is in {}; expected m, cm or mm", unit.name));
            }
            (_, Some(unit)) if unit.quantity != Quantity::Counts => {
                return Err(format!("{name} is in {}; expected another unit, or none", unit.name));
            }
            _ => 1.0,
        };
        let number = sheet.number(row, at).map(|number| (size * number).to_string());
        pairs.push((name.clone(), number.unwrap_or(cell.to_string())));
    }
    // Of one side alone it is the width.
    if pairs.iter().all(|(name, _)| name != "width") {
        pairs
            .iter_mut()
            .filter(|(name, _)| name == "depth")
            .for_each(|(name, _)| *name = "width".to_string());
    }
    Spec::of_pairs(pairs.into_iter())
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
