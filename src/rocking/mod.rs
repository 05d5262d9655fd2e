//! The response of a free-standing rocking block or frame to a ground motion (section 2.2).
//!
//! ```text
//! structure  p, alpha, eta and where they come from
//! record     the ground acceleration as a piecewise-linear function of time
//! taylor     the rotation over one step, as the polynomial of its Taylor series
//! polynomial roots of such polynomials: impacts, peaks and overturning are found as these
//! observer   who looks on while a structure rocks, and the side to which it leans
//! uplift     when a structure at rest leaves its base
//! march      from rest to uplift, impact, re-uplift, overturning: one record, one structure
//! tail       what happens after the record has ended, in closed form
//! response   the outcome and the engineering demand parameter
//! batch      many structures and records at once, one in each lane of a vector register
//! lanes      where each lane stands; lane_step what march does, for all of them; real, vector and lane_roots their numbers
//!            and roots
//! incremental  one motion at rising intensity: where a structure overturns, and which stronger motions it survives
//! trace      the same march, observed: rotation, velocity and events over time
//! ```

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
mod tail;
mod taylor;
mod trace;
mod uplift;
mod vector;

pub use batch::{Problem, Simd, simulate_all};
pub use incremental::{Capacity, CapacityStatus, Look, SafeWindow, Scan, ScanResponse};
pub use march::simulate;
pub use record::{Record, RecordError};
pub use response::{Outcome, Response};
pub use structure::{Structure, StructureError, frame_eta, frame_p, housner_eta, rectangular_p};
pub use trace::{Event, TracePoint, trace, with_tail};
