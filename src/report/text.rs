//! Text of figures and pages: labels with italics and subscripts, escapes, and numbers.

use super::font::Face;

/// A text in several styles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Label {
    pub runs: Vec<Run>,
}

/// Words in one style.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub words: String,
    pub face: Face,
    pub level: Level,
}

/// The height of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    Line,
    /// Small, below the line.
    Sub,
    /// Small, above the line.
    Super,
}

impl Level {
    /// Returns the size over that of the line.
    pub fn scale(self) -> f64 {
        if self == Level::Line { 1.0 } else { 0.72 }
    }

    /// Returns how far the baseline lies below that of the line, over the size of the line.
    pub fn drop(self) -> f64 {
        match self {
            Level::Line => 0.0,
            Level::Sub => 0.22,
            Level::Super => -0.36,
        }
    }
}

impl Label {
    /// Takes words as they are, such as names out of a file.
    pub fn plain(words: impl Into<String>) -> Label {
        Label { runs: vec![Run { words: words.into(), face: Face::Regular, level: Level::Line }] }
    }

    /// Parses marked text: `*p* PGV`, `*P*_{ex}`, `10^{-3}`. For what stands in the source, not for names out of files.
    pub fn marked(text: &str) -> Label {
        let (mut runs, mut face, mut level) = (Vec::new(), Face::Regular, Level::Line);
        let mut words = String::new();
        let mut letters = text.chars().peekable();
        while let Some(letter) = letters.next() {
            let (next_face, next_level) = match letter {
                '*' => (if face == Face::Italic { Face::Regular } else { Face::Italic }, level),
                '_' | '^' if letters.next_if_eq(&'{').is_some() => {
                    (face, if letter == '_' { Level::Sub } else { Level::Super })
                }
                '}' if level != Level::Line => (face, Level::Line),
                other => {
                    words.push(other);
                    continue;
                }
            };
            if !words.is_empty() {
                runs.push(Run { words: std::mem::take(&mut words), face, level });
            }
            (face, level) = (next_face, next_level);
        }
        if !words.is_empty() {
            runs.push(Run { words, face, level });
        }
        Label { runs }
    }

    /// Appends another label.
    pub fn then(mut self, other: Label) -> Label {
        self.runs.extend(other.runs);
        self
    }

    /// Sets all but italics in bold type.
    pub fn bold(mut self) -> Label {
        for run in self.runs.iter_mut().filter(|run| run.face == Face::Regular) {
            run.face = Face::SemiBold;
        }
        self
    }

    /// Returns the words without styles.
    pub fn words(&self) -> String {
        self.runs.iter().map(|run| run.words.as_str()).collect()
    }

    pub fn is_empty(&self) -> bool {
        self.runs.iter().all(|run| run.words.is_empty())
    }

    /// Measures the width, points.
    pub fn width(&self, size: f64) -> f64 {
        self.runs.iter().map(|run| run.face.width(&run.words, size * run.level.scale())).sum()
    }
}

/// Escapes text for HTML, SVG and their attributes.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            other => escaped.push(other),
        }
    }
    escaped
}

/// Writes numbers as short as a reader needs them.
pub mod number {
    /// Puts a true minus sign in place of the hyphen.
    fn minus(text: String) -> String {
        text.replace('-', "\u{2212}")
    }

    /// Writes a number with so many decimals.
    pub fn fixed(value: f64, decimals: usize) -> String {
        // Adding 0 turns -0 into 0.
        minus(format!("{:.decimals$}", value + 0.0))
    }

    /// Writes a number without trailing zeros.
    pub fn plain(value: f64) -> String {
        let text = format!("{value:.6}");
        minus(text.trim_end_matches('0').trim_end_matches('.').to_string())
    }

    /// Writes a power of ten, marked for a label.
    pub fn power(value: f64) -> String {
        format!("10^{{{}}}", fixed(libm::log10(value).round(), 0))
    }

    /// Writes a number with three significant digits.
    pub fn short(value: f64) -> String {
        significant(value, 3)
    }

    /// Writes a number with so many significant digits.
    pub fn significant(value: f64, digits: i32) -> String {
        if value == 0.0 {
            return "0".to_string();
        }
        if !value.is_finite() {
            return "\u{2013}".to_string();
        }
        match libm::log10(value.abs()).floor() as i32 {
            magnitude @ -4..6 => fixed(value, (digits - 1 - magnitude).max(0) as usize),
            _ => minus(format!("{value:.*e}", (digits - 1).max(0) as usize)),
        }
    }

    /// Writes a number for programs, nothing where there is none.
    pub fn machine(value: f64) -> String {
        if value.is_finite() { value.to_string() } else { String::new() }
    }

    /// Writes a number for tables, with so many significant digits; what is too large or too small to be read says so.
    pub fn readable(value: f64, digits: i32) -> String {
        let size = value.abs();
        match () {
            () if !value.is_finite() => "\u{2013}".to_string(),
            () if size >= LARGEST && value < 0.0 => "< \u{2212}10\u{2076}".to_string(),
            () if size >= LARGEST => "> 10\u{2076}".to_string(),
            () if value != 0.0 && size < SMALLEST => scientific(value, digits),
            () => significant(value, digits),
        }
    }

    /// The largest number that is written in full.
    const LARGEST: f64 = 1e6;
    /// The smallest.
    const SMALLEST: f64 = 1e-3;

    /// Writes a number with a power of ten: 6.5 × 10⁻⁴.
    fn scientific(value: f64, digits: i32) -> String {
        let text = format!("{value:.*e}", (digits - 1).max(0) as usize);
        let (factor, power) = text.split_once('e').unwrap_or((&text, "0"));
        let raised = power.chars().map(|letter| match letter {
            '-' => '\u{207b}',
            digit => {
                ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit.to_digit(10).unwrap_or(0) as usize]
            }
        });
        format!("{} × 10{}", minus(factor.to_string()), raised.collect::<String>())
    }

    /// Writes a value with its limits.
    pub fn with_limits([value, low, high]: [f64; 3], digits: i32) -> String {
        let value = readable(value, digits);
        match low.is_nan() && high.is_nan() {
            true => value,
            false => format!("{value} ({} to {})", readable(low, digits), readable(high, digits)),
        }
    }

    /// Writes a share of a count: `12 (34 %)`, in which no line breaks before the sign.
    pub fn share(of: usize, all: usize) -> String {
        if all == 0 {
            return count(of);
        }
        let percent = 100.0 * of as f64 / all as f64;
        let decimals = if percent > 0.0 && percent < 9.95 { 1 } else { 0 };
        format!("{} ({}\u{a0}%)", count(of), fixed(percent, decimals))
    }

    /// Writes a count, its thousands apart.
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
}
