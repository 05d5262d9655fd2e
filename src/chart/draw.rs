//! Drawing of figures: as SVG files in points of 1/72 inch and as PNG of them; as SVG in a page.

use std::collections::HashSet;
use std::fmt::Write;
use std::slice;

use super::axis::Ruler;
use super::figure::{Dash, Figure, Frame, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel};
use super::pen::{LETTERS, Pen, Point, SMALL, course, round};
use super::text::{escape, html, literal, words};
use crate::table::provenance::CREATED_BY;

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
/// Height of a row with a name, and the most room for names.
const ROW: f64 = 13.0;
const NAMES: f64 = 190.0;
/// Height of a line of the legend, length of its marks, and room between its entries.
const LEGEND: f64 = 12.0;
const MARK: f64 = 14.0;
const BETWEEN: f64 = 12.0;
/// Number of points below which they are drawn larger and darker, and above which a line is thin.
const FEW_POINTS: usize = 400;

/// The fonts of a file: the first that its reader has.
const FONTS: &str = "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif";

/// Writes a figure as an SVG file on white.
pub fn svg(figure: &Figure) -> String {
    let (body, height) = drawn(figure, FILE_WIDTH, Ink::in_file);
    let width = FILE_WIDTH;
    let captions = figure.panels.iter().map(|panel| words(&panel.caption));
    let caption: Vec<String> =
        std::iter::once(words(&figure.caption)).chain(captions).filter(|text| !text.is_empty()).collect();
    let (title, caption) = (escape(&words(&figure.title)), escape(&caption.join(" ")));
    let size = format!("width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\"");
    let meta = format!("xmlns=\"http://www.w3.org/1999/xhtml\" name=\"generator\" content=\"{CREATED_BY}\"");
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
    let (mut pen, mut shared, mut panels) = (Pen::new(Ink::in_page), String::new(), String::new());
    // A legend that all panels share stands above them.
    let is_shared = figure.panels.windows(2).all(|pair| labels(&pair[0]) == labels(&pair[1]));
    let is_shared = is_shared && figure.panels.len() > 1;
    let above = if is_shared { pen.legend(legend(&figure.panels), PAGE_WIDTH) } else { 0.0 };
    if above > 0.0 {
        let (view, body) = (format!("0 0 {PAGE_WIDTH} {above}"), &pen.text);
        shared = format!("<svg class=\"legend\" viewBox=\"{view}\" role=\"group\">\n{body}</svg>\n");
    }
    for panel in &figure.panels {
        let name = if panel.title.is_empty() { &figure.title } else { &panel.title };
        let (name, caption) = (escape(&words(name)), html(&panel.caption));
        let mut panel = panel.clone();
        panel.layers.iter_mut().filter(|_| is_shared).for_each(|layer| layer.label.clear());
        let alone = Figure { columns: 1, height, panels: vec![panel], ..Figure::default() };
        let (body, height) = drawn(&alone, PAGE_WIDTH, Ink::in_page);
        panels += &format!(
            "<figure>\n<svg viewBox=\"0 0 {PAGE_WIDTH} {height}\" role=\"img\" aria-label=\"{name}\">\n\
             {body}</svg>\n<figcaption>{caption}</figcaption></figure>\n"
        );
    }
    let class = if figure.panels.len() == 4 { "panels four" } else { "panels" };
    format!("{shared}<div class=\"{class}\">\n{panels}</div>\n")
}

/// Dots per inch of PNG files.
pub const DPI: f32 = 300.0;

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

/// A PNG with our name behind its head: a chunk of its length, its kind, its words and their sum.
fn named(png: &[u8]) -> Vec<u8> {
    const HEAD: usize = 33;
    let content = [b"tEXtSoftware\0", CREATED_BY.as_bytes()].concat();
    let mut sum = flate2::Crc::new();
    sum.update(&content);
    let [length, sum] = [content.len() as u32 - 4, sum.sum()].map(u32::to_be_bytes);
    [&png[..HEAD], &length, &content, &sum, &png[HEAD..]].concat()
}

/// Draws all panels in rows below one legend, so wide; returns the height too.
fn drawn(figure: &Figure, width: f64, colour: fn(Ink) -> &'static str) -> (String, f64) {
    let mut pen = Pen::new(colour);
    let across = width / figure.columns.max(1) as f64;
    let mut top = pen.legend(legend(&figure.panels), width);
    for row in figure.panels.chunks(figure.columns.max(1)) {
        let rooms: Vec<Rooms> = row.iter().map(|panel| Rooms::new(panel, figure, across)).collect();
        let above = rooms.iter().map(|rooms| rooms.above).fold(0.0, f64::max);
        for (column, (panel, rooms)) in row.iter().zip(&rooms).enumerate() {
            let area = Area {
                left: column as f64 * across + rooms.left,
                top: top + above,
                width: across - rooms.left - rooms.right,
                height: rooms.height,
            };
            pen.panel(panel, area, above);
        }
        top += above + rooms.iter().map(|rooms| rooms.height).fold(0.0, f64::max);
        top += rooms.iter().map(|rooms| rooms.below).fold(0.0, f64::max);
    }
    (pen.text, round(top.max(1.0)))
}

/// The area of the data of a panel.
#[derive(Debug, Clone, Copy)]
struct Area {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

/// The height of the area of the data of a panel, and the room around it.
struct Rooms {
    left: f64,
    right: f64,
    above: f64,
    below: f64,
    height: f64,
}

impl Rooms {
    fn new(panel: &Panel, figure: &Figure, across: f64) -> Rooms {
        let is_to_scale = panel.frame == Frame::ToScale;
        let has_words_above = panel.words.iter().any(|words| words.position == LabelPosition::Above);
        let title = TITLE * f64::from(!panel.title.is_empty());
        let labels = LABEL * f64::from(!panel.y.label.is_empty()) + LABEL * f64::from(has_words_above);
        let mut rooms = Rooms {
            left: if is_to_scale { 4.0 } else { LEFT },
            right: RIGHT,
            above: GAP + title + labels,
            below: if is_to_scale || panel.x.label.is_empty() { GAP } else { BELOW },
            height: figure.height,
        };
        if !panel.names().is_empty() {
            rooms.height = ROW * panel.names().len() as f64;
            // The names and words of rows have the same room in all panels over the same axis.
            for peer in figure.panels.iter().filter(|peer| !peer.names().is_empty() && peer.x == panel.x) {
                let words = peer.words.iter().filter(|words| words.position == LabelPosition::Margin);
                rooms.right = words.map(|words| room(&words.text)).fold(rooms.right, f64::max);
                rooms.left = peer.names().iter().map(|name| room(name)).fold(rooms.left, f64::max);
            }
            rooms.left = rooms.left.min(NAMES.min(0.46 * across));
        }
        rooms
    }
}

/// Estimates the width of marked text: the letters of its reader are not known.
fn width(marked: &str, size: f64) -> f64 {
    words(marked).chars().count() as f64 * size * LETTER_WIDTH
}

/// The room for a name or words beside a row.
fn room(marked: &str) -> f64 {
    width(marked, SMALL) + 8.0
}

/// Cuts a name to the room for names.
fn shortened(name: &str, room: f64, size: f64) -> String {
    let name = words(name);
    let most = (room / (size * LETTER_WIDTH)) as usize;
    match name.char_indices().nth(most) {
        Some(_) => format!("{}\u{2026}", name.chars().take(most.saturating_sub(1)).collect::<String>()),
        None => name,
    }
}

/// One layer of each name, in the order in which they come.
fn legend(panels: &[Panel]) -> impl Iterator<Item = &Layer> {
    let mut known = HashSet::new();
    let layers = panels.iter().flat_map(|panel| &panel.layers);
    layers.filter(move |layer| !layer.label.is_empty() && known.insert(&layer.label))
}

fn labels(panel: &Panel) -> Vec<&str> {
    legend(slice::from_ref(panel)).map(|layer| layer.label.as_str()).collect()
}

impl Pen {
    /// Draws the legend in lines; returns where the first row of panels begins.
    fn legend<'a>(&mut self, entries: impl Iterator<Item = &'a Layer>, across: f64) -> f64 {
        let left = 4.0;
        let (mut x, mut y) = (left, 11.0);
        for layer in entries {
            let long = MARK + 3.0 + width(&layer.label, LETTERS);
            if x > left && x + long > across {
                (x, y) = (left, y + LEGEND);
            }
            self.legend_mark(layer, Point::new(x, y - 2.6));
            self.label(Point::new(x + MARK + 3.0, y), LETTERS, "", Ink::Text, &layer.label);
            x += long + BETWEEN;
        }
        if x > left { y + 5.0 } else { 0.0 }
    }

    /// The mark of a layer in the legend, from this place to the right.
    fn legend_mark(&mut self, layer: &Layer, from: Point) {
        let (colour, y) = ((self.colour)(layer.ink), from.y);
        let [middle, end] = [0.5, 1.0].map(|part| Point::new(from.x + part * MARK, y));
        match layer.style {
            MarkStyle::Points => self.dots(&[middle], 2.0, colour, 1.0),
            MarkStyle::Line(dash) => self.path(&[from, end], colour, 1.3, dash),
            MarkStyle::Estimates => {
                self.interval(Point::new(from.x + 1.0, y), Point::new(end.x - 1.0, y), colour);
                self.dots(&[middle], 2.2, colour, 1.0);
            }
        }
    }

    /// Draws a panel with its title and label of y in the room `above` the area of its data.
    fn panel(&mut self, panel: &Panel, area: Area, above: f64) {
        let Area { left, top, width, height } = area;
        let [mut x, mut y] = panel.rulers();
        if panel.frame == Frame::ToScale {
            let longest = (x.length() / width).max(y.length() / height);
            (x, y) = (x.over_length(longest * width), y.over_length(longest * height));
        }
        let transform = PanelTransform { x, y, area };
        if panel.frame == Frame::Axes {
            self.axes(panel, &transform);
        }
        // What lies beyond the axes is cut off by the inner picture; words may stand over its edge.
        let [x, y, wide, high] = [left, top, width, height].map(round);
        let _ = writeln!(
            self.text,
            "<svg x=\"{x}\" y=\"{y}\" width=\"{wide}\" height=\"{high}\" viewBox=\"{x} {y} {wide} {high}\">"
        );
        for layer in &panel.layers {
            self.marks(layer, !panel.names().is_empty(), &transform);
        }
        self.text.push_str("</svg>\n");
        for words in &panel.words {
            let at = transform.at(words.x, words.y);
            let x = if words.position == LabelPosition::Margin { left + width } else { at.x };
            self.beside(Point { x, ..at }, words);
        }
        // Titles stand over the ticks, not over the names of rows.
        let room = if panel.names().is_empty() { LEFT } else { NAMES };
        let edge = (left - room).max(0.0) + 2.0;
        let first = Point::new(edge, top - above + 9.0);
        self.label(first, LETTERS, " font-weight=\"600\"", Ink::Text, &panel.title);
        self.label(Point::new(edge, top - GAP), SMALL, "", Ink::Muted, &panel.y.label);
    }

    /// The axes; faint lines stand at labelled ticks of y, or along rows.
    fn axes(&mut self, panel: &Panel, transform: &PanelTransform) {
        let Area { left, top, width, height } = transform.area;
        let (bottom, right, middle) = (top + height, left + width, " text-anchor=\"middle\"");
        let (room, mut lines) = (left - 4.0, String::new());
        for tick in transform.y.ticks(((height / 18.0) as usize).max(5)) {
            let Some(words) = tick.label else { continue };
            let at = transform.down(tick.value);
            lines += &course(&[Point::new(left, at), Point::new(right, at)]);
            let (ink, words) = match panel.names() {
                [] => (Ink::Muted, words),
                _ => (Ink::Text, literal(&shortened(&words, room, SMALL))),
            };
            self.label(Point::new(room, at + 0.35 * SMALL), SMALL, " text-anchor=\"end\"", ink, &words);
        }
        self.stroke(&lines, (self.colour)(Ink::Rule), 0.45, "");
        let mut axis = course(&[Point::new(left, bottom), Point::new(right, bottom)]);
        for tick in transform.x.ticks((width / 28.0) as usize) {
            let at = transform.across(tick.value);
            let length = if tick.label.is_some() { 3.0 } else { 1.6 };
            axis += &course(&[Point::new(at, bottom), Point::new(at, bottom + length)]);
            if let Some(words) = tick.label.filter(|_| !panel.x.label.is_empty()) {
                self.label(Point::new(at, bottom + 10.5), SMALL, middle, Ink::Muted, &words);
            }
        }
        self.stroke(&axis, (self.colour)(Ink::Muted), 0.6, "");
        let label = Point::new(left + 0.5 * width, bottom + 21.0);
        self.label(label, SMALL, middle, Ink::Muted, &panel.x.label);
    }

    /// Draws the marks of a layer, each value at its place.
    fn marks(&mut self, layer: &Layer, has_rows: bool, transform: &PanelTransform) {
        let (colour, marks) = ((self.colour)(layer.ink), &layer.marks);
        let places: Vec<Point> = marks.iter().map(|mark| transform.at(mark.x, mark.y)).collect();
        match layer.style {
            MarkStyle::Points => {
                let (radius, opacity) = match marks.len() {
                    ..6 => (2.2, 1.0),
                    6..FEW_POINTS => (1.3, 0.85),
                    _ => (0.8, 0.5),
                };
                self.dots(&places, radius, colour, opacity);
            }
            MarkStyle::Line(dash) => {
                let has_band = |mark: &Mark| mark.is_finite() && mark.low.is_finite();
                for piece in marks.split(|mark| !has_band(mark)).filter(|piece| !piece.is_empty()) {
                    let lows = piece.iter().map(|mark| transform.at(mark.x, mark.low));
                    let highs = piece.iter().rev().map(|mark| transform.at(mark.x, mark.high));
                    self.fill(&lows.chain(highs).collect::<Vec<_>>(), colour, 0.16);
                }
                let stroke = match marks.len() {
                    ..=FEW_POINTS if dash == Dash::Short => 0.9,
                    ..=FEW_POINTS => 1.4,
                    _ => 0.65,
                };
                self.path(&places, colour, stroke, dash);
            }
            MarkStyle::Estimates => {
                let most = marks.iter().map(|mark| mark.n).fold(1.0, f64::max);
                for (mark, at) in marks.iter().zip(places) {
                    let [low, high] = [mark.low, mark.high].map(|limit| match has_rows {
                        true => transform.at(limit, mark.y),
                        false => transform.at(mark.x, limit),
                    });
                    self.interval(low, high, colour);
                    let radius = if mark.n.is_nan() { 2.3 } else { 0.9 + 2.3 * (mark.n / most).sqrt() };
                    self.dots(&[at], radius, colour, 1.0);
                }
            }
        }
    }
}

/// Where values stand in a picture.
struct PanelTransform<'a> {
    x: Ruler<'a>,
    y: Ruler<'a>,
    area: Area,
}

impl PanelTransform<'_> {
    fn across(&self, x: f64) -> f64 {
        self.area.left + self.area.width * self.x.fraction(x)
    }

    fn down(&self, y: f64) -> f64 {
        self.area.top + self.area.height * (1.0 - self.y.fraction(y))
    }

    fn at(&self, x: f64, y: f64) -> Point {
        Point::new(self.across(x), self.down(y))
    }
}
