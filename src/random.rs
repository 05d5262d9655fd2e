//! Counter-based random streams: the numbers of a row do not depend on which other rows are made.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// What random numbers are for. Streams of different purposes are independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The order of the strata of a Latin hypercube; the row is the cell times the dimensions plus the dimension.
    Strata,
    /// The place of a sample within its stratum, or in the unit cube; the row is the scenario.
    Sample,
    /// The noise of the stochastic motion; the row is the scenario. Two files of scenarios of one seed share the noise of rows of the
    /// same number: a grid of one cell has that of the first cell of any other.
    Noise,
    /// The rows of a resample; the row is the replicate.
    Bootstrap,
}

impl Purpose {
    fn label(self) -> &'static str {
        match self {
            Purpose::Strata => "strata",
            Purpose::Sample => "sample",
            Purpose::Noise => "noise",
            Purpose::Bootstrap => "bootstrap",
        }
    }
}

/// Returns the stream of random numbers of a seed, a purpose and a row: ChaCha with 8 rounds, whose key comes from seed and
/// purpose and whose stream number is the row.
pub fn stream(seed: u64, purpose: Purpose, row: u64) -> ChaCha8Rng {
    let key = blake3::hash(format!("rockfrag {} {seed}", purpose.label()).as_bytes());
    let mut generator = ChaCha8Rng::from_seed(*key.as_bytes());
    generator.set_stream(row);
    generator
}
