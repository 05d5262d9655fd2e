//! The report that people look at: figures and one page that holds all.
//!
//! ```text
//! material  what a report is made of
//! figures   one file a figure: material -> drawing and caption
//! figure    a figure and what stands under it; the places of its panels
//! panel     axes, and data within them; axis, legend
//! bins      values gathered; envelope: long series cut down to what can be seen
//! label     words with italics and subscripts; number: numbers in words
//! drawing   paths, dots and text
//! svg, png  a drawing as a picture; font: the letters
//! page      all of it in one HTML page
//! ```

mod axis;
mod bins;
mod drawing;
mod envelope;
mod figure;
mod figures;
mod font;
mod label;
mod legend;
pub mod material;
mod number;
mod page;
mod panel;
mod png;
mod svg;

pub use drawing::Drawing;
pub use figure::Figure;
pub use figures::{ALL, Draw};
pub use page::{Page, page};
pub use png::png;
pub use svg::{Place, svg};
