//! The response of a free-standing rocking block or frame to a ground motion (section 2.2): see `reference`.

mod batch;
mod body;
mod incremental;
mod lanes;
mod polynomial;
mod record;
pub mod reference;
mod response;
mod roots;
mod step;
mod structure;
mod taylor;
mod uplift;
mod vector;

pub use batch::{simulate, simulate_all};
pub use body::Body;
pub use incremental::{Capacity, CapacityStatus, Scan, ScanPoint, ScanResponse};
pub use lanes::Problem;
pub use record::{Ground, Record, RecordError};
pub use reference::{SolverEvent, TracePoint, trace};
pub use response::{Outcome, Response};
pub use structure::{Structure, StructureError, frame_eta, frame_p, housner_eta, rectangular_p};
