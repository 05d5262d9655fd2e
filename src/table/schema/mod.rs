//! Every column of every file, once; and what a table is.
//!
//! ```text
//! column      name, type, unit, meaning
//! dictionary  all columns
//! table       columns in order, and the stage that writes them
//! ```

mod column;
mod dictionary;
mod table;

pub use column::{Column, Kind};
pub use dictionary::*;
pub use table::{Table, is_spectral_acceleration, joined, same, spectral_acceleration_name};
