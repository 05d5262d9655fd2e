//! The response of a free-standing rocking block or frame to a ground motion (section 2.2).
//!
//! ```text
//! structure    p, alpha, eta and where they come from
//! record       the ground acceleration as a piecewise-linear function of time
//! taylor       the equation of motion (Eqs. 8 to 11): the rotation over one step as a Taylor polynomial
//! polynomial   roots of such polynomials: impacts, peaks and overturning are found as these
//! march        one structure through one record: uplift, impact, rest, overturning
//! response     the outcome, the demand (Eq. 7), and free rocking after the record in closed form
//! observer     callbacks for the events of a simulation; trace: rotation, velocity and events over time
//! batch        many structures and records at once, one in each lane of a vector register
//! lanes        the states of the lanes; lane_step: what march does, for all of them; lane_roots: their roots
//! real         the numbers in which all of this is written: f64, or a vector of lanes
//! incremental  one motion at rising intensity: where a structure overturns, and which stronger motions it survives
//! ```

#![deny(clippy::disallowed_methods)]

mod batch;
mod incremental;
mod lane_roots;
mod lane_step;
mod lanes;
mod march;
mod observer;
mod polynomial;
mod real;
mod record;
mod response;
mod structure;
mod taylor;
mod trace;

pub use batch::{Problem, Simd, simulate_all};
pub use incremental::{Capacity, CapacityStatus, SafeWindow, Scan, ScanPoint, ScanResponse};
pub use march::simulate;
pub use record::{Record, RecordError};
pub use response::{Outcome, Response};
pub use structure::{
    BOUNDS, Block, Bound, Structure, StructureError, frame_eta, frame_p, housner_eta, judge, rectangular_p,
};
pub use trace::{SolverEvent, TracePoint, trace, with_tail};
