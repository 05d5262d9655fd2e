//! Words of people's tables, in several languages: data/headings.csv.

use std::sync::LazyLock;

static WORDS: LazyLock<Vec<(&str, &str)>> = LazyLock::new(|| {
    let lines = include_str!("../../data/headings.csv").lines();
    lines.filter(|line| !line.starts_with('#')).skip(1).filter_map(|line| line.split_once(',')).collect()
});

/// The words with a meaning, the best first.
pub fn words(meaning: &str) -> impl Iterator<Item = &'static str> {
    WORDS.iter().filter(move |(known, _)| *known == meaning).map(|(_, word)| *word)
}

/// Whether a text has a meaning.
pub fn means(text: &str, meaning: &str) -> bool {
    let text = joined(text);
    words(meaning).any(|word| word == text)
}

/// The letters and digits of a text in lower case, its parts joined by hyphens.
pub fn joined(text: &str) -> String {
    let parts = text.split(|sign: char| !sign.is_alphanumeric()).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("-").to_lowercase().replace("center", "centre")
}
