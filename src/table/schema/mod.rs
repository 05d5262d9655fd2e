//! Every column of every file, once; and what a table is.
//!
//! ```text
//! column      name, type, unit, meaning
//! dictionary  all columns; headings other names of them in files of others
//! table       columns in order, and the stage that writes them
//! ```

mod column;
mod dictionary;
pub mod headings;
mod table;

pub use column::{Column, Kind};
pub use dictionary::*;
pub use table::{Table, is_spectral_acceleration, joined, same, spectral_acceleration_name};
