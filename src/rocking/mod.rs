//! The response of a free-standing rocking block or frame to a ground motion (section 2.2).
//!
//! ```text
//! structure    p, alpha, eta and where they come from
//! record       the ground acceleration as a piecewise-linear function of time
//! reference    Eqs. 4 to 6, motion, uplift and impact, as the paper writes them: read this first
//! taylor       the equation of motion (Eq. 4): the rotation over one step as a Taylor polynomial
//! uplift       where a structure at rest leaves its base (Eq. 5)
//! vector       the numbers in which all of this is written: one or several to a register, a lane each
//! lanes        the states of the structures in the lanes: rest, uplift, rocking
//! step         a step of all lanes: impact, peak, overturning
//! roots        where these are: roots of the step's polynomials; polynomial: of one lane, by Bernstein coefficients
//! response     the outcome, the demand (Eq. 7), and free rocking after the record in closed form
//! batch        many structures and records, as lanes come free; trace: one, with rotation, velocity and events over time
//! incremental  one motion at rising intensity: where a structure overturns, and which stronger motions it survives
//! ```

mod batch;
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
mod trace;
mod uplift;
mod vector;

pub use batch::{simulate, simulate_all};
pub use incremental::{Capacity, CapacityStatus, SafeWindow, Scan, ScanPoint, ScanResponse};
pub use lanes::Problem;
pub use record::{Record, RecordError};
pub use reference::trace;
pub use response::{Outcome, Response};
pub use structure::{
    BOUNDS, Block, Bound, Structure, StructureError, frame_eta, frame_p, housner_eta, judge, rectangular_p,
};
pub use trace::{SolverEvent, TracePoint, with_tail};
