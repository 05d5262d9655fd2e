//! What several stages have: objects and models as options, and what they read: motions, responses.

pub mod fits;
pub mod model_args;
pub mod motion_columns;
pub mod motions;
pub mod objects;
pub mod observed;
pub mod reading_args;
pub mod responses;
