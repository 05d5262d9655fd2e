//! Objects: their properties and location, the directions in which they can fall, and the uncertainty of
//! each.

mod changes;
mod contacts;
mod field;
mod given;
mod pedestal;
mod rocking;
mod sides;

pub use changes::Changed;
pub use contacts::{Base, Wall};
pub use field::{Entry, Field};
pub use given::{Object, ObjectError, Place, Restitution, Shape};
pub use pedestal::stacked;
pub use rocking::{LowHigh, RockingObject, SD_OF_PERIOD, UncertaintySource, structure_warnings};
pub use sides::Side;
