//! Words of people's tables, in several languages: data/headings.csv.

use std::collections::HashMap;
use std::sync::LazyLock;

static WORDS: LazyLock<HashMap<&str, Vec<&str>>> = LazyLock::new(|| {
    let lines = include_str!("../../data/headings.csv").lines().filter(|line| !line.starts_with('#'));
    let mut words: HashMap<_, Vec<_>> = HashMap::new();
    for (meaning, word) in lines.skip(1).filter_map(|line| line.split_once(',')) {
        words.entry(meaning).or_default().push(word);
    }
    words
});

/// The words with a meaning, the best first.
pub fn synonyms(meaning: &str) -> impl Iterator<Item = &'static str> {
    WORDS.get(meaning).into_iter().flatten().copied()
}

/// Whether a text has a meaning.
pub fn means(text: &str, meaning: &str) -> bool {
    is_one_of(&joined(text), meaning)
}

/// Whether a word, as in the table, has a meaning.
pub fn is_one_of(word: &str, meaning: &str) -> bool {
    synonyms(meaning).any(|known| known == word)
}

/// The letters and digits of a text in lower case, its parts joined by hyphens.
pub fn joined(text: &str) -> String {
    let parts = text.split(|sign: char| !sign.is_alphanumeric()).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("-").to_lowercase().replace("center", "centre")
}

/// Words for a vertical component, in capitals.
const VERTICAL: [&str; 20] = [
    "UP", "UD", "U-D", "U", "V", "Z", "VER", "VERT", "VERTICAL", "VRT", "BVRT", "VT", "VRTC", "UPD", "UPDO",
    "UPWARD", "DOWN", "DOWNWARD", "DWN", "DN",
];

/// Whether the name of a component is that of a vertical one: a word, alone, numbered (UD2) or after the
/// station (CHY101-V), or the last letter of a channel code, as in HNZ.
pub fn is_vertical(component: &str) -> bool {
    let name = component.to_ascii_uppercase();
    let mut words = name.split(|sign: char| sign.is_whitespace() || "(),:;".contains(sign));
    let is_word = |word: &str| {
        let word = word.trim_matches(['.', '-']);
        let numbered = word.trim_matches(|sign: char| sign.is_ascii_digit());
        let last = word.rsplit(['-', '_']).next().unwrap_or_default();
        VERTICAL.contains(&word)
            || VERTICAL.contains(&last)
            || (numbered.len() > 1 || numbered == "V") && VERTICAL.contains(&numbered)
    };
    name.len() == 3 && name.ends_with('Z') || words.any(is_word)
}
