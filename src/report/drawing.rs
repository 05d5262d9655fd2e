//! Drawings, whatever they are written as: paths, dots and text in points of 1/72 inch, y downwards.

use super::plotted::{Plotted, Series};
use super::text::Label;

/// Width of a figure in one column of a journal, 88 mm.
pub const ONE_COLUMN: f64 = 249.4;
/// Width of a figure across two columns, 180 mm.
pub const TWO_COLUMNS: f64 = 510.2;

/// A picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Width, points.
    pub width: f64,
    /// Height, points.
    pub height: f64,
    /// Items, each over those before.
    pub items: Vec<Item>,
    /// What its panels show, as data.
    pub plotted: Vec<Plotted>,
    /// The series of the panel that is not finished yet.
    pub series: Vec<Series>,
}

/// A colour by its role: light and dark pages give it different values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// Words and axes.
    Text,
    /// What stands back.
    Muted,
    /// Boundaries between areas.
    Rule,
    Paper,
    /// Data, from a palette that the colour-blind can tell apart.
    Data(usize),
}

/// A colour and its opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    pub ink: Ink,
    /// Opacity, from 0 to 1.
    pub opacity: f64,
}

/// The style of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    pub paint: Paint,
    /// Width, points.
    pub width: f64,
    pub dash: Dash,
}

/// The pattern of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Long,
    Short,
    /// Long and short dashes.
    Mixed,
}

/// A place, points.
pub type Point = [f64; 2];

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    Move(Point),
    Line(Point),
    /// Back to the start.
    Close,
    /// A whole circle around a place.
    Circle(Point, f64),
}

/// The part of a text that its place refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A piece of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// Place on its baseline.
    pub at: Point,
    pub anchor: Anchor,
    /// Height of the letters, points.
    pub size: f64,
    pub ink: Ink,
    /// Whether it runs upwards, along a vertical axis.
    pub upwards: bool,
    pub label: Label,
}

/// An item of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// A path, filled, stroked, or both.
    Path {
        steps: Vec<Step>,
        fill: Option<Paint>,
        stroke: Option<Stroke>,
    },
    /// Many small discs.
    Dots {
        at: Vec<Point>,
        radius: f64,
        paint: Paint,
    },
    Text(Text),
}

impl Ink {
    pub fn full(self) -> Paint {
        Paint { ink: self, opacity: 1.0 }
    }

    pub fn thin(self, opacity: f64) -> Paint {
        Paint { ink: self, opacity }
    }

    pub fn line(self, width: f64) -> Stroke {
        Stroke { paint: self.full(), width, dash: Dash::Solid }
    }

    pub fn dashed(self, width: f64, dash: Dash) -> Stroke {
        Stroke { paint: self.full(), width, dash }
    }

    /// Names its variable in the style sheet of the page.
    pub fn variable(self) -> String {
        match self {
            Ink::Text => "--ink".to_string(),
            Ink::Muted => "--muted".to_string(),
            Ink::Rule => "--rule".to_string(),
            Ink::Paper => "--paper".to_string(),
            Ink::Data(index) => format!("--data{}", index % DATA.len()),
        }
    }

    /// All that differ.
    pub const ALL: [Ink; 10] = [
        Ink::Text,
        Ink::Muted,
        Ink::Rule,
        Ink::Paper,
        Ink::Data(0),
        Ink::Data(1),
        Ink::Data(2),
        Ink::Data(3),
        Ink::Data(4),
        Ink::Data(5),
    ];

    /// Returns the colour on white paper as style sheets write it.
    pub fn hex(self) -> String {
        let [r, g, b] = self.on_white();
        format!("#{r:02x}{g:02x}{b:02x}")
    }

    /// Returns red, green and blue on white paper.
    pub fn on_white(self) -> [u8; 3] {
        match self {
            Ink::Text => [0x1a, 0x1a, 0x1a],
            Ink::Muted => [0x5c, 0x5c, 0x5c],
            Ink::Rule => [0xc4, 0xc4, 0xc4],
            Ink::Paper => [0xff, 0xff, 0xff],
            Ink::Data(index) => DATA[index % DATA.len()],
        }
    }
}

/// Okabe & Ito's palette without its yellow, which is too faint for lines on white.
const DATA: [[u8; 3]; 6] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
];

impl Dash {
    /// Returns the lengths of strokes and gaps, points.
    pub fn lengths(self) -> &'static [f64] {
        match self {
            Dash::Solid => &[],
            Dash::Long => &[5.0, 2.0],
            Dash::Short => &[1.6, 1.6],
            Dash::Mixed => &[5.0, 1.6, 1.2, 1.6],
        }
    }
}

impl Drawing {
    pub fn new(width: f64, height: f64) -> Drawing {
        Drawing { width, height, ..Drawing::default() }
    }

    /// Draws a line through points.
    pub fn line(&mut self, points: &[Point], stroke: Stroke) {
        let steps = course(points);
        if steps.len() > 1 {
            self.items.push(Item::Path { steps, fill: None, stroke: Some(stroke) });
        }
    }

    /// Fills the area within points.
    pub fn area(&mut self, points: &[Point], fill: Paint) {
        let mut steps = course(points);
        if steps.len() > 2 {
            steps.push(Step::Close);
            self.items.push(Item::Path { steps, fill: Some(fill), stroke: None });
        }
    }

    /// Draws a path of any kind.
    pub fn path(&mut self, steps: Vec<Step>, fill: Option<Paint>, stroke: Option<Stroke>) {
        if !steps.is_empty() {
            self.items.push(Item::Path { steps, fill, stroke });
        }
    }

    /// Keeps what is drawn as data: values of x and y, and what else there is of each point.
    pub fn record(&mut self, name: &str, further: &'static [&'static str], values: Vec<f64>) {
        if !values.is_empty() {
            self.series.push(Series { name: name.to_string(), further, values });
        }
    }

    /// Draws many small discs.
    pub fn dots(&mut self, at: Vec<Point>, radius: f64, paint: Paint) {
        if !at.is_empty() {
            self.items.push(Item::Dots { at, radius, paint });
        }
    }

    /// Writes words.
    pub fn text(&mut self, at: Point, anchor: Anchor, size: f64, ink: Ink, label: Label) {
        self.items.push(Item::Text(Text { at, anchor, size, ink, upwards: false, label }));
    }

    /// Writes words along a vertical axis.
    pub fn text_upwards(&mut self, at: Point, size: f64, label: Label) {
        let text = Text { at, anchor: Anchor::Middle, size, ink: Ink::Text, upwards: true, label };
        self.items.push(Item::Text(text));
    }
}

fn course(points: &[Point]) -> Vec<Step> {
    let mut steps: Vec<Step> = points.iter().map(|&point| Step::Line(point)).collect();
    if let Some(first) = steps.first_mut() {
        *first = Step::Move(points[0]);
    }
    steps
}

/// Returns the steps of a rectangle.
pub fn rectangle([x, y]: Point, width: f64, height: f64) -> [Step; 5] {
    [
        Step::Move([x, y]),
        Step::Line([x + width, y]),
        Step::Line([x + width, y + height]),
        Step::Line([x, y + height]),
        Step::Close,
    ]
}
