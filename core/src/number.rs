//! Numbers for people, significant digits with their zeros (0.30) and commas between thousands (27,000); and
//! texts of users without characters that control a terminal.

use std::borrow::Cow;
use std::fmt::Display;

pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    // What rounds to zero has no sign.
    let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
    let text = if is_zero { text.trim_start_matches('-') } else { &text };
    let (first, whole) = (usize::from(text.starts_with('-')), text.find('.').unwrap_or(text.len()));
    let with_comma = |(place, sign): (usize, char)| {
        let comma = place > first && place < whole && (whole - place).is_multiple_of(3);
        [comma.then_some(','), Some(sign)].into_iter().flatten()
    };
    text.char_indices().flat_map(with_comma).collect()
}

pub fn count(value: usize) -> String {
    fixed(value as f64, 0)
}

/// `1 motion`, `3,500 motions`.
pub fn counted(value: usize, one: &str) -> String {
    format!("{} {one}{}", count(value), if value == 1 { "" } else { "s" })
}

/// `a, b, c and 9 more`, with the first few by name.
pub fn listed<T: Display>(items: &[T], named: usize) -> String {
    let first: Vec<String> = items.iter().take(named).map(T::to_string).collect();
    match items.len() - first.len() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}

/// A number as one types it, without zeros at its end.
pub fn plain(value: f64) -> String {
    fixed(value, 6).trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Small and large numbers have a power of ten: 2.9e-5.
pub fn significant(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits - 1);
    let power: i32 = text.split_once('e').map_or(0, |(_, power)| power.parse().unwrap_or(0));
    match power {
        _ if value == 0.0 => "0".to_string(),
        _ if !value.is_finite() => "-".to_string(),
        -3..6 => fixed(value, (digits as i32 - 1 - power).max(0) as usize),
        _ => text,
    }
}

/// Rounds off errors of a change of unit in the last digits: 1.8 mm are 0.0018 m, not 0.0018000000000000002.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// In m, to the centimetre or, if not a round one, the millimetre.
pub fn length(length_m: f64) -> String {
    let text = fixed(length_m, 3);
    text.strip_suffix('0').unwrap_or(&text).to_string()
}

/// A return period with two digits.
pub fn period(years: f64) -> String {
    let unit = 10_f64.powf((years.log10().floor() - 1.0).max(0.0));
    match years {
        _ if years >= 1e9 => "more than 1e9".to_string(),
        _ if years < 10.0 => significant(years, 2),
        _ => fixed((years / unit).round() * unit, 0),
    }
}

/// Letters of a name that are shown on a line.
const LONGEST_NAME: usize = 100;
/// Letters of any text that are shown on a line.
pub const LONGEST_TEXT: usize = 1000;

/// A name given by a user, as [`shown`].
pub fn name(name: &str) -> Cow<'_, str> {
    shown(name, LONGEST_NAME)
}

/// Whether a letter controls a terminal, changes the direction of text, or is not allowed in XML.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}')
        || matches!(letter, '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}')
}

/// Hidden letters other than `kept` are escaped as in JSON: `\u001b`.
pub fn visible<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    let is_escaped = |letter: char| is_hidden(letter) && !kept.contains(&letter);
    if !text.contains(is_escaped) {
        return Cow::Borrowed(text);
    }
    let letter = |letter: char| match letter {
        '\n' if is_escaped(letter) => "\\n".to_string(),
        _ if is_escaped(letter) => format!("\\u{:04x}", u32::from(letter)),
        _ => letter.to_string(),
    };
    Cow::Owned(text.chars().map(letter).collect())
}

/// On one line, cut to this many letters.
pub fn shown(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => Cow::Owned(visible(&text[..end], &[]).into_owned() + "..."),
        None => visible(text, &[]),
    }
}
