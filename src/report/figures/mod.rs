//! One file a figure; each a function of the material to the figures that can be made of it.

mod outcomes;
mod regressions;

use super::figure::Figure;
use super::material::{Group, Material};
use super::number;
use crate::rocking::Structure;

/// What draws figures.
pub type Draw = fn(&Material) -> Vec<Figure>;

/// All of them, in the order of the page.
pub const ALL: [Draw; 2] = [outcomes::figures, regressions::figures];

/// p, alpha and eta in words.
fn structure_words(structure: &Structure) -> String {
    format!(
        "p = {} rad/s, α = {} rad, η = {}",
        number::plain(structure.p_rad_s),
        number::plain(structure.alpha_rad),
        number::plain(structure.eta)
    )
}

/// A name that a file may have.
fn file_words(name: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_lowercase() } else { '-' };
    name.chars().map(letter).collect()
}

fn group_file_words(group: &Group) -> String {
    match &group.suite {
        Some(suite) => format!("{}-{}", file_words(&group.structure.name), file_words(suite)),
        None => file_words(&group.structure.name),
    }
}
