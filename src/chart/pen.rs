//! The elements of a picture: texts, lines, areas and dots, in the colours of a file or of the page.

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

/// The colours in a file, and their names on the page, by [`Ink::place`]. Data: Okabe & Ito's palette without
/// its yellow, too faint on white.
const COLOURS: [&str; 12] = [
    "#1b1f24", "#5d646d", "#d8dce1", "#0069a8", "#cf5412", "#00916b", "#c06a97", "#d99400", "#4aa3d8",
    "#4f86a6", "#d98a00", "#b8321f",
];
const NAMES: [&str; 12] =
    ["ink", "muted", "rule", "data0", "data1", "data2", "data3", "data4", "data5", "step0", "step1", "step2"];

impl Ink {
    fn place(self) -> usize {
        match self {
            Ink::Text => 0,
            Ink::Muted => 1,
            Ink::Rule => 2,
            Ink::Data(number) => 3 + number % 6,
            Ink::Step(number) => 9 + number.min(2),
        }
    }

    pub fn in_file(self) -> String {
        COLOURS[self.place()].to_string()
    }

    pub fn in_page(self) -> String {
        format!("var(--{})", NAMES[self.place()])
    }
}

/// Writes the elements of a picture.
pub struct Pen {
    pub text: String,
    /// The colour of an ink, in a file or on the page.
    colour: fn(Ink) -> String,
}

impl Pen {
    pub fn new(colour: fn(Ink) -> String) -> Pen {
        Pen { text: String::new(), colour }
    }

    /// Writes a text beside its place.
    pub fn beside(&mut self, at: Point, words: &Words) {
        let (right, down, anchor) = match words.position {
            LabelPosition::Right | LabelPosition::Margin => (5.0, 0.35 * SMALL, "start"),
            LabelPosition::Left => (-5.0, 0.35 * SMALL, "end"),
            LabelPosition::Above => (0.0, -5.0, "middle"),
            LabelPosition::Below => (0.0, 5.0 + SMALL, "middle"),
            LabelPosition::Along => (-3.0, 0.0, "end"),
        };
        let at = Point::new(at.x + right, at.y + down);
        let mut style = format!(" class=\"word\" text-anchor=\"{anchor}\"");
        if words.position == LabelPosition::Along {
            style += &format!(" transform=\"rotate(-90 {} {})\"", round(at.x), round(at.y));
        }
        self.label(at, SMALL, &style, words.ink, &words.text);
    }

    /// Writes marked text; `style` are further attributes.
    pub fn label(&mut self, at: Point, size: f64, style: &str, ink: Ink, marked: &str) {
        if marked.is_empty() {
            return;
        }
        let (x, y, letters, colour) = (round(at.x), round(at.y), round(size), (self.colour)(ink));
        self.text += &format!("<text x=\"{x}\" y=\"{y}\" font-size=\"{letters}\" fill=\"{colour}\"{style}>");
        let mut drop = 0.0;
        for run in runs(marked) {
            let below = match run.level {
                Level::Line => 0.0,
                Level::Sub => 0.22 * size,
                Level::Super => -0.36 * size,
            };
            self.text += "<tspan";
            if below != 0.0 {
                self.text += &format!(" font-size=\"{}\"", round(0.72 * size));
            }
            if run.italic {
                self.text += " font-style=\"italic\" font-weight=\"400\"";
            }
            if below != drop {
                self.text += &format!(" dy=\"{}\"", round(below - drop));
            }
            drop = below;
            self.text += &format!(">{}</tspan>", escape(&run.words));
        }
        self.text += "</text>\n";
    }

    /// Draws small discs: strokes of no length with round ends, short to write.
    pub fn dots(&mut self, places: &[Point], radius: f64, ink: Ink, opacity: f64) {
        let finite = places.iter().filter(|place| place.is_finite());
        let d: String = finite.map(|place| format!("M{} {}h0", round(place.x), round(place.y))).collect();
        let style = format!(" stroke-linecap=\"round\" stroke-opacity=\"{opacity}\"");
        self.stroke(&d, ink, 2.0 * radius, &style);
    }

    /// The limits of a value: a broad, pale line.
    pub fn interval(&mut self, from: Point, to: Point, ink: Ink) {
        self.stroke(&course(&[from, to]), ink, 2.4, " class=\"limits\" stroke-opacity=\"0.42\"");
    }

    pub fn fill(&mut self, outline: &[Point], ink: Ink, opacity: f64) {
        let (d, colour) = (course(outline), (self.colour)(ink));
        self.text += &format!("<path d=\"{d}Z\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>\n");
    }

    pub fn path(&mut self, places: &[Point], ink: Ink, width: f64, dash: Dash) {
        let dash = match dash {
            Dash::Solid => "",
            Dash::Long => " stroke-dasharray=\"5 2\"",
            Dash::Short => " stroke-dasharray=\"2 2\"",
            Dash::Mixed => " stroke-dasharray=\"5 1.6 1.2 1.6\"",
        };
        self.stroke(&course(places), ink, width, &format!(" stroke-linejoin=\"round\"{dash}"));
    }

    /// Draws a course of lines; `style` are further attributes.
    pub fn stroke(&mut self, d: &str, ink: Ink, width: f64, style: &str) {
        let (width, colour) = (round(width), (self.colour)(ink));
        let line = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"");
        self.text += &format!("<path d=\"{d}\" {line}{style}/>\n");
    }
}

/// Writes the steps of a line, anew after each place that is not finite.
pub fn course(places: &[Point]) -> String {
    let (mut d, mut step) = (String::new(), 'M');
    for place in places {
        if place.is_finite() {
            d += &format!("{step}{} {}", round(place.x), round(place.y));
        }
        step = if place.is_finite() { 'L' } else { 'M' };
    }
    d
}

/// Rounds to a hundredth of a point, within what readers of SVG can count.
pub fn round(number: f64) -> f64 {
    (number.clamp(-9999.0, 9999.0) * 100.0).round() / 100.0 + 0.0
}
