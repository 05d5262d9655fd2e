//! The report: figures, and one HTML page that holds all.
//!
//! ```text
//! figure     a figure as data: panels of layers
//! draw       a figure as SVG and PNG; axis: ranges and ticks
//! page       the HTML page: sections of tables and figures
//! text       marked text
//! ```

mod axis;
mod draw;
mod figure;
mod page;
pub mod text;

pub use draw::{png, svg, svg_in_page};
pub use figure::{Axis, Dash, Estimate, Figure, Ink, Layer, Marks, Panel, Scale};
pub use page::{Column, Page, Section, Table};
