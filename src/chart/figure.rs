//! A figure as data: panels of layers. Its axes, its legend and the table of its numbers follow from them.

use rockfrag_core::statistics::{Interval, Range};

use super::text::words;

/// One picture: panels in rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// Name of its files.
    pub name: String,
    pub title: String,
    /// Marked text, see [`super::text`].
    pub caption: String,
    /// Number of panels in a row.
    pub columns: usize,
    /// Height of the area of the data of a panel, points; a panel of names has its own.
    pub height: f64,
    pub panels: Vec<Panel>,
    /// What moves, beside the panels on a page: a picture as HTML.
    pub moving: String,
}

/// A pair of axes and what lies between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel {
    /// Marked text.
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    /// Each over those before.
    pub layers: Vec<Layer>,
    /// Over all layers and the edge of the panel.
    pub words: Vec<Words>,
    /// Marked text that is enough to read the panel alone; below it on the page.
    pub caption: String,
    pub frame: Frame,
}

/// What surrounds the data of a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Frame {
    #[default]
    Axes,
    /// Nothing: a drawing to scale, as long up as across.
    ToScale,
}

/// An axis; its range is that of the layers unless it is given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// Marked text; a horizontal axis without a label has ticks without numbers.
    pub label: String,
    pub scale: Scale,
    pub range: Option<Range>,
}

#[derive(Debug, Clone, PartialEq, Default)]
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
    /// Name in the legend, which has each name once; none if empty.
    pub label: String,
    pub ink: Ink,
    pub style: MarkStyle,
    pub marks: Vec<Mark>,
}

/// What is drawn of marks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MarkStyle {
    Points,
    /// A line, and between the limits of y a band.
    Line(Dash),
    /// Values with limits of y, or of x where y is an axis of names.
    Estimates,
}

/// A place over the axes; with limits if it is an estimate. What is NaN is not drawn: a line has a gap there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    pub x: f64,
    pub y: f64,
    pub low: f64,
    pub high: f64,
    /// Number of cases behind it, which its dot shows.
    pub n: f64,
}

/// A text at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    pub x: f64,
    pub y: f64,
    /// Marked text.
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
}

/// A colour by its role; the page has others in the dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    Text,
    Muted,
    /// Guides, behind data.
    Rule,
    /// Data, by number.
    Data(usize),
    /// How much there is to worry about: 0, 1 or 2.
    Band(usize),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Long,
    Short,
    Mixed,
}

/// Upper bound of the points of a layer: a picture shows no more.
const MOST_POINTS: usize = 5000;

impl Mark {
    pub fn new(x: f64, y: f64) -> Mark {
        Mark { x, y, low: f64::NAN, high: f64::NAN, n: f64::NAN }
    }

    /// A value of y with its limits.
    pub fn estimate(x: f64, Interval { value, low, high }: Interval) -> Mark {
        Mark { low, high, ..Mark::new(x, value) }
    }

    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}

impl Layer {
    pub fn new(label: &str, ink: Ink, style: MarkStyle, marks: impl IntoIterator<Item = Mark>) -> Layer {
        Layer { label: label.to_string(), ink, style, marks: marks.into_iter().collect() }
    }

    /// Draws points; of too many, some that are spread over all.
    pub fn points(label: &str, ink: Ink, marks: impl IntoIterator<Item = Mark>) -> Layer {
        let marks: Vec<Mark> = marks.into_iter().filter(Mark::is_finite).collect();
        let step = marks.len().div_ceil(MOST_POINTS).max(1);
        Layer::new(label, ink, MarkStyle::Points, marks.into_iter().step_by(step))
    }

    pub fn line(label: &str, ink: Ink, marks: impl IntoIterator<Item = Mark>) -> Layer {
        Layer::new(label, ink, MarkStyle::Line(Dash::Solid), marks)
    }

    /// Draws a thin dashed line.
    pub fn guide(ink: Ink, marks: impl IntoIterator<Item = Mark>) -> Layer {
        Layer::new("", ink, MarkStyle::Line(Dash::Short), marks)
    }
}

impl Figure {
    pub fn new(name: &str, title: &str, columns: usize, height: f64, panels: Vec<Panel>) -> Figure {
        let columns = columns.min(panels.len());
        let [name, title] = [name, title].map(str::to_string);
        Figure { name, title, columns, height, panels, ..Figure::default() }
    }

    pub fn explained(self, caption: impl Into<String>) -> Figure {
        Figure { caption: caption.into(), ..self }
    }

    /// Writes what is drawn as comma-separated values: a row a mark, numbers that it does not have left
    /// empty.
    pub fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(["panel", "layer", "x_is", "x", "y_is", "y", "low", "high", "n"])?;
        for panel in &self.panels {
            let [title, x_is, y_is] =
                [&panel.title, &panel.x.label, &panel.y.label].map(|label| words(label));
            for layer in &panel.layers {
                let name = words(&layer.label);
                for mark in &layer.marks {
                    let [x, y, low, high, n] = [mark.x, mark.y, mark.low, mark.high, mark.n].map(written);
                    writer.write_record([&title, &name, &x_is, &x, &y_is, &y, &low, &high, &n])?;
                }
            }
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}

fn written(value: f64) -> String {
    if value.is_finite() { value.to_string() } else { String::new() }
}

impl Panel {
    pub fn new(title: &str, x: Axis, y: Axis, layers: Vec<Layer>) -> Panel {
        Panel { title: title.to_string(), x, y, layers, ..Panel::default() }
    }

    pub fn explained(self, caption: impl Into<String>) -> Panel {
        Panel { caption: caption.into(), ..self }
    }

    /// Adds words, and a vertical line from a height to them.
    pub fn add_upright(&mut self, words: Words, from: f64) {
        self.layers.push(Layer::guide(words.ink, [Mark::new(words.x, from), Mark::new(words.x, words.y)]));
        self.words.push(words);
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
        Axis { range: Some(Range { low, high }), ..self }
    }

    /// From 0 to 1, with room for dots at both ends.
    pub fn probability(label: &str) -> Axis {
        Axis::linear(label).over(-0.04, 1.04)
    }
}
