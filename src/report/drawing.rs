//! What a figure is made of, whatever it is written as: paths, dots and text in points of 1/72 inch, y downwards.

use super::label::Label;

/// Width of a figure in one column of a journal, 88 mm.
pub const ONE_COLUMN: f64 = 249.4;
/// Width of a figure across two columns, 180 mm.
pub const TWO_COLUMNS: f64 = 510.2;

/// A figure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drawing {
    /// Width, points.
    pub width: f64,
    /// Height, points.
    pub height: f64,
    /// What is drawn, each over those before.
    pub items: Vec<Item>,
}

/// A colour by the part it plays: light and dark pages give it different values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// Of words and axes.
    Text,
    /// Of what stands back.
    Muted,
    /// Of boundaries between areas.
    Rule,
    /// Of the page.
    Paper,
    /// Of data, from a palette that the colour-blind can tell apart.
    Data(usize),
}

/// A colour and how much of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    /// The colour.
    pub ink: Ink,
    /// From 0 to 1.
    pub opacity: f64,
}

/// A line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Its colour.
    pub paint: Paint,
    /// Its width, points.
    pub width: f64,
    /// How it is broken.
    pub dash: Dash,
}

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Into long pieces.
    Long,
    /// Into short pieces.
    Short,
    /// Into long and short ones.
    Mixed,
}

/// A place, points.
pub type Point = [f64; 2];

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Step {
    /// Begins here.
    Move(Point),
    /// Straight to here.
    Line(Point),
    /// Back to where it began.
    Close,
    /// A whole circle around here.
    Circle(Point, f64),
}

/// Where a text stands with respect to its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// A piece of text.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// Its baseline.
    pub at: Point,
    /// Which end of it is there.
    pub anchor: Anchor,
    /// Height of the letters, points.
    pub size: f64,
    /// Its colour.
    pub ink: Ink,
    /// Upwards, along a vertical axis.
    pub upwards: bool,
    /// What it says.
    pub label: Label,
}

/// A piece of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// Filled, stroked, or both.
    Path {
        /// Its course.
        steps: Vec<Step>,
        /// Its inside.
        fill: Option<Paint>,
        /// Its line.
        stroke: Option<Stroke>,
    },
    /// Many small discs.
    Dots {
        /// Their centres.
        at: Vec<Point>,
        /// Their radius.
        radius: f64,
        /// Their colour.
        paint: Paint,
    },
    /// Words.
    Text(Text),
}

impl Ink {
    /// In full.
    pub fn full(self) -> Paint {
        Paint { ink: self, opacity: 1.0 }
    }

    /// Thinned.
    pub fn thin(self, opacity: f64) -> Paint {
        Paint { ink: self, opacity }
    }

    /// As a line.
    pub fn line(self, width: f64) -> Stroke {
        Stroke { paint: self.full(), width, dash: Dash::Solid }
    }

    /// As a broken line.
    pub fn dashed(self, width: f64, dash: Dash) -> Stroke {
        Stroke { paint: self.full(), width, dash }
    }

    /// Its name in the style sheet of the page.
    pub fn variable(self) -> String {
        match self {
            Ink::Text => "--ink".to_string(),
            Ink::Muted => "--muted".to_string(),
            Ink::Rule => "--rule".to_string(),
            Ink::Paper => "--paper".to_string(),
            Ink::Data(index) => format!("--data{}", index % DATA.len()),
        }
    }

    /// Red, green and blue on white paper.
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
    /// Lengths of its strokes and gaps, points.
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
    /// Empty, of this size.
    pub fn new(width: f64, height: f64) -> Drawing {
        Drawing { width, height, items: Vec::new() }
    }

    /// A line through points.
    pub fn line(&mut self, points: &[Point], stroke: Stroke) {
        let steps = course(points);
        if steps.len() > 1 {
            self.items.push(Item::Path { steps, fill: None, stroke: Some(stroke) });
        }
    }

    /// An area within points.
    pub fn area(&mut self, points: &[Point], fill: Paint) {
        let mut steps = course(points);
        if steps.len() > 2 {
            steps.push(Step::Close);
            self.items.push(Item::Path { steps, fill: Some(fill), stroke: None });
        }
    }

    /// A path of any kind.
    pub fn path(&mut self, steps: Vec<Step>, fill: Option<Paint>, stroke: Option<Stroke>) {
        if !steps.is_empty() {
            self.items.push(Item::Path { steps, fill, stroke });
        }
    }

    /// Many small discs.
    pub fn dots(&mut self, at: Vec<Point>, radius: f64, paint: Paint) {
        if !at.is_empty() {
            self.items.push(Item::Dots { at, radius, paint });
        }
    }

    /// Words.
    pub fn text(&mut self, at: Point, anchor: Anchor, size: f64, ink: Ink, label: Label) {
        self.items.push(Item::Text(Text { at, anchor, size, ink, upwards: false, label }));
    }

    /// Words along a vertical axis.
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

/// The steps of a rectangle.
pub fn rectangle([x, y]: Point, width: f64, height: f64) -> [Step; 5] {
    [
        Step::Move([x, y]),
        Step::Line([x + width, y]),
        Step::Line([x + width, y + height]),
        Step::Line([x, y + height]),
        Step::Close,
    ]
}
