//! The response of a free-standing rocking block or frame to a ground motion (section 2.2).
//!
//! ```text
//! structure    p, alpha and eta, and their formulas for blocks and frames
//! body         those of any rigid body on two edges, of its weaker side
//! record       ground acceleration, piecewise linear in time
//! reference    equation of motion, uplift, impact (Eqs. 4 to 6) as printed, in small steps: read this first
//! taylor       the equation of motion (Eq. 4): rotation over one step as a Taylor polynomial
//! uplift       when a structure at rest leaves its base (Eq. 5)
//! vector       SIMD numbers, one structure to a lane
//! lanes        state of the structures in the lanes: rest, uplift, rocking
//! step         one step of all lanes: impact (Eq. 6), peak, overturning
//! roots        roots of the step's polynomials, all lanes at once
//! polynomial   roots of one lane's polynomial, by Bernstein coefficients
//! response     outcome, demand (Eq. 7), and free rocking after the record in closed form
//! batch        many structures and records; a lane that is done takes the next
//! incremental  one motion at rising intensity: where a structure overturns, and where it is safe again
//! ```

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
