//! Simulates many structures and records, one in each lane of the vector registers.

use pulp::{Arch, Simd, WithSimd};

use super::lanes::{Lanes, Problem};
use super::record::Record;
use super::response::Response;
use super::structure::Structure;

/// Simulates a structure, initially at rest, through a record and the free rocking after it.
pub fn simulate(structure: &Structure, record: &Record) -> Response {
    simulate_all(&[Problem { structure, record: *record }])[0]
}

/// Simulates the problems in the widest vector registers, independently of each other. Returns one response
/// for each, in order.
pub fn simulate_all(problems: &[Problem]) -> Vec<Response> {
    Arch::new().dispatch(ProblemBatch { problems })
}

struct ProblemBatch<'a> {
    problems: &'a [Problem<'a>],
}

impl WithSimd for ProblemBatch<'_> {
    type Output = Vec<Response>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, registers: S) -> Vec<Response> {
        let mut lanes = Lanes::new(registers, self.problems);
        while lanes.busy != 0 {
            let step = lanes.step();
            let events = lanes.advance(&step);
            if events.any() {
                lanes.handle(events);
            }
        }
        lanes.responses
    }
}
