//! Drawing of figures: as SVG in points of 1/72 inch, and as PNG of it.

use std::fmt::Write;

use super::axis::Ruler;
use super::figure::{Dash, Figure, Ink, Layer, Marks, Panel};
use super::text::{Level, escape, runs, words};

/// Width of a figure across two columns of a journal, 180 mm.
const WIDTH: f64 = 510.2;
/// Height of the letters of titles, labels and legends; and of ticks.
const LETTERS: f64 = 8.0;
const SMALL_LETTERS: f64 = 7.0;
/// Mean width of a letter, of its height.
const LETTER_WIDTH: f64 = 0.52;
/// Room around the area of the data of a panel: for ticks and label, at the right, for the title, for ticks
/// and label.
const LEFT: f64 = 40.0;
const RIGHT: f64 = 12.0;
const TITLE: f64 = 17.0;
const BELOW: f64 = 28.0;
/// Height of a row with a name, and the most room for names.
const ROW: f64 = 12.0;
const NAMES: f64 = 190.0;
/// Length of a tick with a label.
const TICK: f64 = 3.0;
/// Height of a line of the legend, length of its marks, and room between its entries.
const LEGEND: f64 = 12.0;
const MARK: f64 = 14.0;
const BETWEEN: f64 = 12.0;
/// Number of points below which they are drawn larger and darker.
const FEW_POINTS: usize = 400;

/// The fonts of a file: the first that its reader has.
const FONTS: &str = "Fira Sans, Helvetica Neue, Helvetica, Arial, Liberation Sans, sans-serif";

impl Ink {
    /// The colours in a file and the names of those on the page. Data: Okabe & Ito's palette without its
    /// yellow, too faint on white.
    const COLOURS: [(&'static str, &'static str); 9] = [
        ("#1a1a1a", "--ink"),
        ("#5c5c5c", "--muted"),
        ("#c4c4c4", "--rule"),
        ("#0072b2", "--data0"),
        ("#d55e00", "--data1"),
        ("#009e73", "--data2"),
        ("#cc79a7", "--data3"),
        ("#e69f00", "--data4"),
        ("#56b4e9", "--data5"),
    ];

    fn colour(self) -> &'static str {
        match self {
            Ink::Text => Ink::COLOURS[0].0,
            Ink::Muted => Ink::COLOURS[1].0,
            Ink::Rule => Ink::COLOURS[2].0,
            Ink::Data(number) => Ink::COLOURS[3 + number % 6].0,
        }
    }
}

/// Writes a figure as an SVG file on white, with the key of what made it.
pub fn svg(figure: &Figure, key: &str) -> String {
    let (body, height) = drawing(figure);
    let (title, caption) = (escape(&words(&figure.title)), escape(&words(&figure.caption)));
    let size = format!("width=\"{WIDTH}pt\" height=\"{height}pt\" viewBox=\"0 0 {WIDTH} {height}\"");
    let meta = format!(
        "<meta xmlns=\"http://www.w3.org/1999/xhtml\" name=\"rockfrag\" content=\"{}\"/>",
        escape(key)
    );
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" {size} font-family=\"{FONTS}\">\n<metadata>{meta}</metadata>\n<title>{title}</title>\n<desc>{caption}</desc>\n<rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// Writes a figure as SVG within a page that has the fonts and the colours.
pub fn svg_in_page(figure: &Figure) -> String {
    let (body, height) = drawing(figure);
    let name = escape(&words(&figure.title));
    let body = Ink::COLOURS.iter().fold(body, |body, (hex, name)| body.replace(hex, &format!("var({name})")));
    format!("<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{name}\">\n{body}</svg>\n")
}

/// Draws an SVG file as PNG with so many dots per inch.
pub fn png(svg: &str, dpi: f32) -> Result<Vec<u8>, resvg::usvg::Error> {
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
    pixels.encode_png().map_err(|_| usvg::Error::InvalidSize)
}

/// The area of the data of a panel: left, top, width and height.
type Area = [f64; 4];

fn drawing(figure: &Figure) -> (String, f64) {
    let mut text = String::new();
    let columns = figure.columns.max(1);
    let across = WIDTH / columns as f64;
    let names = figure.panels.iter().map(|panel| names_room(panel, across)).fold(LEFT, f64::max);
    let mut top = legend(&mut text, figure, names);
    for row in figure.panels.chunks(columns) {
        let height = |panel: &Panel| match panel.names().len() {
            0 => figure.height,
            rows => ROW * rows as f64,
        };
        let height = row.iter().map(height).fold(0.0, f64::max);
        let title = if row.iter().all(|panel| panel.title.is_empty()) { 0.3 * TITLE } else { TITLE };
        for (column, panel) in row.iter().enumerate() {
            let left = column as f64 * across + names;
            let width = across - names - RIGHT;
            write_panel(&mut text, panel, [left, top + title, width, height]);
        }
        let has_labels = row.iter().any(|panel| !panel.x.label.is_empty());
        top += title + height + if has_labels { BELOW } else { 0.25 * BELOW };
    }
    (text, round(top.max(1.0)))
}

/// Returns the room to the left of a panel, for its names if it has any.
fn names_room(panel: &Panel, across: f64) -> f64 {
    let widest = panel.names().iter().map(|name| width(name, SMALL_LETTERS)).fold(0.0, f64::max);
    (widest + 12.0).clamp(LEFT, NAMES.min(0.5 * across))
}

/// Estimates the width of marked text: the letters of its reader are not known.
fn width(marked: &str, size: f64) -> f64 {
    words(marked).chars().count() as f64 * size * LETTER_WIDTH
}

/// Cuts a name to the room for names.
fn shortened(name: String) -> String {
    let most = ((NAMES - 12.0) / (SMALL_LETTERS * LETTER_WIDTH)) as usize;
    match name.char_indices().nth(most) {
        Some((end, _)) => format!("{}\u{2026}", &name[..end]),
        None => name,
    }
}

/// Draws one legend for all panels, if anything has a name; returns where the first row of panels begins.
fn legend(text: &mut String, figure: &Figure, left: f64) -> f64 {
    let mut entries: Vec<&Layer> = Vec::new();
    for layer in figure.panels.iter().flat_map(|panel| &panel.layers) {
        if !layer.label.is_empty() && entries.iter().all(|entry| entry.label != layer.label) {
            entries.push(layer);
        }
    }
    let (mut x, mut y) = (left, 10.0);
    for layer in &entries {
        let long = MARK + 3.0 + width(&layer.label, LETTERS);
        if x > left && x + long > WIDTH {
            (x, y) = (left, y + LEGEND);
        }
        let colour = layer.ink.colour();
        let middle = [x + 0.5 * MARK, y - 2.6];
        match &layer.marks {
            Marks::Points(_) => dots(text, &[middle], 2.0, colour, 1.0),
            Marks::Line { dash, .. } => {
                path(text, &[[x, middle[1]], [x + MARK, middle[1]]], colour, 1.3, *dash)
            }
            Marks::Estimates(_) => {
                path(text, &[-4.5, 4.5].map(|up| [middle[0], middle[1] + up]), colour, 0.8, Dash::Solid);
                dots(text, &[middle], 1.8, colour, 1.0);
            }
        }
        label(text, [x + MARK + 3.0, y], LETTERS, "", Ink::Text, &layer.label);
        x += long + BETWEEN;
    }
    if entries.is_empty() { 0.0 } else { y + 5.0 }
}

fn write_panel(text: &mut String, panel: &Panel, area: Area) {
    let [x, y] = panel.rulers();
    let [left, top, width, height] = area;
    // What lies beyond the axes is cut off by the inner picture.
    let [x_at, y_at, wide, high] = area.map(round);
    let _ = writeln!(text, "<svg x=\"{x_at}\" y=\"{y_at}\" width=\"{wide}\" height=\"{high}\">");
    for row in 0..panel.names().len() {
        let at = height * (1.0 - y.fraction(row as f64));
        path(text, &[[0.0, at], [width, at]], Ink::Rule.colour(), 0.3, Dash::Solid);
    }
    for layer in &panel.layers {
        marks(text, layer, !panel.names().is_empty(), |[x_value, y_value]| {
            [width * x.fraction(x_value), height * (1.0 - y.fraction(y_value))]
        });
    }
    text.push_str("</svg>\n");
    axes(text, panel, [&x, &y], area);
    label(text, [left, top - 6.0], LETTERS, " font-weight=\"600\"", Ink::Text, &panel.title);
}

fn axes(text: &mut String, panel: &Panel, [x, y]: [&Ruler; 2], [left, top, width, height]: Area) {
    let (right, bottom) = (left + width, top + height);
    let mut lines = vec![vec![[left, top], [left, bottom], [right, bottom]]];
    let middle = " text-anchor=\"middle\"";
    for tick in x.ticks((width / 26.0) as usize) {
        let at = left + width * x.fraction(tick.value);
        let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
        lines.push(vec![[at, bottom], [at, bottom + length]]);
        if let Some(words) = tick.label.filter(|_| !panel.x.label.is_empty()) {
            label(text, [at, bottom + TICK + 7.5], SMALL_LETTERS, middle, Ink::Text, &words);
        }
    }
    for tick in y.ticks(((height / 16.0) as usize).max(4)) {
        let at = top + height * (1.0 - y.fraction(tick.value));
        let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
        lines.push(vec![[left - length, at], [left, at]]);
        if let Some(words) = tick.label {
            let place = [left - TICK - 2.5, at + 0.35 * SMALL_LETTERS];
            label(text, place, SMALL_LETTERS, " text-anchor=\"end\"", Ink::Text, &shortened(words));
        }
    }
    let d: String = lines.iter().map(|line| course(line)).collect();
    let ink = Ink::Text.colour();
    let _ = writeln!(text, "<path d=\"{d}\" fill=\"none\" stroke=\"{ink}\" stroke-width=\"0.6\"/>");
    label(text, [left + 0.5 * width, bottom + 21.0], LETTERS, middle, Ink::Text, &panel.x.label);
    let [at, along] = [left - LEFT + 11.0, top + 0.5 * height].map(round);
    let turned = format!("{middle} transform=\"rotate(-90 {at} {along})\"");
    label(text, [at, along], LETTERS, &turned, Ink::Text, &panel.y.label);
}

/// Draws the marks of a layer, each value at its place.
fn marks(text: &mut String, layer: &Layer, has_rows: bool, place: impl Fn([f64; 2]) -> [f64; 2]) {
    let colour = layer.ink.colour();
    match &layer.marks {
        Marks::Points(points) => {
            let places: Vec<[f64; 2]> = points.iter().map(|&point| place(point)).collect();
            let (radius, opacity) = if points.len() < FEW_POINTS { (1.2, 0.9) } else { (0.7, 0.5) };
            dots(text, &places, radius, colour, opacity);
        }
        Marks::Line { points, band, dash } => {
            let limits: Vec<([f64; 2], [f64; 2])> =
                points.iter().copied().zip(band.iter().copied()).collect();
            for piece in limits.split(|([x, y], _)| !(x + y).is_finite()).filter(|piece| !piece.is_empty()) {
                let edge = |end: usize| piece.iter().map(move |([x, _], limits)| [*x, limits[end]]);
                let area = course(&edge(0).chain(edge(1).rev()).map(&place).collect::<Vec<_>>());
                let _ = writeln!(text, "<path d=\"{area}Z\" fill=\"{colour}\" fill-opacity=\"0.2\"/>");
            }
            let line: Vec<[f64; 2]> = points.iter().map(|&point| place(point)).collect();
            // Series over time are long, and thin.
            path(text, &line, colour, if points.len() > 500 { 0.6 } else { 1.3 }, *dash);
        }
        Marks::Estimates(estimates) => {
            let most = estimates.iter().map(|e| e.n).fold(1.0, f64::max);
            for e in estimates {
                let ends =
                    if has_rows { [[e.low, e.y], [e.high, e.y]] } else { [[e.x, e.low], [e.x, e.high]] };
                path(text, &ends.map(&place), colour, 0.8, Dash::Solid);
                let radius = if e.n.is_nan() { 1.8 } else { 0.9 + 2.3 * (e.n / most).sqrt() };
                dots(text, &[place([e.x, e.y])], radius, colour, 1.0);
            }
        }
    }
}

/// Writes marked text; `style` are further attributes.
fn label(text: &mut String, [x, y]: [f64; 2], size: f64, style: &str, ink: Ink, marked: &str) {
    if marked.is_empty() {
        return;
    }
    let (x, y, colour) = (round(x), round(y), ink.colour());
    let _ = write!(text, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{colour}\"{style}>");
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
        let moved = if below == drop { String::new() } else { format!(" dy=\"{}\"", round(below - drop)) };
        drop = below;
        let _ = write!(text, "<tspan{small}{italic}{moved}>{}</tspan>", escape(&run.words));
    }
    text.push_str("</text>\n");
}

/// Draws small discs: strokes of no length with round ends, short to write.
fn dots(text: &mut String, places: &[[f64; 2]], radius: f64, colour: &str, opacity: f64) {
    let finite = places.iter().filter(|place| place.iter().all(|v| v.is_finite()));
    let d: String = finite.map(|[x, y]| format!("M{} {}h0", round(*x), round(*y))).collect();
    let _ = writeln!(
        text,
        "<path d=\"{d}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{}\" stroke-linecap=\"round\" stroke-opacity=\"{opacity}\"/>",
        round(2.0 * radius)
    );
}

fn path(text: &mut String, places: &[[f64; 2]], colour: &str, width: f64, dash: Dash) {
    let dash = match dash {
        Dash::Solid => "",
        Dash::Long => " stroke-dasharray=\"5 2\"",
        Dash::Short => " stroke-dasharray=\"1.6 1.6\"",
        Dash::Mixed => " stroke-dasharray=\"5 1.6 1.2 1.6\"",
    };
    let d = course(places);
    let _ = writeln!(
        text,
        "<path d=\"{d}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"{dash}/>"
    );
}

/// Writes the steps of a line, anew after each place that is not finite.
fn course(places: &[[f64; 2]]) -> String {
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
fn round(number: f64) -> f64 {
    (number.clamp(-9999.0, 9999.0) * 100.0).round() / 100.0 + 0.0
}
