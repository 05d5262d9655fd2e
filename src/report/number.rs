//! Numbers in words: as short as a reader needs them.

/// A true minus sign in place of the hyphen.
fn minus(text: String) -> String {
    text.replace('-', "\u{2212}")
}

/// With so many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    // Adding 0 turns -0 into 0.
    minus(format!("{:.decimals$}", value + 0.0))
}

/// Without trailing zeros.
pub fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    minus(text.trim_end_matches('0').trim_end_matches('.').to_string())
}

/// A power of ten, marked for a label.
pub fn power(value: f64) -> String {
    format!("10^{{{}}}", fixed(value.log10().round(), 0))
}

/// With three significant digits.
pub fn short(value: f64) -> String {
    significant(value, 3)
}

/// With so many significant digits.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_string();
    }
    if !value.is_finite() {
        return "\u{2013}".to_string();
    }
    match value.abs().log10().floor() as i32 {
        magnitude @ -4..6 => fixed(value, (digits - 1 - magnitude).max(0) as usize),
        _ => minus(format!("{value:.*e}", (digits - 1).max(0) as usize)),
    }
}

/// A count, its thousands apart.
pub fn count(value: usize) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && digits.len() > 4 && (digits.len() - place).is_multiple_of(3) {
            text.push('\u{a0}');
        }
        text.push(digit);
    }
    text
}
