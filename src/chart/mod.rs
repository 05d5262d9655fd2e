//! Figures as data, and as SVG and PNG.
//!
//! ```text
//! figure     a figure as data: panels of layers; its numbers as CSV
//! draw       a figure as SVG and PNG; axis: ranges and ticks
//! pen        texts, lines, areas and dots of a drawing
//! text       marked text
//! ```

mod axis;
mod draw;
mod figure;
mod pen;
pub mod text;

pub use draw::{DPI, html_of_panels, png, svg};
pub use figure::{Axis, Dash, Figure, Frame, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Words};
pub use pen::round;
