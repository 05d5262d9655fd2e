//! Words of people's tables, in several languages: data/headings.csv.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::LazyLock;

use unicode_normalization::UnicodeNormalization;

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

pub fn means(text: &str, meaning: &str) -> bool {
    is_one_of(&joined(text), meaning)
}

/// Whether a word, as in the table, has a meaning.
pub fn is_one_of(word: &str, meaning: &str) -> bool {
    synonyms(meaning).any(|known| known == word)
}

/// Whether all words of a text have one, with a meaning of whatever kind.
pub fn are_known(text: &str) -> bool {
    let text = joined(text);
    !text.is_empty() && text.split('-').all(|word| WORDS.values().flatten().any(|known| *known == word))
}

/// The letters and digits of a text in lower case, its parts joined by hyphens.
pub fn joined(text: &str) -> String {
    let text = normal(text);
    let parts = text.split(|sign: char| !sign.is_alphanumeric()).filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("-").to_lowercase().replace("center", "centre")
}

/// A text in the form in which it is compared: Unicode's NFKC, with the minus sign and the quotation marks of a
/// keyboard. The marks of feet and inches are quotation marks too.
pub fn normal(text: &str) -> Cow<'_, str> {
    let sign = |sign| match sign {
        '\u{2010}'..='\u{2015}' | '\u{2212}' => '-',
        '\u{2018}' | '\u{2019}' | '\u{2032}' => '\'',
        '\u{201c}' | '\u{201d}' | '\u{2033}' => '"',
        other => other,
    };
    if text.is_ascii() { text.into() } else { text.chars().map(sign).nfkc().collect() }
}

/// A cell as a number is compared; none with digits that its normal form would take for others: 10\u{b2}, \u{bd}.
pub fn normal_number(cell: &str) -> Option<Cow<'_, str>> {
    let is_digit = |sign: char| sign.is_ascii_digit() || ('\u{ff10}'..='\u{ff19}').contains(&sign);
    let is_other = |sign: char| sign.is_numeric() && !is_digit(sign);
    (!cell.contains(is_other)).then(|| normal(cell))
}

/// Words for a vertical component, in capitals.
const VERTICAL: [&str; 19] = [
    "UP", "UD", "U-D", "U", "V", "Z", "VER", "VERT", "VRT", "BVRT", "VT", "VRTC", "UPD", "UPDO", "UPWARD",
    "DOWN", "DOWNWARD", "DWN", "DN",
];

/// Whether a text has a word for vertical, in whatever language, and none for horizontal.
pub fn says_vertical(text: &str) -> bool {
    let text = joined(text);
    let has = |start: &str| text.split('-').any(|word| word.starts_with(start));
    (has("vertical") || has("vertikal")) && !has("horiz") && !has("orizz")
}

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
    name.len() == 3 && name.ends_with('Z') || says_vertical(component) || words.any(is_word)
}
