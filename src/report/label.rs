//! Words of figures and pages: italics, subscripts and superscripts.

use super::font::Face;

/// A text of runs in one style each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Label {
    /// The runs in order.
    pub runs: Vec<Run>,
}

/// Words in one style.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The words.
    pub words: String,
    /// The font.
    pub face: Face,
    /// Where they stand.
    pub level: Level,
}

/// Where a run stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// On the line.
    Line,
    /// Small, below it.
    Sub,
    /// Small, above it.
    Super,
}

impl Level {
    /// Size over that of the line.
    pub fn scale(self) -> f64 {
        if self == Level::Line { 1.0 } else { 0.72 }
    }

    /// How far the baseline lies below that of the line, over the size of the line.
    pub fn drop(self) -> f64 {
        match self {
            Level::Line => 0.0,
            Level::Sub => 0.22,
            Level::Super => -0.36,
        }
    }
}

impl Label {
    /// Words as they stand, such as names out of a file.
    pub fn plain(words: impl Into<String>) -> Label {
        Label { runs: vec![Run { words: words.into(), face: Face::Regular, level: Level::Line }] }
    }

    /// Marked text: `*p* PGV`, `*P*_{ex}`, `10^{-3}`. For what stands in the source, not for names out of files.
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

    /// With another label after it.
    pub fn then(mut self, other: Label) -> Label {
        self.runs.extend(other.runs);
        self
    }

    /// In bold type, but for italics.
    pub fn bold(mut self) -> Label {
        for run in self.runs.iter_mut().filter(|run| run.face == Face::Regular) {
            run.face = Face::SemiBold;
        }
        self
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        self.runs.iter().all(|run| run.words.is_empty())
    }

    /// Width in this size.
    pub fn width(&self, size: f64) -> f64 {
        self.runs.iter().map(|run| run.face.width(&run.words, size * run.level.scale())).sum()
    }
}

/// Text that stands in HTML, SVG or their attributes.
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
