//! The options that the fits and the studies of them share, checked.

use crate::fragility::Uncertainty;
use crate::pipeline::options::{DEFAULT_SEED, check};
use crate::rocking::Bound;

/// Upper bound that catches typing errors.
const MOST_REPLICATES: usize = 1_000_000;

/// The demand |theta|max / alpha that P_ex is about: safe rocking hardly passes 1.
pub const LIMIT_STATE: Bound = Bound {
    parameter: "limit-state",
    range: (f64::MIN_POSITIVE, 1.0),
    expected: "a demand |theta|max / alpha above 0, up to 1",
    slip: "is it in percent?",
};

/// Checks the options `--bootstrap`, `--confidence` and `--seed`.
///
/// # Errors
/// If one is out of range.
pub fn uncertainty(replicates: usize, confidence: f64, seed: Option<u64>) -> anyhow::Result<Uncertainty> {
    check(replicates <= MOST_REPLICATES, "bootstrap", replicates, "up to 1,000,000 replicates")?;
    let possible = (0.5..1.0).contains(&confidence);
    check(possible, "confidence", confidence, "a probability from 0.5 to below 1")?;
    Ok(Uncertainty { replicates, confidence, seed: seed.unwrap_or(DEFAULT_SEED) })
}
