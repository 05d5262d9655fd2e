//! Figure 6: the tree of outcomes with its numbers.

use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData};
use crate::report::drawing::{Anchor, Drawing, Ink, Point, rectangle};
use crate::report::figure::{Figure, Grid};
use crate::report::plotted::Plotted;
use crate::report::text::{Label, number};
use crate::rocking::Outcome;

const HEIGHT: f64 = 112.0;
const BOX: Point = [50.0, 24.0];

/// Draws one tree a group.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let grid = Grid::of(data.groups.len(), HEIGHT - 28.0);
    let mut drawing = grid.drawing();
    for (index, group) in data.groups.iter().enumerate() {
        let ([left, top], width) = grid.place(index);
        tree(&mut drawing, group, data.limit, [left - 30.0, top], width + 30.0);
    }
    let caption = format!(
        "Motions, and the share of those of the box before. The share of failure is of those that rock: they overturn or exceed the limit state (Eq. 12). {}",
        super::of_paper("Figure 6")
    );
    vec![Figure {
        name: "tree".to_string(),
        title: "The tree of outcomes".to_string(),
        caption,
        made: String::new(),
        drawing,
    }]
}

/// A box of the tree.
struct Node {
    /// Column, and height as a fraction of the tree's.
    at: Point,
    words: Label,
    count: usize,
    /// Index of the box before it.
    parent: Option<usize>,
    ink: Ink,
}

fn tree(drawing: &mut Drawing, group: &Group, limit: Option<f64>, [left, top]: Point, width: f64) {
    let all = group.responses.len();
    let overturned = group.count(Outcome::Overturning);
    let safe = group.count(Outcome::SafeRocking);
    let node =
        |at, words: &str, count, parent, ink| Node { at, words: Label::marked(words), count, parent, ink };
    let mut nodes = vec![
        node([0.0, 0.5], "motions", all, None, Ink::Text),
        node([1.0, 0.12], "no rocking", group.count(Outcome::NoRocking), Some(0), Ink::Muted),
        node([1.0, 0.6], "rocking", overturned + safe, Some(0), Ink::Text),
        node([2.0, 0.88], "overturning", overturned, Some(2), Ink::Data(1)),
        node([2.0, 0.36], "safe rocking", safe, Some(2), Ink::Data(0)),
    ];
    if let Some(limit) = limit {
        let above = group.safe().filter(|response| response.case.edp > limit).count();
        let limit = number::plain(limit);
        nodes.push(node([3.0, 0.12], &format!("up to {limit} *α*"), safe - above, Some(4), Ink::Data(0)));
        nodes.push(node([3.0, 0.5], &format!("above {limit} *α*"), above, Some(4), Ink::Data(1)));
        if overturned + safe > 0 {
            let share = (overturned + above) as f64 / (overturned + safe) as f64;
            let label = Label::marked(&format!("failure {}", number::short(share)));
            drawing.text(
                [left + width - 0.5 * BOX[0], top + 0.92 * HEIGHT - 16.0],
                Anchor::Middle,
                8.0,
                Ink::Text,
                label,
            );
        }
    }
    let place = |[column, height]: Point| {
        [left + column / 3.0 * (width - BOX[0]), top + height * (HEIGHT - 30.0) - 0.5 * BOX[1] + 8.0]
    };
    for node in &nodes {
        if let Some(parent) = node.parent {
            let ([from_x, from_y], [to_x, to_y]) = (place(nodes[parent].at), place(node.at));
            let ends = [[from_x + BOX[0], from_y + 0.5 * BOX[1]], [to_x, to_y + 0.5 * BOX[1]]];
            drawing.line(&ends, Ink::Muted.line(0.7));
        }
    }
    for Node { at, words, count, parent, ink } in &nodes {
        let [x, y] = place(*at);
        drawing.path(
            rectangle([x, y], BOX[0], BOX[1]).to_vec(),
            Some(Ink::Paper.full()),
            Some(ink.line(1.0)),
        );
        let middle = x + 0.5 * BOX[0];
        drawing.text([middle, y + 10.0], Anchor::Middle, 7.2, Ink::Text, words.clone());
        let share = parent
            .map(|parent| nodes[parent].count)
            .filter(|count| *count > 0)
            .map(|of| 100.0 * *count as f64 / of as f64);
        let share = share.map_or(String::new(), |share| {
            format!(" ({} %)", number::fixed(share, if share < 10.0 { 1 } else { 0 }))
        });
        let label = Label::plain(format!("{}{share}", number::count(*count)));
        drawing.text([middle, y + 20.0], Anchor::Middle, 6.6, Ink::Text, label);
    }
    let title = Label::plain(group.name()).bold();
    drawing.text([left, top - 7.0], Anchor::Start, 8.0, Ink::Text, title.clone());
    let names: Vec<String> = nodes.iter().map(|node| node.words.words()).collect();
    let counts = nodes.iter().enumerate().flat_map(|(row, node)| [node.count as f64, row as f64]);
    drawing.record("motions", &[], counts.collect());
    let (series, axes) = (
        std::mem::take(&mut drawing.series),
        [Axis::linear([0.0, 1.0], Label::plain("count")), Axis::names(names)],
    );
    drawing.plotted.push(Plotted { title, corner: [left, top], size: [0.0, 0.0], axes, series });
}
