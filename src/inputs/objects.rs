//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::collections::HashMap;
use std::path::Path;

use super::floors::{self, Building, Storey};
use super::numbers::is_missing;
use super::words::{joined, means, words};
use super::{Grid, Heading, InputError, Renames};
use crate::keyword::Keyword;
use crate::number::rounded;
use crate::object::{Field, Object, Place, Reason};
use crate::units::{Quantity, Unit};
use crate::warning::{Warning, Warnings};

/// What a column is about.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    /// What is known of an object.
    Known(Field),
    /// The number of such objects.
    Count,
    /// What holds an object.
    Held,
    /// The floor that it stands on.
    Storey,
    /// The number of storeys of its building.
    Storeys,
    /// The type of its building.
    Building,
    /// It speaks of the object, and is not understood.
    Unclear,
    Unused,
}

/// Parts of headings that speak of an object.
const OF_OBJECTS: [&str; 12] = [
    "floor",
    "storey",
    "story",
    "geschoss",
    "stockwerk",
    "centre-of",
    "centroid",
    "cog",
    "schwerpunkt",
    "friction",
    "reibung",
    "anchor",
];

/// What a call says of all rows of a list.
#[derive(Debug, Clone, Copy, Default)]
pub struct Common {
    /// The number of the ground floor, if it is given.
    pub ground_floor: Option<u32>,
    /// Where objects stand that do not say so themselves.
    pub place: Place,
}

/// A list: its columns by what they say.
struct List<'a> {
    grid: &'a Grid,
    columns: Vec<Column>,
    name: Option<usize>,
    ground_floor: u32,
    place: Place,
}

/// Reads a list: the objects of its rows, and the columns that are not used.
pub fn read(
    path: &Path,
    renames: &mut Renames,
    common: &Common,
) -> Result<(Vec<Object>, Warnings), InputError> {
    let mut objects = || {
        let mut grid = Grid::read(path)?;
        renames.apply(&mut grid)?;
        let list = List::new(&grid, common)?;
        Ok((list.objects(), list.unused()))
    };
    objects().map_err(|error: InputError| error.of(path))
}

/// The objects of the rows of a grid.
pub fn of_rows(grid: &Grid) -> Result<Vec<Object>, InputError> {
    Ok(List::new(grid, &Common::default())?.objects())
}

/// Whether a heading says what an object is like or where it stands, p, alpha and eta aside.
pub fn describes_object(heading: &Heading) -> bool {
    const OF_STRUCTURES: [Field; 3] = [Field::P, Field::Alpha, Field::Eta];
    match meaning(heading) {
        Column::Known(field) => !OF_STRUCTURES.contains(&field),
        column => matches!(column, Column::Storey | Column::Storeys | Column::Unclear),
    }
}

fn meaning(heading: &Heading) -> Column {
    let name = joined(&heading.name);
    if heading.unit.is_some_and(|unit| unit.quantity == Quantity::Counts) {
        return Column::Count;
    }
    let is = |meaning: &str| words(meaning).any(|word| word == name);
    let field = Field::ALL.iter().find(|field| field.as_str() == name || is(field.as_str()));
    let others = [
        ("count", Column::Count),
        ("storey", Column::Storey),
        ("storeys", Column::Storeys),
        ("building", Column::Building),
    ];
    let other = others.into_iter().find(|(meaning, _)| is(meaning)).map(|(_, column)| column);
    match field.map(|field| Column::Known(*field)).or(other) {
        Some(column) => column,
        None if words("held").any(|start| name.starts_with(start)) => Column::Held,
        None if OF_OBJECTS.iter().any(|part| name.contains(part)) => Column::Unclear,
        // Perhaps another side of the base: without it the object would seem safer.
        None if heading.unit.is_some_and(|unit| unit.quantity == Quantity::Length) => Column::Unclear,
        None => Column::Unused,
    }
}

impl List<'_> {
    fn new<'a>(grid: &'a Grid, common: &Common) -> Result<List<'a>, InputError> {
        let columns: Vec<Column> = grid.headings.iter().map(meaning).collect();
        let name = words("name")
            .find_map(|name| grid.headings.iter().position(|heading| joined(&heading.name) == name));
        let mut list = List { grid, columns, name, ground_floor: 0, place: common.place };
        list.check()?;
        if list.column(Column::Storey).is_none() {
            // Without a floor, the building says nothing.
            for column in &mut list.columns {
                if matches!(column, Column::Storeys | Column::Building) {
                    *column = Column::Unused;
                }
            }
        }
        let storeys: Vec<Storey> = (0..grid.lines.len())
            .filter(|row| list.cell(*row, Column::Known(Field::Level)).is_none())
            .filter_map(|row| list.cell(row, Column::Storey).and_then(Storey::parse))
            .collect();
        let ask = |lowest| InputError::GroundFloor {
            heading: list.column(Column::Storey).map_or(String::new(), |at| grid.headings[at].text.clone()),
            lowest,
        };
        list.ground_floor = match common.ground_floor {
            Some(number) => number,
            None => floors::ground_floor(&storeys).map_err(ask)?,
        };
        Ok(list)
    }

    /// Checks the headings.
    fn check(&self) -> Result<(), InputError> {
        let (grid, expected) = (self.grid, "name, width, depth and height, or p, alpha and eta");
        let has = |field| self.column(Column::Known(field)).is_some();
        if !(has(Field::Height) || has(Field::P)) {
            let unused =
                |(at, column): &(usize, &Column)| **column == Column::Unused && Some(*at) != self.name;
            let unknown = self.columns.iter().enumerate().find(unused);
            return Err(match unknown {
                Some((at, _)) => {
                    let heading = grid.headings[at].text.clone();
                    InputError::Heading { heading, expected, found: grid.found() }
                }
                None => InputError::Missing { found: grid.found(), expected },
            });
        }
        if grid.lines.is_empty() {
            return Err(InputError::Missing { found: "no rows".to_string(), expected: "one per object" });
        }
        for (at, (heading, column)) in grid.headings.iter().zip(&self.columns).enumerate() {
            let text = heading.text.replace("(-)", "").replace("[-]", "");
            let has_sign = text.contains(['(', '[', '"', '\'', '%']);
            if matches!(column, Column::Known(_)) && heading.unit.is_none() && has_sign {
                let found = format!("heading '{}'", heading.text);
                return Err(InputError::Missing { found, expected: "m, cm or mm in brackets, or no unit" });
            }
            let is_one = !matches!(column, Column::Held | Column::Unclear | Column::Unused);
            if is_one && self.columns[..at].contains(column) {
                let found = format!("two columns '{}'", heading.text);
                return Err(InputError::Missing { found, expected: "one" });
            }
        }
        Ok(())
    }

    fn column(&self, wanted: Column) -> Option<usize> {
        self.columns.iter().position(|column| *column == wanted)
    }

    /// What stands in a column, if anything does.
    fn cell(&self, row: usize, column: Column) -> Option<&str> {
        self.column(column).map(|at| self.grid.cell(row, at)).filter(|cell| !cell.is_empty())
    }

    /// The columns that are not used, named once.
    fn unused(&self) -> Warnings {
        let is_unused =
            |(at, column): &(usize, &Column)| **column == Column::Unused && Some(*at) != self.name;
        let unused: Vec<&str> = self
            .columns
            .iter()
            .enumerate()
            .filter(is_unused)
            .map(|(at, _)| self.grid.headings[at].text.as_str())
            .filter(|text| !text.is_empty())
            .collect();
        let one = (!unused.is_empty()).then(|| (Warning::UnusedColumns, unused.join(", ")));
        one.into_iter().collect()
    }

    fn objects(&self) -> Vec<Object> {
        let grid = self.grid;
        let name = |row: usize| match self.name.map_or("", |column| grid.cell(row, column)) {
            "" => format!("line {}", grid.lines[row]),
            name => name.to_string(),
        };
        let names: Vec<String> = (0..grid.lines.len()).map(name).collect();
        let mut uses: HashMap<&str, usize> = HashMap::new();
        names.iter().for_each(|name| *uses.entry(name).or_default() += 1);
        let listed = |(row, name): (usize, &String)| {
            let is_total = means(name, "total");
            let name = match uses[name.as_str()] {
                1 => name.clone(),
                _ => format!("{name} (line {})", grid.lines[row]),
            };
            match self.object(row) {
                Ok(object) if !is_total => Object { name, refused: self.held(row), ..object },
                given => {
                    let problem = given.err().unwrap_or("a row of totals, not an object".to_string());
                    Object { name, refused: Some(Reason::Implausible(problem)), ..Object::default() }
                }
            }
        };
        names.iter().enumerate().map(listed).collect()
    }

    /// The object of a row, or what is wrong with it.
    fn object(&self, row: usize) -> Result<Object, String> {
        let mut object = Object::default();
        for (at, column) in self.columns.iter().enumerate() {
            let (cell, heading) = (self.grid.cell(row, at), &self.grid.headings[at]);
            let (name, quantity) = match column {
                _ if cell.is_empty() => continue,
                Column::Known(field) => (field.as_str(), field.quantity()),
                Column::Count => ("count", None),
                Column::Unclear if !is_missing(cell) => {
                    let text = &heading.text;
                    return Err(format!(
                        "column '{text}' is not understood: rename it (--columns) or leave it out"
                    ));
                }
                _ => continue,
            };
            let is_needed = matches!(name, "width" | "height" | "p" | "alpha");
            if !is_needed && has_no_value(cell) {
                continue;
            }
            let size = in_si(name, quantity, heading.unit)?;
            match self.grid.number(row, at) {
                Ok(number) => object.set(name, &rounded(size * number).to_string())?,
                Err(error @ InputError::Thousands { .. }) => return Err(error.to_string()),
                Err(_) => object.set(name, cell)?,
            }
        }
        object.place = self.on_floor(row, object.place)?;
        Ok(object)
    }

    /// The place of an object with the floor that its row names.
    fn on_floor(&self, row: usize, place: Place) -> Result<Place, String> {
        let Some(cell) = self.cell(row, Column::Storey).filter(|cell| !has_no_value(cell)) else {
            return Ok(place);
        };
        if place.level.is_some() && place.period.or(self.place.period).is_some() {
            return Ok(place);
        }
        let storey =
            Storey::parse(cell).ok_or_else(|| format!("floor '{cell}'; expected a number, G or roof"))?;
        let above = storey.above(self.ground_floor);
        if above == Some(0) {
            return Ok(Place { level: place.level.or(Some(0.0)), ..place });
        }
        let all = self.cell(row, Column::Storeys);
        let storeys = match all.map(|cell| cell.parse::<f64>()) {
            Some(Ok(storeys)) if storeys.fract() == 0.0 && (1.0..200.0).contains(&storeys) => storeys as u32,
            Some(_) => return Err(format!("storeys '{}'; expected a whole number", all.unwrap_or_default())),
            None => {
                return Err(format!(
                    "floor {cell}: expected the storeys of the building (column Storeys), or Level and T1 (s)"
                ));
            }
        };
        let above = above.unwrap_or(storeys);
        if above > storeys {
            return Err(format!("floor {cell} of {storeys} storeys: which is right?"));
        }
        let building = self.cell(row, Column::Building).filter(|cell| !is_missing(cell));
        let type_of = |cell: &str| {
            let expected = "expected walls, masonry, concrete frame or steel frame";
            Building::parse(cell).ok_or_else(|| format!("building '{cell}'; {expected}"))
        };
        let building = building.map(type_of).transpose()?;
        let known = Place { period: place.period.or(self.place.period), ..place };
        Ok(floors::place(above, storeys, building, known))
    }

    /// Why the object of a row is not free to rock.
    fn held(&self, row: usize) -> Option<Reason> {
        let held = self.columns.iter().enumerate().filter(|(_, column)| **column == Column::Held);
        held.filter_map(|(at, _)| held_by(&self.grid.headings[at].text, self.grid.cell(row, at))).next()
    }
}

/// Whether a cell says that there is nothing to say; an error of a workbook does not.
fn has_no_value(cell: &str) -> bool {
    is_missing(cell) && !cell.starts_with('#')
}

/// The size of a unit in m, s, rad or rad/s.
fn in_si(name: &str, quantity: Option<Quantity>, unit: Option<Unit>) -> Result<f64, String> {
    let refuse = |unit: Unit, expected| Err(format!("{name} is in {}; expected {expected}", unit.name));
    match (quantity, unit) {
        (Some(quantity), Some(unit)) if unit.quantity == quantity => Ok(unit.si),
        (Some(Quantity::Length), Some(unit)) => refuse(unit, "m, cm or mm"),
        (_, Some(unit)) if unit.quantity != Quantity::Counts => refuse(unit, "another unit, or none"),
        _ => Ok(1.0),
    }
}

/// Why an object with this cell under this heading of anchors is not free to rock.
fn held_by(heading: &str, cell: &str) -> Option<Reason> {
    const WHEELS: [&str; 6] = ["castor", "caster", "wheel", "rollen", "ruote", "ruedas"];
    let [heading, word] = [heading, cell].map(|text| text.trim().to_lowercase());
    let rolls = WHEELS.iter().any(|wheels| heading.contains(wheels) || word.contains(wheels));
    if has_no_value(cell) || means(cell, "free") {
        return None;
    }
    Some(Reason::NotRocking(match rolls {
        true => "on castors: it rolls, and does not rock".to_string(),
        false => format!("{heading}: {word}; it is not free to rock"),
    }))
}
