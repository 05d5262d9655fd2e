//! A figure as data: panels of layers. Its axes, its legend and the table of its numbers follow from them.

use super::text::words;

/// One picture: panels in rows. All its texts are marked, see [`super::text`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// Name of its files.
    pub name: String,
    pub title: String,
    pub caption: String,
    /// Number of panels in a row.
    pub columns: usize,
    /// Height of the area of the data of a panel, points; a panel of names has its own.
    pub height: f64,
    pub panels: Vec<Panel>,
    /// HTML that stands beside the panels on a page.
    pub beside: String,
}

/// A pair of axes and what lies between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel {
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// Each over those before.
    pub layers: Vec<Layer>,
    /// Over all layers and the edge of the panel.
    pub words: Vec<Words>,
    /// Enough to read the panel alone; below it on the page.
    pub caption: String,
    /// Whether it is a drawing without axes, as long up as across.
    pub is_to_scale: bool,
}

/// An axis; its range is that of the layers unless it is given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// A horizontal axis without a label has ticks without numbers.
    pub label: String,
    pub scale: Scale,
    pub range: Option<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq, Default, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Scale {
    #[default]
    Linear,
    Log,
    /// Rows, from top to bottom, at 0, 1, 2 ...
    Names(Vec<String>),
}

/// Marks of one kind that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    pub name: String,
    /// Whether the legend has it; of one name it has the first layer.
    pub is_listed: bool,
    pub ink: Ink,
    pub style: MarkStyle,
    pub marks: Vec<Mark>,
}

/// What is drawn of marks.
#[derive(Debug, Clone, Copy, PartialEq, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum MarkStyle {
    Points(Symbol),
    /// A line, and between the limits of y a band.
    Line(Dash),
    /// Values with limits of y, or of x where y is an axis of names; there those of one row stand below each
    /// other.
    Estimates,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Symbol {
    /// Of few points, that have each a meaning.
    Disc,
    Dot,
    Circle,
    Cross,
}

/// A place over the axes; with limits if it is an estimate. What is NaN is not drawn: a line has a gap there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    pub x: f64,
    pub y: f64,
    pub low: f64,
    pub high: f64,
    /// Number of observations behind it.
    pub n: f64,
}

/// A text at a place: over the axes of a panel, and in the picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    pub x: f64,
    pub y: f64,
    pub text: String,
    pub position: LabelPosition,
    pub ink: Ink,
}

/// Where a text stands, seen from its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LabelPosition {
    Right,
    Left,
    Above,
    Below,
    /// Upright, to the left.
    Along,
    /// In a column beyond the right edge of the data.
    Margin,
    /// It begins there: the title of a panel, an entry of the legend, the label of y.
    Title,
    Legend,
    YLabel,
}

/// A colour by its role; the page has others in the dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    Text,
    Muted,
    /// Guides, behind data.
    Rule,
    Data(usize),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Dash {
    Solid,
    Long,
    Short,
    Mixed,
}

/// Upper bound of the points of a layer: a picture shows no more.
const MOST_POINTS: usize = 5000;
const COLUMNS: &str = "panel_number,panel,layer,x_is,x,y_is,y,row,low,high,n,\
                       layer_number,x_scale,y_scale,colour,style,form";

impl Mark {
    pub fn new(x: f64, y: f64) -> Mark {
        Mark { x, y, low: f64::NAN, high: f64::NAN, n: f64::NAN }
    }

    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Layer {
    /// Without a name, it is not in the legend.
    pub fn new(name: &str, ink: Ink, style: MarkStyle, marks: impl IntoIterator<Item = Mark>) -> Layer {
        let (name, is_listed) = (name.to_string(), !name.is_empty());
        Layer { name, is_listed, ink, style, marks: marks.into_iter().collect() }
    }

    /// Draws points; of too many, some that are spread over all.
    pub fn points(name: &str, ink: Ink, symbol: Symbol, marks: impl IntoIterator<Item = Mark>) -> Layer {
        let marks: Vec<Mark> = marks.into_iter().filter(Mark::is_finite).collect();
        let step = marks.len().div_ceil(MOST_POINTS).max(1);
        Layer::new(name, ink, MarkStyle::Points(symbol), marks.into_iter().step_by(step))
    }

    pub fn line(name: &str, ink: Ink, marks: impl IntoIterator<Item = Mark>) -> Layer {
        Layer::new(name, ink, MarkStyle::Line(Dash::Solid), marks)
    }

    /// Draws a thin dashed line, which is not in the legend.
    pub fn guide(name: &str, ink: Ink, marks: impl IntoIterator<Item = Mark>) -> Layer {
        Layer::new(name, ink, MarkStyle::Line(Dash::Short), marks).unlisted()
    }

    pub fn unlisted(self) -> Layer {
        Layer { is_listed: false, ..self }
    }
}

impl Figure {
    /// Leaves panels without marks out.
    pub fn new(name: &str, title: &str, columns: usize, height: f64, mut panels: Vec<Panel>) -> Figure {
        panels.retain(|panel| panel.drawn().next().is_some());
        let columns = columns.min(panels.len());
        let [name, title] = [name, title].map(str::to_string);
        Figure { name, title, columns, height, panels, ..Figure::default() }
    }

    pub fn explained(self, caption: impl Into<String>) -> Figure {
        Figure { caption: caption.into(), ..self }
    }

    /// Comma-separated values: a row a mark; a layer without a name has the title of its panel.
    pub fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(COLUMNS.split(','))?;
        for (panel, panel_number) in self.panels.iter().zip(1_i32..) {
            let [title, x_is, y_is] = [&panel.title, &panel.x.label, &panel.y.label].map(|text| words(text));
            let [x_scale, y_scale] = [&panel.x.scale, &panel.y.scale].map(<&str>::from);
            for (layer, number) in panel.drawn().zip(1_i32..) {
                let [panel_number, number] = [panel_number, number].map(|number| number.to_string());
                let (name, colour) = (words(&layer.name), layer.ink.in_file());
                let name = if name.is_empty() { &title } else { &name };
                let form = match layer.style {
                    MarkStyle::Line(dash) => dash.into(),
                    MarkStyle::Points(symbol) => symbol.into(),
                    MarkStyle::Estimates => "",
                };
                for mark in &layer.marks {
                    let numbers = [mark.x, mark.y, mark.low, mark.high, mark.n];
                    let [x, y, low, high, n] = &numbers
                        .map(|value| if value.is_finite() { value.to_string() } else { String::new() });
                    let row = panel.names().get(mark.y as usize).map_or(String::new(), |row| words(row));
                    let place =
                        [&panel_number, &title, name, &x_is, x, &y_is, y, &row, low, high, n, &number];
                    let kind = [x_scale, y_scale, &colour, layer.style.into(), form];
                    writer.write_record(place.map(String::as_str).into_iter().chain(kind))?;
                }
            }
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}

impl Panel {
    pub fn new(title: &str, x: Axis, y: Axis, layers: Vec<Layer>) -> Panel {
        Panel { title: title.to_string(), x, y, layers, ..Panel::default() }
    }

    pub fn explained(self, caption: impl Into<String>) -> Panel {
        Panel { caption: caption.into(), ..self }
    }

    /// Names of the rows in which estimates lie, with limits along x; none where y has numbers.
    pub fn names(&self) -> &[String] {
        if let Scale::Names(names) = &self.y.scale { names } else { &[] }
    }

    /// The layers that have marks; others stand in the legend alone.
    pub fn drawn(&self) -> impl Iterator<Item = &Layer> {
        self.layers.iter().filter(|layer| !layer.marks.is_empty())
    }

    /// Adds a vertical line from a height to another, where its words stand.
    pub fn add_upright(&mut self, x: f64, [from, y]: [f64; 2], text: String, position: LabelPosition) {
        let line = [from, y].map(|y| Mark::new(x, y));
        self.layers.push(Layer::guide(&text, Ink::Muted, line));
        self.words.push(Words { x, y, text, position, ink: Ink::Muted });
    }
}

impl Axis {
    pub fn linear(label: &str) -> Axis {
        Axis { label: label.to_string(), ..Axis::default() }
    }

    pub fn log(label: &str) -> Axis {
        Axis { scale: Scale::Log, ..Axis::linear(label) }
    }

    pub fn names(names: impl IntoIterator<Item = String>) -> Axis {
        Axis { scale: Scale::Names(names.into_iter().collect()), ..Axis::default() }
    }

    pub fn over(self, low: f64, high: f64) -> Axis {
        Axis { range: Some([low, high]), ..self }
    }

    /// From 0 to 1, with room for dots at both ends.
    pub fn fraction(label: &str) -> Axis {
        Axis::linear(label).over(-0.04, 1.04)
    }
}
