//! A drawing as SVG: in the page, or as a file of its own.

use std::fmt::Write;

use super::drawing::{Anchor, Drawing, Ink, Item, Paint, Step, Stroke, Text};
use super::figure::Figure;
use super::font::Face;
use super::text::{Level, escape};

/// Where the SVG stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// In the page, which has the fonts and the colours, light and dark.
    Page,
    /// In a file of its own, on white, with the fonts that its reader has: Fira Sans, or one like it.
    File,
}

/// The fonts of a file: the first that its reader has.
const FONTS: &str = "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif";

/// Draws a figure as SVG.
pub fn svg(figure: &Figure, place: Place) -> String {
    let Figure { title, drawing: Drawing { width, height, items, .. }, .. } = figure;
    let mut text = String::new();
    let name = escape(title);
    let _ = match place {
        Place::Page => write!(
            text,
            "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{name}\">",
            r(*width),
            r(*height)
        ),
        Place::File => write!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}pt\" height=\"{1}pt\" viewBox=\"0 0 {0} {1}\" font-family=\"{FONTS}\" style=\"white-space:pre\">\n<title>{name}</title>\n<desc>{2}</desc>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>",
            r(*width),
            r(*height),
            escape(&figure.description())
        ),
    };
    text.push('\n');
    let mut writer = Writer { text, place };
    for item in items {
        writer.item(item);
        writer.text.push('\n');
    }
    writer.text.push_str("</svg>\n");
    writer.text
}

struct Writer {
    text: String,
    place: Place,
}

impl Writer {
    fn colour(&self, ink: Ink) -> String {
        match self.place {
            Place::Page => format!("var({})", ink.variable()),
            Place::File => ink.hex(),
        }
    }

    fn item(&mut self, item: &Item) {
        match item {
            Item::Path { steps, fill, stroke } => {
                self.text.push_str("<path d=\"");
                let _ = steps.iter().try_for_each(|step| write_step(&mut self.text, step));
                self.text.push('"');
                self.fill(*fill);
                if let Some(stroke) = stroke {
                    self.stroke(stroke);
                }
                self.text.push_str("/>");
            }
            Item::Dots { at, radius, paint } => {
                self.text.push_str("<path d=\"");
                let _ = at.iter().try_for_each(|&[x, y]| write!(self.text, "M{} {}h0", r(x), r(y)));
                let colour = self.colour(paint.ink);
                let _ = write!(
                    self.text,
                    "\" fill=\"none\" stroke=\"{colour}\" stroke-linecap=\"round\" stroke-width=\"{}\"",
                    r(2.0 * radius)
                );
                self.opacity("stroke", paint.opacity);
                self.text.push_str("/>");
            }
            Item::Text(text) => self.words(text),
        }
    }

    fn fill(&mut self, fill: Option<Paint>) {
        match fill {
            None => self.text.push_str(" fill=\"none\""),
            Some(Paint { ink, opacity }) => {
                let _ = write!(self.text, " fill=\"{}\"", self.colour(ink));
                self.opacity("fill", opacity);
            }
        }
    }

    fn stroke(&mut self, Stroke { paint, width, dash }: &Stroke) {
        let _ = write!(
            self.text,
            " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
            self.colour(paint.ink),
            r(*width)
        );
        self.opacity("stroke", paint.opacity);
        if !dash.lengths().is_empty() {
            let lengths = dash.lengths().iter().map(|&length| r(length).to_string()).collect::<Vec<_>>();
            let _ = write!(self.text, " stroke-dasharray=\"{}\"", lengths.join(" "));
        }
    }

    fn opacity(&mut self, of: &str, opacity: f64) {
        if opacity < 1.0 {
            let _ = write!(self.text, " {of}-opacity=\"{}\"", r(opacity));
        }
    }

    fn words(&mut self, text: &Text) {
        let [x, y] = text.at;
        let turn = if text.upwards {
            format!(" transform=\"rotate(-90 {} {})\"", r(x), r(y))
        } else {
            String::new()
        };
        let colour = self.colour(text.ink);
        let anchor = match text.anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let _ = write!(
            self.text,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" fill=\"{colour}\"{anchor}{turn}>",
            r(x),
            r(y),
            r(text.size)
        );
        let mut drop = 0.0;
        for run in &text.label.runs {
            let mut style = String::new();
            match run.face {
                Face::Regular => {}
                Face::Italic => style.push_str(" font-style=\"italic\""),
                Face::SemiBold => style.push_str(" font-weight=\"600\""),
            }
            if run.level != Level::Line {
                let _ = write!(style, " font-size=\"{}\"", r(text.size * run.level.scale()));
            }
            if run.level.drop() != drop {
                let _ = write!(style, " dy=\"{}\"", r((run.level.drop() - drop) * text.size));
                drop = run.level.drop();
            }
            let _ = write!(self.text, "<tspan{style}>{}</tspan>", escape(&run.words));
        }
        self.text.push_str("</text>");
    }
}

fn write_step(text: &mut String, step: &Step) -> std::fmt::Result {
    match *step {
        Step::Move([x, y]) => write!(text, "M{} {}", r(x), r(y)),
        Step::Line([x, y]) => write!(text, "L{} {}", r(x), r(y)),
        Step::Close => write!(text, "Z"),
        Step::Circle([x, y], radius) => {
            let (radius, across) = (r(radius), r(2.0 * radius));
            write!(
                text,
                "M{} {}a{radius} {radius} 0 1 0 {across} 0a{radius} {radius} 0 1 0 -{across} 0Z",
                r(x - radius),
                r(y)
            )
        }
    }
}

/// Rounds to a hundredth of a point, so that numbers are short.
fn r(number: f64) -> f64 {
    // Adding 0 turns -0 into 0.
    (number * 100.0).round() / 100.0 + 0.0
}
