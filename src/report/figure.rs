//! A figure as data: panels of layers. Its axes, its legend and the table of its numbers follow from them.

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
    pub range: Option<[f64; 2]>,
}

#[derive(Debug, Clone, PartialEq, Default)]
pub enum Scale {
    #[default]
    Linear,
    Log,
    /// Rows, from top to bottom, at 0, 1, 2 ...
    Names(Vec<String>),
}

/// Marks that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// Name in the legend, which has each name once; none if empty.
    pub label: String,
    pub ink: Ink,
    pub marks: Marks,
}

#[derive(Debug, Clone, PartialEq)]
pub enum Marks {
    Points(Vec<[f64; 2]>),
    /// A line, and limits of y at each of its points if `band` is not empty.
    Line {
        points: Vec<[f64; 2]>,
        band: Vec<[f64; 2]>,
        dash: Dash,
    },
    /// Values with limits of y, or of x where y is an axis of names.
    Estimates(Vec<Estimate>),
    /// A closed outline, filled.
    Area(Vec<[f64; 2]>),
    /// Marked texts at places.
    Words(Vec<Words>),
}

/// A text at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    pub x: f64,
    pub y: f64,
    /// Marked text.
    pub text: String,
    pub side: Side,
}

/// Where a text stands, seen from its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Right,
    Left,
    Above,
    Below,
    /// Upright, to the left.
    Along,
}

/// A value with its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    pub x: f64,
    pub y: f64,
    /// NaN where it has no limits.
    pub low: f64,
    pub high: f64,
    /// Number of cases behind it, which its dot shows; NaN if unknown.
    pub n: f64,
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    #[default]
    Solid,
    Long,
    Short,
    Mixed,
}

/// Upper bound of the points of a layer: a picture shows no more.
const MOST_POINTS: usize = 5000;

impl Layer {
    /// Draws points; of too many, some that are spread over all.
    pub fn points(label: &str, ink: Ink, points: impl IntoIterator<Item = [f64; 2]>) -> Layer {
        let points: Vec<[f64; 2]> =
            points.into_iter().filter(|point| point.iter().all(|v| v.is_finite())).collect();
        let step = points.len().div_ceil(MOST_POINTS).max(1);
        let marks = Marks::Points(points.into_iter().step_by(step).collect());
        Layer { label: label.to_string(), ink, marks }
    }

    pub fn line(label: &str, ink: Ink, points: Vec<[f64; 2]>) -> Layer {
        Layer::curve(label, ink, Dash::Solid, points, Vec::new())
    }

    pub fn curve(label: &str, ink: Ink, dash: Dash, points: Vec<[f64; 2]>, band: Vec<[f64; 2]>) -> Layer {
        Layer { label: label.to_string(), ink, marks: Marks::Line { points, band, dash } }
    }

    /// A vertical line between two heights, with words at its upper end.
    pub fn upright(x: f64, [low, high]: [f64; 2], text: &str, side: Side) -> [Layer; 2] {
        let line = Layer::curve("", Ink::Muted, Dash::Short, vec![[x, low], [x, high]], Vec::new());
        [line, Layer::words(Ink::Muted, [Words { x, y: high, text: text.to_string(), side }])]
    }

    pub fn area(label: &str, ink: Ink, outline: Vec<[f64; 2]>) -> Layer {
        Layer { label: label.to_string(), ink, marks: Marks::Area(outline) }
    }

    pub fn words(ink: Ink, words: impl IntoIterator<Item = Words>) -> Layer {
        Layer { label: String::new(), ink, marks: Marks::Words(words.into_iter().collect()) }
    }

    pub fn estimates(label: &str, ink: Ink, estimates: impl IntoIterator<Item = Estimate>) -> Layer {
        let marks = Marks::Estimates(estimates.into_iter().collect());
        Layer { label: label.to_string(), ink, marks }
    }
}

impl Figure {
    pub fn new(
        name: &str,
        title: &str,
        caption: impl Into<String>,
        columns: usize,
        height: f64,
        panels: Vec<Panel>,
    ) -> Figure {
        let columns = columns.min(panels.len());
        let [name, title] = [name, title].map(str::to_string);
        Figure { name, title, caption: caption.into(), columns, height, panels }
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
                for numbers in layer.marks.numbers() {
                    let written =
                        |value: f64| if value.is_finite() { value.to_string() } else { String::new() };
                    let [x, y, low, high, n] = numbers.map(written);
                    writer.write_record([&title, &name, &x_is, &x, &y_is, &y, &low, &high, &n])?;
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

    /// The same with a caption.
    pub fn explained(self, caption: impl Into<String>) -> Panel {
        Panel { caption: caption.into(), ..self }
    }
}

impl Marks {
    /// Rows of x, y, low, high and n; NaN where a kind of marks has no such number. Words have none.
    pub fn numbers(&self) -> Vec<[f64; 5]> {
        const NONE: f64 = f64::NAN;
        match self {
            Marks::Words(_) => Vec::new(),
            Marks::Points(points) | Marks::Area(points) => {
                points.iter().map(|&[x, y]| [x, y, NONE, NONE, NONE]).collect()
            }
            Marks::Line { points, band, .. } => {
                let limits = band.iter().copied().chain(std::iter::repeat([NONE; 2]));
                points.iter().zip(limits).map(|(&[x, y], [low, high])| [x, y, low, high, NONE]).collect()
            }
            Marks::Estimates(estimates) => estimates.iter().map(|e| [e.x, e.y, e.low, e.high, e.n]).collect(),
        }
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
    pub fn probability(label: &str) -> Axis {
        Axis::linear(label).over(-0.04, 1.04)
    }
}
