//! The tree by the models of the paper: P_ex by its planes, P_ro by its curves.

use super::demand::DemandFit;
use super::overturning::OverturningFit;
use super::tree::{GivenRocking, Probabilities, Probability, p_no_rocking};
use crate::motion::IntensityMeasures;

/// Computes the probabilities of the tree (Eq. 12) from the demand fit that holds at the IM4 and a curve of
/// overturning, NaN of P_ex without such a fit; `demand` are the two planes, or one regression that holds
/// everywhere.
pub fn paper_probabilities(
    demand: &[DemandFit],
    overturning: &OverturningFit,
    measures: &IntensityMeasures,
    limit_state: f64,
    confidence: f64,
) -> Probabilities {
    let given_rocking = || {
        let p_ro = overturning.p_overturning(measures, confidence)?;
        let demand = demand.iter().find(|fit| fit.holds_at(measures.im4));
        Some(match demand.and_then(|demand| demand.p_exceeding(measures, limit_state, confidence)) {
            Some(p_ex) => GivenRocking { p_ex, p_ro, p_failure: Probability::of_failure(p_ro, p_ex) },
            None => {
                let unknown = Probability::exact(f64::NAN);
                GivenRocking { p_ex: unknown, p_ro, p_failure: unknown }
            }
        })
    };
    let p_nr = p_no_rocking(measures.im4);
    Probabilities { p_nr, given_rocking: if p_nr == 0.0 { given_rocking() } else { None } }
}
