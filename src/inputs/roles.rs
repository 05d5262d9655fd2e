//! What a list says: its columns by their headings, and its texts of units, anchors and floors, in a remark
//! or under a heading of anchors.

use rockfrag_core::object::{Field, ObjectError};
use rockfrag_core::units::{Quantity, Unit};
use strum::VariantArray;

use super::Heading;
use super::floors::{self, Storey};
use super::grid::only;
use super::layout::uncommented;
use super::numbers::is_missing;
use super::words::{are_known, is_one_of, joined, means, normal, synonyms};

#[derive(Debug, Clone, Copy, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Role {
    Name,
    #[strum(to_string = "{0}")]
    Known(Field),
    /// Of a round base.
    Diameter,
    Count,
    /// Its own time of exposure.
    Years,
    /// A number that counts objects or names them.
    Number,
    /// The unit of lengths.
    Unit,
    /// Known, and needed on a pedestal alone.
    Mass,
    /// What holds an object.
    Held,
    /// The floor that it stands on.
    Storey,
    /// The number of storeys of its building.
    Storeys,
    Building,
    /// A property of the object that is not understood: without it the object has no answer.
    Unclear,
    /// What befell the object.
    Other,
    /// Texts of the list's own.
    Kept,
    NotUnderstood,
}

/// Whether a heading is of a list: a size, or p.
pub fn is_of_list(heading: &Heading) -> bool {
    let sizes = [Field::Width, Field::Height, Field::P].map(Role::Known);
    sizes.contains(&meaning(heading)) || meaning(heading) == Role::Diameter
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

/// What a heading says, parsed to its end: one with a word left over is not understood.
pub fn meaning(heading: &Heading) -> Role {
    let name = &*heading.name;
    let words: Vec<&str> = name.split('-').filter(|word| !is_one_of(word, "of-sizes")).collect();
    let (centres, others): (Vec<&str>, Vec<&str>) = words.iter().partition(|word| is_one_of(word, "centre"));
    let is_one_thing = |role: &Role| words.iter().all(|word| known(word).as_ref() == Some(role));
    let quantity = heading.unit.map(|unit| unit.quantity);
    let are_anchors = || {
        words.iter().any(|word| holds(word))
            && words.iter().all(|word| holds(word) || is_one_of(word, "of-anchors"))
    };
    if let Some(role) = of_pedestal(name).or_else(|| known(name)).or_else(|| known(&words.join("-"))) {
        role
    } else if heading.unit.is_some_and(|unit| unit.name == "ka") && is_one_of(name, "age") {
        Role::Years
    } else if quantity == Some(Quantity::Counts) {
        Role::Count
    } else if let Some(role) = words.first().and_then(|word| known(word)).filter(is_one_thing) {
        // In two languages.
        role
    } else if !centres.is_empty() {
        match known(&others.join("-")) {
            Some(Role::Known(Field::Height)) => Role::Known(Field::CentreHeight),
            Some(Role::Known(Field::CentreOffset)) => Role::Known(Field::CentreOffset),
            _ => Role::Unclear,
        }
    } else if are_anchors() {
        Role::Held
    } else if name.is_empty() && heading.text == "#" {
        Role::Number
    } else if ["of-objects", "holds"].iter().any(|of| synonyms(of).any(|part| name.contains(part)))
        || words.iter().any(|word| is_one_of(word, "count"))
        || is_one_of(name, "free")
        || quantity == Some(Quantity::Length)
    {
        // A length is perhaps another side of the base: without it the object would seem safer.
        Role::Unclear
    } else {
        Role::NotUnderstood
    }
}

/// The role of a heading with a word for a pedestal, perhaps as the beginning of another: Sockelbreite.
fn of_pedestal(name: &str) -> Option<Role> {
    let pedestal = synonyms("pedestal").find(|known| name.split('-').any(|word| word.starts_with(known)))?;
    let rest = name.replacen(pedestal, "", 1);
    let words: Vec<&str> = rest.split('-').filter(|word| !word.is_empty()).collect();
    let is_part = |word: &&str| known(word).is_some() || is_one_of(word, "of-sizes");
    let is_link = |word: &&str| is_one_of(word, "of-anchors");
    let is_held = words.iter().any(|word| holds(word)) && words.iter().any(is_link);
    if is_held && words.iter().all(|word| holds(word) || is_link(word)) {
        return Some(Role::Known(Field::FixedToPedestal));
    }
    words.iter().filter(|_| words.iter().all(is_part)).find_map(|word| match known(word)? {
        Role::Known(Field::Width) => Some(Role::Known(Field::PedestalWidth)),
        Role::Known(Field::Depth) => Some(Role::Known(Field::PedestalDepth)),
        Role::Known(Field::Height) => Some(Role::Known(Field::PedestalHeight)),
        Role::Mass => Some(Role::Known(Field::PedestalMass)),
        Role::Diameter => Some(Role::Unclear),
        _ => None,
    })
}

pub fn holds(word: &str) -> bool {
    synonyms("holds").any(|start| word.starts_with(start))
}

fn known(name: &str) -> Option<Role> {
    const OTHERS: [(&str, Role); 9] = [
        ("diameter", Role::Diameter),
        ("count", Role::Count),
        ("exposure", Role::Years),
        ("number", Role::Number),
        ("unit", Role::Unit),
        ("mass", Role::Mass),
        ("storey", Role::Storey),
        ("storeys", Role::Storeys),
        ("building", Role::Building),
    ];
    let fields = Field::VARIANTS.iter().map(|field| (field.into(), Role::Known(*field)));
    let mut all =
        OTHERS.into_iter().chain(fields).filter(|(meaning, _)| name == *meaning || is_one_of(name, meaning));
    all.next().map(|(_, role)| role).filter(|_| !name.is_empty())
}

pub fn is_on_anchors(text: &str) -> bool {
    joined(text).split('-').any(holds)
}

/// Whether a text says on which floor, by a number with a word for floors, or by a word for the upper ones.
pub fn is_on_floors(text: &str) -> bool {
    let words = joined(text);
    let has = |meaning: &str| words.split('-').any(|word| is_one_of(word, meaning) && word.len() > 2);
    let is_one = matches!(Storey::parse(text), Some(Storey::Number(_) | Storey::Above(_)));
    let has_number = text.contains(|sign: char| sign.is_ascii_digit())
        || words.split('-').any(|word| floors::ordinal(word).is_some());
    // 3F-201, 2/F
    let is_floor = |word: &str| {
        let letters = word.trim_start_matches(|sign: char| sign.is_ascii_digit());
        letters.len() < word.len() && matches!(letters, "f" | "fl")
    };
    has("upper")
        || (has("of-floors") || has("storeys")) && has_number
        || is_one && text.contains(char::is_alphabetic)
        || words.replace("-f", "f").split('-').any(is_floor)
}

/// Whether a remark is not understood: a title, or a comment on anchors or floors.
pub fn is_unread(note: &str) -> bool {
    let is_title = uncommented(note) == note && note.contains(char::is_alphabetic) && !are_known(note);
    is_title || is_on_anchors(note) || is_on_floors(note)
}

/// The unit of lengths that a remark names, other than behind a number: all in mm.
pub fn unit_of_remark(note: &str) -> Option<Unit> {
    let note = normal(note).to_lowercase();
    let words: Vec<&str> =
        note.split(|sign: char| !sign.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    let is_unit = |before: &str, word: &str| {
        !before.ends_with(|sign: char| sign.is_ascii_digit())
            && (word.len() > 2 || ["cm", "mm", "ft"].contains(&word) || before == "in" && word == "m")
    };
    let behind = [""].into_iter().chain(words.iter().copied());
    let named = behind.zip(&words).filter(|(before, word)| is_unit(before, word));
    let is_length = |unit: &Unit| unit.quantity == Quantity::Length;
    let mut units = named.filter_map(|(_, word)| Unit::parse(word).filter(is_length)).peekable();
    // Several say what may stand in headings.
    match units.peek() {
        Some(_) => only(units),
        None => Heading::new(&note).unit.filter(is_length),
    }
}

/// Why an object with this cell under this heading of anchors is not free to rock, or not known to be.
pub fn held_by(heading: &str, cell: &str) -> Option<ObjectError> {
    let (heading, text) = (heading.to_lowercase(), joined(cell));
    let has = |text: &str, meaning: &str| synonyms(meaning).any(|part| text.contains(part));
    let not = ["not-", "un", "no-", "non-", "nicht-"].iter().find_map(|not| text.strip_prefix(not));
    let is_loose = not.is_some_and(|word| has(word, "holds") && !word.trim_matches('-').contains('-'));
    if cell.is_empty() || is_missing(cell) || means(cell, "free") || is_loose {
        None
    } else if text.starts_with("no-") || !(means(cell, "yes") || has(&text, "holds") || has(&text, "rolls")) {
        Some(ObjectError::Implausible(format!("{heading}: '{cell}'; expected yes or no")))
    } else if has(&heading, "rolls") || has(&text, "rolls") {
        Some(ObjectError::NotRocking("on castors: it rolls, and does not rock".to_string()))
    } else {
        Some(ObjectError::NotRocking(format!("{heading}: {}; it is not free to rock", cell.to_lowercase())))
    }
}
