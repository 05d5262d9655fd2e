//! Text of figures and of the page. Marked text has italics and small letters below or above the line:
//! `*P*_{ro}`, `10^{-3}`; a backslash takes the next letter as it stands, as [`literal`] does for names.

use crate::number::is_hidden;

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

pub fn runs(marked: &str) -> Vec<Run> {
    let mut runs = Vec::new();
    let mut run = Run { words: String::new(), italic: false, level: Level::Line };
    let mut letters = marked.chars().peekable();
    while let Some(letter) = letters.next() {
        let (italic, level) = match letter {
            '\\' => {
                run.words.extend(letters.next());
                continue;
            }
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

/// Marks a text so that it reads as it stands: a name of the user's is no markup.
pub fn literal(name: &str) -> String {
    let mark = |letter| ['\\', '*', '_', '^', '}'].contains(&letter).then_some('\\');
    name.chars().flat_map(|letter| mark(letter).into_iter().chain([letter])).collect()
}

/// Writes marked text as HTML, without a break between a number and its percent sign.
pub fn html(marked: &str) -> String {
    let mut text = String::new();
    for run in runs(marked) {
        let words = escape(&run.words).replace(" %", "\u{a0}%");
        let words = if run.italic { format!("<i>{words}</i>") } else { words };
        text += &match run.level {
            Level::Line => words,
            Level::Sub => format!("<sub>{words}</sub>"),
            Level::Super => format!("<sup>{words}</sup>"),
        };
    }
    text
}

/// Drops the marks but for those of small letters: `P_ro`, `R^2`.
pub fn words(marked: &str) -> String {
    let mark = |level| match level {
        Level::Line => "",
        Level::Sub => "_",
        Level::Super => "^",
    };
    runs(marked).into_iter().flat_map(|run| [mark(run.level).to_string(), run.words]).collect()
}

/// The letters and digits of a marked text as the name of a file: `rack-2-csgm`.
pub fn file_words(marked: &str) -> String {
    let parts = marked.split(|letter: char| !letter.is_alphanumeric());
    parts.filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-").to_lowercase()
}

/// Escapes text for HTML, SVG and their attributes; drops what is no letter to read.
pub fn escape(text: &str) -> String {
    let clean = text.replace(|letter: char| is_hidden(letter) && letter != '\n', "");
    clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

pub fn minus(number: String) -> String {
    number.replace('-', "\u{2212}")
}
