//! What several stages have: the options of structures and fits, and motions as simulate and ida take them.

pub mod fits;
pub mod fitted;
pub mod hazard;
pub mod motions;
pub mod responses;
pub mod structures;
