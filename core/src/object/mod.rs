//! Objects: their properties and location, the directions in which they can fall, and the uncertainty of
//! each.
//!
//! ```text
//! changes    changes of an object that change its probability of overturning
//! contacts   what it strikes: a base, a wall
//! field      the numbers that may be known, with the ranges in which they are possible
//! given      an object as given: dimensions, or p, alpha and eta; ground or floor
//! sides      its rocking structures, and their uncertainty
//! rocking    its directions with their models, and their uncertainty
//! ```

mod changes;
mod contacts;
mod field;
mod given;
mod rocking;
mod sides;

pub use changes::Changed;
pub use contacts::{Base, Wall};
pub use field::{Entry, Field};
pub use given::{Object, ObjectError, Place, Restitution, Shape};
pub use rocking::{LowHigh, RockingObject, SD_OF_PERIOD, UncertaintySource, structure_warnings};
pub use sides::Side;
