//! What texts of a list say of units, anchors and floors, in a remark or under a heading of anchors.

use rockfrag_core::object::ObjectError;
use rockfrag_core::units::{Quantity, Unit};

use super::Heading;
use super::floors::{self, Storey};
use super::grid::only;
use super::layout::uncommented;
use super::numbers::is_missing;
use super::roles::holds;
use super::words::{are_known, is_one_of, joined, means, normal, synonyms};

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
