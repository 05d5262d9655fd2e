//! Where results are read: on a terminal of some width and with colours, or in a file or pipe, which gets them plain and whole.

use std::io::IsTerminal;

/// What a stream leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Terminal {
    /// Columns of its window; none where it is no terminal.
    pub width: Option<usize>,
    /// Whether it shows weight and colour, and is asked to.
    pub styled: bool,
}

/// How a line is set off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weight {
    /// Not at all.
    Plain,
    /// Bold.
    Strong,
    /// Grey.
    Faint,
}

/// What follows a line that is cut.
const CUT: char = '\u{2026}';

impl Terminal {
    /// No terminal: a file or a pipe.
    pub const PLAIN: Terminal = Terminal { width: None, styled: false };

    /// Where stdout leads.
    pub fn stdout() -> Terminal {
        Terminal::of(std::io::stdout())
    }

    /// Where stderr leads.
    pub fn stderr() -> Terminal {
        Terminal::of(std::io::stderr())
    }

    fn of(stream: impl IsTerminal) -> Terminal {
        if !stream.is_terminal() {
            return Terminal::PLAIN;
        }
        let set = |name: &str| std::env::var(name).unwrap_or_default();
        let styled = set("NO_COLOR").is_empty() && set("TERM") != "dumb";
        let size = terminal_size::terminal_size();
        Terminal { width: size.map(|(width, _)| usize::from(width.0)), styled }
    }

    /// Words in a weight.
    pub fn set(&self, words: &str, weight: Weight) -> String {
        let code = match weight {
            Weight::Strong if self.styled => "1",
            Weight::Faint if self.styled => "2",
            _ => return words.to_string(),
        };
        format!("\u{1b}[{code}m{words}\u{1b}[0m")
    }

    /// A line, cut to the width of the window.
    pub fn line(&self, words: &str, weight: Weight) -> String {
        let cut = match self.width {
            Some(width) if words.chars().count() > width => {
                words.chars().take(width.saturating_sub(1)).chain([CUT]).collect()
            }
            _ => words.to_string(),
        };
        format!("{}\n", self.set(&cut, weight))
    }

    /// A table under a line of names.
    pub fn table(&self, text: &str) -> String {
        let weight = |index: usize| if index == 0 { Weight::Strong } else { Weight::Plain };
        text.lines().enumerate().map(|(index, line)| self.line(line, weight(index))).collect()
    }
}
