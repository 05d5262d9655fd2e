//! Text of figures and pages. Marked text has italics and small letters below or above the line: `*P*_{ro}`,
//! `10^{-3}`.

/// Words in one style.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    pub words: String,
    pub italic: bool,
    pub level: Level,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    Line,
    Sub,
    Super,
}

/// Splits marked text into its styles.
pub fn runs(marked: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut run = Run { words: String::new(), italic: false, level: Level::Line };
    let mut letters = marked.chars().peekable();
    while let Some(letter) = letters.next() {
        let (italic, level) = match letter {
            '*' => (!run.italic, run.level),
            '_' if letters.next_if_eq(&'{').is_some() => (run.italic, Level::Sub),
            '^' if letters.next_if_eq(&'{').is_some() => (run.italic, Level::Super),
            '}' if run.level != Level::Line => (run.italic, Level::Line),
            other => {
                run.words.push(other);
                continue;
            }
        };
        runs.push(std::mem::replace(&mut run, Run { words: String::new(), italic, level }));
    }
    runs.push(run);
    runs.retain(|run| !run.words.is_empty());
    runs
}

/// Writes marked text as HTML.
pub fn html(marked: &str) -> String {
    let tagged = |run: Run| {
        let words = escape(&run.words);
        let words = if run.italic { format!("<i>{words}</i>") } else { words };
        match run.level {
            Level::Line => words,
            Level::Sub => format!("<sub>{words}</sub>"),
            Level::Super => format!("<sup>{words}</sup>"),
        }
    };
    runs(marked).into_iter().map(tagged).collect()
}

/// Drops the marks.
pub fn words(marked: &str) -> String {
    runs(marked).into_iter().map(|run| run.words).collect()
}

/// Escapes text for HTML, SVG and their attributes; drops what XML cannot hold.
pub fn escape(text: &str) -> String {
    let clean = text.replace(|letter: char| letter.is_control() && letter != '\n', "");
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Writes numbers as short as a reader needs them.
pub mod number {
    /// Writes a number with so many decimals and a true minus sign.
    pub fn fixed(value: f64, decimals: usize) -> String {
        // Adding 0 turns -0 into 0.
        format!("{:.decimals$}", value + 0.0).replace('-', "\u{2212}")
    }

    /// Writes a number without trailing zeros.
    pub fn plain(value: f64) -> String {
        fixed(value, 6).trim_end_matches('0').trim_end_matches('.').to_string()
    }

    /// Writes a number with so many significant digits, very small and very large ones with a power of ten; a
    /// dash if it is none.
    pub fn significant(value: f64, digits: usize) -> String {
        match value.abs().log10().floor() {
            _ if value == 0.0 => "0".to_string(),
            _ if !value.is_finite() => "\u{2013}".to_string(),
            power if (-2.0..6.0).contains(&power) => {
                fixed(value, (digits as f64 - 1.0 - power).max(0.0) as usize)
            }
            power => format!("{}e{power}", fixed(value / 10_f64.powf(power), digits - 1)),
        }
    }

    /// Writes a value with its limits.
    pub fn with_limits([value, low, high]: [f64; 3], digits: usize) -> String {
        let [value, low, high] = [value, low, high].map(|value| significant(value, digits));
        format!("{value} ({low} to {high})")
    }

    /// Writes a count, its thousands apart.
    pub fn count(value: usize) -> String {
        let digits = value.to_string();
        let apart = |(place, digit): (usize, char)| {
            let left = digits.len() - place;
            let space = place > 0 && digits.len() > 4 && left.is_multiple_of(3);
            [space.then_some('\u{a0}'), Some(digit)].into_iter().flatten()
        };
        digits.chars().enumerate().flat_map(apart).collect()
    }
}
