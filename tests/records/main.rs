//! Files of records in the formats of the networks.

mod formats;
mod slips;
mod traits;
mod writers;
