//! Newton's method for a likelihood, free or along a constraint.

use nalgebra::{DMatrix, DVector};

/// The most steps.
const MOST_STEPS: usize = 100;
/// The shortest share of a step that is tried.
const LEAST_SHARE: f64 = 1e-9;
/// What a value may lose in a step, as a share of it: its rounding.
const ROUNDING: f64 = 1e-12;

/// A function to be maximised, with its derivatives.
#[derive(Debug, Clone)]
pub struct Objective {
    pub value: f64,
    /// Its first derivatives.
    pub gradient: DVector<f64>,
    /// A positive definite stand-in for the negative of its second derivatives.
    pub information: DMatrix<f64>,
}

/// Where the iterations ended.
#[derive(Debug, Clone)]
pub struct Maximum {
    pub at: DVector<f64>,
    /// The function there, or a last small step before.
    pub objective: Objective,
    /// Newton steps that it took.
    pub steps: usize,
}

/// Where a search may go from its start.
#[derive(Debug, Clone, Copy)]
pub enum Along<'a> {
    All,
    /// Only along the columns of this matrix: the constraint that the start fulfils goes on to hold.
    Columns(&'a DMatrix<f64>),
}

/// Maximises a function by Newton's method with step halving, until a step promises to gain less than `tolerance` (or the rounding
/// of the value): a maximum of a concave function; of another, a place from which no step leads up. None if that does not happen, or
/// the information is singular.
pub fn maximise(
    objective: impl Fn(&DVector<f64>) -> Objective,
    start: &DVector<f64>,
    along: Along,
    tolerance: f64,
) -> Option<Maximum> {
    let mut at = start.clone();
    let mut here = objective(&at);
    for steps in 1..=MOST_STEPS {
        let step = newton_step(&here, along)?;
        let promised = 0.5 * step.dot(&here.gradient);
        if promised <= tolerance.max(1e-20 * (1.0 + here.value.abs())) {
            // So small a step needs no look where it leads.
            return here.value.is_finite().then_some(Maximum { at: at + step, objective: here, steps });
        }
        match ascend(&objective, &at, &step, &here) {
            Some((next, there)) if next != at => (at, here) = (next, there),
            // What the step promises is the rounding of the value, or the function is not what its derivatives say.
            _ if promised <= ROUNDING * (1.0 + here.value.abs()) => {
                return here.value.is_finite().then_some(Maximum { at, objective: here, steps });
            }
            _ => return None,
        }
    }
    None
}

/// The step to the maximum of the quadratic model.
pub fn newton_step(here: &Objective, along: Along) -> Option<DVector<f64>> {
    match along {
        Along::All => Some(here.information.clone().cholesky()?.solve(&here.gradient)),
        Along::Columns(directions) => {
            let information = directions.tr_mul(&here.information.tr_mul(directions));
            let gradient = directions.tr_mul(&here.gradient);
            Some(directions * information.cholesky()?.solve(&gradient))
        }
    }
}

/// The longest of the step and its halves that does not lower the function; none if each does.
fn ascend(
    objective: impl Fn(&DVector<f64>) -> Objective,
    from: &DVector<f64>,
    step: &DVector<f64>,
    here: &Objective,
) -> Option<(DVector<f64>, Objective)> {
    let least = here.value - ROUNDING * (1.0 + here.value.abs());
    let mut share = 1.0;
    while share > LEAST_SHARE {
        let to = from + step * share;
        let there = objective(&to);
        if there.value >= least {
            return Some((to, there));
        }
        share *= 0.5;
    }
    None
}
