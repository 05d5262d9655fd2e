//! What several stages have: the options of structures and fits, and motions as simulate and ida take them.

pub mod fit_tables;
pub mod hazard;
pub mod model_args;
pub mod motions;
pub mod object_list;
pub mod objects;
pub mod responses;
pub mod spec;
