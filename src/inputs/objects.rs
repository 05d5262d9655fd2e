//! Lists of objects as people keep them: names, sizes, floors, numbers, anchors.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use rockfrag_core::object::{Field, Object, ObjectError, Place};
use rockfrag_core::plausibility::validate_lengths;
use rockfrag_core::units::{Quantity, Unit};
use rockfrag_core::warning::{Warning, Warnings};

use super::floors::{self, Building, Storey};
use super::roles::{Role, held_by, is_on_anchors, is_on_floors, meaning, unit_of_remark};
use super::words::means;
use super::{Grid, InputError, Meaning, Reader, Result, SECTION};
use crate::number::rounded;

/// Without one of these, in a cell that is not empty, there is no object.
const NEEDED: [Field; 4] = [Field::Width, Field::Height, Field::P, Field::Alpha];

#[derive(Debug, Clone, Copy, Default)]
pub struct ListDefaults {
    pub ground_floor: Option<u32>,
    /// Where objects stand that do not say so themselves.
    pub place: Place,
    /// The storeys and the kind of building of objects that do not say so themselves.
    pub storeys: Option<u32>,
    pub building: Option<&'static Building>,
}

struct List<'a> {
    grid: &'a Grid,
    columns: Vec<Role>,
    ground_floor: u32,
    defaults: ListDefaults,
}

/// Reads a list: the objects of its rows. The reader keeps what is not known of them.
pub fn read(path: &Path, reader: &mut Reader, defaults: &ListDefaults) -> Result<Vec<Object>> {
    let list = |reader: &mut Reader| {
        let mut grid = reader.read(path)?;
        grid.leave_out("a row of totals", |grid, row| {
            let name = grid.about("name").map_or("", |at| grid.cell(row, at));
            let first = (0..grid.headings.len()).find_map(|at| grid.value(row, at)).unwrap_or_default();
            [name, first].iter().any(|cell| means(cell, "total"))
        });
        let list = List::new(&grid, defaults)?;
        reader.tell(path, &grid, list.meanings());
        reader.warnings.extend(list.doubts());
        Ok(list.objects())
    };
    list(reader).map_err(|error: InputError| error.in_file(path))
}

/// The objects of the rows of a grid that has these other columns, doubts about them, and what columns say.
pub fn in_rows(grid: &Grid, others: &[usize]) -> Result<(Vec<Object>, Warnings, Vec<Meaning>)> {
    let mut list = List::new(grid, &ListDefaults::default())?;
    others.iter().for_each(|at| list.columns[*at] = Role::Other);
    let objects = list.objects().into_iter().map(Object::on_pedestal).collect();
    Ok((objects, list.doubts(), list.meanings()))
}

impl List<'_> {
    fn new<'a>(grid: &'a Grid, defaults: &ListDefaults) -> Result<List<'a>> {
        let mut columns: Vec<Role> = grid.headings.iter().map(meaning).collect();
        grid.about("name").into_iter().for_each(|at| columns[at] = Role::Name);
        let mut list = List { grid, columns, ground_floor: 0, defaults: *defaults };
        for at in 0..list.columns.len() {
            let is_text = grid.is_text(at);
            list.columns[at] = match list.columns[at] {
                Role::Number if is_text => Role::Kept,
                Role::Number => list.numbered(at)?,
                Role::NotUnderstood if is_text => Role::Kept,
                role => role,
            };
        }
        list.check()?;
        let Some(at) = list.column(Role::Storey) else { return Ok(list) };
        let open = grid.rows().filter(|row| list.cell(*row, Role::Known(Field::Level)).is_none());
        let storeys: Vec<Storey> = open.filter_map(|row| Storey::parse(grid.cell(row, at))).collect();
        let found = defaults.ground_floor.map_or_else(|| floors::ground_floor(&storeys), Ok);
        list.ground_floor = found.map_err(|lowest| {
            let found = format!("column '{}', of which the lowest floor is {lowest}", grid.headings[at].text);
            let expected =
                "--ground-floor 1 if the ground floor is called 1, --ground-floor 0 if 1 is above it";
            InputError::unexpected(found, expected)
        })?;
        Ok(list)
    }

    /// The role of numbers that name rows if they go up by one, and else may count objects.
    fn numbered(&self, at: usize) -> Result<Role> {
        let numbers = self.grid.numbers(at)?;
        let go_up = numbers.windows(2).all(|pair| pair[1] == pair[0] + 1.0);
        let is_sure = go_up && (numbers.len() > 1 || numbers == [1.0]);
        let found = format!("column '{}', which counts objects or names them", self.grid.headings[at].text);
        let expected = "--columns count=HEADING or name=HEADING, or --ignore HEADING";
        if is_sure { Ok(Role::Kept) } else { Err(InputError::unexpected(found, expected)) }
    }

    /// Checks the headings, the lengths below each, and remarks on units.
    fn check(&self) -> Result<()> {
        let (grid, expected) = (self.grid, "name, width, depth and height, or p, alpha and eta");
        if [Field::Height, Field::P].iter().all(|field| self.column(Role::Known(*field)).is_none()) {
            let unknown = [Role::NotUnderstood, Role::Unclear, Role::Kept];
            let unknown =
                unknown.iter().find_map(|role| self.column(*role)).map(|at| &*grid.headings[at].text);
            return Err(grid.not_understood(unknown.as_slice(), expected));
        }
        if grid.lines.is_empty() {
            return Err(InputError::unexpected("no rows", "one per object"));
        }
        let remarked = self.unit_elsewhere();
        for (at, (heading, column)) in grid.headings.iter().zip(&self.columns).enumerate() {
            if matches!(column, Role::Known(_)) && (heading.is_scaled || heading.is_percent) {
                let found = format!("heading '{}'", heading.text);
                return Err(InputError::unexpected(found, "m, cm or mm in brackets, or no unit"));
            }
            let may_repeat = matches!(column, Role::Held | Role::Unclear | Role::NotUnderstood | Role::Kept);
            if let Some(first) = self.column(*column).filter(|first| *first != at && !may_repeat) {
                let found = format!("columns '{}' and '{}'", grid.headings[first].text, heading.text);
                return Err(InputError::unexpected(found, "one of them (--ignore leaves one out)"));
            }
            let is_side = [Field::Width, Field::Depth, Field::Height].map(Role::Known).contains(column)
                || *column == Role::Diameter;
            if let Some(unit) = heading.unit.filter(|_| is_side) {
                let lengths = grid.rows().filter_map(|row| grid.number(row, at).ok());
                validate_lengths(*column == Role::Known(Field::Height), unit, lengths).map_err(
                    |expected| InputError::unexpected(format!("column '{}'", heading.text), expected),
                )?;
            }
            let size = heading.unit.map_or(1.0, |unit| unit.si);
            if let Some((note, unit)) = remarked.filter(|(_, unit)| is_side && unit.si != size) {
                let found = format!("a unit of lengths ({}) in '{note}'", unit.name);
                return Err(InputError::unexpected(
                    found,
                    "the unit in the heading of each column: Width (mm)",
                ));
            }
        }
        Ok(())
    }

    /// A unit of lengths that names and the list's own columns have in their headings, a column of units in
    /// its cells, or a remark: what stands above, between, below or beside the rows.
    fn unit_elsewhere(&self) -> Option<(&str, Unit)> {
        let grid = self.grid;
        let cells = |at: usize| grid.rows().map(move |row| grid.cell(row, at));
        let own = || self.all(Role::Name).chain(self.all(Role::Kept)).map(|at| (at, &grid.headings[at]));
        let of_headings = own().filter_map(|(_, heading)| Some((&*heading.text, heading.unit?)));
        let of_units = self.column(Role::Unit).into_iter().flat_map(cells);
        let of_units = of_units.filter_map(|cell| Some((cell, Unit::parse(cell)?)));
        let beside = own().filter(|(_, heading)| ["", SECTION].contains(&&*heading.text));
        let beside = beside.flat_map(|(at, _)| cells(at));
        let remarks =
            grid.notes.iter().map(String::as_str).chain(own().map(|(_, own)| &*own.text)).chain(beside);
        let of_remarks = remarks.filter_map(|note| Some((note, unit_of_remark(note)?)));
        let mut all = of_headings.chain(of_units).chain(of_remarks);
        all.find(|(_, unit)| unit.quantity == Quantity::Length)
    }

    fn all(&self, wanted: Role) -> impl Iterator<Item = usize> {
        (0..self.columns.len()).filter(move |at| self.columns[*at] == wanted)
    }

    fn column(&self, wanted: Role) -> Option<usize> {
        self.all(wanted).next()
    }

    /// What stands in a column, if it says anything.
    fn cell(&self, row: usize, column: Role) -> Option<&str> {
        self.column(column).and_then(|at| self.grid.value(row, at))
    }

    /// The words that are taken as no value.
    fn doubts(&self) -> Warnings {
        let (grid, mut doubts) = (self.grid, Warnings::default());
        for (at, column) in self.columns.iter().enumerate() {
            let says = |row: usize| match column {
                // None is an answer.
                Role::Held => !grid.cell(row, at).is_empty(),
                _ => grid.value(row, at).is_some() || self.cell(row, Role::Diameter).is_some(),
            };
            // A blank cell beside filled ones may be unknown.
            let is_open = match column {
                Role::Held | Role::Known(Field::Depth) => grid.rows().any(says),
                Role::Known(_) | Role::Diameter => false,
                _ => continue,
            };
            for row in grid.rows().filter(|row| !says(*row)) {
                if is_open || grid.cell(row, at).contains(char::is_alphanumeric) {
                    let about = format!(
                        "{} of {}",
                        grid.headings[at].text,
                        self.name_of(self.column(Role::Name), row)
                    );
                    doubts.add(Warning::NotGiven, about);
                }
            }
        }
        doubts
    }

    fn objects(&self) -> Vec<Object> {
        // Where there are no names, tags are.
        let tags = self.tags();
        let named = self.column(Role::Name).or(tags);
        let names: Vec<String> = self.grid.rows().map(|row| self.name_of(named, row)).collect();
        let mut uses: HashMap<&str, usize> = HashMap::new();
        names.iter().for_each(|name| *uses.entry(name).or_default() += 1);
        let level = self.defaults.place.level;
        let names_floors = level.is_none() && self.grid.rows().any(|row| self.names_floor(row));
        let objects = names.iter().enumerate().map(|(row, name)| {
            let object = match self.object(row) {
                Ok(_) if names_floors && !self.names_floor(row) => {
                    Err("no floor, but others have one: write G if it is the ground".to_string())
                }
                given => given,
            };
            let refused = self.held(row).or(object.as_ref().err().cloned().map(ObjectError::Implausible));
            let labels = self.labels(row);
            let line = || format!("line {}", self.grid.lines[row]);
            let tag = tags.map_or_else(line, |at| self.grid.cell(row, at).to_string());
            let name = if uses[name.as_str()] == 1 { name.clone() } else { format!("{name} ({tag})") };
            let known = object.unwrap_or_else(|_| Object { count: self.count(row), ..Object::default() });
            Object { name, refused, labels, ..known }
        });
        objects.collect()
    }

    fn count(&self, row: usize) -> Option<u32> {
        let number = self.grid.number(row, self.column(Role::Count)?).ok();
        number.filter(|number| number.fract() == 0.0 && *number >= 0.0).map(|number| number as u32)
    }

    /// The first column of tags: texts of which each is another.
    fn tags(&self) -> Option<usize> {
        self.all(Role::Kept).find(|at| {
            let cells: HashSet<&str> = self.grid.rows().map(|row| self.grid.cell(row, *at)).collect();
            cells.len() == self.grid.lines.len() && !cells.contains("")
        })
    }

    fn meanings(&self) -> Vec<Meaning> {
        let meaning = |role: &Role| match role {
            Role::Kept => Meaning::Kept,
            Role::NotUnderstood | Role::Unclear => Meaning::NotUnderstood,
            known => Meaning::Known(known.to_string()),
        };
        self.columns.iter().map(meaning).collect()
    }

    fn labels(&self, row: usize) -> Vec<(String, String)> {
        let label = |at: usize| (self.grid.headings[at].text.clone(), self.grid.cell(row, at).to_string());
        self.all(Role::Kept).map(label).collect()
    }

    fn name_of(&self, column: Option<usize>, row: usize) -> String {
        match column.map_or("", |column| self.grid.cell(row, column)) {
            "" => format!("line {}", self.grid.lines[row]),
            name => name.to_string(),
        }
    }

    fn names_floor(&self, row: usize) -> bool {
        self.cell(row, Role::Storey).or(self.cell(row, Role::Known(Field::Level))).is_some()
    }

    fn is_on_pedestal(&self, row: usize) -> bool {
        use Field::{FixedToPedestal, PedestalDepth, PedestalHeight, PedestalMass, PedestalWidth};
        let fields = [FixedToPedestal, PedestalWidth, PedestalDepth, PedestalHeight, PedestalMass];
        fields.iter().any(|field| self.cell(row, Role::Known(*field)).is_some())
    }

    fn object(&self, row: usize) -> Result<Object, String> {
        let is_round = self.cell(row, Role::Diameter).is_some();
        let mut object = Object { is_round, ..Object::default() };
        for (at, column) in self.columns.iter().enumerate() {
            let (cell, value, heading) =
                (self.grid.cell(row, at), self.grid.value(row, at), &self.grid.headings[at].text);
            let fields: &[Field] = match column {
                _ if cell.is_empty() => continue,
                Role::Years => {
                    object.years = value.map(|_| self.years(row, at)).transpose()?;
                    continue;
                }
                Role::Known(Field::Wall) if means(cell, "free") => continue,
                Role::Known(Field::Width | Field::Depth) if is_round && value.is_some() => {
                    return Err("a diameter and a width or depth: which is that of its base?".to_string());
                }
                Role::Known(field) => std::slice::from_ref(field),
                Role::Mass if self.is_on_pedestal(row) => &[Field::Mass],
                Role::Diameter => &[Field::Width, Field::Depth],
                Role::Count if self.grid.is_repeated(row, at) => {
                    return Err("a number in merged cells: write that of each object".to_string());
                }
                Role::Count => &[],
                Role::Unclear if value.is_some() => {
                    let expected = "rename it (--columns) or leave it out (--ignore)";
                    return Err(format!("column '{heading}' is not understood: {expected}"));
                }
                _ => continue,
            };
            if fields.iter().any(|field| field.entry().quantity.is_some()) && cell.ends_with('%') {
                return Err(format!("'{cell}' under '{heading}'; expected no percent"));
            }
            let is_needed = !is_round && fields.iter().any(|field| NEEDED.contains(field));
            if value.is_none() && !is_needed {
                continue;
            }
            let size = fields.first().map_or(Ok(1.0), |field| self.size(at, *field))?;
            let is_answer = matches!(fields, [Field::Wall | Field::FixedToPedestal]);
            let text = match self.grid.number(row, at) {
                _ if is_answer && means(cell, "yes") => "yes".to_string(),
                _ if is_answer && means(cell, "free") => "no".to_string(),
                Ok(number) => rounded(size * number).to_string(),
                // Other fields may be words, or know what is expected.
                Err(InputError::Cell { .. }) if !is_needed => cell.to_string(),
                Err(error) => return Err(error.to_string()),
            };
            let names: Vec<&str> = fields.iter().map(|field| field.into()).collect();
            for name in if names.is_empty() { vec!["count"] } else { names } {
                object.set(name, &text)?;
            }
        }
        self.put_on_floor(row, &mut object)?;
        Ok(object)
    }

    fn years(&self, row: usize, at: usize) -> Result<f64, String> {
        let heading = &self.grid.headings[at];
        let year = Unit::parse("years").map_or(f64::NAN, |unit| unit.si);
        let years = self.grid.number(row, at).map_err(|error| error.to_string())?;
        let years = years * heading.unit.map_or(1.0, |unit| rounded(unit.si / year));
        let expected = || format!("{} is {years} years; expected 0.001 to 1,000,000", heading.text);
        Some(years).filter(|years| (1e-3..=1e6).contains(years)).ok_or_else(expected)
    }

    /// The size of the unit of a column in m, s, rad or rad/s.
    fn size(&self, at: usize, field: Field) -> Result<f64, String> {
        match self.grid.headings[at].unit {
            None => Ok(1.0),
            Some(unit) if Some(unit.quantity) == field.entry().quantity => Ok(unit.si),
            Some(unit) => Err(format!("{field} is in {}; expected another unit, or none", unit.name)),
        }
    }

    fn put_on_floor(&self, row: usize, object: &mut Object) -> Result<(), String> {
        let Some(cell) = self.cell(row, Role::Storey) else { return Ok(()) };
        let default = self.defaults.storeys.map(|all| all.to_string());
        let (storey, all) = (Storey::parse(cell), self.cell(row, Role::Storeys).or(default.as_deref()));
        if let Some(Storey::Number(number) | Storey::Above(number)) = storey {
            let of_all = all.map_or(String::new(), |all| format!(" of {all}"));
            object.floor = Some(format!("floor {number}{of_all}"));
        }
        let place = &mut object.place;
        if place.level.is_some() && all.is_some() {
            return Err(format!("floor '{cell}' and a level: leave one out (--ignore)"));
        }
        let known = Place { period: place.period.or(self.defaults.place.period), ..*place };
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
        let expected = "the storeys of the building (column Storeys, or --storeys), or Level and T1 (s)";
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
        *place = floors::place(above, storeys, building.transpose()?.or(self.defaults.building), known);
        Ok(())
    }

    /// Why the object of a row is not free to rock, or not known to be: by columns of anchors, else by what other
    /// texts say of anchors or floors.
    fn held(&self, row: usize) -> Option<ObjectError> {
        let cells = |wanted: Role| {
            self.all(wanted).map(move |at| (&*self.grid.headings[at].text, self.grid.cell(row, at)))
        };
        let mut anchors = cells(Role::Held).filter(|(_, cell)| !cell.is_empty()).peekable();
        let says_nothing = anchors.peek().is_none();
        let has_floor = self.column(Role::Storey).is_some() || self.defaults.place.level.is_some();
        let speaks = |cell: &str| is_on_anchors(cell) && says_nothing || is_on_floors(cell) && !has_floor;
        let open = |(heading, cell): (&str, &str)| {
            let words =
                format!("{heading} '{cell}': a floor or an anchor? Say so in a column Floor or Anchored");
            speaks(cell).then_some(ObjectError::Implausible(words))
        };
        anchors
            .find_map(|(heading, cell)| held_by(heading, cell))
            .or_else(|| cells(Role::Kept).find_map(open))
            // A name may be F2.
            .or_else(|| cells(Role::Name).filter(|(_, name)| !is_on_floors(name)).find_map(open))
    }
}
