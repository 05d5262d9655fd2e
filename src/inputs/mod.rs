//! The files that people bring: from bytes to tables, and from tables to what they are about.
//!
//! ```text
//! unpack       gzip and zip
//! decode       bytes to text: UTF-8, UTF-16, Windows-1252, Shift JIS, any ends of lines
//! workbook     sheets of .xlsx, .xls and .ods
//! separated    rows of a text
//! layout       which rows of a file or sheet are headings, units, remarks, sections and data
//! grid         cells under headings, with the line of each
//! heading      names and units
//! numbers      which signs are decimal and which stand between thousands, settled for a whole table
//! reader       headings that the user names or leaves out
//! reading      how a file was read
//! hazard       the hazard of a site
//! roles        what the columns of a list say
//! remarks      what texts of a list say of units, anchors and floors
//! objects      lists of objects
//! intensities  tables of motions by their peaks
//! about        tables about records
//! records      records in the formats of networks
//! floors       floors as people write them: level and first period
//! words        words of lists in several languages
//! error        what is wrong with a file
//! ```

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
