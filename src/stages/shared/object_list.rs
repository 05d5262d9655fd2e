//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::path::Path;

use anyhow::Context;

use super::spec::{NUMBERS, Spec};
use crate::sheet::{Heading, Sheet};
use crate::units::Quantity;

/// The specification of each row, or its name and what is wrong with it; and the headings of columns that say
/// nothing of objects.
pub type Listed = (Vec<Result<Spec, (String, String)>>, Vec<String>);

/// What a column is about.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    /// A number, and the quantity that it has a unit of.
    Number(&'static str, Option<Quantity>),
    Eta,
    Name,
    /// What holds an object.
    Held,
    Unused,
}

/// Headings of names, the best first.
const NAMES: [&str; 6] = ["name", "equipment", "object", "item", "tag", "description"];
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

/// Reads a list.
pub fn read(path: &Path) -> anyhow::Result<Listed> {
    let place = || path.display().to_string();
    let sheet = Sheet::parse(&std::fs::read(path).with_context(place)?).with_context(place)?;
    let named = NAMES.iter().find_map(|name| sheet.column(&[name]));
    let columns: Vec<Column> = (0..sheet.columns)
        .map(|at| if Some(at) == named { Column::Name } else { meaning(sheet.headings.get(at)) })
        .collect();
    let has = |key: &str| columns.iter().any(|column| matches!(column, Column::Number(of, _) if *of == key));
    let texts = || sheet.headings.iter().map(|heading| heading.text.clone());
    if !(has("height") || has("p")) {
        let headings = texts().collect::<Vec<_>>().join(", ");
        anyhow::bail!(
            "{}: headings {headings}; expected name, width, depth and height, or p, alpha and eta",
            place()
        );
    }
    let unused = texts().zip(&columns).filter(|(_, column)| **column == Column::Unused).map(|(text, _)| text);
    let names: Vec<String> = (0..sheet.lines.len()).map(|row| name(&sheet, named, row)).collect();
    let spec = |row: usize| {
        let is_other = |name: &&String| **name == names[row];
        let name = match names.iter().filter(is_other).count() {
            1 => names[row].clone(),
            _ => format!("{} (line {})", names[row], sheet.lines[row]),
        };
        let refused = |problem: String| (name.clone(), format!("{}: structure '{name}': {problem}", place()));
        let spec = spec(&sheet, &columns, row).map_err(refused)?;
        Ok(Spec { name: Some(name), ..spec })
    };
    Ok(((0..sheet.lines.len()).map(spec).collect(), unused.collect()))
}

fn name(sheet: &Sheet, column: Option<usize>, row: usize) -> String {
    match column.map_or("", |column| sheet.cell(row, column)) {
        "" => format!("line {}", sheet.lines[row]),
        name => name.to_string(),
    }
}

fn meaning(heading: Option<&Heading>) -> Column {
    let Some(heading) = heading else { return Column::Unused };
    let key = heading.name.replace('_', "-").replace("center", "centre");
    let synonym = SYNONYMS.iter().find(|(other, _)| *other == key).map(|(_, key)| *key);
    let is_count = heading.unit.is_some_and(|unit| unit.quantity == Quantity::Counts);
    let key = if is_count { "count" } else { synonym.unwrap_or(&key) };
    match NUMBERS.iter().find(|number| **number == key) {
        Some(number @ (&"width" | &"height" | &"depth")) => Column::Number(number, Some(Quantity::Length)),
        Some(number) if number.starts_with("centre") => Column::Number(number, Some(Quantity::Length)),
        Some(number @ &"period") => Column::Number(number, Some(Quantity::Time)),
        Some(number) => Column::Number(number, None),
        None if key == "eta" => Column::Eta,
        None if HELD.iter().any(|start| key.starts_with(start)) => Column::Held,
        None => Column::Unused,
    }
}

fn spec(sheet: &Sheet, columns: &[Column], row: usize) -> Result<Spec, String> {
    let mut spec = Spec::default();
    for (at, column) in columns.iter().enumerate() {
        let cell = sheet.cell(row, at);
        match column {
            Column::Held => spec.held = spec.held.or(held(&sheet.headings[at].text, cell)),
            _ if cell.is_empty() => {}
            Column::Number(key, quantity) => {
                let (heading, number) = (&sheet.headings[at], sheet.number(row, at));
                let size = match (quantity, heading.unit) {
                    (Some(quantity), Some(unit)) if unit.quantity == *quantity => unit.si,
                    (Some(Quantity::Length), Some(unit)) => {
                        return Err(format!("{key} is in {}; expected m, cm or mm", unit.name));
                    }
                    (Some(_), Some(unit)) => return Err(format!("{key} is in {}; expected s", unit.name)),
                    _ => 1.0,
                };
                let value = size * number.map_err(|error| error.to_string())?;
                spec.number_mut(key).expect("each column of numbers has a field").replace(value);
            }
            Column::Eta => spec.eta = Some(cell.parse()?),
            Column::Name | Column::Unused => {}
        }
    }
    // Of one side alone it is the width.
    if spec.width.is_none() {
        spec.width = spec.depth.take();
    }
    Ok(spec)
}

/// Why an object with this cell under this heading of anchors is not free to rock.
fn held(heading: &str, cell: &str) -> Option<String> {
    let [heading, word] = [heading, cell].map(|text| text.trim().to_lowercase());
    let rolls =
        ["castor", "caster", "wheel"].iter().any(|wheels| heading.contains(wheels) || word.contains(wheels));
    match FREE.contains(&word.as_str()) {
        true => None,
        false if rolls => Some("on castors: it rolls, and does not rock".to_string()),
        false => Some(format!("{heading}: {word}; it is not free to rock")),
    }
}
