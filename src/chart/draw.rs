//! Drawing of figures: as SVG files in points of 1/72 inch and as PNG of them; as SVG in a page.

use std::collections::HashSet;
use std::slice;

use anyhow::Context;

use super::axis::Ruler;
use super::figure::{Dash, Figure, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Scale, Symbol};
use super::picture::{LETTER_WIDTH, LETTERS, Picture, Point, SMALL, course, round, width};
use super::text::{escape, html, literal, words};
use crate::number;
use crate::table::provenance::CREATED_BY;

/// Width of a file, points: across two columns of a journal, 180 mm.
const FILE_WIDTH: f64 = 510.2;
/// Width of a panel on the page, which is a picture of its own, and least height of the area of its data.
const PAGE_WIDTH: f64 = 267.0;
const LEAST_HEIGHT: f64 = 60.0;

/// Room around the area of the data of a panel: at the left for ticks, at the right, above for title and
/// label of y, below for ticks and label of x.
const LEFT: f64 = 30.0;
const RIGHT: f64 = 12.0;
const TITLE: f64 = 12.0;
const LABEL: f64 = 10.0;
const GAP: f64 = 6.0;
const BELOW: f64 = 26.0;
/// Height of a row with a name, and the most share of the width for names.
const ROW: f64 = 13.0;
const NAMES: f64 = 0.55;
/// Height of a line of the legend, length of its marks, and room before it and between its entries.
const LEGEND: f64 = 12.0;
const MARK: f64 = 14.0;
const BEFORE: f64 = 4.0;
const BETWEEN: f64 = 12.0;
/// Number of points above which lines are thin and symbols small.
const FEW_POINTS: usize = 400;
/// Room that several values of a row of names take, rows.
const SPREAD: f64 = 0.64;

/// The fonts of a file: the first that its reader has.
const FONTS: &str = "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif";
pub const DPI: f32 = 300.0;

/// Writes a figure as an SVG file on white.
pub fn svg(figure: &Figure) -> String {
    let mut picture = Picture::new(FILE_WIDTH, Ink::in_file);
    picture.legend(&figure.panels);
    let (columns, mut panels) = (figure.columns.max(1), figure.panels.clone());
    let mut captions = vec![figure.caption.clone()];
    let has_letters = panels.len() > 1;
    for (panel, letter) in panels.iter_mut().zip('a'..='z') {
        let letter = if has_letters { format!("({letter}) ") } else { String::new() };
        captions.extend((!panel.caption.is_empty()).then(|| format!("{letter}{}", panel.caption)));
        panel.title.insert_str(0, &letter);
    }
    let rows = panels.chunks(columns);
    rows.for_each(|row| picture.row(row, figure.height, FILE_WIDTH / columns as f64));
    let height = round(picture.height.max(1.0));
    picture.height = height;
    let [title, caption] = [&figure.title, captions.join(" ").trim()].map(|text| escape(&words(text)));
    let size = format!("width=\"{FILE_WIDTH}pt\" height=\"{height}pt\"");
    let attributes = format!("xmlns=\"http://www.w3.org/2000/svg\" {size} font-family=\"{FONTS}\"");
    let meta = format!("xmlns=\"http://www.w3.org/1999/xhtml\" name=\"generator\" content=\"{CREATED_BY}\"");
    let head = format!(
        "<metadata><meta {meta}/></metadata>\n<title>{title}</title>\n<desc>{caption}</desc>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    picture.svg(&attributes, &head)
}

/// The panels of a figure for a page, each a picture of its own, beside each other where there is room.
pub fn html_of_panels(figure: &Figure) -> String {
    // As high over its width as in the file.
    let across = PAGE_WIDTH * figure.columns.max(1) as f64 / FILE_WIDTH;
    let height = (figure.height * across).max(LEAST_HEIGHT);
    // A legend that all panels share stands above them.
    let names = |panel| listed(slice::from_ref(panel)).map(|layer| &layer.name).collect::<Vec<_>>();
    let is_shared = figure.panels.windows(2).all(|pair| names(&pair[0]) == names(&pair[1]));
    let is_shared = is_shared && figure.panels.len() > 1;
    let mut above = Picture::new(PAGE_WIDTH, Ink::in_page);
    above.legend(if is_shared { &figure.panels } else { &[] });
    let above = above.svg("class=\"legend\" role=\"group\"", "");
    let class = if figure.panels.len() == 4 { "panels four" } else { "panels" };
    let mut text = format!("{above}<div class=\"{class}\">\n");
    for panel in &figure.panels {
        let name = if panel.title.is_empty() { &figure.title } else { &panel.title };
        let (name, caption) = (escape(&words(name)), html(&panel.caption));
        let (mut picture, alone) = (Picture::new(PAGE_WIDTH, Ink::in_page), slice::from_ref(panel));
        picture.legend(if is_shared { &[] } else { alone });
        picture.row(alone, height, PAGE_WIDTH);
        let svg = picture.svg(&format!("role=\"img\" aria-label=\"{name}\""), "");
        text += &format!("<figure>\n{svg}<figcaption>{caption}</figcaption></figure>\n");
    }
    text + "</div>\n"
}

/// Draws an SVG file as PNG with so many dots per inch.
pub fn png(svg: &str, dpi: f32) -> anyhow::Result<Vec<u8>> {
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
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).context("a picture without size")?;
    resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixels.as_mut());
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size.width(), size.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.add_text_chunk("Software".to_string(), CREATED_BY.to_string())?;
    encoder.write_header()?.write_image_data(&pixels.take_demultiplied())?;
    Ok(file)
}

/// The layers of the legend, in the order in which they come.
fn listed(panels: &[Panel]) -> impl Iterator<Item = &Layer> {
    let mut known = HashSet::new();
    let layers = panels.iter().flat_map(|panel| &panel.layers);
    layers.filter(move |layer| layer.is_listed && known.insert(&layer.name))
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
        if self.x.label.is_empty() { GAP } else { BELOW }
    }

    /// The height of the area of its data, where that of others is given.
    fn height(&self, of_others: f64) -> f64 {
        if self.names().is_empty() { of_others } else { ROW * self.names().len() as f64 }
    }

    /// The room at the left for ticks or names, and at the right for words in the margin.
    fn sides(&self, across: f64) -> [f64; 2] {
        // Other fonts are wider.
        let room = |marked: &String| 1.1 * width(marked, SMALL) + 8.0;
        let left = self.names().iter().map(room).fold(LEFT, f64::max).min(NAMES * across);
        let words = self.words.iter().filter(|words| words.position == LabelPosition::Margin);
        let right = words.map(|words| room(&words.text)).fold(RIGHT, f64::max);
        [if self.is_to_scale { 4.0 } else { left }, right]
    }
}

impl Picture {
    fn legend(&mut self, panels: &[Panel]) {
        let (mut x, mut y) = (BEFORE, self.height + 11.0);
        for Layer { name, ink, style, marks, .. } in listed(panels) {
            let limits = f64::from(marks.iter().any(|mark| mark.low.is_finite()));
            let long = MARK + 3.0 + width(name, LETTERS);
            if x > BEFORE && x + long > self.width {
                (x, y) = (BEFORE, y + LEGEND);
            }
            let along = |part: f64| Point::new(x + part * MARK, y - 2.6);
            match *style {
                MarkStyle::Points(symbol) => self.symbols(&[along(0.5)], symbol, 2.0, *ink, 1.0),
                MarkStyle::Line(dash) => {
                    let ends = [0.0, 1.0].map(along);
                    self.stroke(&course(&ends), *ink, 6.0 * limits, " stroke-opacity=\"0.16\"");
                    self.path(&ends, *ink, 1.3, dash);
                }
                MarkStyle::Estimates => {
                    self.estimate(along(0.5), [0.5 - 0.43 * limits, 0.5 + 0.43 * limits].map(along), *ink);
                }
            }
            self.write([x + MARK + 3.0, y], LabelPosition::Legend, Ink::Text, name);
            x += long + BETWEEN;
            self.height = y + 5.0;
        }
    }

    /// Draws panels beside each other, each so wide.
    fn row(&mut self, panels: &[Panel], height: f64, across: f64) {
        let most = |room: &dyn Fn(&Panel) -> f64| panels.iter().map(room).fold(0.0, f64::max);
        let top = self.height;
        let data = top + most(&Panel::above);
        for (column, panel) in panels.iter().enumerate() {
            let (edge, [left, right]) = (column as f64 * across, panel.sides(across));
            let [x, y] =
                panel.rulers([edge + left, edge + across - right], [data + panel.height(height), data]);
            self.write([edge + 2.0, top + 9.0], LabelPosition::Title, Ink::Text, &panel.title);
            self.write([edge + 2.0, data - GAP], LabelPosition::YLabel, Ink::Muted, &panel.y.label);
            self.panel(panel, &x, &y);
        }
        self.height = data + most(&|panel| panel.height(height)) + most(&Panel::below);
    }

    fn panel(&mut self, panel: &Panel, x: &Ruler, y: &Ruler) {
        if !panel.is_to_scale {
            self.axes(panel, x, y);
        }
        // What lies beyond the axes is cut off by the inner picture; words may stand over its edge.
        let [left, top, width, height] = [x.from, y.to, x.to - x.from, y.from - y.to].map(round);
        let area = format!("{left} {top} {width} {height}");
        self.shapes += &format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" viewBox=\"{area}\">\n"
        );
        // Where rows have several values, these stand below each other, in the order of their layers.
        let estimates = || panel.drawn().filter(|layer| layer.style == MarkStyle::Estimates);
        let (rows, layers) = (panel.names().len(), estimates().count());
        let is_crowded = rows > 0 && estimates().map(|layer| layer.marks.len()).sum::<usize>() > rows;
        let apart = if is_crowded { SPREAD / layers as f64 } else { 0.0 };
        let mut down = 0.5 * apart * (1.0 - layers as f64);
        for layer in panel.drawn() {
            self.marks(layer, down, [x, y]);
            down += apart * f64::from(layer.style == MarkStyle::Estimates);
        }
        self.shapes += "</svg>\n";
        for words in &panel.words {
            let across = if words.position == LabelPosition::Margin { x.to } else { x.at(words.x) };
            self.write([across, y.at(words.y)], words.position, words.ink, &words.text);
        }
    }

    /// The axes; faint lines stand at labelled ticks of y, or along rows.
    fn axes(&mut self, panel: &Panel, x: &Ruler, y: &Ruler) {
        let mut lines = String::new();
        let letters = ((x.from - 4.0) / (SMALL * LETTER_WIDTH)) as usize;
        let ticks = y.ticks((((y.from - y.to) / 18.0) as usize).max(5));
        for (value, label) in ticks.into_iter().filter(|(_, label)| !label.is_empty()) {
            let at = y.at(value);
            lines += &course(&[Point::new(x.from, at), Point::new(x.to, at)]);
            let (ink, label) = match panel.names() {
                [] => (Ink::Muted, label),
                _ => (Ink::Text, literal(&number::shown(&words(&label), letters))),
            };
            self.write([x.from, at], LabelPosition::Left, ink, &label);
        }
        self.stroke(&lines, Ink::Rule, 0.45, "");
        let bottom = y.from;
        let mut axis = course(&[Point::new(x.from, bottom), Point::new(x.to, bottom)]);
        for (value, label) in x.ticks(((x.to - x.from) / 28.0) as usize) {
            let (at, length) = (x.at(value), if label.is_empty() { 1.6 } else { 3.0 });
            axis += &course(&[Point::new(at, bottom), Point::new(at, bottom + length)]);
            if !panel.x.label.is_empty() {
                self.write([at, bottom], LabelPosition::Below, Ink::Muted, &label);
            }
        }
        self.stroke(&axis, Ink::Muted, 0.6, "");
        let middle = 0.5 * (x.from + x.to);
        self.write([middle, bottom + 10.5], LabelPosition::Below, Ink::Muted, &panel.x.label);
    }

    /// Draws the marks of a layer, each value at its place or so much further down.
    fn marks(&mut self, layer: &Layer, down: f64, [x, y]: [&Ruler; 2]) {
        let (ink, marks) = (layer.ink, &layer.marks);
        let place = |[across, up]: [f64; 2]| Point::new(x.at(across), y.at(up + down));
        let places: Vec<Point> = marks.iter().map(|mark| place([mark.x, mark.y])).collect();
        let limits = |mark: &Mark| match y.scale {
            Scale::Names(_) => [mark.low, mark.high].map(|limit| place([limit, mark.y])),
            _ => [mark.low, mark.high].map(|limit| place([mark.x, limit])),
        };
        match layer.style {
            MarkStyle::Points(symbol) => {
                let (radius, opacity) = match symbol {
                    Symbol::Disc => (1.5, 0.9),
                    Symbol::Dot => (0.9, 0.55),
                    Symbol::Circle | Symbol::Cross => (1.1, 0.7),
                };
                let part = if marks.len() > FEW_POINTS { 0.7 } else { 1.0 };
                self.symbols(&places, symbol, part * radius, ink, opacity);
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
                marks.iter().zip(places).for_each(|(mark, at)| self.estimate(at, limits(mark), ink));
            }
        }
    }
}
