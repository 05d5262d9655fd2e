//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::collections::HashMap;
use std::path::Path;

use rockfrag_core::object::{Field, Object, ObjectError, Place, Wall};
use rockfrag_core::plausibility::validate_lengths;
use rockfrag_core::units::{Quantity, Unit};
use rockfrag_core::warning::{Warning, Warnings};
use strum::VariantArray;

use super::floors::{self, Building, Storey};
use super::words::{is_one_of, joined, means, synonyms};
use super::{Grid, Heading, InputError, Meaning, Reader, Result};
use crate::number::rounded;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Role {
    Name,
    Known(Field),
    Count,
    /// The unit of lengths.
    Unit,
    /// What holds an object.
    Held,
    /// The floor that it stands on.
    Storey,
    /// The number of storeys of its building.
    Storeys,
    Building,
    /// A property of the object that is not understood.
    Unclear,
    /// What befell the object.
    Other,
    Unused,
}

/// Floors beyond this number are levels in percent, or something else.
const HIGHEST_FLOOR: f64 = 50.0;

/// What a call says of all rows of a list.
#[derive(Debug, Clone, Copy, Default)]
pub struct ListDefaults {
    pub ground_floor: Option<u32>,
    /// Those of the building of rows that do not say theirs.
    pub storeys: Option<u32>,
    pub building: Option<&'static Building>,
    /// Where objects stand that do not say so themselves.
    pub place: Place,
}

struct List<'a> {
    grid: &'a Grid,
    columns: Vec<Role>,
    ground_floor: u32,
    place: Place,
}

/// Reads a list: the objects of its rows, and doubts about them.
pub fn read(path: &Path, reader: &mut Reader, defaults: &ListDefaults) -> Result<(Vec<Object>, Warnings)> {
    let list = |reader: &mut Reader| {
        let grid = reader.read(path)?;
        let list = List::new(&grid, defaults)?;
        reader.tell(path, &grid, list.meanings());
        Ok((list.objects(), list.doubts()))
    };
    list(reader).map_err(|error: InputError| error.in_file(path))
}

/// The objects of the rows of a grid that has these other columns, doubts about them, and what columns say.
pub fn in_rows(grid: &Grid, others: &[usize]) -> Result<(Vec<Object>, Warnings, Vec<Meaning>)> {
    let mut list = List::new(grid, &ListDefaults::default())?;
    others.iter().for_each(|at| list.columns[*at] = Role::Other);
    Ok((list.objects(), list.doubts(), list.meanings()))
}

/// Whether a heading says what an object is like or where it stands, p, alpha and eta aside.
pub fn describes_object(heading: &Heading) -> bool {
    match meaning(heading) {
        // Of an earthquake or a station.
        _ if heading.unit.is_some_and(|unit| unit.name == "km") => false,
        Role::Known(field) => !matches!(field, Field::P | Field::Alpha | Field::Eta),
        Role::Unclear => synonyms("of-objects").any(|part| heading.name.contains(part)),
        column => matches!(column, Role::Storey | Role::Storeys),
    }
}

fn meaning(heading: &Heading) -> Role {
    const OTHERS: [(&str, Role); 5] = [
        ("count", Role::Count),
        ("unit", Role::Unit),
        ("storey", Role::Storey),
        ("storeys", Role::Storeys),
        ("building", Role::Building),
    ];
    let (name, quantity) = (&heading.name, heading.unit.map(|unit| unit.quantity));
    let fields = Field::VARIANTS.iter().map(|field| (field.into(), Role::Known(*field)));
    let mut known = fields.chain(OTHERS).filter(|(meaning, _)| name == meaning || is_one_of(name, meaning));
    match known.next().map(|(_, column)| column) {
        _ if quantity == Some(Quantity::Counts) => Role::Count,
        Some(column) => column,
        None if synonyms("held").any(|start| name.starts_with(start)) => Role::Held,
        None if synonyms("of-objects").any(|part| name.contains(part)) => Role::Unclear,
        // Perhaps another side of the base: without it the object would seem safer.
        None if quantity == Some(Quantity::Length) => Role::Unclear,
        None => Role::Unused,
    }
}

impl List<'_> {
    fn new<'a>(grid: &'a Grid, defaults: &ListDefaults) -> Result<List<'a>> {
        let mut columns: Vec<Role> = grid.headings.iter().map(meaning).collect();
        grid.about("name").into_iter().for_each(|at| columns[at] = Role::Name);
        let mut list = List { grid, columns, ground_floor: 0, place: defaults.place };
        list.check()?;
        let has_units = list.column(Role::Unit).is_some_and(|at| {
            let mut units = grid.rows().filter_map(|row| Unit::parse(grid.cell(row, at)));
            units.any(|unit| unit.quantity == Quantity::Length)
        });
        let is_of_floors = list.level_is_of_floors();
        let has_storey = list.column(Role::Storey).is_some() || is_of_floors;
        for (at, column) in list.columns.iter_mut().enumerate() {
            match column {
                Role::Known(Field::Level) if is_of_floors => *column = Role::Storey,
                Role::Count if numbers_rows(grid, at) => *column = Role::Unused,
                // A ward, perhaps.
                Role::Unit if !has_units => *column = Role::Unused,
                // Without a floor, the building says nothing.
                Role::Storeys | Role::Building if !has_storey => *column = Role::Unused,
                _ => {}
            }
        }
        let Some(at) = list.column(Role::Storey) else { return Ok(list) };
        let open = grid.rows().filter(|row| list.cell(*row, Role::Known(Field::Level)).is_none());
        let storeys: Vec<Storey> = open.filter_map(|row| Storey::parse(grid.cell(row, at))).collect();
        let heading = grid.headings[at].text.clone();
        let found = defaults.ground_floor.map_or_else(|| floors::ground_floor(&storeys), Ok);
        list.ground_floor = found.map_err(|lowest| InputError::GroundFloor { heading, lowest })?;
        Ok(list)
    }

    /// Whether levels are floors: shares of the height of a building do not exceed 1.
    fn level_is_of_floors(&self) -> bool {
        let level = self.column(Role::Known(Field::Level));
        level.filter(|_| self.column(Role::Storey).is_none()).is_some_and(|at| {
            let levels = || self.grid.rows().filter_map(|row| self.grid.number(row, at).ok());
            levels().any(|level| level > 1.0)
                && levels().all(|level| level.fract() == 0.0 && level < HIGHEST_FLOOR)
        })
    }

    /// Checks the headings, and the lengths below each.
    fn check(&self) -> Result<()> {
        let (grid, expected) = (self.grid, "name, width, depth and height, or p, alpha and eta");
        if [Field::Height, Field::P].iter().all(|field| self.column(Role::Known(*field)).is_none()) {
            let mut unknown = self.headings(Role::Unused).chain(self.headings(Role::Unclear));
            return Err(InputError::not_understood(unknown.next(), expected, grid.found()));
        }
        if grid.lines.is_empty() {
            return Err(InputError::unexpected("no rows", "one per object"));
        }
        for (at, (heading, column)) in grid.headings.iter().zip(&self.columns).enumerate() {
            let text = heading.text.replace("(-)", "").replace("[-]", "");
            let has_sign = text.contains(['(', '[', '"', '\'', '%']);
            if matches!(column, Role::Known(_)) && heading.unit.is_none() && has_sign {
                let found = format!("heading '{}'", heading.text);
                return Err(InputError::unexpected(found, "m, cm or mm in brackets, or no unit"));
            }
            let may_repeat = matches!(column, Role::Held | Role::Unclear | Role::Unused);
            if let Some(first) = self.column(*column).filter(|first| *first != at && !may_repeat) {
                let found = format!("columns '{}' and '{}'", grid.headings[first].text, heading.text);
                return Err(InputError::unexpected(found, "one of them"));
            }
            let is_side = matches!(column, Role::Known(Field::Width | Field::Depth | Field::Height));
            if let Some(unit) = heading.unit.filter(|_| is_side) {
                let lengths = grid.rows().filter_map(|row| grid.number(row, at).ok());
                validate_lengths(*column == Role::Known(Field::Height), unit, lengths).map_err(
                    |expected| InputError::unexpected(format!("column '{}'", heading.text), expected),
                )?;
            } else if let Some(note) = grid.notes.iter().find(|note| is_side && names_unit_of_length(note)) {
                let expected = "the unit in the heading of each column: Width (mm)";
                return Err(InputError::unexpected(format!("a unit above the headings: '{note}'"), expected));
            }
        }
        Ok(())
    }

    fn column(&self, wanted: Role) -> Option<usize> {
        self.columns.iter().position(|column| *column == wanted)
    }

    fn headings(&self, wanted: Role) -> impl Iterator<Item = &str> {
        let all = self.grid.headings.iter().zip(&self.columns).filter(move |(_, column)| **column == wanted);
        all.map(|(heading, _)| heading.text.as_str()).filter(|text| !text.is_empty())
    }

    /// What stands in a column, if it says anything.
    fn cell(&self, row: usize, column: Role) -> Option<&str> {
        self.column(column).and_then(|at| self.grid.value(row, at))
    }

    /// The words that are taken as no value.
    fn doubts(&self) -> Warnings {
        let (grid, mut doubts) = (self.grid, Warnings::default());
        for (at, column) in self.columns.iter().enumerate() {
            let mut values = grid.rows().filter_map(|row| grid.value(row, at));
            // A blank cell beside filled ones may be unknown.
            let is_open = match column {
                Role::Held => values.any(|cell| means(cell, "free")),
                Role::Known(Field::Depth) => values.next().is_some(),
                Role::Known(_) => false,
                _ => continue,
            };
            for row in grid.rows().filter(|row| grid.value(*row, at).is_none()) {
                if is_open || grid.cell(row, at).contains(char::is_alphanumeric) {
                    let about = format!("{} of {}", grid.headings[at].text, self.name_of(row));
                    doubts.add(Warning::NotGiven, about);
                }
            }
        }
        doubts
    }

    fn objects(&self) -> Vec<Object> {
        let names: Vec<String> = self.grid.rows().map(|row| self.name_of(row)).collect();
        let mut uses: HashMap<&str, usize> = HashMap::new();
        names.iter().for_each(|name| *uses.entry(name).or_default() += 1);
        let names_floors = self.place.level.is_none() && self.grid.rows().any(|row| self.names_floor(row));
        let objects = names.iter().zip(&self.grid.lines).enumerate().map(|(row, (name, line))| {
            let object = match self.object(row) {
                Ok(_) if means(name, "total") => Err("a row of totals, not an object".to_string()),
                Ok(_) if names_floors && !self.names_floor(row) => {
                    Err("no floor, but others have one: write G if it is the ground".to_string())
                }
                given => given,
            };
            let refused = self.held(row).or(object.as_ref().err().cloned().map(ObjectError::Implausible));
            let labels = self.labels(row);
            let is_unique = uses[name.as_str()] == 1;
            let name = if is_unique { name.clone() } else { format!("{name} (line {line})") };
            Object { name, refused, labels, ..object.unwrap_or_default() }
        });
        objects.collect()
    }

    /// What each column says.
    fn meanings(&self) -> Vec<Meaning> {
        let meaning = |(at, role): (usize, &Role)| match role {
            Role::Known(field) => Meaning::Known(field.to_string()),
            Role::Unused if self.grid.is_text(at) => Meaning::Kept,
            Role::Unused | Role::Unclear => Meaning::NotUnderstood,
            other => Meaning::Known(format!("{other:?}").to_lowercase()),
        };
        self.columns.iter().enumerate().map(meaning).collect()
    }

    /// What else a row says, in words of its own.
    fn labels(&self, row: usize) -> Vec<(String, String)> {
        let kept =
            (0..self.columns.len()).filter(|at| self.columns[*at] == Role::Unused && self.grid.is_text(*at));
        kept.map(|at| (self.grid.headings[at].text.clone(), self.grid.cell(row, at).to_string())).collect()
    }

    fn name_of(&self, row: usize) -> String {
        match self.column(Role::Name).map_or("", |column| self.grid.cell(row, column)) {
            "" => format!("line {}", self.grid.lines[row]),
            name => name.to_string(),
        }
    }

    /// Whether a row says on which floor its object stands.
    fn names_floor(&self, row: usize) -> bool {
        self.cell(row, Role::Storey).or(self.cell(row, Role::Known(Field::Level))).is_some()
    }

    fn object(&self, row: usize) -> Result<Object, String> {
        let mut object = Object::default();
        for (at, column) in self.columns.iter().enumerate() {
            let cell = self.grid.cell(row, at);
            let is_needed =
                [Field::Width, Field::Height, Field::P, Field::Alpha].map(Role::Known).contains(column);
            let (name, size) = match column {
                _ if cell.is_empty() || self.grid.value(row, at).is_none() && !is_needed => continue,
                Role::Known(Field::Wall) if means(cell, "free") => continue,
                Role::Known(Field::Wall) if means(cell, "yes") => {
                    object.place.wall = Some(Wall::Yes);
                    continue;
                }
                Role::Known(field) => (field.into(), self.size(row, at, *field)?),
                Role::Count => ("count", 1.0),
                Role::Unclear => {
                    let text = &self.grid.headings[at].text;
                    return Err(format!(
                        "column '{text}' is not understood: rename it (--columns) or leave it out"
                    ));
                }
                _ => continue,
            };
            match self.grid.number(row, at) {
                Ok(number) => object.set(name, &rounded(size * number).to_string())?,
                // Other fields may be words, or know what is expected.
                Err(InputError::Cell { .. }) if !is_needed => object.set(name, cell)?,
                Err(error) => return Err(error.to_string()),
            }
        }
        self.put_on_floor(row, &mut object)?;
        Ok(object)
    }

    /// The size of the unit of a cell in m, s, rad or rad/s: that of its heading, of lengths else that of the
    /// row.
    fn size(&self, row: usize, at: usize, field: Field) -> Result<f64, String> {
        let (heading, quantity) = (&self.grid.headings[at], field.entry().quantity);
        let cell = self.cell(row, Role::Unit).filter(|_| quantity == Some(Quantity::Length));
        let own = cell.map(|cell| {
            let own = Unit::parse(cell).filter(|own| heading.unit.is_none_or(|unit| unit == *own));
            own.ok_or_else(|| format!("unit '{cell}'; expected that of '{}', or m, cm or mm", heading.text))
        });
        match heading.unit.or(own.transpose()?) {
            None => Ok(1.0),
            Some(unit) if Some(unit.quantity) == quantity => Ok(unit.si),
            Some(unit) => Err(format!("{field} is in {}; expected another unit, or none", unit.name)),
        }
    }

    /// Puts an object on the floor that its row names.
    fn put_on_floor(&self, row: usize, object: &mut Object) -> Result<(), String> {
        let Some(cell) = self.cell(row, Role::Storey) else { return Ok(()) };
        let (storey, all) = (Storey::parse(cell), self.cell(row, Role::Storeys));
        if let Some(Storey::Number(number) | Storey::Above(number)) = storey {
            let of_all = all.map_or(String::new(), |all| format!(" of {all}"));
            object.floor = Some(format!("floor {number}{of_all}"));
        }
        let place = &mut object.place;
        let known = Place { period: place.period.or(self.place.period), ..*place };
        if known.level.is_some() && known.period.is_some() {
            return Ok(());
        }
        let expected = "one whole number, such as 3 or 3rd floor, G, B1 or roof";
        let storey = storey.ok_or_else(|| format!("floor '{cell}'; expected {expected}"))?;
        let above = storey.above(self.ground_floor);
        if above == Some(0) {
            place.level.get_or_insert(0.0);
            return Ok(());
        }
        let expected = "the storeys of the building (column Storeys), or Level and T1 (s)";
        let all = all.ok_or_else(|| format!("floor {cell}: expected {expected}"))?;
        let storeys = all.parse().ok().filter(|all: &f64| all.fract() == 0.0 && (1.0..200.0).contains(all));
        let storeys = storeys.ok_or_else(|| format!("storeys '{all}'; expected a whole number"))? as u32;
        let above = above.unwrap_or(storeys);
        if above > storeys {
            return Err(format!("floor {cell} of {storeys} storeys: which is right?"));
        }
        let expected = "walls, masonry, concrete frame or steel frame";
        let building = self.cell(row, Role::Building).map(|cell| {
            Building::parse(cell).ok_or_else(|| format!("building '{cell}'; expected {expected}"))
        });
        *place = floors::place(above, storeys, building.transpose()?, known);
        Ok(())
    }

    /// Why the object of a row is not free to rock.
    fn held(&self, row: usize) -> Option<ObjectError> {
        let mut held = (0..self.columns.len()).filter(|at| self.columns[*at] == Role::Held);
        held.find_map(|at| held_by(&self.grid.headings[at].text, self.grid.value(row, at)?))
    }
}

/// Whether a column that seems to count objects numbers the rows.
fn numbers_rows(grid: &Grid, column: usize) -> bool {
    let is_numbered =
        |numbers: Vec<f64>| numbers.len() > 1 && numbers.windows(2).all(|pair| pair[1] == pair[0] + 1.0);
    grid.headings[column].name == "number" && grid.numbers(column).is_ok_and(is_numbered)
}

/// Whether a line above the headings names a unit of lengths other than m.
fn names_unit_of_length(note: &str) -> bool {
    note.split([',', ';', '\t']).any(|cell| {
        let unit = Heading::new(cell.trim()).unit;
        unit.is_some_and(|unit| unit.quantity == Quantity::Length && unit.si != 1.0)
    })
}

/// Why an object with this cell under this heading of anchors is not free to rock, or not known to be.
fn held_by(heading: &str, cell: &str) -> Option<ObjectError> {
    let (heading, text) = (heading.to_lowercase(), joined(cell));
    let has = |text: &str, meaning: &str| synonyms(meaning).any(|part| text.contains(part));
    let not = ["not-", "un", "no-", "non-", "nicht-"].iter().find_map(|not| text.strip_prefix(not));
    let is_loose = not.is_some_and(|word| has(word, "holds") && !word.trim_matches('-').contains('-'));
    if means(cell, "free") || is_loose {
        None
    } else if text.starts_with("no-") || !(means(cell, "yes") || has(&text, "holds") || has(&text, "rolls")) {
        Some(ObjectError::Implausible(format!("{heading}: '{cell}'; expected yes or no")))
    } else if has(&heading, "rolls") || has(&text, "rolls") {
        Some(ObjectError::NotRocking("on castors: it rolls, and does not rock".to_string()))
    } else {
        Some(ObjectError::NotRocking(format!("{heading}: {}; it is not free to rock", cell.to_lowercase())))
    }
}
