//! What the marks of a figure mean.

use super::drawing::{Anchor, Drawing, Ink, Paint, Point, Step, Stroke, rectangle};
use super::label::Label;
use super::panel::LETTERS;

/// How a thing is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// As dots.
    Dot(Paint),
    /// As a line.
    Line(Stroke),
    /// As an area.
    Area(Paint),
    /// As circles sized by count.
    Circle(Ink),
}

const MARK_WIDTH: f64 = 14.0;
const BETWEEN: f64 = 12.0;

/// One line of marks and words, which begins here.
pub fn legend(drawing: &mut Drawing, at: Point, entries: &[(Mark, Label)]) {
    let [mut x, y] = at;
    for (mark, label) in entries {
        let (left, middle) = (x, [x + 0.5 * MARK_WIDTH, y - 2.6]);
        match *mark {
            Mark::Dot(paint) => drawing.dots(vec![middle], 2.0, Paint { opacity: 1.0, ..paint }),
            Mark::Line(stroke) => drawing.line(&[[left, middle[1]], [left + MARK_WIDTH, middle[1]]], stroke),
            Mark::Area(paint) => {
                let corner = [left, middle[1] - 3.0];
                let steps = rectangle(corner, MARK_WIDTH, 6.0);
                drawing.path(steps.to_vec(), Some(paint), None);
            }
            Mark::Circle(ink) => {
                let circle = vec![Step::Circle(middle, 3.0)];
                drawing.path(circle, Some(ink.thin(0.25)), Some(ink.line(0.6)));
            }
        }
        x += MARK_WIDTH + 3.0;
        drawing.text([x, y], Anchor::Start, LETTERS, Ink::Text, label.clone());
        x += label.width(LETTERS) + BETWEEN;
    }
}
