//! The report: figures, and one HTML page that holds all.
//!
//! ```text
//! data       the data of a report
//! figures    one file a figure: data -> drawing and caption
//! figure     a figure, the places of its panels, and long series cut to what can be seen
//! panel      axes (axis), data within them, and the legend; plotted: the same as data
//! text       labels with italics and subscripts; numbers as text
//! drawing    paths, dots and text
//! svg, png   a drawing as a picture; font: the letters
//! page       the HTML page; findings: its first page; page_data: what its scripts work on
//! ```

mod axis;
pub mod data;
mod drawing;
mod figure;
mod figures;
mod findings;
mod font;
mod page;
mod page_data;
mod panel;
mod plotted;
mod png;
mod svg;
mod text;

pub use drawing::Drawing;
pub use figure::Figure;
pub use figures::{ALL, Draw, Part};
pub use page::{Page, page};
pub use plotted::csv;
pub use png::png;
pub use svg::{Place, svg};
pub use text::number;
