//! Every column of every file, once.
//!
//! ```text
//! column       name, type, unit, words
//! table        columns in order, and the stage that writes them
//! scenario, motion, response, pex, pro, ranking, evaluated, validation, universality, ida, paper
//!              the columns of a subject and the tables that have them
//! ```

mod column;
mod evaluated;
mod ida;
mod motion;
mod paper;
mod pex;
mod pro;
mod ranking;
mod response;
mod scenario;
mod table;
mod universality;
mod validation;

pub use column::{Column, Kind};
pub use evaluated::*;
pub use ida::*;
pub use motion::*;
pub use paper::*;
pub use pex::*;
pub use pro::*;
pub use ranking::*;
pub use response::*;
pub use scenario::*;
pub use table::{Table, is_spectral_acceleration, spectral_acceleration_name};
pub use universality::*;
pub use validation::*;
