//! What a drawing shows, as data: for a table of it, and to point at.

use super::axis::Axis;
use super::text::{Label, number};

/// The data of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Plotted {
    pub title: Label,
    /// Upper left corner of the area of the data, points.
    pub corner: [f64; 2],
    /// Its width and height.
    pub size: [f64; 2],
    pub axes: [Axis; 2],
    pub series: Vec<Series>,
}

/// Points of one kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub name: String,
    /// What each point has besides x and y: limits of y (or of x, where y is a name), or how many cases it stands for.
    pub further: &'static [&'static str],
    /// Point by point.
    pub values: Vec<f64>,
}

impl Series {
    /// Iterates over the points.
    pub fn points(&self) -> impl Iterator<Item = &[f64]> {
        self.values.chunks_exact(2 + self.further.len())
    }
}

/// Heads of the table of a figure.
const HEADS: [&str; 9] = ["panel", "series", "x_is", "x", "y_is", "y", "low", "high", "n"];

/// Writes all that a figure shows as comma-separated values.
///
/// # Errors
/// If memory runs out.
pub fn csv(panels: &[Plotted]) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(HEADS)?;
    for Plotted { title, axes, series, .. } in panels {
        let (title, of_axes) = (title.words(), axes.each_ref().map(|axis| axis.label.words()));
        for of in series {
            for point in of.points() {
                let place = |axis: usize| match axes[axis].names.get(point[axis] as usize) {
                    Some(name) => name.clone(),
                    None => number::machine(point[axis]),
                };
                let further = HEADS[6..].iter().map(|head| {
                    let at = of.further.iter().position(|name| name == head);
                    at.map_or(String::new(), |at| number::machine(point[2 + at]))
                });
                let [x_is, y_is] = of_axes.clone();
                let first = [title.clone(), of.name.clone(), x_is, place(0), y_is, place(1)];
                writer.write_record(first.into_iter().chain(further))?;
            }
        }
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}
