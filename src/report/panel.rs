//! A panel of a figure: axes, data within them, and the legend above.

use super::axis::Axis;
use super::drawing::{Anchor, Drawing, Ink, Paint, Point, Step, Stroke, rectangle};
use super::plotted::Plotted;
use super::text::Label;

/// Height of the letters of axes and legends, points.
pub const LETTERS: f64 = 8.0;
/// Height of the letters at ticks.
const TICK_LETTERS: f64 = 7.0;
/// Length of a labelled tick; the others have half of it.
const TICK: f64 = 3.0;
/// Width of axes.
const AXIS_WIDTH: f64 = 0.6;
/// Upper bound of the points that are drawn one by one; more are drawn as a density.
pub const MOST_POINTS: usize = 5000;
/// Number of points below which they are drawn larger.
const FEW_POINTS: usize = 400;
/// Side of a square of a density, points.
const SQUARE: f64 = 2.4;
/// Number of shades of a density.
const SHADES: usize = 6;

/// Axes and the area of the data between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Upper left corner of the area of the data.
    pub corner: Point,
    /// Width, points.
    pub width: f64,
    /// Height, points.
    pub height: f64,
    pub x: Axis,
    pub y: Axis,
}

impl Panel {
    /// Returns the place of a pair of values.
    pub fn at(&self, [x, y]: [f64; 2]) -> Point {
        let [left, top] = self.corner;
        [left + self.width * self.x.fraction(x), top + self.height * (1.0 - self.y.fraction(y))]
    }

    fn holds(&self, [x, y]: [f64; 2]) -> bool {
        self.x.holds(x) && self.y.holds(y)
    }

    fn right(&self) -> f64 {
        self.corner[0] + self.width
    }

    fn bottom(&self) -> f64 {
        self.corner[1] + self.height
    }

    /// Draws axes with ticks, labels and a title above. A horizontal axis without a label is that of the panel below.
    pub fn frame(&self, drawing: &mut Drawing, title: Label) {
        let [left, top] = self.corner;
        let (right, bottom) = (self.right(), self.bottom());
        let mut steps =
            vec![Step::Move([left, top]), Step::Line([left, bottom]), Step::Line([right, bottom])];
        for tick in self.x.ticks((self.width / 26.0) as usize) {
            let [x, _] = self.at([tick.value, self.y.low]);
            let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
            steps.extend([Step::Move([x, bottom]), Step::Line([x, bottom + length])]);
            if let Some(label) = tick.label.filter(|_| !self.x.label.is_empty()) {
                drawing.text([x, bottom + TICK + 7.5], Anchor::Middle, TICK_LETTERS, Ink::Text, label);
            }
        }
        for tick in self.y.ticks(((self.height / 16.0) as usize).max(4)) {
            let [_, y] = self.at([self.x.low, tick.value]);
            let length = if tick.label.is_some() { TICK } else { 0.5 * TICK };
            steps.extend([Step::Move([left, y]), Step::Line([left - length, y])]);
            if let Some(label) = tick.label {
                drawing.text([left - TICK - 2.0, y + 2.4], Anchor::End, TICK_LETTERS, Ink::Text, label);
            }
        }
        drawing.path(steps, None, Some(Ink::Text.line(AXIS_WIDTH)));
        let middle = [0.5 * (left + right), bottom + 21.5];
        drawing.text(middle, Anchor::Middle, LETTERS, Ink::Text, self.x.label.clone());
        drawing.text_upwards([left - 27.0, 0.5 * (top + bottom)], LETTERS, self.y.label.clone());
        drawing.text([left, top - 5.0], Anchor::Start, LETTERS, Ink::Text, title.clone());
        let series = std::mem::take(&mut drawing.series);
        let (size, axes) = ([self.width, self.height], [self.x.clone(), self.y.clone()]);
        drawing.plotted.push(Plotted { title, corner: self.corner, size, axes, series });
    }

    /// Draws a curve of the data, as far as it lies within.
    pub fn curve(&self, drawing: &mut Drawing, name: &str, values: &[[f64; 2]], stroke: Stroke) {
        drawing.record(name, &[], values.concat());
        self.line(drawing, values, stroke);
    }

    /// Draws a line, as far as it lies within.
    pub fn line(&self, drawing: &mut Drawing, values: &[[f64; 2]], stroke: Stroke) {
        let mut piece: Vec<Point> = Vec::new();
        for pair in values.windows(2) {
            let shares = [self.shares(pair[0]), self.shares(pair[1])];
            let Some([from, to]) = clipped(shares) else { continue };
            let (from, to) = (self.place(from), self.place(to));
            if piece.last() != Some(&from) {
                drawing.line(&piece, stroke);
                piece = vec![from];
            }
            piece.push(to);
        }
        drawing.line(&piece, stroke);
    }

    fn shares(&self, [x, y]: [f64; 2]) -> Point {
        [self.x.fraction(x), self.y.fraction(y)]
    }

    fn place(&self, [x, y]: Point) -> Point {
        [self.corner[0] + self.width * x, self.corner[1] + self.height * (1.0 - y)]
    }

    /// Fills the area between two curves over the same x: `[x, low, high]`.
    pub fn band(&self, drawing: &mut Drawing, values: &[[f64; 3]], paint: Paint) {
        let inside = |value: f64| self.y.fraction(value).clamp(0.0, 1.0);
        let values =
            values.iter().filter(|[x, low, high]| self.x.holds(*x) && low.is_finite() && high.is_finite());
        let values: Vec<&[f64; 3]> = values.collect();
        let upper = values.iter().map(|[x, _, high]| self.place([self.x.fraction(*x), inside(*high)]));
        let lower = values.iter().rev().map(|[x, low, _]| self.place([self.x.fraction(*x), inside(*low)]));
        drawing.area(&upper.chain(lower).collect::<Vec<_>>(), paint);
    }

    /// Draws points, or their density where there are too many of them.
    pub fn scatter(&self, drawing: &mut Drawing, name: &str, values: &[[f64; 2]], radius: f64, paint: Paint) {
        if values.len() > MOST_POINTS {
            return self.density(drawing, name, values, paint.ink);
        }
        drawing.record(name, &[], values.concat());
        let inside = values.iter().filter(|&&value| self.holds(value));
        drawing.dots(inside.map(|&value| self.at(value)).collect(), radius, paint);
    }

    /// Draws squares as dark as they are full of points.
    pub fn density(&self, drawing: &mut Drawing, name: &str, values: &[[f64; 2]], ink: Ink) {
        let points = values.iter().filter(|&&value| self.holds(value)).map(|&value| self.at(value));
        let [left, top] = self.corner;
        let (columns, rows) = ((self.width / SQUARE) as usize + 1, (self.height / SQUARE) as usize + 1);
        let mut counts = vec![0_u32; columns * rows];
        for [x, y] in points {
            let (column, row) = (((x - left) / SQUARE) as usize, ((y - top) / SQUARE) as usize);
            counts[row.min(rows - 1) * columns + column.min(columns - 1)] += 1;
        }
        let middle = |square: usize| {
            let along = |place: usize, length: f64| (place as f64 + 0.5) * SQUARE / length;
            let (x, y) = (along(square % columns, self.width), along(square / columns, self.height));
            [self.x.value(x), self.y.value(1.0 - y), f64::from(counts[square])]
        };
        let full = (0..counts.len()).filter(|&square| counts[square] > 0);
        drawing.record(name, &["n"], full.flat_map(middle).collect());
        let most = counts.iter().copied().max().unwrap_or(0);
        let shade = |count: u32| match count {
            0 => None,
            count if most <= 1 => Some(count as usize * SHADES - 1),
            count => {
                let share = libm::log(f64::from(count)) / libm::log(f64::from(most));
                Some(((share * SHADES as f64) as usize).min(SHADES - 1))
            }
        };
        for level in 0..SHADES {
            let full = (0..counts.len()).filter(|&square| shade(counts[square]) == Some(level));
            let squares = full.flat_map(|square| {
                let corner =
                    [left + (square % columns) as f64 * SQUARE, top + (square / columns) as f64 * SQUARE];
                rectangle(corner, SQUARE, SQUARE)
            });
            let opacity = 0.15 + 0.85 * (level + 1) as f64 / SHADES as f64;
            drawing.path(squares.collect(), Some(ink.thin(opacity)), None);
        }
    }

    /// Draws estimates as points, with bars from limit to limit: along y, or along x where rows have names.
    pub fn estimates(&self, drawing: &mut Drawing, name: &str, estimates: &[Estimate], ink: Ink) {
        let row = |of: &Estimate| [of.at[0], of.at[1], of.low, of.high, of.n];
        drawing.record(name, &["low", "high", "n"], estimates.iter().flat_map(row).collect());
        for &Estimate { at: [x, y], low, high, radius, .. } in estimates.iter().filter(|of| self.holds(of.at))
        {
            // A value without limits has no bar.
            let ends = [low, high].map(|end| match self.y.names.is_empty() {
                true => [x, end.clamp(self.y.low, self.y.high)],
                false => [end.clamp(self.x.low, self.x.high), y],
            });
            if ends.as_flattened().iter().all(|end| !end.is_nan()) {
                drawing.line(&ends.map(|end| self.at(end)), ink.line(0.8));
            }
            drawing.dots(vec![self.at([x, y])], radius, ink.full());
        }
    }

    /// Draws faint lines through the rows that have names.
    pub fn rows(&self, drawing: &mut Drawing) {
        for row in 0..self.y.names.len() {
            let y = row as f64;
            self.line(drawing, &[[self.x.low, y], [self.x.high, y]], Ink::Rule.line(0.3));
        }
    }

    /// Writes words at fractions of width and height.
    pub fn note(&self, drawing: &mut Drawing, [x, y]: [f64; 2], anchor: Anchor, label: Label) {
        let [left, top] = self.corner;
        drawing.text([left + x * self.width, top + y * self.height], anchor, TICK_LETTERS, Ink::Muted, label);
    }
}

/// A point with limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    pub at: [f64; 2],
    pub low: f64,
    pub high: f64,
    /// Number of cases; not a number where none are counted.
    pub n: f64,
    /// Of its dot, points.
    pub radius: f64,
}

/// By how much dots are larger where there are few of them.
pub fn dot_scale(count: usize) -> f64 {
    if count < FEW_POINTS { 1.8 } else { 1.0 }
}

/// The part of a line between shares that lies within 0 and 1, if any does (Liang & Barsky).
fn clipped([from, to]: [Point; 2]) -> Option<[Point; 2]> {
    if ![from, to].iter().flatten().all(|share| share.is_finite()) {
        return None;
    }
    let run = [to[0] - from[0], to[1] - from[1]];
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for axis in [0, 1] {
        if run[axis] == 0.0 {
            if !(0.0..=1.0).contains(&from[axis]) {
                return None;
            }
            continue;
        }
        let ends = [-from[axis] / run[axis], (1.0 - from[axis]) / run[axis]];
        enters = enters.max(ends[0].min(ends[1]));
        leaves = leaves.min(ends[0].max(ends[1]));
    }
    let along = |share: f64| match share {
        0.0 => from,
        1.0 => to,
        _ => [from[0] + share * run[0], from[1] + share * run[1]],
    };
    (enters <= leaves).then(|| [along(enters), along(leaves)])
}

/// The mark of an entry of a legend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    Dot(Paint),
    Line(Stroke),
    /// A point with a bar.
    Bar(Ink),
}

const MARK_WIDTH: f64 = 14.0;
const BETWEEN: f64 = 12.0;
const LEGEND_LINE: f64 = 12.0;

/// Where the entries of a legend lie in a figure of this width: side by side, and on further lines where they are too long for that.
pub fn legend_places(
    entries: &[(Mark, Label)],
    [left, top]: Point,
    width: f64,
) -> impl Iterator<Item = Point> {
    let [mut x, mut y] = [left, top];
    entries.iter().map(move |(_, label)| {
        let long = MARK_WIDTH + 3.0 + label.width(LETTERS);
        if x > left && x + long > width {
            [x, y] = [left, y + LEGEND_LINE];
        }
        let place = [x, y];
        x += long + BETWEEN;
        place
    })
}

/// Draws a legend from its upper left corner.
pub fn legend(drawing: &mut Drawing, at: Point, entries: &[(Mark, Label)]) {
    let places: Vec<Point> = legend_places(entries, at, drawing.width).collect();
    for ((mark, label), [left, y]) in entries.iter().zip(places) {
        let middle = [left + 0.5 * MARK_WIDTH, y - 2.6];
        match *mark {
            Mark::Dot(paint) => drawing.dots(vec![middle], 2.0, Paint { opacity: 1.0, ..paint }),
            Mark::Line(stroke) => drawing.line(&[[left, middle[1]], [left + MARK_WIDTH, middle[1]]], stroke),
            Mark::Bar(ink) => {
                let ends = [-4.5, 4.5].map(|height| [middle[0], middle[1] + height]);
                drawing.line(&ends, ink.line(0.8));
                drawing.dots(vec![middle], 1.8, ink.full());
            }
        }
        drawing.text([left + MARK_WIDTH + 3.0, y], Anchor::Start, LETTERS, Ink::Text, label.clone());
    }
}
