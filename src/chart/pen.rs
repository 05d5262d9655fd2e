//! The elements of a picture: texts, lines, areas and dots, in the colours of a file.

use std::fmt::Write;

use super::figure::{Dash, Ink, LabelPosition, Words};
use super::text::{Level, escape, runs};

/// Height of the letters of titles and legends; and of ticks and words beside data.
pub const LETTERS: f64 = 8.0;
pub const SMALL: f64 = 7.2;

/// A place in a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
}

impl Point {
    pub fn new(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Ink {
    /// The colours in a file, and those on the page. Data: Okabe & Ito's palette without its
    /// yellow, too faint on white; then the bands of a probability, from rare to frequent.
    const COLOURS: [(&'static str, &'static str); 12] = [
        ("#1b1f24", "var(--ink)"),
        ("#5d646d", "var(--muted)"),
        ("#d8dce1", "var(--rule)"),
        ("#0069a8", "var(--data0)"),
        ("#cf5412", "var(--data1)"),
        ("#00916b", "var(--data2)"),
        ("#c06a97", "var(--data3)"),
        ("#d99400", "var(--data4)"),
        ("#4aa3d8", "var(--data5)"),
        ("#4f86a6", "var(--band0)"),
        ("#d98a00", "var(--band1)"),
        ("#b8321f", "var(--band2)"),
    ];

    fn colours(self) -> (&'static str, &'static str) {
        match self {
            Ink::Text => Ink::COLOURS[0],
            Ink::Muted => Ink::COLOURS[1],
            Ink::Rule => Ink::COLOURS[2],
            Ink::Data(number) => Ink::COLOURS[3 + number % 6],
            Ink::Band(number) => Ink::COLOURS[9 + number.min(2)],
        }
    }

    pub fn in_file(self) -> &'static str {
        self.colours().0
    }

    pub fn in_page(self) -> &'static str {
        self.colours().1
    }
}

/// Writes the elements of a picture.
pub struct Pen {
    pub text: String,
    /// The colour of an ink, in a file or on the page.
    pub colour: fn(Ink) -> &'static str,
}

impl Pen {
    pub fn new(colour: fn(Ink) -> &'static str) -> Pen {
        Pen { text: String::new(), colour }
    }

    /// Writes a text beside its place.
    pub fn beside(&mut self, at: Point, words: &Words) {
        let (right, down, style) = match words.position {
            LabelPosition::Right | LabelPosition::Margin => (5.0, 0.35 * SMALL, String::new()),
            LabelPosition::Left => (-5.0, 0.35 * SMALL, " text-anchor=\"end\"".to_string()),
            LabelPosition::Above => (0.0, -5.0, " text-anchor=\"middle\"".to_string()),
            LabelPosition::Below => (0.0, 5.0 + SMALL, " text-anchor=\"middle\"".to_string()),
            LabelPosition::Along => {
                let (x, y) = (round(at.x - 3.0), round(at.y));
                (-3.0, 0.0, format!(" text-anchor=\"end\" transform=\"rotate(-90 {x} {y})\""))
            }
        };
        let place = Point::new(at.x + right, at.y + down);
        self.label(place, SMALL, &format!("{style} class=\"word\""), words.ink, &words.text);
    }

    /// Writes marked text; `style` are further attributes.
    pub fn label(&mut self, at: Point, size: f64, style: &str, ink: Ink, marked: &str) {
        if marked.is_empty() {
            return;
        }
        let (x, y, letters, colour) = (round(at.x), round(at.y), round(size), (self.colour)(ink));
        let _ =
            write!(self.text, "<text x=\"{x}\" y=\"{y}\" font-size=\"{letters}\" fill=\"{colour}\"{style}>");
        let mut drop = 0.0;
        for run in runs(marked) {
            let below = match run.level {
                Level::Line => 0.0,
                Level::Sub => 0.22 * size,
                Level::Super => -0.36 * size,
            };
            let small =
                if below == 0.0 { String::new() } else { format!(" font-size=\"{}\"", round(0.72 * size)) };
            let italic = if run.italic { " font-style=\"italic\" font-weight=\"400\"" } else { "" };
            let moved =
                if below == drop { String::new() } else { format!(" dy=\"{}\"", round(below - drop)) };
            drop = below;
            let _ = write!(self.text, "<tspan{small}{italic}{moved}>{}</tspan>", escape(&run.words));
        }
        self.text.push_str("</text>\n");
    }

    /// Draws small discs: strokes of no length with round ends, short to write.
    pub fn dots(&mut self, places: &[Point], radius: f64, colour: &str, opacity: f64) {
        let finite = places.iter().filter(|place| place.is_finite());
        let d: String = finite.map(|place| format!("M{} {}h0", round(place.x), round(place.y))).collect();
        let style = format!(" stroke-linecap=\"round\" stroke-opacity=\"{opacity}\"");
        self.stroke(&d, colour, 2.0 * radius, &style);
    }

    /// The limits of a value: a broad, pale line.
    pub fn interval(&mut self, from: Point, to: Point, colour: &str) {
        self.stroke(&course(&[from, to]), colour, 2.4, " class=\"limits\" stroke-opacity=\"0.42\"");
    }

    pub fn fill(&mut self, outline: &[Point], colour: &str, opacity: f64) {
        let d = course(outline);
        let _ = writeln!(self.text, "<path d=\"{d}Z\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>");
    }

    pub fn path(&mut self, places: &[Point], colour: &str, width: f64, dash: Dash) {
        let dash = match dash {
            Dash::Solid => "",
            Dash::Long => " stroke-dasharray=\"5 2\"",
            Dash::Short => " stroke-dasharray=\"2 2\"",
            Dash::Mixed => " stroke-dasharray=\"5 1.6 1.2 1.6\"",
        };
        self.stroke(&course(places), colour, width, &format!(" stroke-linejoin=\"round\"{dash}"));
    }

    /// Draws a course of lines; `style` are further attributes.
    pub fn stroke(&mut self, d: &str, colour: &str, width: f64, style: &str) {
        let width = round(width);
        let line = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"");
        let _ = writeln!(self.text, "<path d=\"{d}\" {line}{style}/>");
    }
}

/// Writes the steps of a line, anew after each place that is not finite.
pub fn course(places: &[Point]) -> String {
    let mut d = String::new();
    let mut step = 'M';
    for place in places {
        if place.is_finite() {
            let _ = write!(d, "{step}{} {}", round(place.x), round(place.y));
            step = 'L';
        } else {
            step = 'M';
        }
    }
    d
}

/// Rounds to a hundredth of a point, within what readers of SVG can count.
pub fn round(number: f64) -> f64 {
    (number.clamp(-9999.0, 9999.0) * 100.0).round() / 100.0 + 0.0
}
