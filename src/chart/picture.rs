//! A picture as it is written: shapes, and over them texts whose places are known before.

use super::figure::{Dash, Ink, LabelPosition, Symbol, Words};
use super::text::{Level, escape, runs, words};

pub type Point = nalgebra::Point2<f64>;

/// Height of the letters of titles and legends; and of ticks, labels and words beside data.
pub const LETTERS: f64 = 8.0;
pub const SMALL: f64 = 7.2;
/// Mean width of a letter, of its height.
pub const LETTER_WIDTH: f64 = 0.54;

/// Width of the line of a circle or cross, of its radius.
const OUTLINE: f64 = 0.45;

/// The colours of data in a file: Okabe & Ito's palette without its yellow, too faint on white.
const DATA: [&str; 6] = ["#0069a8", "#cf5412", "#00916b", "#c06a97", "#d99400", "#4aa3d8"];

impl Ink {
    pub fn in_file(self) -> String {
        let colour = match self {
            Ink::Text => "#1b1f24",
            Ink::Muted => "#5d646d",
            Ink::Rule => "#d8dce1",
            Ink::Data(number) => DATA[number % DATA.len()],
        };
        colour.to_string()
    }

    pub fn in_page(self) -> String {
        match self {
            Ink::Text => "var(--ink)".to_string(),
            Ink::Muted => "var(--muted)".to_string(),
            Ink::Rule => "var(--rule)".to_string(),
            Ink::Data(number) => format!("var(--data{})", number % DATA.len()),
        }
    }
}

/// Shapes and texts, from the top down to its height.
pub struct Picture {
    pub width: f64,
    pub height: f64,
    pub shapes: String,
    /// At their places in the picture.
    pub texts: Vec<Words>,
    /// The colour of an ink, in a file or on the page.
    colour: fn(Ink) -> String,
}

impl Picture {
    pub fn new(width: f64, colour: fn(Ink) -> String) -> Picture {
        Picture { width, height: 0.0, shapes: String::new(), texts: Vec::new(), colour }
    }

    /// Writes the picture with attributes, and with what stands before its shapes; nothing without height.
    pub fn svg(&self, attributes: &str, head: &str) -> String {
        if self.height == 0.0 {
            return String::new();
        }
        let texts: String = self.texts.iter().map(|text| self.text(text)).collect();
        let (width, height) = (self.width, round(self.height));
        let svg = format!("<svg {attributes} viewBox=\"0 0 {width} {height}\">\n");
        [&svg, head, &self.shapes, &texts, "</svg>\n"].concat()
    }

    fn text(&self, words: &Words) -> String {
        let middle = 0.35 * SMALL;
        let (size, right, down, anchor) = match words.position {
            LabelPosition::Title | LabelPosition::Legend => (LETTERS, 0.0, 0.0, "start"),
            LabelPosition::YLabel => (SMALL, 0.0, 0.0, "start"),
            LabelPosition::Right | LabelPosition::Margin => (SMALL, 5.0, middle, "start"),
            LabelPosition::Left => (SMALL, -5.0, middle, "end"),
            LabelPosition::Above => (SMALL, 0.0, -5.0, "middle"),
            LabelPosition::Below => (SMALL, 0.0, 10.5, "middle"),
            LabelPosition::Along => (SMALL, -3.0, 0.0, "end"),
        };
        let (x, y, colour) = (round(words.x + right), round(words.y + down), (self.colour)(words.ink));
        let style = match words.position {
            LabelPosition::Title => " font-weight=\"600\"".to_string(),
            LabelPosition::Along => format!(" transform=\"rotate(-90 {x} {y})\""),
            _ => String::new(),
        };
        let place = format!("x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\"");
        let mut svg = format!("<text {place} fill=\"{colour}\"{style}>");
        let mut drop = 0.0;
        for run in runs(&words.text) {
            let (below, letters) = match run.level {
                Level::Line => (0.0, size),
                Level::Sub => (0.22 * size, 0.72 * size),
                Level::Super => (-0.36 * size, 0.72 * size),
            };
            let slant = if run.italic { " font-style=\"italic\" font-weight=\"400\"" } else { "" };
            let ([letters, down], words) = ([letters, below - drop].map(round), escape(&run.words));
            svg += &format!("<tspan font-size=\"{letters}\" dy=\"{down}\"{slant}>{words}</tspan>");
            drop = below;
        }
        svg + "</text>\n"
    }

    pub fn write(&mut self, [x, y]: [f64; 2], position: LabelPosition, ink: Ink, marked: &str) {
        if !marked.is_empty() {
            self.texts.push(Words { x, y, text: marked.to_string(), position, ink });
        }
    }

    /// Draws small symbols, short to write: a disc is a stroke of no length with round ends.
    pub fn symbols(&mut self, places: &[Point], symbol: Symbol, radius: f64, ink: Ink, opacity: f64) {
        let (r, d) = (round(radius), round(2.0 * radius));
        let (shape, width) = match symbol {
            Symbol::Disc | Symbol::Dot => ("h0".to_string(), d),
            Symbol::Circle => (format!("m-{r} 0a{r} {r} 0 1 1 0 .1"), OUTLINE * r),
            Symbol::Cross => (format!("m-{r}-{r}l{d} {d}m-{d} 0l{d}-{d}"), OUTLINE * r),
        };
        let finite = places.iter().filter(|place| is_finite(place));
        let d: String = finite.map(|at| format!("M{} {}{shape}", round(at.x), round(at.y))).collect();
        self.stroke(&d, ink, width, &format!(" stroke-linecap=\"round\" stroke-opacity=\"{opacity}\""));
    }

    /// Draws a disc over its limits, a broad, pale line.
    pub fn estimate(&mut self, at: Point, limits: [Point; 2], ink: Ink) {
        self.stroke(&course(&limits), ink, 2.4, " class=\"limits\" stroke-opacity=\"0.42\"");
        self.symbols(&[at], Symbol::Dot, 2.2, ink, 1.0);
    }

    pub fn fill(&mut self, outline: &[Point], ink: Ink, opacity: f64) {
        let (d, colour) = (course(outline), (self.colour)(ink));
        self.shapes += &format!("<path d=\"{d}Z\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>\n");
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
        self.shapes += &format!("<path d=\"{d}\" {line}{style}/>\n");
    }
}

fn is_finite(place: &Point) -> bool {
    place.iter().all(|number| number.is_finite())
}

/// Writes the steps of a line, anew after each place that is not finite.
pub fn course(places: &[Point]) -> String {
    let step = |place: &Point| format!("{} {}", round(place.x), round(place.y));
    let pieces = places.split(|place| !is_finite(place)).filter(|piece| !piece.is_empty());
    pieces.map(|piece| format!("M{}", piece.iter().map(step).collect::<Vec<_>>().join("L"))).collect()
}

/// Estimates the width of marked text: the letters of its reader are not known.
pub fn width(marked: &str, size: f64) -> f64 {
    words(marked).chars().count() as f64 * size * LETTER_WIDTH
}

/// Rounds to a hundredth of a point, within what readers of SVG can count.
pub fn round(number: f64) -> f64 {
    (number.clamp(-9999.0, 9999.0) * 100.0).round() / 100.0 + 0.0
}
