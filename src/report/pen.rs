//! The elements of a picture: texts, lines, areas and dots, in the colours of a file.

use std::fmt::Write;

use super::figure::{Dash, Ink, Side, Words};
use super::text::{Level, escape, runs};

/// Height of the letters of titles and legends; and of ticks and words beside data.
pub const LETTERS: f64 = 8.0;
pub const SMALL: f64 = 7.2;
impl Ink {
    /// The colours in a file and the names of those on the page. Data: Okabe & Ito's palette without its
    /// yellow, too faint on white; then the bands of a probability, from rare to frequent.
    const COLOURS: [(&'static str, &'static str); 12] = [
        ("#1b1f24", "--ink"),
        ("#5d646d", "--muted"),
        ("#d8dce1", "--rule"),
        ("#0069a8", "--data0"),
        ("#cf5412", "--data1"),
        ("#00916b", "--data2"),
        ("#c06a97", "--data3"),
        ("#d99400", "--data4"),
        ("#4aa3d8", "--data5"),
        ("#4f86a6", "--band0"),
        ("#d98a00", "--band1"),
        ("#b8321f", "--band2"),
    ];

    pub fn colour(self) -> &'static str {
        match self {
            Ink::Text => Ink::COLOURS[0].0,
            Ink::Muted => Ink::COLOURS[1].0,
            Ink::Rule => Ink::COLOURS[2].0,
            Ink::Data(number) => Ink::COLOURS[3 + number % 6].0,
            Ink::Band(number) => Ink::COLOURS[9 + number.min(2)].0,
        }
    }

    /// The drawing in the colours of the page.
    pub fn of_page(drawing: String) -> String {
        Ink::COLOURS
            .iter()
            .fold(drawing, |drawing, (hex, name)| drawing.replace(hex, &format!("var({name})")))
    }
}

/// Writes the elements of a picture whose letters and lines are `unit` times as large as in a file.
pub struct Pen {
    pub text: String,
    pub unit: f64,
}

impl Pen {
    /// Writes a text beside its place.
    pub fn beside(&mut self, [x, y]: [f64; 2], ink: Ink, Words { text, side, .. }: &Words) {
        let unit = self.unit;
        let (off, style) = match side {
            Side::Right => ([5.0, 0.35 * SMALL], String::new()),
            Side::Left => ([-5.0, 0.35 * SMALL], " text-anchor=\"end\"".to_string()),
            Side::Above => ([0.0, -5.0], " text-anchor=\"middle\"".to_string()),
            Side::Below => ([0.0, 5.0 + SMALL], " text-anchor=\"middle\"".to_string()),
            Side::Along => {
                let at = [x - 3.0 * unit, y].map(round);
                ([-3.0, 0.0], format!(" text-anchor=\"end\" transform=\"rotate(-90 {} {})\"", at[0], at[1]))
            }
        };
        let style = format!("{style} class=\"word\"");
        self.label([x + off[0] * unit, y + off[1] * unit], SMALL, &style, ink, text);
    }

    /// Writes marked text, its size as in a file; `style` are further attributes.
    pub fn label(&mut self, [x, y]: [f64; 2], size: f64, style: &str, ink: Ink, marked: &str) {
        if marked.is_empty() {
            return;
        }
        let size = size * self.unit;
        let (x, y, letters, colour) = (round(x), round(y), round(size), ink.colour());
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
    pub fn dots(&mut self, places: &[[f64; 2]], radius: f64, colour: &str, opacity: f64) {
        let finite = places.iter().filter(|place| place.iter().all(|v| v.is_finite()));
        let d: String = finite.map(|[x, y]| format!("M{} {}h0", round(*x), round(*y))).collect();
        let size = round(2.0 * radius * self.unit);
        let _ = writeln!(
            self.text,
            "<path d=\"{d}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{size}\" \
             stroke-linecap=\"round\" stroke-opacity=\"{opacity}\"/>"
        );
    }

    /// The limits of a value: a broad, pale line.
    pub fn interval(&mut self, ends: [[f64; 2]; 2], colour: &str) {
        let (d, size) = (course(&ends), round(2.4 * self.unit));
        let _ = writeln!(
            self.text,
            "<path d=\"{d}\" stroke=\"{colour}\" stroke-width=\"{size}\" stroke-opacity=\"0.38\"/>"
        );
    }

    pub fn fill(&mut self, outline: &[[f64; 2]], colour: &str, opacity: f64) {
        let d = course(outline);
        let _ = writeln!(self.text, "<path d=\"{d}Z\" fill=\"{colour}\" fill-opacity=\"{opacity}\"/>");
    }

    pub fn path(&mut self, places: &[[f64; 2]], colour: &str, width: f64, dash: Dash) {
        let dash = match dash {
            Dash::Solid => "",
            Dash::Long => " stroke-dasharray=\"5 2\"",
            Dash::Short => " stroke-dasharray=\"2 2\"",
            Dash::Mixed => " stroke-dasharray=\"5 1.6 1.2 1.6\"",
        };
        let (d, width) = (course(places), round(width * self.unit));
        let _ = writeln!(
            self.text,
            "<path d=\"{d}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\"{dash}/>"
        );
    }
}

/// Writes the steps of a line, anew after each place that is not finite.
pub fn course(places: &[[f64; 2]]) -> String {
    let mut d = String::new();
    let mut step = 'M';
    for [x, y] in places {
        if x.is_finite() && y.is_finite() {
            let _ = write!(d, "{step}{} {}", round(*x), round(*y));
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
