//! The report: figures, and one HTML page that holds all.
//!
//! ```text
//! figure     a figure as data: panels of layers
//! draw       a figure as SVG and PNG; axis: ranges and ticks
//! pen        texts, lines, areas and dots of a drawing
//! text       marked text
//! page       the HTML page: sections of tables and figures
//! rated      objects with their rates, in a reader's words
//! portrait   what the page of one object shows beside its row
//! object     the page of one object
//! list       of several
//! compare    of two evaluations
//! response   of a response over time, and the block as it moves
//! figures    of responses and fits, those of the paper among them
//! workbook   a table as a workbook
//! ```

mod axis;
pub mod compare;
mod draw;
mod figure;
pub mod figures;
pub mod list;
pub mod object;
mod page;
mod pen;
pub mod portrait;
pub mod rated;
pub mod response;
pub mod text;
mod workbook;

pub use draw::{DPI, png, svg};
pub use figure::{Axis, Dash, Estimate, Figure, Frame, Ink, Layer, Marks, Panel, Scale, Side, Words};
pub use page::{Column, Page, Section, Table, Tile, made_in_words};
pub use workbook::workbook;
