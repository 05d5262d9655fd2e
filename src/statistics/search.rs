//! Roots and minima of functions of one variable, by Brent's methods (`argmin`).

use argmin::core::{CostFunction, Executor, IterState, Solver, State};
use argmin::solver::brent::{BrentOpt, BrentRoot};

/// Evaluations before a search counts as failed; Brent's methods need some ten.
const MOST_TRIALS: u64 = 200;

/// Finds where `f` is zero between two values at which its signs differ, to within `tolerance`. None if `f` has no value
/// where it is asked for one, or has the same sign at both ends.
pub fn root(f: impl Fn(f64) -> Option<f64>, (from, to): (f64, f64), tolerance: f64) -> Option<f64> {
    run(f, BrentRoot::new(from, to, tolerance))
}

/// Finds a minimum of `f` between two values, to within `tolerance`: the only one if `f` has one. None if `f` has no value
/// where it is asked for one.
pub fn minimum(f: impl Fn(f64) -> Option<f64>, (from, to): (f64, f64), tolerance: f64) -> Option<f64> {
    run(f, BrentOpt::new(from, to).set_tolerance(f64::EPSILON.sqrt(), tolerance))
}

/// A function of one variable, as argmin asks for it.
struct Objective<F>(F);

impl<F: Fn(f64) -> Option<f64>> CostFunction for Objective<F> {
    type Param = f64;
    type Output = f64;

    fn cost(&self, at: &f64) -> Result<f64, argmin::core::Error> {
        (self.0)(*at).filter(|value| !value.is_nan()).ok_or_else(|| argmin::core::Error::msg("no value"))
    }
}

fn run<F, S>(f: F, solver: S) -> Option<f64>
where
    F: Fn(f64) -> Option<f64>,
    S: Solver<Objective<F>, IterState<f64, (), (), (), (), f64>>,
{
    let search =
        Executor::new(Objective(f), solver).timer(false).configure(|state| state.max_iters(MOST_TRIALS));
    let state = search.run().ok()?.state;
    state.get_param().copied().filter(|_| state.get_iter() < MOST_TRIALS)
}
