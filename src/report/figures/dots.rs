//! Dot plots: named rows, each with a point and a bar from limit to limit. Most figures of comparisons are this one.

use crate::report::axis::Axis;
use crate::report::drawing::{Dash, Drawing, Ink, TWO_COLUMNS};
use crate::report::panel::{Estimate, Mark, Panel, legend};
use crate::report::text::Label;

/// Height of a row, points.
const ROW: f64 = 12.0;
/// Height of a row where there are many.
const NARROW_ROW: f64 = 9.0;
const MANY: usize = 16;
/// Bounds of the room for names.
const NAMES: [f64; 2] = [40.0, 190.0];
/// Room above the rows for a title, below them for the axis, and to their right.
const TITLE: f64 = 17.0;
const BELOW: f64 = 28.0;
const RIGHT: f64 = 12.0;
/// Room for a legend.
const LEGEND: f64 = 15.0;

/// A panel of named rows.
pub struct Dots {
    pub title: Label,
    pub x: Axis,
    pub names: Vec<String>,
    /// Name, colour and points; y of a point is the number of its row.
    pub series: Vec<(&'static str, Ink, Vec<Estimate>)>,
    /// A value to compare with.
    pub mark: Option<f64>,
}

/// A point in a row.
pub fn estimate(row: f64, [value, low, high]: [f64; 3], n: f64) -> Estimate {
    Estimate { at: [value, row], low, high, n, radius: 1.8 }
}

/// A name that fits into a width, points.
fn shortened(name: &str, width: f64) -> String {
    let fits = |name: &str| Label::plain(name).width(7.0) <= width;
    if fits(name) {
        return name.to_string();
    }
    let cut = |end: usize| name.chars().take(end).chain(['\u{2026}']).collect::<String>();
    (0..name.chars().count()).rev().map(cut).find(|name| fits(name)).unwrap_or_default()
}

/// Draws panels below each other, or two beside each other where `columns` is 2.
pub fn draw(panels: &[Dots], columns: usize) -> Drawing {
    let names = panels.iter().flat_map(|panel| &panel.names);
    let widest = names.map(|name| Label::plain(name.as_str()).width(7.0)).fold(0.0, f64::max);
    let across = TWO_COLUMNS / columns as f64;
    let left = (widest + 12.0).clamp(NAMES[0], NAMES[1].max(0.5 * across));
    let height = |panel: &Dots| {
        let row = if panel.names.len() > MANY { NARROW_ROW } else { ROW };
        row * panel.names.len() as f64
    };
    let above = if panels[0].series.len() > 1 { LEGEND } else { 0.0 };
    let mut places = Vec::new();
    let mut top = above;
    for row in panels.chunks(columns) {
        for (column, _) in row.iter().enumerate() {
            places.push([column as f64 * across + left, top + TITLE]);
        }
        top += TITLE + row.iter().map(height).fold(0.0, f64::max) + BELOW;
    }
    let mut drawing = Drawing::new(TWO_COLUMNS, top);
    if above > 0.0 {
        let of = |(name, ink, _): &(&'static str, Ink, _)| (Mark::Bar(*ink), Label::plain(*name));
        let entries: Vec<(Mark, Label)> = panels[0].series.iter().map(of).collect();
        legend(&mut drawing, [left, 10.0], &entries);
    }
    for (of, corner) in panels.iter().zip(places) {
        let (width, height) = (across - left - RIGHT, height(of));
        let names = of.names.iter().map(|name| shortened(name, left - 12.0)).collect();
        let panel = Panel { corner, width, height, x: of.x.clone(), y: Axis::names(names) };
        panel.rows(&mut drawing);
        if let Some(mark) = of.mark {
            let [top, bottom] = [panel.y.low, panel.y.high];
            panel.line(&mut drawing, &[[mark, bottom], [mark, top]], Ink::Muted.dashed(0.7, Dash::Short));
        }
        for (name, ink, estimates) in &of.series {
            panel.estimates(&mut drawing, name, estimates, *ink);
        }
        panel.frame(&mut drawing, of.title.clone().bold());
    }
    drawing
}
