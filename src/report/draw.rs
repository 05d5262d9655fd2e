//! Drawing of figures: as SVG files in points of 1/72 inch and as PNG of them; as SVG in a page.

use std::fmt::Write;

use super::axis::{Ruler, Tick};
use super::figure::{Dash, Figure, Frame, Ink, Layer, Marks, Panel, Side, Words};
use super::pen::{LETTERS, Pen, SMALL, course, round};
use super::text::{escape, html, words};

/// How wide a picture is drawn, and the height of its letters over that of a file, which is 8 points.
#[derive(Debug, Clone, Copy)]
struct Look {
    width: f64,
    unit: f64,
}

/// A file: across two columns of a journal, 180 mm.
const FILE: Look = Look { width: 510.2, unit: 1.0 };
/// A panel on the page, in pixels of a small screen; and one that is wide where the screen is.
const NARROW: Look = Look { width: 360.0, unit: 1.35 };
const WIDE: Look = Look { width: 800.0, unit: 1.4 };
/// Least height of the area of the data of a panel on the page, in the letters' unit.
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

/// Writes a figure as an SVG file on white, with the key of what made it.
pub fn svg(figure: &Figure, key: &str) -> String {
    let (body, height) = whole(figure);
    let width = FILE.width;
    let captions = figure.panels.iter().map(|panel| words(&panel.caption));
    let caption: Vec<String> =
        std::iter::once(words(&figure.caption)).chain(captions).filter(|text| !text.is_empty()).collect();
    let (title, caption) = (escape(&words(&figure.title)), escape(&caption.join(" ")));
    let size = format!("width=\"{width}pt\" height=\"{height}pt\" viewBox=\"0 0 {width} {height}\"");
    let meta = format!(
        "<meta xmlns=\"http://www.w3.org/1999/xhtml\" name=\"rockfrag\" content=\"{}\"/>",
        escape(key)
    );
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" {size} font-family=\"{FONTS}\">\n\
         <metadata>{meta}</metadata>\n<title>{title}</title>\n<desc>{caption}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Writes the panels of a figure for a page that has the fonts and the colours: each a picture of its own,
/// below a legend, so that they stand beside each other where there is room.
pub fn html_of_panels(figure: &Figure) -> String {
    let entries = legend_entries(figure);
    let entry = |layer: &&Layer| {
        let mut pen = Pen { unit: 1.0, text: String::new() };
        pen.legend_mark(layer, [0.0, 5.0]);
        let (mark, label) = (pen.text, html(&layer.label));
        format!("<span><svg viewBox=\"0 0 {MARK} 10\" aria-hidden=\"true\">{mark}</svg>{label}</span>\n")
    };
    let legend = match &entries[..] {
        [] => String::new(),
        _ => format!("<div class=\"legend\">\n{}</div>\n", entries.iter().map(entry).collect::<String>()),
    };
    // A legend that is of one panel alone stands below it.
    let mut labelled =
        figure.panels.iter().filter(|panel| panel.layers.iter().any(|layer| !layer.label.is_empty()));
    let owner = labelled.next().filter(|_| labelled.next().is_none() && figure.panels.len() > 1);
    let is_wide = figure.columns == 1 && figure.panels.iter().all(|panel| panel.names().is_empty());
    let panel = |panel: &Panel| {
        let name = if panel.title.is_empty() { &figure.title } else { &panel.title };
        let caption = match panel.caption.as_str() {
            "" => String::new(),
            words => format!("<figcaption>{}</figcaption>\n", html(words)),
        };
        let small = svg_of_panel(panel, name, figure, NARROW, if is_wide { "small" } else { "" });
        let wide = match is_wide {
            true => svg_of_panel(panel, name, figure, WIDE, "wide"),
            false => String::new(),
        };
        let legend = if owner.is_some_and(|owner| std::ptr::eq(owner, panel)) { legend.as_str() } else { "" };
        format!("<figure>\n{wide}{small}{legend}{caption}</figure>\n")
    };
    let above = if owner.is_some() { "" } else { legend.as_str() };
    let class = match figure.panels.len() {
        _ if is_wide => "panels long",
        4 => "panels four",
        _ => "panels",
    };
    let panels: String = figure.panels.iter().map(panel).collect();
    Ink::of_page(format!("{above}<div class=\"{class}\">\n{panels}</div>\n"))
}

fn svg_of_panel(panel: &Panel, name: &str, figure: &Figure, look: Look, class: &str) -> String {
    let unit = look.unit;
    let mut pen = Pen { text: String::new(), unit };
    // As high over its width as in the file.
    let across = look.width / unit * figure.columns.max(1) as f64 / FILE.width;
    let height = match panel.names().len() {
        0 => (figure.height * across.min(1.6)).max(LEAST_HEIGHT) * unit,
        rows => ROW * unit * rows as f64,
    };
    let left = names_room(panel, look.width, unit);
    let top = head(panel) * unit;
    let area = [left, top, look.width - left - RIGHT * unit, height];
    pen.panel(panel, area, top);
    let bottom = round(top + height + foot(panel) * unit);
    let (width, name) = (look.width, escape(&words(name)));
    format!(
        "<svg class=\"{class}\" viewBox=\"0 0 {width} {bottom}\" role=\"img\" aria-label=\"{name}\">\n{}</svg>\n",
        pen.text
    )
}

/// Dots per inch of PNG files.
pub const DPI: f32 = 300.0;

/// Draws an SVG file as PNG with so many dots per inch, with the key of what made it.
pub fn png(svg: &str, dpi: f32, key: &str) -> Result<Vec<u8>, resvg::usvg::Error> {
    use resvg::{tiny_skia, usvg};
    let mut options = usvg::Options { dpi, font_family: "Fira Sans".to_string(), ..usvg::Options::default() };
    let faces: [&[u8]; 3] = [
        include_bytes!("assets/fonts/FiraSans-Regular.ttf"),
        include_bytes!("assets/fonts/FiraSans-Italic.ttf"),
        include_bytes!("assets/fonts/FiraSans-SemiBold.ttf"),
    ];
    faces.iter().for_each(|face| options.fontdb_mut().load_font_data(face.to_vec()));
    let tree = usvg::Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size();
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).ok_or(usvg::Error::InvalidSize)?;
    resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixels.as_mut());
    let drawn = pixels.encode_png().map_err(|_| usvg::Error::InvalidSize)?;
    Ok(with_text(&drawn, key))
}

/// A PNG with a text, called rockfrag, behind its head: a chunk of its length, its kind, its words and their
/// sum.
fn with_text(png: &[u8], text: &str) -> Vec<u8> {
    const HEAD: usize = 33;
    let content = [b"iTXtrockfrag\0\0\0\0\0", text.as_bytes()].concat();
    let mut sum = flate2::Crc::new();
    sum.update(&content);
    let [length, sum] = [content.len() as u32 - 4, sum.sum()].map(u32::to_be_bytes);
    [&png[..HEAD], &length, &content, &sum, &png[HEAD..]].concat()
}

/// The area of the data of a panel: left, top, width and height.
type Area = [f64; 4];

/// Draws all panels in rows below one legend, as a file has them; returns the height too.
fn whole(figure: &Figure) -> (String, f64) {
    let mut pen = Pen { text: String::new(), unit: FILE.unit };
    let columns = figure.columns.max(1);
    let across = FILE.width / columns as f64;
    let mut top = pen.legend(&legend_entries(figure), 4.0, FILE.width);
    for row in figure.panels.chunks(columns) {
        let height = |panel: &Panel| match panel.names().len() {
            0 => figure.height,
            rows => ROW * rows as f64,
        };
        let height = row.iter().map(height).fold(0.0, f64::max);
        let above = row.iter().map(head).fold(0.0, f64::max);
        // Panels below each other have the same room for names.
        let names = |panel: &Panel| names_room(panel, across, 1.0);
        for (column, panel) in row.iter().enumerate() {
            let column_of_panels = figure.panels.iter().skip(column).step_by(columns);
            let left = column_of_panels.map(names).fold(0.0, f64::max);
            let own = match panel.names().len() {
                0 => height,
                rows => ROW * rows as f64,
            };
            let area = [column as f64 * across + left, top + above, across - left - RIGHT, own];
            pen.panel(panel, area, above);
        }
        top += above + height + row.iter().map(foot).fold(0.0, f64::max);
    }
    (pen.text, round(top.max(1.0)))
}

/// The room above the area of the data.
fn head(panel: &Panel) -> f64 {
    let line = |text: &str, height: f64| if text.is_empty() { 0.0 } else { height };
    let is_above = |words: &Words| words.side == Side::Above;
    let has_words = panel.layers.iter().any(|layer| match &layer.marks {
        Marks::Words(words) => words.iter().any(is_above),
        _ => false,
    });
    GAP + line(&panel.title, TITLE) + line(&panel.y.label, LABEL) + if has_words { LABEL } else { 0.0 }
}

/// The room below it.
fn foot(panel: &Panel) -> f64 {
    match panel.frame {
        Frame::ToScale => GAP,
        Frame::Axes if panel.x.label.is_empty() => GAP,
        Frame::Axes => BELOW,
    }
}

/// The room to the left of a panel, for its names if it has any.
fn names_room(panel: &Panel, across: f64, unit: f64) -> f64 {
    if panel.frame == Frame::ToScale {
        return 4.0 * unit;
    }
    let widest = panel.names().iter().map(|name| width(name, SMALL * unit)).fold(0.0, f64::max);
    (widest + 8.0 * unit).clamp(LEFT * unit, (NAMES * unit).min(0.46 * across).max(LEFT * unit))
}

/// Estimates the width of marked text: the letters of its reader are not known.
fn width(marked: &str, size: f64) -> f64 {
    words(marked).chars().count() as f64 * size * LETTER_WIDTH
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
fn legend_entries(figure: &Figure) -> Vec<&Layer> {
    let mut entries: Vec<&Layer> = Vec::new();
    for layer in figure.panels.iter().flat_map(|panel| &panel.layers) {
        if !layer.label.is_empty() && entries.iter().all(|entry| entry.label != layer.label) {
            entries.push(layer);
        }
    }
    entries
}

impl Pen {
    /// Draws the legend in lines; returns where the first row of panels begins.
    fn legend(&mut self, entries: &[&Layer], left: f64, across: f64) -> f64 {
        let (mut x, mut y) = (left, 11.0);
        for layer in entries {
            let long = MARK + 3.0 + width(&layer.label, LETTERS);
            if x > left && x + long > across {
                (x, y) = (left, y + LEGEND);
            }
            self.legend_mark(layer, [x, y - 2.6]);
            self.label([x + MARK + 3.0, y], LETTERS, "", Ink::Text, &layer.label);
            x += long + BETWEEN;
        }
        if entries.is_empty() { 0.0 } else { y + 5.0 }
    }

    /// The mark of a layer in the legend, from this place to the right.
    fn legend_mark(&mut self, layer: &Layer, [x, y]: [f64; 2]) {
        let colour = layer.ink.colour();
        let middle = [x + 0.5 * MARK, y];
        match &layer.marks {
            Marks::Points(_) | Marks::Words(_) => self.dots(&[middle], 2.0, colour, 1.0),
            Marks::Line { dash, .. } => self.path(&[[x, y], [x + MARK, y]], colour, 1.3, *dash),
            Marks::Area(_) => {
                let corners = [[x, y - 3.5], [x + MARK, y - 3.5], [x + MARK, y + 3.5], [x, y + 3.5]];
                self.fill(&corners, colour, 0.3);
            }
            Marks::Estimates(_) => {
                self.interval([[x + 1.0, y], [x + MARK - 1.0, y]], colour);
                self.dots(&[middle], 2.2, colour, 1.0);
            }
        }
    }

    /// Draws a panel with its title and label of y in the room `above` the area of its data.
    fn panel(&mut self, panel: &Panel, area: Area, above: f64) {
        let [left, top, width, height] = area;
        let mut rulers = panel.rulers();
        if panel.frame == Frame::ToScale {
            let [x, y] = &rulers;
            let longest = (x.length() / width).max(y.length() / height);
            rulers = [x.over_length(longest * width), y.over_length(longest * height)];
        }
        let [x, y] = &rulers;
        if panel.frame == Frame::Axes {
            self.guides(y, area);
        }
        // What lies beyond the axes is cut off by the inner picture; words may stand over its edge.
        let [x_at, y_at, wide, high] = area.map(round);
        let _ = writeln!(self.text, "<svg x=\"{x_at}\" y=\"{y_at}\" width=\"{wide}\" height=\"{high}\">");
        let place = |[x_value, y_value]: [f64; 2]| {
            [width * x.fraction(x_value), height * (1.0 - y.fraction(y_value))]
        };
        for layer in &panel.layers {
            self.marks(layer, !panel.names().is_empty(), place);
        }
        self.text.push_str("</svg>\n");
        for layer in &panel.layers {
            let Marks::Words(words) = &layer.marks else { continue };
            for one in words {
                let [x_at, y_at] = place([one.x, one.y]);
                self.beside([left + x_at, top + y_at], layer.ink, one);
            }
        }
        if panel.frame == Frame::Axes {
            self.axes(panel, [x, y], area);
        }
        let unit = self.unit;
        // Titles stand over the ticks, not over the names of rows.
        let room = if panel.names().is_empty() { LEFT } else { NAMES };
        let edge = (left - room * unit).max(0.0) + 2.0 * unit;
        let first = top - above + 9.0 * unit;
        self.label([edge, first], LETTERS, " font-weight=\"600\"", Ink::Text, &panel.title);
        self.label([edge, top - GAP * unit], SMALL, "", Ink::Muted, &panel.y.label);
    }

    /// Faint lines behind the data: at labelled ticks of y, or along rows.
    fn guides(&mut self, y: &Ruler, [left, top, width, height]: Area) {
        let at = |tick: &Tick| top + height * (1.0 - y.fraction(tick.value));
        let lines = y.ticks(self.y_ticks(height)).into_iter().filter(|tick| tick.label.is_some());
        let places: Vec<f64> = lines.map(|tick| at(&tick)).collect();
        let d: String = places.iter().map(|&at| course(&[[left, at], [left + width, at]])).collect();
        let (rule, stroke) = (Ink::Rule.colour(), round(0.45 * self.unit));
        let _ = writeln!(
            self.text,
            "<path d=\"{d}\" fill=\"none\" stroke=\"{rule}\" stroke-width=\"{stroke}\"/>"
        );
    }

    fn y_ticks(&self, height: f64) -> usize {
        ((height / (18.0 * self.unit)) as usize).max(5)
    }

    fn axes(&mut self, panel: &Panel, [x, y]: [&Ruler; 2], [left, top, width, height]: Area) {
        let unit = self.unit;
        let bottom = top + height;
        let mut lines = vec![vec![[left, bottom], [left + width, bottom]]];
        let middle = " text-anchor=\"middle\"";
        for tick in x.ticks((width / (28.0 * unit)) as usize) {
            let at = left + width * x.fraction(tick.value);
            let length = if tick.label.is_some() { 3.0 } else { 1.6 };
            lines.push(vec![[at, bottom], [at, bottom + length * unit]]);
            if let Some(words) = tick.label.filter(|_| !panel.x.label.is_empty()) {
                self.label([at, bottom + 10.5 * unit], SMALL, middle, Ink::Muted, &words);
            }
        }
        for words in y.ticks(self.y_ticks(height)) {
            let at = top + height * (1.0 - y.fraction(words.value));
            let place = [left - 4.0 * unit, at + 0.35 * SMALL * unit];
            let Some(words) = words.label else { continue };
            let (ink, words) = match panel.names() {
                [] => (Ink::Muted, words),
                _ => (Ink::Text, super::text::literal(&shortened(&words, left - 4.0 * unit, SMALL * unit))),
            };
            self.label(place, SMALL, " text-anchor=\"end\"", ink, &words);
        }
        let d: String = lines.iter().map(|line| course(line)).collect();
        let (ink, stroke) = (Ink::Muted.colour(), round(0.6 * unit));
        let _ =
            writeln!(self.text, "<path d=\"{d}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"{stroke}\"/>");
        let place = [left + 0.5 * width, bottom + 21.0 * unit];
        self.label(place, SMALL, middle, Ink::Muted, &panel.x.label);
    }

    /// Draws the marks of a layer, each value at its place.
    fn marks(&mut self, layer: &Layer, has_rows: bool, place: impl Fn([f64; 2]) -> [f64; 2]) {
        let colour = layer.ink.colour();
        match &layer.marks {
            Marks::Words(_) => {}
            Marks::Area(points) => {
                self.fill(&points.iter().map(|&point| place(point)).collect::<Vec<_>>(), colour, 0.22);
            }
            Marks::Points(points) => {
                let places: Vec<[f64; 2]> = points.iter().map(|&point| place(point)).collect();
                let (radius, opacity) = match points.len() {
                    ..6 => (2.2, 1.0),
                    6..FEW_POINTS => (1.3, 0.85),
                    _ => (0.8, 0.5),
                };
                self.dots(&places, radius, colour, opacity);
            }
            Marks::Line { points, band, dash } => {
                let limits: Vec<([f64; 2], [f64; 2])> =
                    points.iter().copied().zip(band.iter().copied()).collect();
                for piece in
                    limits.split(|([x, y], _)| !(x + y).is_finite()).filter(|piece| !piece.is_empty())
                {
                    let edge = |end: usize| piece.iter().map(move |([x, _], limits)| [*x, limits[end]]);
                    let outline: Vec<_> = edge(0).chain(edge(1).rev()).map(&place).collect();
                    self.fill(&outline, colour, 0.16);
                }
                let line: Vec<[f64; 2]> = points.iter().map(|&point| place(point)).collect();
                let stroke = match points.len() {
                    ..=FEW_POINTS if *dash == Dash::Short => 0.9,
                    ..=FEW_POINTS => 1.4,
                    _ => 0.65,
                };
                self.path(&line, colour, stroke, *dash);
            }
            Marks::Estimates(estimates) => {
                let most = estimates.iter().map(|e| e.n).fold(1.0, f64::max);
                for e in estimates {
                    let ends =
                        if has_rows { [[e.low, e.y], [e.high, e.y]] } else { [[e.x, e.low], [e.x, e.high]] };
                    self.interval(ends.map(&place), colour);
                    let radius = if e.n.is_nan() { 2.3 } else { 0.9 + 2.3 * (e.n / most).sqrt() };
                    self.dots(&[place([e.x, e.y])], radius, colour, 1.0);
                }
            }
        }
    }
}
