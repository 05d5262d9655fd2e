//! The files that people bring: from bytes to tables, and from tables to what they are about.

mod about;
mod decode;
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
mod reading;
pub mod records;
mod remarks;
mod roles;
mod separated;
mod unpack;
pub mod words;
mod workbook;

pub use about::About;
pub use decode::decode;
pub use error::{InputError, Result};
pub use floors::Building;
pub use grid::{Grid, SECTION};
pub use heading::Heading;
pub use numbers::plain_number;
pub use reader::{Reader, Rename};
pub use reading::{ColumnReading, Meaning, Reading};
pub use roles::is_of_list;
pub use unpack::{Member, unpack};
