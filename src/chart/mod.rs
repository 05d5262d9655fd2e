//! Figures as data, and as SVG and PNG.
//!
//! ```text
//! figure     a figure as data: panels of layers; its numbers as CSV
//! draw       a figure as SVG and PNG; axis: ranges and ticks
//! picture    texts, lines, areas and dots at their places
//! text       marked text
//! ```

mod axis;
mod draw;
mod figure;
mod picture;
pub mod text;

pub use draw::{DPI, html_of_panels, png, svg};
pub use figure::{Axis, Dash, Figure, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Symbol, Words};
pub use picture::round;
