//! A figure, the places of its panels, and long series cut to what can be seen.

use super::drawing::{Drawing, ONE_COLUMN, TWO_COLUMNS};
use super::panel::{Mark, legend, legend_places};
use super::text::Label;

/// A drawing with its name, title and caption.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of its files.
    pub name: String,
    pub title: String,
    pub caption: String,
    /// What made it, in a sentence: for its files, which may be alone.
    pub made: String,
    pub drawing: Drawing,
}

impl Figure {
    /// Joins the caption and what made the figure.
    pub fn description(&self) -> String {
        format!("{} {}", self.caption, self.made).trim_end().to_string()
    }
}

/// The places of panels side by side: one in a column, or two across the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Number of panels.
    pub count: usize,
    /// Number of panels in a row.
    pub columns: usize,
    /// Width of the figure, points.
    pub width: f64,
    /// Height of the area of the data of a panel, points.
    pub panel_height: f64,
    /// Room above the first row, points.
    pub above: f64,
}

/// Room to the left of a panel, for ticks and the label of the axis, points.
const LEFT: f64 = 40.0;
/// Room to its right.
const RIGHT: f64 = 9.0;
/// Room above it, for its title.
const TITLE: f64 = 17.0;
/// Room below it, for ticks and the label of the axis.
const BELOW: f64 = 28.0;
/// Where a legend begins.
const LEGEND: [f64; 2] = [LEFT, 10.0];

impl Grid {
    /// Puts one panel into the width of a column, more in pairs across the page.
    pub fn of(count: usize, panel_height: f64) -> Grid {
        let columns = count.clamp(1, 2);
        let width = if columns == 1 { ONE_COLUMN } else { TWO_COLUMNS };
        Grid { count, columns, width, panel_height, above: 0.0 }
    }

    /// Adds room for a legend of these entries, and makes a drawing of the size of all panels that has it.
    pub fn with_legend(self, entries: &[(Mark, Label)]) -> (Grid, Drawing) {
        let [_, last] = legend_places(entries, LEGEND, self.width).last().unwrap_or(LEGEND);
        let grid = Grid { above: last + 5.0, ..self };
        let mut drawing = grid.drawing();
        legend(&mut drawing, LEGEND, entries);
        (grid, drawing)
    }

    /// Makes an empty drawing of the size of all panels.
    pub fn drawing(&self) -> Drawing {
        let rows = self.count.div_ceil(self.columns) as f64;
        Drawing::new(self.width, self.above + rows * (TITLE + self.panel_height + BELOW))
    }

    /// Places a panel: corner and width of the area of its data.
    pub fn place(&self, index: usize) -> ([f64; 2], f64) {
        let across = self.width / self.columns as f64;
        let (column, row) = ((index % self.columns) as f64, (index / self.columns) as f64);
        let left = column * across + LEFT;
        let top = self.above + row * (TITLE + self.panel_height + BELOW) + TITLE;
        ([left, top], across - LEFT - RIGHT)
    }
}

/// A series cut down to equal steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Envelope {
    /// Number of samples of the whole series in a step.
    pub each: usize,
    pub values: Vec<f64>,
}

/// Cuts a series down to `most` values: to the least and the largest value of each of `most` / 2 buckets, in the order in which
/// they come. A series that is not longer stays as it is.
pub fn envelope(values: &[f64], most: usize) -> Envelope {
    let each = values.len().div_ceil(most).max(1);
    if each == 1 {
        return Envelope { each, values: values.to_vec() };
    }
    let ends = values.chunks(2 * each).flat_map(|bucket| {
        let best = |better: fn(f64, f64) -> bool| {
            (1..bucket.len()).fold(0, |best, at| if better(bucket[at], bucket[best]) { at } else { best })
        };
        let (least, largest) = (best(|a, b| a < b), best(|a, b| a > b));
        [bucket[least.min(largest)], bucket[least.max(largest)]]
    });
    Envelope { each, values: ends.collect() }
}
