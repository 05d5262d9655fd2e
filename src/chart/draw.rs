//! Drawing of figures: as SVG files in points of 1/72 inch and as PNG of them; as SVG in a page.

use std::collections::HashSet;
use std::{iter, slice};

use super::axis::Ruler;
use super::figure::{Dash, Figure, Frame, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Scale};
use super::pen::{LETTERS, Pen, Point, SMALL, course, round};
use super::text::{escape, html, literal, words};
use crate::number;

/// Width of a file, points: across two columns of a journal, 180 mm.
const FILE_WIDTH: f64 = 510.2;
/// Width of a panel on the page, which is a picture of its own.
const PAGE_WIDTH: f64 = 267.0;
/// Least height of the area of the data of a panel on the page.
const LEAST_HEIGHT: f64 = 60.0;

/// Mean width of a letter, of its height.
const LETTER_WIDTH: f64 = 0.54;
/// Room around the area of the data of a panel: at the left for ticks, at the right, above for title and
/// label of y, below for ticks and label of x.
const LEFT: f64 = 30.0;
const RIGHT: f64 = 12.0;
const TITLE: f64 = 12.0;
const LABEL: f64 = 10.0;
const GAP: f64 = 6.0;
const BELOW: f64 = 26.0;
/// Height of a row with a name; the most room for names, and its most share of the width.
const ROW: f64 = 13.0;
const NAMES: f64 = 190.0;
const NAMES_SHARE: f64 = 0.46;
/// Height of a line of the legend, length of its marks, and room between its entries.
const LEGEND: f64 = 12.0;
const MARK: f64 = 14.0;
const BETWEEN: f64 = 12.0;
/// Number of points below which they are drawn larger and darker, and above which a line is thin.
const FEW_POINTS: usize = 400;

/// The fonts of a file: the first that its reader has.
const FONTS: &str = "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif";
/// What made the files, in their heads.
const GENERATOR: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
/// Dots per inch of PNG files.
pub const DPI: f32 = 300.0;

/// Writes a figure as an SVG file on white.
pub fn svg(figure: &Figure) -> String {
    let mut pen = Pen::new(Ink::in_file);
    let mut height = pen.legend(&figure.panels, FILE_WIDTH);
    let columns = figure.columns.max(1);
    for row in figure.panels.chunks(columns) {
        height = pen.row(row, figure.height, FILE_WIDTH / columns as f64, height);
    }
    let (width, height) = (FILE_WIDTH, round(height.max(1.0)));
    let captions = iter::once(&figure.caption).chain(figure.panels.iter().map(|panel| &panel.caption));
    let caption: Vec<String> =
        captions.filter(|text| !text.is_empty()).map(|text| escape(&words(text))).collect();
    let (title, caption, body) = (escape(&words(&figure.title)), caption.join(" "), pen.text);
    let size = format!("width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\"");
    let meta = format!("xmlns=\"http://www.w3.org/1999/xhtml\" name=\"generator\" content=\"{GENERATOR}\"");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" {size} font-family=\"{FONTS}\">\n\
         <metadata><meta {meta}/></metadata>\n<title>{title}</title>\n<desc>{caption}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Writes the panels of a figure for a page that has the fonts and the colours: each a picture of its own,
/// so that they stand beside each other where there is room.
pub fn html_of_panels(figure: &Figure) -> String {
    // As high over its width as in the file.
    let across = PAGE_WIDTH * figure.columns.max(1) as f64 / FILE_WIDTH;
    let height = (figure.height * across).max(LEAST_HEIGHT);
    // A legend that all panels share stands above them.
    let names = |panel| listed(slice::from_ref(panel)).map(|layer| &layer.name).collect::<Vec<_>>();
    let is_shared = figure.panels.windows(2).all(|pair| names(&pair[0]) == names(&pair[1]));
    let shared = if is_shared && figure.panels.len() > 1 { &figure.panels[..] } else { &[] };
    let mut pen = Pen::new(Ink::in_page);
    let mut text = match pen.legend(shared, PAGE_WIDTH) {
        0.0 => String::new(),
        above => format!(
            "<svg class=\"legend\" viewBox=\"0 0 {PAGE_WIDTH} {above}\" role=\"group\">\n{}</svg>\n",
            pen.text
        ),
    };
    let class = if figure.panels.len() == 4 { "panels four" } else { "panels" };
    text += &format!("<div class=\"{class}\">\n");
    for panel in &figure.panels {
        let name = if panel.title.is_empty() { &figure.title } else { &panel.title };
        let (name, caption) = (escape(&words(name)), html(&panel.caption));
        let (mut pen, alone) = (Pen::new(Ink::in_page), slice::from_ref(panel));
        let top = pen.legend(if shared.is_empty() { alone } else { &[] }, PAGE_WIDTH);
        let (height, body) = (round(pen.row(alone, height, PAGE_WIDTH, top)), pen.text);
        text += &format!(
            "<figure>\n<svg viewBox=\"0 0 {PAGE_WIDTH} {height}\" role=\"img\" aria-label=\"{name}\">\n\
             {body}</svg>\n<figcaption>{caption}</figcaption></figure>\n"
        );
    }
    text + "</div>\n"
}

/// Draws an SVG file as PNG with so many dots per inch.
pub fn png(svg: &str, dpi: f32) -> Result<Vec<u8>, resvg::usvg::Error> {
    use resvg::{tiny_skia, usvg};
    let mut options = usvg::Options { dpi, font_family: "Fira Sans".to_string(), ..usvg::Options::default() };
    let faces: [&[u8]; 3] = [
        include_bytes!("fonts/FiraSans-Regular.ttf"),
        include_bytes!("fonts/FiraSans-Italic.ttf"),
        include_bytes!("fonts/FiraSans-SemiBold.ttf"),
    ];
    faces.iter().for_each(|face| options.fontdb_mut().load_font_data(face.to_vec()));
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).ok_or(usvg::Error::InvalidSize)?;
    resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixels.as_mut());
    let drawn = pixels.encode_png().map_err(|_| usvg::Error::InvalidSize)?;
    Ok(named(&drawn))
}

/// A PNG with what made it behind its head: a chunk of its length, its kind, its words and their sum.
fn named(png: &[u8]) -> Vec<u8> {
    const HEAD: usize = 33;
    let content = [b"tEXtSoftware\0", GENERATOR.as_bytes()].concat();
    let mut sum = flate2::Crc::new();
    sum.update(&content);
    let [length, sum] = [content.len() as u32 - 4, sum.sum()].map(u32::to_be_bytes);
    [&png[..HEAD], &length, &content, &sum, &png[HEAD..]].concat()
}

/// The layers of the legend, in the order in which they come.
fn listed(panels: &[Panel]) -> impl Iterator<Item = &Layer> {
    let mut known = HashSet::new();
    let layers = panels.iter().flat_map(|panel| &panel.layers);
    layers.filter(move |layer| layer.is_listed && known.insert(&layer.name))
}

/// Estimates the width of marked text: the letters of its reader are not known.
fn width(marked: &str, size: f64) -> f64 {
    words(marked).chars().count() as f64 * size * LETTER_WIDTH
}

impl Panel {
    /// The room above the area of its data, for title and label of y.
    fn above(&self) -> f64 {
        let has_words = self.words.iter().any(|words| words.position == LabelPosition::Above);
        let labels = LABEL * f64::from(!self.y.label.is_empty()) + LABEL * f64::from(has_words);
        GAP + TITLE * f64::from(!self.title.is_empty()) + labels
    }

    /// The room below it, for ticks and label of x.
    fn below(&self) -> f64 {
        if self.frame == Frame::ToScale || self.x.label.is_empty() { GAP } else { BELOW }
    }

    /// The height of the area of its data, where that of others is given.
    fn height(&self, of_others: f64) -> f64 {
        if self.names().is_empty() { of_others } else { ROW * self.names().len() as f64 }
    }

    /// The room at the left for ticks or names, and at the right for words in the margin.
    fn sides(&self, across: f64) -> [f64; 2] {
        let room = |marked: &String| width(marked, SMALL) + 8.0;
        let left = self.names().iter().map(room).fold(LEFT, f64::max).min(NAMES.min(NAMES_SHARE * across));
        let words = self.words.iter().filter(|words| words.position == LabelPosition::Margin);
        let right = words.map(|words| room(&words.text)).fold(RIGHT, f64::max);
        [if self.frame == Frame::ToScale { 4.0 } else { left }, right]
    }
}

impl Pen {
    /// Draws the legend in lines; returns where the first row of panels begins.
    fn legend(&mut self, panels: &[Panel], across: f64) -> f64 {
        let left = 4.0;
        let (mut x, mut y) = (left, 11.0);
        for layer in listed(panels) {
            let long = MARK + 3.0 + width(&layer.name, LETTERS);
            if x > left && x + long > across {
                (x, y) = (left, y + LEGEND);
            }
            let along = |part: f64| Point::new(x + part * MARK, y - 2.6);
            match layer.style {
                MarkStyle::Points => self.dots(&[along(0.5)], 2.0, layer.ink, 1.0),
                MarkStyle::Line(dash) => self.path(&[along(0.0), along(1.0)], layer.ink, 1.3, dash),
                MarkStyle::Estimates => {
                    self.interval(along(0.07), along(0.93), layer.ink);
                    self.dots(&[along(0.5)], 2.2, layer.ink, 1.0);
                }
            }
            self.label(Point::new(x + MARK + 3.0, y), LETTERS, "", Ink::Text, &layer.name);
            x += long + BETWEEN;
        }
        if x > left { y + 5.0 } else { 0.0 }
    }

    /// Draws panels beside each other, each so wide; returns where the next row begins.
    fn row(&mut self, panels: &[Panel], height: f64, across: f64, top: f64) -> f64 {
        let most = |room: &dyn Fn(&Panel) -> f64| panels.iter().map(room).fold(0.0, f64::max);
        let data = top + most(&Panel::above);
        for (column, panel) in panels.iter().enumerate() {
            let (edge, [left, right]) = (column as f64 * across, panel.sides(across));
            let [x, y] =
                panel.rulers([edge + left, edge + across - right], [data + panel.height(height), data]);
            let bold = " font-weight=\"600\"";
            self.label(Point::new(edge + 2.0, top + 9.0), LETTERS, bold, Ink::Text, &panel.title);
            self.label(Point::new(edge + 2.0, data - GAP), SMALL, "", Ink::Muted, &panel.y.label);
            self.panel(panel, &x, &y);
        }
        data + most(&|panel| panel.height(height)) + most(&Panel::below)
    }

    fn panel(&mut self, panel: &Panel, x: &Ruler, y: &Ruler) {
        if panel.frame == Frame::Axes {
            self.axes(panel, x, y);
        }
        // What lies beyond the axes is cut off by the inner picture; words may stand over its edge.
        let [left, top, width, height] = [x.from, y.to, x.to - x.from, y.from - y.to].map(round);
        let area = format!("{left} {top} {width} {height}");
        self.text += &format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" viewBox=\"{area}\">\n"
        );
        panel.drawn().for_each(|layer| self.marks(layer, x, y));
        self.text += "</svg>\n";
        for words in &panel.words {
            let across = if words.position == LabelPosition::Margin { x.to } else { x.at(words.x) };
            self.beside(Point::new(across, y.at(words.y)), words);
        }
    }

    /// The axes; faint lines stand at labelled ticks of y, or along rows.
    fn axes(&mut self, panel: &Panel, x: &Ruler, y: &Ruler) {
        let (end, mut lines) = (x.from - 4.0, String::new());
        let letters = (end / (SMALL * LETTER_WIDTH)) as usize;
        for tick in y.ticks((((y.from - y.to) / 18.0) as usize).max(5)) {
            let Some(label) = tick.label else { continue };
            let at = y.at(tick.value);
            lines += &course(&[Point::new(x.from, at), Point::new(x.to, at)]);
            let (ink, label) = match panel.names() {
                [] => (Ink::Muted, label),
                _ => (Ink::Text, literal(&number::shown(&words(&label), letters))),
            };
            self.label(Point::new(end, at + 0.35 * SMALL), SMALL, " text-anchor=\"end\"", ink, &label);
        }
        self.stroke(&lines, Ink::Rule, 0.45, "");
        let (bottom, middle) = (y.from, " text-anchor=\"middle\"");
        let mut axis = course(&[Point::new(x.from, bottom), Point::new(x.to, bottom)]);
        for tick in x.ticks(((x.to - x.from) / 28.0) as usize) {
            let at = x.at(tick.value);
            let length = if tick.label.is_some() { 3.0 } else { 1.6 };
            axis += &course(&[Point::new(at, bottom), Point::new(at, bottom + length)]);
            if let Some(words) = tick.label.filter(|_| !panel.x.label.is_empty()) {
                self.label(Point::new(at, bottom + 10.5), SMALL, middle, Ink::Muted, &words);
            }
        }
        self.stroke(&axis, Ink::Muted, 0.6, "");
        let below = Point::new(0.5 * (x.from + x.to), bottom + 21.0);
        self.label(below, SMALL, middle, Ink::Muted, &panel.x.label);
    }

    /// Draws the marks of a layer, each value at its place.
    fn marks(&mut self, layer: &Layer, x: &Ruler, y: &Ruler) {
        let (ink, marks) = (layer.ink, &layer.marks);
        let places: Vec<Point> = marks.iter().map(|mark| Point::new(x.at(mark.x), y.at(mark.y))).collect();
        let limits = |mark: &Mark| match y.scale {
            Scale::Names(_) => [mark.low, mark.high].map(|limit| Point::new(x.at(limit), y.at(mark.y))),
            _ => [mark.low, mark.high].map(|limit| Point::new(x.at(mark.x), y.at(limit))),
        };
        match layer.style {
            MarkStyle::Points => {
                let (radius, opacity) = match marks.len() {
                    ..6 => (2.2, 1.0),
                    6..FEW_POINTS => (1.3, 0.85),
                    _ => (0.8, 0.5),
                };
                self.dots(&places, radius, ink, opacity);
            }
            MarkStyle::Line(dash) => {
                let has_band = |mark: &Mark| mark.is_finite() && mark.low.is_finite();
                for piece in marks.split(|mark| !has_band(mark)).filter(|piece| !piece.is_empty()) {
                    let lows = piece.iter().map(|mark| limits(mark)[0]);
                    let highs = piece.iter().rev().map(|mark| limits(mark)[1]);
                    self.fill(&lows.chain(highs).collect::<Vec<_>>(), ink, 0.16);
                }
                let width = match marks.len() {
                    ..=FEW_POINTS if dash == Dash::Short => 0.9,
                    ..=FEW_POINTS => 1.4,
                    _ => 0.65,
                };
                self.path(&places, ink, width, dash);
            }
            MarkStyle::Estimates => {
                let most = marks.iter().map(|mark| mark.n).fold(1.0, f64::max);
                for (mark, at) in marks.iter().zip(places) {
                    let [low, high] = limits(mark);
                    self.interval(low, high, ink);
                    let radius = if mark.n.is_nan() { 2.3 } else { 0.9 + 2.3 * (mark.n / most).sqrt() };
                    self.dots(&[at], radius, ink, 1.0);
                }
            }
        }
    }
}
