//! Answers and responses in a reader's words, and the HTML page.
//!
//! ```text
//! page       the HTML page: sections of tables and figures
//! answers    objects with their rates, in a reader's words
//! probabilities  rows of probabilities
//! object     the page of one object
//! list       of several
//! compare    of two evaluations
//! fragility  of objects without a hazard
//! response   of a response over time, and the block as it moves
//! workbook   a table as a workbook
//! ```

pub mod answers;
pub mod compare;
pub mod fragility;
pub mod list;
pub mod object;
mod page;
mod probabilities;
pub mod response;
mod workbook;

pub use page::{Page, Section, Table, Tile};
pub use workbook::workbook;
