//! The report: figures, and one HTML page that holds all.
//!
//! ```text
//! figure     a figure as data: panels of layers
//! draw       a figure as SVG and PNG; axis: ranges and ticks
//! pen        texts, lines, areas and dots of a drawing
//! text       marked text
//! page       the HTML page: sections of tables and figures
//! answers    objects with their rates, in a reader's words
//! probabilities  rows of probabilities
//! object     the page of one object
//! list       of several
//! compare    of two evaluations
//! fragility  of objects without a hazard
//! response   of a response over time, and the block as it moves
//! figures    of responses and fits, those of the paper among them
//! workbook   a table as a workbook
//! ```

pub mod answers;
mod axis;
pub mod compare;
mod draw;
mod figure;
pub mod figures;
pub mod fragility;
pub mod list;
pub mod object;
mod page;
mod pen;
mod probabilities;
pub mod response;
pub mod text;
mod workbook;

pub use draw::{DPI, png, svg};
pub use figure::{
    Axis, Dash, Figure, Frame, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Scale, Words,
};
pub use page::{Page, Section, Table, Tile};
pub use workbook::workbook;
