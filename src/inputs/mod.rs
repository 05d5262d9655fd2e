//! The files that people bring: from bytes to tables, and from tables to what they are about.

mod about;
mod bytes;
mod error;
mod floors;
mod grid;
pub mod hazard;
mod heading;
pub mod intensities;
mod layout;
mod numbers;
pub mod objects;
mod reader;
pub mod records;
mod roles;
mod separated;
pub mod words;
mod workbook;

pub use about::About;
pub use bytes::{Member, decode, unpack};
pub use error::{InputError, Result};
pub use floors::Building;
pub use grid::{Grid, SECTION};
pub use heading::Heading;
pub use numbers::plain_number;
pub use reader::{ColumnReading, Meaning, Reader, Reading, Rename};
pub use roles::is_of_list;
