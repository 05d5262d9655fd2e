//! A figure and what stands under it.

use super::drawing::{Drawing, ONE_COLUMN, TWO_COLUMNS};

/// A figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The name of its files.
    pub name: String,
    /// What it shows, in a few words.
    pub title: String,
    /// What one must know to read it.
    pub caption: String,
    /// The figure itself.
    pub drawing: Drawing,
}

/// Places of panels side by side: one in a column, or two across the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Panels.
    pub count: usize,
    /// Panels in a row.
    pub columns: usize,
    /// Width of the figure, points.
    pub width: f64,
    /// Height of the area of the data of a panel, points.
    pub panel_height: f64,
    /// Room above the first row, points.
    pub above: f64,
}

/// Room to the left of a panel for ticks and the label of the axis.
const LEFT: f64 = 40.0;
/// To its right.
const RIGHT: f64 = 9.0;
/// Above it, for its title.
const TITLE: f64 = 17.0;
/// Below it, for ticks and the label of the axis.
const BELOW: f64 = 28.0;

impl Grid {
    /// One panel in the width of a column, more in pairs across the page.
    pub fn of(count: usize, panel_height: f64) -> Grid {
        let columns = count.clamp(1, 2);
        let width = if columns == 1 { ONE_COLUMN } else { TWO_COLUMNS };
        Grid { count, columns, width, panel_height, above: 0.0 }
    }

    /// With this room for a legend.
    pub fn with_legend(self) -> Grid {
        Grid { above: 15.0, ..self }
    }

    /// An empty drawing of the size of all.
    pub fn drawing(&self) -> Drawing {
        let rows = self.count.div_ceil(self.columns) as f64;
        Drawing::new(self.width, self.above + rows * (TITLE + self.panel_height + BELOW))
    }

    /// Corner and width of the area of the data of a panel.
    pub fn place(&self, index: usize) -> ([f64; 2], f64) {
        let across = self.width / self.columns as f64;
        let (column, row) = ((index % self.columns) as f64, (index / self.columns) as f64);
        let left = column * across + LEFT;
        let top = self.above + row * (TITLE + self.panel_height + BELOW) + TITLE;
        ([left, top], across - LEFT - RIGHT)
    }

    /// Where a legend begins.
    pub fn legend_at(&self) -> [f64; 2] {
        [LEFT, 10.0]
    }
}
